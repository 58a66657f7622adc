"""Families of matrices in memory: polynomials, functions, samples."""

import io
import os
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any, Optional, Union

import numpy as np

from . import files, matrices, toml
from .checked import checked
from .errors import SceneError

Matrices = Any  # one matrix, a list of them by powers of the parameter, or a dict by powers and names
Range = tuple[Any, Any]


class InMemory:
    """What all families share: labels, and the files that the program reads."""

    function: Optional[Callable[[float], Mapping[str, Any]]] = None
    parameters: Mapping[str, Any] = {}
    span: Optional[Range] = None  # the range where none is given
    table: str  # of the scene, that names the file of the matrices
    keys: Mapping[str, Any]  # others of this table; those that are empty are left out
    datasets: Mapping[str, Any]  # of the file, by their names

    def __init__(self, labelled: Mapping[str, Any], parameter: Optional[str], unit: str, names: Optional[Iterable[Any]],
                 title: str):
        self.parameter, self.unit, self.title, self.names = parameter, unit, title, _texts(names)
        _require_names(self.names, labelled)

    def scene(self, parameter: str, span: Optional[Range], file: str = "family.h5") -> str:
        """The scene of the family as text (TOML); its matrices are in `file`."""
        span, declared = span or self.span, dict(self.parameters)
        keys = {name: value for name, value in self.keys.items() if value not in (None, [], {})}
        table = {} if self.function is not None else {self.table: {"file": file, **keys}}
        if parameter not in declared and (self.unit or "matrix_family" not in table):
            begin = span[0] if span else 0.0
            declared[parameter] = {"value": begin, "unit": self.unit} if self.unit else begin
        tables = {"title": self.title, "parameters": declared,
                  "trace": {"parameter": parameter, **dict(zip(("from", "to"), span or ()))}, **table}
        return toml.dumps({name: value for name, value in tables.items() if value})

    def image(self) -> bytes:
        """The matrices as an HDF5 file, in the layout of [matrix_family] or [sampled_family]."""
        import h5py

        buffer = io.BytesIO()
        with h5py.File(buffer, "w") as file:
            for name, values in self.datasets.items():
                if matrices.is_sparse(values):
                    for part in ("data", "indices", "indptr"):
                        file[f"{name}/{part}"] = getattr(values, part)
                else:
                    file[name] = values
            if self.unit and "parameter" in file:
                file["parameter"].attrs["units"] = self.unit
        return buffer.getvalue()

    def save(self, path: Union[str, os.PathLike[str]], span: Optional[Range] = None, overwrite: bool = False) -> str:
        """Writes `path` (.toml), the scene, and the matrices beside it (.h5), for the program. Returns the path. Files that
        exist are kept (FileExistsError), unless `overwrite`."""
        if self.function is not None:
            raise SceneError("a family that a function gives cannot be written; sample it: eigentrail.Samples")
        scene = os.fspath(path)
        if not scene.endswith(".toml"):
            raise SceneError(f"{scene}: expected the name of a scene, *.toml")
        if self.parameter is None:
            raise SceneError("expected the name of the parameter: Family(..., parameter=...)")
        beside = scene[:-len(".toml")] + ".h5"
        files.write({beside: self.image(), scene: self.scene(self.parameter, span, os.path.basename(beside)).encode()},
                    overwrite)
        return scene

    def _described(self, what: str) -> str:
        unit = f" ({self.unit})" if self.unit else ""
        return what + (f", parameter {self.parameter}{unit}" if self.parameter else "")


