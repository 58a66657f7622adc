"""Chains of rigid links: each against its own matrices in the angles of the links, and together against the continuum they
converge to with second order, the hanging chain (zeros of J0) and the rotating cable (Legendre polynomials)."""

import math
import pathlib
import sys
import unittest

import numpy as np

from program import PROGRAM
from scene_test_case import SceneTest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "docs" / "scenes"))
import chain

NUMBERS = (5, 10, 20)


def link_matrices(n):
    """Inertia in the small angles of n links, and sideways displacement of the centres per angle (centres x angles)."""
    length, mass = chain.LENGTH / n, chain.MASS / n
    reach = length * (np.tri(n, k=-1) + 0.5 * np.eye(n))
    return mass * reach.T @ reach + mass * length**2 / 12.0 * np.eye(n), reach


def sorted_roots(M, K):
    return np.sqrt(np.maximum(np.sort(np.linalg.eigvals(np.linalg.solve(M, K)).real), 0.0))


def hanging_links(n):
    """V = -sum of m g z with z = sum of lengths times cos: K is diagonal."""
    M, reach = link_matrices(n)
    return sorted_roots(M, np.diag(chain.G * chain.MASS / n * reach.sum(axis=0)))


def rotating_links(n):
    """Flap: the centrifugal potential -W^2/2 int x^2 dm with x = sum of lengths times cos; lag: the same less W^2 M."""
    M, reach = link_matrices(n)
    centres = reach.sum(axis=1)
    K = chain.SPEED**2 * np.diag(chain.MASS / n * (centres @ reach + (chain.LENGTH / n) ** 2 / 12.0))
    return sorted_roots(M, K), sorted_roots(M, K - chain.SPEED**2 * M)


class Chains(SceneTest):
    def test_hanging_links(self):
        for n in NUMBERS[:2]:
            found = chain.frequencies(PROGRAM, chain.hanging(n), chain.G, "--to", "12")
            np.testing.assert_allclose(found, hanging_links(n), rtol=1e-10)

    def test_rotating_links(self):
        """All modes but the turn about the axis, which is neutral."""
        flap, lag = rotating_links(5)
        found = np.array(chain.frequencies(PROGRAM, chain.rotating(5), chain.SPEED, "--to", "25"))
        moving = found[found > 1e-3]
        np.testing.assert_allclose(moving, np.sort(np.concatenate([flap, lag[1:]])), rtol=1e-10)
        self.assertLess(lag[0], 1e-3)
        self.assertLess(found[0], 1e-4)

    def test_second_order(self):
        """If the links are half as long, the error is a quarter; this holds more exactly for shorter links."""
        errors = chain.converging(PROGRAM, NUMBERS)
        self.assertEqual(len(errors), 7)
        for name, values in errors.items():
            with self.subTest(name):
                orders = [math.log2(a / b) for a, b in zip(values, values[1:])]
                self.assertTrue(all(v > 0.0 for v in values))  # rigid links are stiffer
                self.assertLess(abs(orders[1] - 2.0), 0.2)
                self.assertLess(abs(orders[1] - 2.0), abs(orders[0] - 2.0) + 1e-3)

    def test_extrapolated_to_the_continuum(self):
        """Richardson extrapolation from 10 and 20 links has at most a tenth of the error of 20 links."""
        for name, (_, coarse, fine) in chain.converging(PROGRAM, NUMBERS).items():
            with self.subTest(name):
                self.assertLess(abs(fine - (coarse - fine) / 3.0), 0.2 * fine)

    def test_a_straight_cable_flaps_as_one(self):
        """At the speed of rotation, whatever the number of links."""
        for n in (1, 3):
            found = chain.frequencies(PROGRAM, chain.rotating(n), chain.SPEED, "--to", "25")
            self.assertLess(min(abs(f / chain.SPEED - 1.0) for f in found), 1e-10)

    def test_speed_scales_all_frequencies(self):
        path = self.trace_text(chain.rotating(3), "--to", "60", tolerance=1e-10)
        one, two = (np.sort(self.eval_at(path, [w])[0].imag) for w in (20.0, 60.0))
        np.testing.assert_allclose(two[-5:], 3.0 * one[-5:], rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
