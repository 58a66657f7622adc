"""Random families without damping: every change of stability is listed, none is invented. The reference is the number of
eigenvalues of -M^-1 K that are not negative real numbers, on a fine grid.

Run as a program for more of them: undamped_test.py FAMILIES [FIRST SEED]"""

import sys
import unittest

import numpy as np

from verdicts_test import VerdictTest

GRID = 4001
PLACES = 25


def family(seed):
    """M, and K0 + p K1: positive or indefinite M, symmetric or circulatory K."""
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
    return M, K0, K1


def grows(M, K, margin=0.0):
    """Whether some s with s^2 M + K singular has Re s > margin."""
    squares = np.linalg.eigvals(-np.linalg.solve(M, K)).astype(complex)
    roots = np.sqrt(squares)
    return bool((np.abs(roots.real) > margin).any())


class RandomFamilies(VerdictTest):
    families = 24
    first = 0

    def test_ranges_are_those_of_the_spectrum(self):
        for seed in range(self.first, self.first + self.families):
            M, K0, K1 = family(seed)
            for begin, end in ((-1.0, 1.0), (1.0, -1.0)):
                with self.subTest(seed=seed, begin=begin):
                    self.check(M, K0, K1, begin, end)

    def check(self, M, K0, K1, begin, end):
        scene = (f'[trace]\nparameter = "p"\nfrom = {begin}\nto = {end}\ntolerance = 1e-7\n[matrix_family]\n'
                 f"M = [{M.tolist()}]\nK = [{K0.tolist()}, {K1.tolist()}]\n")
        file = self.trace(scene, "--force")
        self.assertEqual(self.events(file, "flutter"), [])
        ranges = [sorted(entry[1:]) for entry in self.ranges(file)]
        edges = np.array([place for entry in ranges for place in entry])
        for p in np.linspace(-1.0, 1.0, PLACES):
            if edges.size and np.abs(edges - p).min() < 1e-6:
                continue
            inside = any(low <= p <= high for low, high in ranges)
            K = K0 + p * K1
            # Beside an onset the real part is the root of rounding in the reference.
            self.assertEqual(inside, not grows(M, K, 1e-6), f"at p = {p}")
        for place in edges[np.abs(np.abs(edges) - 1.0) > 1e-9]:
            sides = [grows(M, K0 + (place + h) * K1, 1e-7) for h in (-1e-6, 1e-6)]
            self.assertNotEqual(sides[0], sides[1], f"nothing changes at p = {place}")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        RandomFamilies.families = int(sys.argv[1])
        RandomFamilies.first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    unittest.main(argv=sys.argv[:1])
