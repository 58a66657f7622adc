"""Every way in which numpy and scipy give a matrix, at every entry of the package: the same eigenvalues, or an error that says why
not."""

import os
import tempfile
import unittest
import warnings
from fractions import Fraction

import eigentrail as et
import numpy as np
import scipy.sparse as sp
import xarray

K = np.array([[4.0, 1.0, 0.0], [1.0, 9.0, 2.0], [0.0, 2.0, 16.0]])
ONE = np.eye(3)
EXPECTED = np.sqrt(np.linalg.eigvalsh(K))  # of x'' + K x = 0


def field(of_type):
    """A matrix among other fields of records: strides of 12 bytes, entries that are not aligned."""
    packed = np.zeros((3, 3), dtype=[("v", of_type), ("flag", "<i4")])
    packed["v"] = K
    return packed["v"]


def read_only():
    array = K.copy()
    array.flags.writeable = False
    return array


def memory_map():
    handle, path = tempfile.mkstemp()
    os.write(handle, K.tobytes())
    os.close(handle)
    array = np.memmap(path, dtype=float, mode="r", shape=(3, 3))
    os.unlink(path)
    return array


def unaligned():
    return np.frombuffer(b"x" + K.tobytes(), dtype=np.uint8)[1:].view(float).reshape(3, 3)


def duplicates():
    """Two entries for each place, which belong together."""
    rows, columns = np.nonzero(K)
    entries = np.concatenate([K[rows, columns] - 3, np.full(rows.size, 3)]).astype(np.int8)
    return sp.coo_matrix((entries, (np.tile(rows, 2), np.tile(columns, 2))), (3, 3))


def unsorted():
    matrix = sp.csr_matrix(K)
    for begin, end in zip(matrix.indptr, matrix.indptr[1:]):
        for part in (matrix.indices, matrix.data):
            part[begin:end] = part[begin:end][::-1].copy()
    matrix.has_sorted_indices = False
    return matrix


DENSE = {
    "C order": K, "Fortran order": np.asfortranarray(K), "transposed view": np.ascontiguousarray(K.T).T,
    "every second column": np.repeat(K, 2, 1)[:, ::2], "backwards": K[::-1, ::-1].copy()[::-1, ::-1], "field": field("<f8"),
    "field, big-endian": field(">f8"), "unaligned": unaligned(), "big-endian": K.astype(">f8"), "single": K.astype(np.float32),
    "half": K.astype(np.float16), "long double": K.astype(np.longdouble), "complex without imaginary parts": K.astype(complex),
    "objects": K.astype(object), "read-only": read_only(), "memory map": memory_map(), "np.matrix": np.matrix(K),
    "masked array without masks": np.ma.array(K), "list": K.tolist(), "tuple of arrays": tuple(K), "DataArray": xarray.DataArray(K),
    "fractions": [[Fraction(entry) for entry in row] for row in K]}
SPARSE = {**{kind: getattr(sp, f"{kind}_matrix")(K) for kind in ("bsr", "coo", "csc", "csr", "dia", "dok", "lil")},
          **{f"{kind} array": getattr(sp, f"{kind}_array")(K) for kind in ("bsr", "coo", "csc", "csr", "dia", "dok", "lil")},
          "single csr": sp.csr_matrix(K.astype(np.float32)), "duplicates": duplicates(), "unsorted indices": unsorted()}
REFUSED = {
    "complex": (K * (1 + 0.1j), "complex"), "complex objects": ((K * (1 + 0.1j)).astype(object), "complex"),
    "complex sparse": (sp.csr_matrix(K * 1j), "complex"), "masked": (np.ma.array(K, mask=K == 9.0), "masked"),
    "masked in a list": ([[np.ma.masked, 1.0, 0.0], *K.tolist()[1:]], "masked"), "texts": (K.astype(str), "numbers"),
    "dates": (np.zeros((3, 3), "M8[s]"), "numbers"), "None": ([[None, 1.0, 0.0], *K.tolist()[1:]], "None"),
    "long double with more digits": (K.astype(np.longdouble) + np.longdouble("1e-18"), "double precision holds"),
    "integers beyond 2^53": (np.full((3, 3), 2 ** 53 + 1), "double precision holds"),
    "thirds": ([[Fraction(1, 3)] * 3] * 3, "double precision holds"), "rows of different lengths": ([[1.0], [2.0, 3.0]], "rows"),
    "records": (np.zeros((3, 3), [("v", "f8"), ("w", "f8")]), "numbers")}


def at_zero(scene):
    return et.spectrum(scene, at=0.0, p=(0, 1))


def traced(family):
    return et.trace(family, p=(0, 1), tolerance=1e-3, progress=False)


