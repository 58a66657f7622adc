"""Families of matrices in memory: the same bits as the program on their files, closed forms, and mistakes."""

import pathlib
import tempfile
import timeit
import unittest

import eigentrail as et
import numpy as np
import scipy.sparse as sp

from loci_comparison import differences
from program import ProgramTest

M, K = np.diag([2.0, 1.0]), np.array([[3.0, -1.0], [-1.0, 2.0]])
C0, G = 0.01 * K, np.array([[0.0, 1.0], [-1.0, 0.0]])


def quadratic(omega):
    return dict(M=M, C=C0 + omega * G, K=K)


def exact(omega):
    """One eigenvalue of each pair, by the companion matrix."""
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C0 + omega * G)]])
    s = np.linalg.eigvals(A)
    return np.sort_complex(s[s.imag > 0])


class Polynomials(ProgramTest):
    def assert_same_as_the_program(self, family, span, **how):
        scene = family.save(self.folder / "family.toml", span)
        self.run_well("trace", scene, "-o", "program.h5", "--quiet", "--force", *[f"--{key}={value}" for key, value in how.items()])
        loci = et.trace(family, **{family.parameter: span}, **how)
        loci.eigentrail.save(self.folder / "python.h5")
        found = differences(self.folder / "program.h5", self.folder / "python.h5")
        self.assertEqual([name for name in found if name != "scene_path"], [])
        return loci

    def test_dense(self):
        loci = self.assert_same_as_the_program(et.Family(M=M, C=[C0, G], K=K, parameter="omega", unit="rad/s"), (0, 4))
        for omega in (0.3, 2.2):
            found = np.sort_complex(loci.eigentrail.sel(omega=omega).eigenvalue.values)
            np.testing.assert_allclose(found, exact(omega), rtol=1e-6)

    def test_first_order(self):
        A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C0)]])
        A1 = np.block([[np.zeros((2, 4))], [np.zeros((2, 2)), -np.linalg.solve(M, G)]])
        loci = self.assert_same_as_the_program(et.Family(A=[A, A1], parameter="w", names=["a", "b", "c", "d"]), (0, 4))
        np.testing.assert_allclose(np.sort_complex(loci.eigentrail.sel(w=2.2).eigenvalue.values), exact(2.2), rtol=1e-6)
        self.assertEqual(list(loci.coordinate.values), ["a", "b", "c", "d"])

    def test_sparse_with_factors(self):
        n = 300
        chain = sp.diags([-1.0, 2.0, -1.0], [-1, 0, 1], (n, n)) * n ** 2
        foot = sp.csr_matrix(([1.0], ([0], [0])), (n, n)) * n
        family = et.Family(M=sp.eye(n), K={0: chain, "foot": foot, 1: sp.eye(n)}, parameter="p", factors={"foot": "k"},
                           parameters={"k": 3.0})
        loci = self.assert_same_as_the_program(family, (0, 5), modes=4)
        matrix = (chain + 3.0 * foot + 2.5 * sp.eye(n)).toarray()
        expected = np.sqrt(np.linalg.eigvalsh(matrix)[:4])
        np.testing.assert_allclose(loci.eigentrail.sel(p=2.5).natural_frequency, expected, rtol=1e-6)
        stiffer = et.trace(family, p=(0, 5), k=30, modes=4)
        self.assertGreater(stiffer.eigentrail.sel(p=2.5).natural_frequency[0], expected[0])

    def test_samples(self):
        w = np.linspace(0, 4, 9)
        family = et.Samples(w, M=M, C=[C0 + one * G for one in w], K=K, parameter="omega", unit="rad/s", digits=15)
        loci = self.assert_same_as_the_program(family, (0.0, 4.0))
        found = loci.eigentrail.sel(omega=2.2)
        error = np.abs(np.sort_complex(found.eigenvalue.values) - exact(2.2))
        self.assertTrue((error < 1e-6 * np.abs(exact(2.2)) + found.interpolation_error.values.max()).all())

    def test_state_space(self):
        w = np.linspace(0, 4, 9)
        A = [np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C0 + one * G)]]) for one in w]
        loci = et.trace(et.StateSpace(np.array(A), w, names=["x", "y", "vx", "vy"]), omega=(0, 4))
        np.testing.assert_allclose(np.sort_complex(loci.eigentrail.sel(omega=2.2).eigenvalue.values), exact(2.2), rtol=1e-6)

    def test_boundaries_and_maps(self):
        family = et.Family(M=np.eye(2), C={0: 0.02 * np.eye(2), "d": np.diag([1.0, 0.5])}, parameter="p", factors={"d": "d"},
                           K=[np.diag([1.0, 2.0]), np.array([[0.0, 1.0], [-1.0, 0.0]])], parameters={"d": 0.1})
        boundary = et.boundary(family, p=(0, 2), d=(0, 0.5))
        self.assertGreaterEqual(boundary.sizes["curve"], 1)
        stability = et.map(family, p=(0, 2), d=(0, 0.5), grid=(4, 30))
        curve = boundary.eigentrail.curve(0)
        at = np.interp(0.25, *[curve[name].values[np.argsort(curve.d.values)] for name in ("d", "p")])
        line = stability.unstable.interp(d=0.25).values
        self.assertAlmostEqual(stability.p.values[np.flatnonzero(line > 0)[0]], at, delta=2 / 29)


