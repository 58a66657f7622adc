"""Families of matrices in memory: polynomials, functions, samples."""

import io
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Optional, Union

import h5py
import numpy as np

from . import toml

Matrices = Any  # one matrix, a list of them by powers of the parameter, or a dict by powers and names
Range = tuple[Any, Any]


class Family:
    """M(p) x'' + C(p) x' + K(p) x = 0, or E(p) x' = A(p) x, with matrices in memory.

    Each of `M`, `C`, `K`, `E`, `A` is one matrix (numpy or scipy.sparse), a list of matrices for the powers 0, 1, ... of the
    parameter, or a dict by powers and names; `factors` gives what a name is multiplied with, an expression of `parameters`.
    Sparse matrices stay sparse.

        Family(M=M, C=[C0, G], K=K, parameter="omega")             # C = C0 + omega G
        Family(M=M, K={0: K0, "bearing": Kb}, factors={"bearing": "k"}, parameters={"k": 1e6, "omega": 0}, parameter="omega")
        Family(lambda omega: dict(M=M, C=C0 + omega * G, K=K))    # called only where needed

    A function is given as the first argument: p -> dict of matrices. It is called a few dozen times at Chebyshev points of
    the range, as often as `function_tolerance` (of every entry, relative; by default a thousandth of the tolerance of the
    trace) needs, `max_calls` times at most; `breaks` are places where its matrices have a jump or a kink.

    `parameter` is the name of the parameter, by default the one that is traced; `unit` its unit, for labels; `names` the
    names of the coordinates, n of them.

    >>> import eigentrail as et, numpy as np
    >>> family = et.Family(M=np.eye(1), K=[[[1.0]], [[3.0]]], parameter="p")     # K = 1 + 3 p
    >>> et.trace(family, p=(0, 1)).natural_frequency.values[[0, -1], 0].round(6)
    array([1., 2.])
    >>> family = et.Family(lambda p: dict(M=np.eye(1), K=[[1.0 + 3.0 * p]]))
    >>> et.trace(family, p=(0, 1)).natural_frequency.values[[0, -1], 0].round(6)
    array([1., 2.])
    """

    def __init__(self, function: Optional[Callable[[float], Mapping[str, Any]]] = None, *, M: Matrices = None,
                 C: Matrices = None, K: Matrices = None, E: Matrices = None, A: Matrices = None,
                 parameter: Optional[str] = None, unit: str = "", names: Optional[Sequence[str]] = None,
                 factors: Optional[Mapping[str, Any]] = None, parameters: Optional[Mapping[str, Any]] = None,
                 title: str = "", function_tolerance: Optional[float] = None, max_calls: int = 1000,
                 breaks: Sequence[float] = ()):
        given = {key: value for key, value in dict(M=M, C=C, K=K, E=E, A=A).items() if value is not None}
        if (function is None) == (not given):
            raise TypeError("expected matrices M, C, K or E, A, or a function that returns them")
        if function is not None and not callable(function):
            raise TypeError(f"expected a function of the parameter, found {type(function).__name__}; "
                            "matrices have keywords: Family(M=..., K=...)")
        self.function = function
        self.matrices = {key: _by_name(key, value) for key, value in given.items()}
        self.parameter, self.unit, self.title = parameter, unit, title
        self.names = None if names is None else [str(name) for name in names]
        self.factors, self.parameters = dict(factors or {}), dict(parameters or {})
        self.function_tolerance, self.max_calls, self.breaks = function_tolerance, max_calls, list(breaks)

    def scene(self, parameter: str, span: Optional[Range], file: str = "family.h5") -> str:
        """The scene of the family as text (TOML); its matrices are in `file`."""
        tables: dict[str, Any] = {"title": self.title} if self.title else {}
        declared = dict(self.parameters)
        if parameter not in declared and (self.unit or self.function is not None):
            begin = span[0] if span else 0.0
            declared[parameter] = {"value": begin, "unit": self.unit} if self.unit else begin
        if declared:
            tables["parameters"] = declared
        tables["trace"] = {"parameter": parameter}
        if span is not None:
            tables["trace"].update({"from": span[0], "to": span[1]})
        if self.function is None:
            tables["matrix_family"] = {"file": file, **({"factors": self.factors} if self.factors else {}),
                                       **({"state_names": self.names} if self.names is not None else {})}
        return toml.dumps(tables)

    def is_dense_polynomial(self) -> bool:
        """Whether the engine can take the matrices where they are: dense ones of powers only."""
        return self.function is None and not self.factors and not any(
            _is_sparse(matrix) for terms in self.matrices.values() for matrix in terms.values())

    def image(self) -> bytes:
        """The matrices as an HDF5 file, in the layout of [matrix_family]."""
        buffer = io.BytesIO()
        with h5py.File(buffer, "w") as file:
            for key, terms in self.matrices.items():
                for name, matrix in terms.items():
                    _write_matrix(file, f"{key}/{name}", matrix)
        return buffer.getvalue()

    def save(self, path: Union[str, "os.PathLike[str]"], span: Optional[Range] = None) -> str:
        """Writes `path` (.toml), the scene, and the matrices beside it (.h5), for the program. Returns the path."""
        if self.function is not None:
            raise ValueError("a family that a function gives cannot be written; sample it: eigentrail.Samples")
        return _save(self, path, span)