class Family(InMemory):
    """M(p) x'' + C(p) x' + K(p) x = 0, or E(p) x' = A(p) x, with matrices in memory.

    Each of `M`, `C`, `K`, `E`, `A` is one matrix (numpy or scipy.sparse), a list of matrices for the powers 0, 1, ... of the
    parameter, or a dict by powers and names; `factors` gives what a name is multiplied with, an expression of `parameters`.
    Sparse matrices stay sparse. The family has copies, with exactly the given numbers; SceneError for complex matrices, masked
    entries, and numbers that double precision does not hold.

        Family(M=M, C=[C0, G], K=K, parameter="omega")             # C = C0 + omega G
        Family(M=M, K={0: K0, "bearing": Kb}, factors={"bearing": "k"}, parameters={"k": 1e6, "omega": 0}, parameter="omega")
        Family(lambda omega: dict(M=M, C=C0 + omega * G, K=K))    # called only where needed

    A function is given as the first argument: p -> dict of matrices. It is called at Chebyshev points of the range, as often
    as `function_tolerance` (of every entry, relative; by default a thousandth of the tolerance of the trace) needs, and
    between them so that no two calls are farther apart than `resolution`, a share of the range: narrower bumps may be
    missed, and what is certified is so down to this width. `max_calls` times at most; `breaks` are places where its matrices
    have a kink; the two sides of a jump are two families.

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

    @checked
    def __init__(self, function: Optional[Callable[[float], Mapping[str, Any]]] = None, *, M: Matrices = None,
                 C: Matrices = None, K: Matrices = None, E: Matrices = None, A: Matrices = None,
                 parameter: Optional[str] = None, unit: str = "", names: Optional[Iterable[Any]] = None,
                 factors: Optional[Mapping[str, Any]] = None, parameters: Optional[Mapping[str, Any]] = None,
                 title: str = "", function_tolerance: Optional[float] = None, max_calls: int = 1000,
                 resolution: float = 0.01, breaks: Sequence[float] = ()):
        given = _given(dict(M=M, C=C, K=K, E=E, A=A))
        if (function is None) == (not given):
            raise TypeError("expected matrices M, C, K or E, A, or a function that returns them")
        if function is not None and not callable(function):
            raise TypeError(f"expected a function of the parameter, found {type(function).__name__}; "
                            "matrices have keywords: Family(M=..., K=...)")
        self.function = function
        self.matrices = {key: matrices.terms(key, value) for key, value in given.items()}
        super().__init__(_labelled(self.matrices), parameter, unit, names, title)
        self.factors, self.parameters = dict(factors or {}), dict(parameters or {})
        self.function_tolerance, self.max_calls = function_tolerance, max_calls
        self.resolution, self.breaks = resolution, list(breaks)
        self.table, self.keys = "matrix_family", {"factors": self.factors, "state_names": self.names}
        self.datasets = {f"{key}/{name}": matrix for key, terms in self.matrices.items() for name, matrix in terms.items()}

    def __repr__(self) -> str:
        if self.function is not None:
            return self._described(f"Family of the function {getattr(self.function, '__name__', self.function)}")
        labelled = _labelled(self.matrices)
        terms = "; ".join(label + (" sparse" if matrices.is_sparse(matrix) else "") for label, matrix in labelled.items())
        size = next(iter(labelled.values())).shape[0]
        return self._described(f"Family of matrices {size} x {size}: {terms}")

    def at(self, p: float, parameter: str) -> dict[str, Any]:
        """The matrices that the function gives at p, dense. What it raises gets a note with the value."""
        try:
            returned = self.function(p)  # type: ignore[misc]
        except Exception as error:
            error.add_note(f"raised by the function of the family, at {parameter} = {p!r}")
            raise
        where = f"the function of the family, at {parameter} = {p!r}"
        if not isinstance(returned, Mapping):
            raise SceneError(f"{where}: expected a dict with matrices M, C, K or E, A; found {type(returned).__name__}")
        unknown = [key for key in returned if key not in ("M", "C", "K", "E", "A")]
        if unknown:
            raise SceneError(f"{where}: expected a dict with matrices M, C, K or E, A; found the key {unknown[0]!r}")
        try:
            _require_equations(returned)
            found = {key: matrices.dense(matrices.matrix(key, value)) for key, value in returned.items()}
            _require_names(self.names, found)
        except SceneError as error:
            raise SceneError(f"{where}: {error}") from None
        return found

    def is_dense_polynomial(self) -> bool:
        """Whether the engine can take the matrices where they are: dense ones of powers only."""
        return not (self.function or self.factors or any(map(matrices.is_sparse, self.datasets.values())))


class Samples(InMemory):
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

    @checked
    def __init__(self, p: Any, *, M: Any = None, C: Any = None, K: Any = None, E: Any = None, A: Any = None,
                 parameter: Optional[str] = None, unit: str = "", names: Optional[Iterable[Any]] = None,
                 units: Optional[Iterable[Any]] = None, digits: Optional[int] = None, kinks: Sequence[float] = (),
                 title: str = ""):
        self.p = np.atleast_1d(matrices.exact("p", p))
        given = _given(dict(M=M, C=C, K=K, E=E, A=A))
        if not given:
            raise TypeError("expected samples of matrices: A (and E), or K with M or C")
        self.samples = {key: matrices.samples(key, value, self.p.size) for key, value in given.items()}
        super().__init__({key: samples[0] for key, samples in self.samples.items()}, parameter, unit, names, title)
        self.span = (self.p.min(), self.p.max())
        self.table, self.keys = "sampled_family", {"kinks": list(kinks), "digits": digits}
        labels = {"state_names": self.names, "state_units": _texts(units)}
        self.datasets = {"parameter": self.p, **self.samples, **{name: texts for name, texts in labels.items() if texts is not None}}

    def __repr__(self) -> str:
        size = next(iter(self.samples.values())).shape[-1]
        return self._described(f"{type(self).__name__} of {', '.join(self.samples)}, {size} x {size}, at {self.p.size} values "
                               f"from {self.p.min():g} to {self.p.max():g}")


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


def _given(matrices: Mapping[str, Any]) -> dict[str, Any]:
    """Matrices that were given, which must be those of one kind of equations."""
    given = {key: value for key, value in matrices.items() if value is not None}
    if given:
        _require_equations(given)
    return given


def _require_equations(given: Collection[str]) -> None:
    second, first = {"M", "C", "K"} & set(given), {"E", "A"} & set(given)
    if second and first:
        raise SceneError(f"expected M, C, K or E, A; found {', '.join(given)}")
    if second and ("K" not in given or len(second) < 2):
        raise SceneError(f"expected K with M, C or both; found {', '.join(given)}")
    if first and "A" not in given:
        raise SceneError("expected A, and E if it is not the identity; found E")


def _require_names(names: Optional[Sequence[str]], labelled: Mapping[str, Any]) -> None:
    """SceneError unless all matrices have one size, with a name for each coordinate."""
    label, first = matrices.require_one_size(labelled)
    if names is not None and first is not None and len(names) != first.shape[-1]:
        raise SceneError(f"names: expected {first.shape[-1]} of them, one per row of {label}; found {len(names)}")


def _labelled(terms: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    return {key if list(by_name) == ["0"] else f"{key}[{name}]": matrix
            for key, by_name in terms.items() for name, matrix in by_name.items()}


def _texts(given: Optional[Iterable[Any]]) -> Optional[list[str]]:
    return None if given is None else [str(one) for one in given]