class Functions(unittest.TestCase):
    def test_a_function_gives_the_loci_of_its_matrices(self):
        loci = et.trace(et.Family(quadratic), omega=(4, 0), tolerance=1e-9)
        for omega in (0.3, 2.2, 4.0):
            found = np.sort_complex(loci.eigentrail.sel(omega=omega).eigenvalue.values)
            np.testing.assert_allclose(found, exact(omega), rtol=1e-9)

    def test_it_is_called_only_where_needed(self):
        called = []

        def counted(omega):
            called.append(omega)
            return quadratic(omega)

        # A smooth function alone, and with calls at the distance of what is looked for.
        for resolution, most in ((1.0, 30), (0.02, 70), (0.01, 130)):
            called.clear()
            et.trace(et.Family(counted, resolution=resolution), omega=(0, 4))
            self.assertLessEqual(len(called), most)
            self.assertEqual(len(called), len(set(called)))
        self.assertLessEqual(np.diff(np.sort(called)).max(), 0.04 * (1 + 1e-12))

    def test_sparse_matrices_lists_and_other_orders_of_memory(self):
        expected = et.trace(et.Family(quadratic), omega=(0, 4)).eigenvalue
        for change in (sp.csr_matrix, np.asfortranarray, lambda m: m.tolist(), lambda m: np.repeat(m, 2, 1)[:, ::2]):
            found = et.trace(et.Family(lambda omega: {key: change(value) for key, value in quadratic(omega).items()}),
                             omega=(0, 4)).eigenvalue
            np.testing.assert_array_equal(found, expected)

    def test_kinks_are_places_that_the_user_knows(self):
        loci = et.trace(et.Family(lambda p: dict(M=np.eye(1), K=[[1.0 + abs(p - 1.0)]]), breaks=[1.0]), p=(0, 3))
        np.testing.assert_allclose(loci.eigentrail.sel(p=[0.5, 1.0, 2.5]).natural_frequency[:, 0], np.sqrt([1.5, 1, 2.5]), rtol=1e-6)

    def test_what_the_function_raises_comes_through(self):
        def fail(speed):
            raise ZeroDivisionError("here")

        with self.assertRaisesRegex(ZeroDivisionError, "here") as raised:
            et.trace(et.Family(fail), speed=(0, 1))
        self.assertRegex(raised.exception.__notes__[0], r"function of the family, at speed = [\d.]+")

    def test_what_cannot_be_resolved_says_where(self):
        with self.assertRaisesRegex(et.NotResolved, "calls"):
            et.trace(et.Family(lambda p: dict(M=np.eye(1), K=[[1.0 + abs(p - 1 / 3)]]), max_calls=60), p=(0, 1))

    def test_maps_of_functions_are_refused(self):
        with self.assertRaisesRegex(et.SceneError, "traced only"):
            et.map(et.Family(quadratic), omega=(0, 1), d=(0, 1))

    def test_rigid_motions_of_states_are_followed_together(self):
        # Two free motions are a fourfold zero of the states, known to the root of rounding.
        for seed in range(6):
            rng = np.random.default_rng(seed)
            n = 4
            V = rng.standard_normal((n, n))
            held = np.diag([0.0, 0.0, 1.0, 1.0]) @ V
            B = [X @ X.T for X in rng.standard_normal((2, n, n))]

            def states(p):
                K = np.linalg.solve(V.T @ V, held.T @ (B[0] + (1 + np.sin(p)) * B[1] + np.eye(n)) @ held)
                return dict(A=np.block([[np.zeros((n, n)), np.eye(n)], [-K, -0.1 * K]]))

            with self.subTest(seed=seed):
                loci = et.trace(et.Family(states), p=(0, 2))
                self.assertEqual(loci.attrs["status"], "completed")
                self.assertFalse(loci.eigentrail.events.kind.isin(["flutter", "divergence"]).any())
                exact = np.linalg.eigvals(states(float(loci.p[-1]))["A"])
                elastic = np.sort_complex(exact[(np.abs(exact) > 1e-3) & (exact.imag > 0)])
                found = loci.eigenvalue.values[-1]
                np.testing.assert_allclose(np.sort_complex(found[np.isfinite(found) & (found.imag > 1e-3)]), elastic, rtol=1e-6)

    def test_a_matrix_that_is_symmetric_but_for_rounding_cannot_flutter(self):
        # Two equal planes of a shaft in coordinates that mix them: K is symmetric to 1e-16 only.
        n = 6
        shaft = 1e4 * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
        for seed in range(6):
            Q = np.linalg.qr(np.random.default_rng(seed).standard_normal((2 * n, 2 * n)))[0]

            def matrices(p):
                K = shaft + np.diag([1e3 * (1 + 0.3 * np.sin(p))] + (n - 2) * [0.0] + [3e3 * np.sqrt(1 + p * p)])
                return dict(M=np.eye(2 * n), K=Q.T @ np.kron(np.eye(2), K) @ Q)

            for tolerance in (1e-6, 1e-8):
                with self.subTest(seed=seed, tolerance=tolerance):
                    loci = et.trace(et.Family(matrices), p=(0, 3), tolerance=tolerance)
                    self.assertEqual(len(loci.eigentrail.events), 0)
                    self.assertTrue((np.abs(loci.eigenvalue.values.real) <= loci.rounding.values).all())

    def test_damping_at_the_level_of_rounding_shows_no_flutter(self):
        # Two nearly equal planes in coordinates that mix them, damped or hardly: nothing crosses the axis.
        for seed in (52, 56, 59, 61, 62, 70):
            rng = np.random.default_rng(seed)
            n = int(rng.integers(2, 5))
            W, B0, B1, D = (rng.standard_normal(shape) for shape in ((2 * n, 2 * n), (n, n), (n, n), (2 * n, 2 * n)))
            unequal, damping = 10.0 ** rng.integers(-13, -7, 2)
            M, B0, B1, D = W.T @ W, B0 @ B0.T + np.eye(n), B1 @ B1.T, D @ D.T
            K = [W.T @ (np.kron(np.eye(2), B0) + unequal * D) @ W, W.T @ np.kron(np.eye(2), B1) @ W]
            with self.subTest(seed=seed, unequal=unequal, damping=damping):
                loci = et.trace(et.Family(M=M, C=damping * M, K=K), p=(0, 2))
                self.assertFalse(loci.eigentrail.events.kind.isin(["flutter", "divergence"]).any())

    def test_rigid_motions_stay_at_zero(self):
        # Free motions in coordinates that mix them with the others: K is singular to rounding only.
        for seed in range(6):
            rng = np.random.default_rng(seed)
            n, free = 5, 1 + seed % 2
            V = rng.standard_normal((n, n))
            held = np.diag([0.0] * free + [1.0] * (n - free)) @ V
            B = [X @ X.T for X in rng.standard_normal((2, n, n))]

            def matrices(p):
                return dict(M=V.T @ V, K=held.T @ (B[0] + (1 + np.sin(p)) * B[1] + np.eye(n)) @ held)

            with self.subTest(seed=seed):
                loci = et.trace(et.Family(matrices), p=(0, 2))
                zero = np.abs(loci.eigenvalue.values).max(axis=0) == 0
                self.assertEqual((loci.attrs["status"], loci.sizes["mode"], zero.sum()), ("completed", n + free, 2 * free))
                self.assertEqual(len(loci.eigentrail.events), 0)
                end = matrices(float(loci.p[-1]))
                elastic = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(end["M"], end["K"])).real)[free:])
                np.testing.assert_allclose(np.sort(loci.eigenvalue.values[-1, ~zero].imag), elastic, rtol=1e-6)


class Mistakes(unittest.TestCase):
    def test_families_say_what_they_are(self):
        for family, text in ((et.Family(M=M, C=[C0, G], K=sp.csr_matrix(K), parameter="omega", unit="rad/s"),
                              "Family of matrices 2 x 2: M; C[0]; C[1]; K sparse, parameter omega (rad/s)"),
                             (et.Family(quadratic), "Family of the function quadratic"),
                             (et.Samples([0, 1], M=M, K=[K, K], parameter="p"), "Samples of M, K, 2 x 2, at 2 values from 0 to 1, parameter p"),
                             (et.StateSpace([K, K], [0, 1]), "StateSpace of A, 2 x 2, at 2 values from 0 to 1")):
            self.assertEqual(repr(family), text)


if __name__ == "__main__":
    unittest.main()