class Samples:
    """Matrices at values `p` of the parameter, not equidistant in general: arrays of shape (len(p), n, n).

        Samples(p, M=M, C=C, K=K, parameter="omega", unit="rad/s")

    An interpolant is chosen by the samples; its estimated error goes to every eigenvalue. `digits` is the number of
    significant digits of the entries. A matrix that does not change may be given once, n x n.

    >>> import eigentrail as et, numpy as np
    >>> p = np.array([0.0, 0.3, 0.7, 1.0])
    >>> loci = et.trace(et.Samples(p, M=np.eye(1), K=[[[1.0 + 3.0 * one]] for one in p]), p=(0, 1))
    >>> loci.natural_frequency.values[[0, -1], 0].round(6), bool(loci.interpolation_error.max() < 1e-12)
    (array([1., 2.]), True)
    """

    function = None

    def __init__(self, p: Any, *, M: Any = None, C: Any = None, K: Any = None, E: Any = None, A: Any = None,
                 parameter: Optional[str] = None, unit: str = "", names: Optional[Sequence[str]] = None,
                 units: Optional[Sequence[str]] = None, digits: Optional[int] = None, kinks: Sequence[float] = (),
                 title: str = ""):
        self.p = np.atleast_1d(np.asarray(p, float))
        given = {key: value for key, value in dict(M=M, C=C, K=K, E=E, A=A).items() if value is not None}
        if not given:
            raise TypeError("expected samples of matrices: A (and E), or K with M or C")
        self.samples = {key: _samples(key, value, self.p.size) for key, value in given.items()}
        self.parameter, self.unit, self.title = parameter, unit, title
        self.names = None if names is None else [str(name) for name in names]
        self.units = None if units is None else [str(name) for name in units]
        self.digits, self.kinks = digits, list(kinks)

    def scene(self, parameter: str, span: Optional[Range], file: str = "family.h5") -> str:
        """The scene of the family as text (TOML); its samples are in `file`."""
        begin, end = span if span is not None else (self.p.min(), self.p.max())
        tables: dict[str, Any] = {"title": self.title} if self.title else {}
        tables["parameters"] = {parameter: {"value": begin, "unit": self.unit} if self.unit else begin}
        tables["trace"] = {"parameter": parameter, "from": begin, "to": end}
        tables["sampled_family"] = {"file": file}
        if self.kinks:
            tables["sampled_family"]["kinks"] = self.kinks
        if self.digits is not None:
            tables["sampled_family"]["digits"] = self.digits
        return toml.dumps(tables)

    def image(self) -> bytes:
        """The samples as an HDF5 file, in the layout of [sampled_family]."""
        buffer = io.BytesIO()
        with h5py.File(buffer, "w") as file:
            file["parameter"] = self.p
            if self.unit:
                file["parameter"].attrs["units"] = self.unit
            for key, samples in self.samples.items():
                file[key] = samples
            for name, texts in (("state_names", self.names), ("state_units", self.units)):
                if texts is not None:
                    file[name] = np.array(texts, dtype=h5py.string_dtype())
        return buffer.getvalue()

    def save(self, path: Union[str, "os.PathLike[str]"], span: Optional[Range] = None) -> str:
        """Writes `path` (.toml), the scene, and the samples beside it (.h5), for the program. Returns the path."""
        return _save(self, path, span)


