"""Random families without damping: every change of stability is listed, none is invented, nor is a crossing. The reference is
the spectrum of the companion form.

Run as a program for more of them, of each kind: undamped_test.py FAMILIES [FIRST SEED]"""

import sys
import unittest

import numpy as np

from program import SCENES
from verdicts_test import MODELS, VerdictTest

PLACES = 25


def without_velocities(seed):
    """M, C, K by powers of p: positive or indefinite M, symmetric or circulatory K."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 6))
    signs = np.where(rng.random(n) < 0.3, -1.0, 1.0) if seed % 3 == 0 else np.ones(n)
    M = np.diag(signs)
    K0 = signs[:, None] * np.diag(np.sort(rng.uniform(0.5, 9.0, n)))
    K1 = np.diag(rng.uniform(-3.0, 3.0, n))
    coupling = rng.normal(scale=0.2, size=(n, n))
    K0 += coupling + coupling.T
    if seed % 3 == 1:
        K1 += rng.normal(scale=1.0, size=(n, n))
    return [M], [np.zeros((n, n))], [K0, K1]


def gyroscopic(seed):
    """The same with skew C, so that the spectrum is that of a Hamiltonian; every other K is indefinite."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 5))
    def skew(scale):
        A = rng.normal(scale=scale, size=(n, n))
        return A - A.T
    coupling = rng.normal(scale=0.2, size=(n, n))
    K0 = np.diag(np.sort(rng.uniform(-4.0 if seed % 2 else 0.5, 9.0, n))) + coupling + coupling.T
    return [np.eye(n)], [skew(1.0), skew(0.5)], [K0, np.diag(rng.uniform(-3.0, 3.0, n))]


def grows(matrices, p, margin):
    """Whether some s with s^2 M + s C + K singular has |Re s| > margin; the spectra are symmetric."""
    M, C, K = (sum(p**k * A for k, A in enumerate(series)) for series in matrices)
    n = len(M)
    companion = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    return bool((np.abs(np.linalg.eigvals(companion).real) > margin).any())


class RandomFamilies(VerdictTest):
    families = 16
    first = 0

    def seeds(self):
        return range(self.first, self.first + self.families)

    def test_ranges_are_those_of_the_spectrum(self):
        for kind in (without_velocities, gyroscopic):
            for seed in self.seeds():
                for begin, end in ((-1.0, 1.0), (1.0, -1.0)):
                    with self.subTest(kind=kind.__name__, seed=seed, begin=begin):
                        self.check(kind(seed), begin, end)

    def test_conservative_columns_below_their_load(self):
        # Clamped, EI = L = 1: pi^2 / 4 less what shear and stretch take, at most half a percent.
        model = (MODELS / "undamped_column.toml").read_text(encoding="utf-8")
        for seed in self.seeds():
            rng = np.random.default_rng(seed)
            stiff = 10.0 ** rng.uniform(3.0, 8.0)
            scene = (model.replace("1e6", f"{stiff:.4g}").replace("elements = 10", f"elements = {rng.integers(2, 7)}")
                     .replace("EI_lag = 20", f"EI_lag = {rng.uniform(1.5, 30.0):.4g}").replace("modes = 8", f"modes = {rng.integers(3, 7)}"))
            with self.subTest(seed=seed, stiff=stiff):
                file = self.trace(scene, "--force")
                self.assertEqual(self.events(file, "flutter", "divergence", "collision", "branch_point"), [])
                self.assertEqual(self.ranges(file), [("marginal", 5.0, -2.4)])
                for event in self.events(file, "crossing"):
                    # The second one may be a mode that is not followed.
                    place, double = float(event["parameter"]), complex(float(event["real"]), float(event["imag"]))
                    at = {mode: s for _, mode, s in self.eval_rows(file, [place])}
                    for mode in event["modes"].split(";"):
                        self.assertLess(abs(at[f"mode {mode}"] - double), 1e-5 * abs(double))

    def test_frequencies_that_meet_behind_a_range_of_growth(self):
        # Ziegler's column from far above its load: real eigenvalues become pairs at 7/2 + sqrt(2), and pairs meet on the
        # axis at 7/2 - sqrt(2). Some of them are followed as s, their opposites as 1/s.
        for begin in (7, 7.5, 8, 20, 30):
            for tolerance in (1e-6, 1e-8):
                with self.subTest(begin=begin, tolerance=tolerance):
                    self.run_well("trace", SCENES / "ziegler_column.toml", "--set", "damping=0", "--from", begin, "--to", 0,
                                  "--tolerance", tolerance, "-o", "column.h5", "--force", "--quiet")
                    places = self.places("column.h5", "collision")
                    self.assertEqual(len(places), 3)
                    for place, exact in zip(places, [3.5 - 2**0.5] + 2 * [3.5 + 2**0.5]):
                        self.assertAlmostEqual(place, exact, delta=1e-9)
                    self.assertEqual(self.ranges("column.h5"), [("marginal", places[0], 0.0)])
        # Two equal unstable motions, held by gyroscopic forces: s = +-5/2 p j +- sqrt(1 - 25/4 p^2), on the axis from |p| = 2/5 on.
        for begin, end in ((2, -1), (1, -1), (-1, 1), (-1, 2)):
            with self.subTest(begin=begin, end=end):
                file = self.trace(f"""[trace]
parameter = "p"
from = {begin}
to = {end}
tolerance = 1e-8
[matrix_family]
M = [[[1, 0], [0, 1]]]
C = [[[0, 0], [0, 0]], [[0, 5], [-5, 0]]]
K = [[[-1, 0], [0, -1]]]
""", "--force")
                for place, exact in zip(self.places(file, "collision"), (-0.4, 0.4), strict=True):
                    self.assertAlmostEqual(place, exact, delta=1e-11)
                self.assertEqual(len(self.ranges(file)), 2)

    def check(self, matrices, begin, end):
        M, C, K = ([A.tolist() for A in series] for series in matrices)
        scene = (f'[trace]\nparameter = "p"\nfrom = {begin}\nto = {end}\ntolerance = 1e-7\n[matrix_family]\n'
                 f"M = {M}\nC = {C}\nK = {K}\n")
        file = self.trace(scene, "--force")
        self.assertEqual(self.events(file, "flutter", "crossing"), [])
        ranges = [sorted(entry[1:]) for entry in self.ranges(file)]
        edges = np.array([place for entry in ranges for place in entry])
        for p in np.linspace(-1.0, 1.0, PLACES):
            if edges.size and np.abs(edges - p).min() < 1e-6:
                continue
            inside = any(low <= p <= high for low, high in ranges)
            # Beside an onset the real part is the root of rounding in the reference.
            self.assertEqual(inside, not grows(matrices, p, 1e-6), f"at p = {p}")
        for place in edges[np.abs(np.abs(edges) - 1.0) > 1e-9]:
            sides = [grows(matrices, place + h, 1e-7) for h in (-1e-6, 1e-6)]
            self.assertNotEqual(sides[0], sides[1], f"nothing changes at p = {place}")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        RandomFamilies.families = int(sys.argv[1])
        RandomFamilies.first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    unittest.main(argv=sys.argv[:1])