P = [0.0, 0.4, 0.7, 1.0]
ENTRIES = {
    "matrix": lambda X: at_zero(et.Family(M=ONE, K={0: X, 1: ONE})),
    "list": lambda X: traced(et.Family(M=ONE, K=[X, ONE])),
    "list of sparse and dense": lambda X: at_zero(et.Family(M=sp.eye(3), K=[X, sp.csr_array(ONE)])),
    "named": lambda X: at_zero(et.Family(M=ONE, K={"a": X, 1: ONE}, factors={"a": 1})),
    "function": lambda X: traced(et.Family(lambda p: dict(M=ONE, K=_plus(X, p)))),
    "samples": lambda X: at_zero(et.Samples(P, M=ONE, K=[X if p == 0.0 else K + p * ONE for p in P])),
    "state space": lambda X: at_zero(et.StateSpace([_states(X if p == 0.0 else K + p * ONE) for p in P], P)),
    "table": lambda X: at_zero({"trace": {"parameter": "p", "from": 0, "to": 1}, "matrix_family": {"M": [ONE], "K": [X, ONE]}})}


def _plus(X, p):
    return X if p == 0.0 else K + p * ONE


def _states(X):
    """x' = v, v' = -X x, of dense or sparse blocks; of lists only where they hold numbers."""
    if X is K or isinstance(X, np.ndarray) and X.dtype == float and type(X) is np.ndarray:
        return np.block([[np.zeros((3, 3)), ONE], [-X, np.zeros((3, 3))]])
    whole = et.matrices.dense(et.matrices.matrix("A", X))
    return sp.bmat([[None, sp.eye(3)], [-sp.csr_matrix(whole), None]]).tolil()


def frequencies(result):
    found = result.natural_frequency.values
    return np.sort(found[0] if found.ndim == 2 else found)


class Matrices(unittest.TestCase):
    def test_every_kind_gives_the_same_eigenvalues_at_every_entry(self):
        for entry, compute in ENTRIES.items():
            expected = frequencies(compute(K))
            np.testing.assert_allclose(expected, EXPECTED, rtol=1e-9)
            for kind, given in {**DENSE, **SPARSE}.items():
                if entry == "table" and kind == "fractions":
                    continue  # a scene holds numbers and texts
                with self.subTest(entry=entry, kind=kind):
                    np.testing.assert_allclose(frequencies(compute(given)), expected, rtol=1e-12)

    def test_what_is_no_matrix_of_doubles_is_refused_at_every_entry(self):
        for entry, compute in ENTRIES.items():
            for kind, (given, text) in REFUSED.items():
                if entry == "table" and kind in ("texts", "fractions"):
                    continue  # texts are expressions there
                with self.subTest(entry=entry, kind=kind), self.assertRaises((et.SceneError, TypeError)) as raised:
                    compute(given)
                if entry != "table":
                    self.assertIn(text, str(raised.exception))
                    self.assertIsInstance(raised.exception, et.SceneError)

    def test_advice_for_complex_matrices_gives_their_eigenvalues(self):
        X = K * (1 + 0.1j)
        with self.assertRaises(et.SceneError) as raised:
            et.Family(M=ONE, K=X)
        advice = str(raised.exception).split(" as ")[1].split(": its")[0]
        doubled = eval(advice, {"np": np, "X": X})
        found = et.spectrum(et.Family(M=np.eye(6), K=[doubled, np.eye(6)]), at=0.0, p=(0, 1)).eigenvalue.to_numpy()
        own = np.sqrt(-np.linalg.eigvals(X))
        for s in np.concatenate([own, -own]):
            self.assertLess(min(abs(found - s).min(), abs(found - s.conjugate()).min()), 1e-9)

    def test_a_family_keeps_what_it_was_given(self):
        for given in (K.copy(), sp.csr_matrix(K)):
            family = et.Family(M=ONE, K=[given, ONE])
            given *= 2.0
            np.testing.assert_allclose(frequencies(traced(family)), EXPECTED, rtol=1e-9)

    def test_entries_of_one_place_are_added_as_doubles(self):
        place = np.zeros(2, int)
        twice = sp.coo_matrix((np.array([100, 100], np.int8), (place, place)), (1, 1))
        found = et.spectrum(et.Family(M=[[1]], K=[twice, [[1]]]), at=0.0, p=(0, 1))
        self.assertAlmostEqual(found.natural_frequency[0], np.sqrt(200), places=9)

    def test_what_was_given_is_not_changed(self):
        given = duplicates()
        before = given.nnz
        et.Family(M=ONE, K=given)
        self.assertEqual(given.nnz, before)


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PendingDeprecationWarning)  # np.matrix
        unittest.main()