class StateSpace(Samples):
    """E x' = A x at values `p` of the parameter: `A` (and `E`) of shape (len(p), n, n), as linearizations come.

        StateSpace(A, p, names=["q1", "q2"], digits=4)

    >>> import eigentrail as et, numpy as np
    >>> p = [0.0, 0.3, 0.7, 1.0]
    >>> loci = et.trace(et.StateSpace([[[0, 1], [-1 - 3 * one, 0]] for one in p], p), p=(0, 1))
    >>> loci.natural_frequency.values[[0, -1], 0].round(6)
    array([1., 2.])
    """

    def __init__(self, A: Any, p: Any, E: Any = None, **more: Any):
        super().__init__(p, A=A, E=E, **more)


def _by_name(key: str, value: Matrices) -> dict[str, Any]:
    if isinstance(value, Mapping):
        return {str(name): _matrix(f"{key}[{name!r}]", item) for name, item in value.items()}
    if _is_sparse(value) or np.ndim(value) == 2:
        return {"0": _matrix(key, value)}
    if isinstance(value, (list, tuple, np.ndarray)):
        return {str(power): _matrix(f"{key}[{power}]", item) for power, item in enumerate(value)}
    raise TypeError(f"{key}: expected a matrix, a list of matrices or a dict of matrices, found {type(value).__name__}")


def _matrix(label: str, value: Any) -> Any:
    if _is_sparse(value):
        return value.tocsr()
    matrix = _real(label, value)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise ValueError(f"{label}: expected a square matrix, found an array of shape {matrix.shape}")
    return matrix


def _samples(key: str, value: Any, count: int) -> Any:
    array = _real(key, value)
    if array.ndim == 2:
        array = np.broadcast_to(array, (count, *array.shape))
    if array.ndim != 3 or array.shape[0] != count or array.shape[1] != array.shape[2]:
        raise ValueError(f"{key}: expected {count} square matrices, an array of shape ({count}, n, n); found the shape "
                         f"{array.shape}")
    return array


def _real(label: str, value: Any) -> Any:
    if np.iscomplexobj(value):
        raise ValueError(f"{label}: expected real numbers, found complex ones")
    try:
        return np.asarray(value, float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{label}: expected a matrix of numbers: {error}") from None


def _is_sparse(value: Any) -> bool:
    return hasattr(value, "tocsr")


def _write_matrix(file: Any, name: str, matrix: Any) -> None:
    if not _is_sparse(matrix):
        file[name] = matrix
        return
    for part in ("data", "indices", "indptr"):
        file[f"{name}/{part}"] = getattr(matrix, part)


def _save(family: Any, path: Union[str, "os.PathLike[str]"], span: Optional[Range]) -> str:
    scene = os.fspath(path)
    if not scene.endswith(".toml"):
        raise ValueError(f"{scene}: expected the name of a scene, *.toml")
    if family.parameter is None:
        raise ValueError("expected the name of the parameter: Family(..., parameter=...)")
    matrices = scene[:-len(".toml")] + ".h5"
    text = family.scene(family.parameter, span, os.path.basename(matrices))
    with open(matrices, "wb") as file:
        file.write(family.image())
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    return scene
