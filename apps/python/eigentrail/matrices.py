"""Matrices that users give, as doubles with exactly the same values.

Every entry of the package for matrices (`Family`, functions, `Samples`, `StateSpace`, tables of a scene) converts here.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import SceneError

NUMBERS = "biufcO"  # kinds of dtypes that can hold numbers: bool, integers, floats, complex, objects
DOUBLED = "np.block([[X.real, -X.imag], [X.imag, X.real]])"


def terms(label: str, given: Any) -> dict[str, Any]:
    """Matrices by names: those of a dict, of a list by powers "0", "1", ..., or the only one."""
    if isinstance(given, Mapping):
        return {str(name): matrix(f"{label}[{name!r}]", value) for name, value in given.items()}
    if dimensions(given) == 3:
        return {str(power): matrix(f"{label}[{power}]", value) for power, value in enumerate(given)}
    return {"0": matrix(label, given)}


def matrix(label: str, given: Any) -> Any:
    """A square matrix: an array of shape (n, n) in C order, or a csr_matrix for what scipy.sparse has; always a copy."""
    found = _sparse(label, given) if is_sparse(given) else exact(label, given)
    if found.ndim != 2 or found.shape[0] != found.shape[1]:
        advice = f"; a diagonal matrix is np.diag({label})" if found.ndim == 1 else ""
        raise SceneError(f"{label}: expected a square matrix, found an array of shape {found.shape}{advice}")
    if not np.isfinite(found.data if is_sparse(found) else found).all():
        raise SceneError(f"{label}: has an entry that is not finite")
    return found


def samples(label: str, given: Any, count: int) -> Any:
    """`count` square matrices, an array (count, n, n); one matrix stands for all."""
    if is_sparse(given) or dimensions(given) == 2:
        one = dense(matrix(label, given))
        return np.broadcast_to(one, (count, *one.shape))
    if dimensions(given) != 3 or len(given) != count:
        raise SceneError(f"{label}: expected {count} square matrices, an array of shape ({count}, n, n); found "
                         + (f"{len(given)} matrices" if dimensions(given) == 3 else f"{dimensions(given)} dimensions"))
    each = {f"{label}[{k}]": dense(matrix(f"{label}[{k}]", one)) for k, one in enumerate(given)}
    require_one_size(each)
    return np.array(list(each.values()))


def require_one_size(labelled: Mapping[str, Any]) -> tuple[str, Any]:
    """The first matrix and its label; SceneError unless all have its size."""
    label = next(iter(labelled), "")
    first: Any = labelled.get(label)
    for other, given in labelled.items():
        if given.shape != first.shape:
            size, first_size = (" x ".join(map(str, one.shape)) for one in (given, first))
            raise SceneError(f"{other}: is {size}, but {label} is {first_size}; all matrices have the same size")
    return label, first


def dense(given: Any) -> Any:
    return given.toarray() if is_sparse(given) else given


def is_sparse(given: Any) -> bool:
    return hasattr(given, "tocsr")


def dimensions(given: Any) -> int:
    """How deep numbers are nested, in lists of arrays or sparse matrices, too."""
    nested = isinstance(given, (list, tuple)) or isinstance(given, np.ndarray) and given.ndim == 1 and given.dtype == object
    if nested:
        return 1 + (dimensions(given[0]) if len(given) else 0)
    return 2 if is_sparse(given) else np.ndim(given)


def exact(label: str, given: Any) -> Any:
    """The same numbers as an own array of doubles in C order. SceneError where they are none: texts, masked entries, complex
    numbers whose imaginary parts are not all zero, and numbers that a double does not hold."""
    if _is_masked(given):
        raise SceneError(f"{label}: has masked entries; say what they are, for instance with .filled(0.0)")
    try:
        array = np.asarray(given)
    except ValueError:
        raise SceneError(f"{label}: expected numbers, found rows of different lengths") from None
    if array.dtype.kind not in NUMBERS:
        raise SceneError(f"{label}: expected numbers, found entries of the type {array.dtype}")
    array = _real(label, array)
    try:
        with np.errstate(over="ignore"):
            doubles = np.array(array, dtype=float, order="C")
    except (TypeError, ValueError) as error:
        raise SceneError(f"{label}: expected numbers: {error}") from None
    lost = _lost(array, doubles)
    if lost.any():
        raise SceneError(f"{label}: expected numbers that double precision holds, found {array[lost].flat[0]!r}; "
                         "round them first, with .astype(float)")
    return doubles


def _sparse(label: str, given: Any) -> Any:
    from scipy import sparse

    if given.ndim != 2:
        return np.empty(given.shape)
    # Entries are doubles before those of one place are added: integers of few bits would overflow.
    entries = given.tocoo()
    return sparse.csr_matrix((exact(label, entries.data), (entries.row, entries.col)), shape=entries.shape)


def _is_masked(given: Any) -> bool:
    if isinstance(given, (list, tuple)):
        return any(map(_is_masked, given))
    return bool(np.ma.is_masked(given))


def _real(label: str, array: Any) -> Any:
    """The real parts where no number has another one."""
    if array.dtype.kind == "c":
        imaginary, real = array.imag, array.real
    elif array.dtype == object and any(isinstance(one, (complex, np.complexfloating)) for one in array.flat):
        imaginary, real = (np.array([part(one) for one in array.flat], dtype=object).reshape(array.shape)
                           for part in (np.imag, np.real))
    else:
        return array
    if np.any(imaginary != 0):
        found = array[imaginary != 0].flat[0]
        raise SceneError(f"{label}: expected real numbers, found the complex {found}; families are real. Give every matrix X as "
                         f"{DOUBLED}: its eigenvalues are those of X and their conjugates")
    return real


def _lost(array: Any, doubles: Any) -> Any:
    """Where a double is not the number in the array."""
    if array.dtype.kind not in "iu":  # NaN is not itself, None is
        return (doubles != array) & (array == array)
    lost = np.abs(doubles) >= 2.0 ** 53
    lost[lost] = doubles[lost].astype(object) != array[lost].astype(object)
    return lost
