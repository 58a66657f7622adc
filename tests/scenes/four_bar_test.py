"""A four-bar linkage against one coordinate: the crank's angle, with the loop and its two derivatives in complex numbers."""

import math
import unittest

import numpy as np

from program import edited
from scene_test_case import SceneTest

G, DENSITY, BASE, COUPLER, ROCKER, STIFFNESS, RELAXED = 9.81, 1.2, 1.0, 0.9, 0.7, 15.0, 0.3


def solve_real_pair(a, b, right):
    """Real x, y with a x + b y = right, complex."""
    return np.linalg.solve([[a.real, b.real], [a.imag, b.imag]], [right.real, right.imag])


class Linkage:
    """x + j z of the moving parts at the crank's angle, with first and second derivatives."""

    def __init__(self, angle, crank):
        a = crank * np.exp(1j * angle)
        # Coupler end = base + rocker: intersection of two circles, the lower one.
        d = BASE - a
        distance = abs(d)
        along = (distance**2 + COUPLER**2 - ROCKER**2) / (2.0 * distance)
        end = a + d / distance * (along - 1j * math.sqrt(COUPLER**2 - along**2))
        b, c = end - a, end - BASE
        # a' j + b j p' = c j q', then the same once more.
        p1, q1 = solve_real_pair(1j * b, -1j * c, -1j * a)
        p2, q2 = solve_real_pair(1j * b, -1j * c, a + b * p1**2 - c * q1**2)
        self.crank, self.coupler, self.rocker = (a, 1j * a, -a), (b, 1j * b * p1, 1j * b * p2 - b * p1**2), (
            c, 1j * c * q1, 1j * c * q2 - c * q1**2)
        self.rates = (1.0, p1, q1)

    def centres(self):
        a, b, c = map(np.array, (self.crank, self.coupler, self.rocker))
        return a / 2, a + b / 2, np.array([BASE, 0, 0]) + c / 2


def energies(angle, crank, pull=STIFFNESS):
    """V', V'' and the inertia per angular rate squared."""
    linkage = Linkage(angle, crank)
    slope = curvature = inertia = 0.0
    for length, rate, r in zip((crank, COUPLER, ROCKER), linkage.rates, linkage.centres()):
        m = DENSITY * length
        slope += m * G * r[1].imag
        curvature += m * G * r[2].imag
        inertia += m * abs(r[1]) ** 2 + m * length**2 / 12.0 * rate**2
    r, r1, r2 = linkage.centres()[1]
    d = r + 1j * BASE  # from the spring's foot
    dot = lambda u, v: (u * np.conj(v)).real
    stretch = abs(d) - RELAXED
    d1 = dot(d, r1) / abs(d)
    d2 = (dot(r1, r1) + dot(d, r2) - d1**2) / abs(d)
    slope += pull * stretch * d1
    curvature += pull * (d1**2 + stretch * d2)
    return slope, curvature, inertia


def steady(crank, pull=STIFFNESS):
    """The hanging equilibrium's crank angle and frequency."""
    angle = -1.65
    for _ in range(50):
        slope, curvature, _ = energies(angle, crank, pull)
        angle -= slope / curvature
    slope, curvature, inertia = energies(angle, crank, pull)
    assert abs(slope) < 1e-12 * curvature
    return angle, math.sqrt(curvature / inertia)


class FourBar(SceneTest):
    scene = "four_bar"

    def test_the_reference_is_consistent(self):
        """V'' and the inertia against central differences of V' and of the positions."""
        h, crank, angle = 1e-5, 0.5, -1.5
        ahead, behind = energies(angle + h, crank), energies(angle - h, crank)
        self.assertAlmostEqual((ahead[0] - behind[0]) / (2 * h), energies(angle, crank)[1], places=6)
        r = [Linkage(angle + x, crank).centres()[2][0] for x in (h, -h)]
        self.assertAlmostEqual(abs((r[0] - r[1]) / (2 * h) - Linkage(angle, crank).centres()[2][1]), 0.0, places=8)

    def test_frequency_and_angle_over_the_crank(self):
        path = self.trace_scene()
        self.check_frequencies(path, lambda a: [steady(a)[1]], np.linspace(0.4, 1.0, 13))
        p, _ = self.nodes(path)
        found = np.arctan2(self.coordinate(path, "crank.x_axis.z"), self.coordinate(path, "crank.x_axis.x"))
        np.testing.assert_allclose(found, [steady(a)[0] for a in p], rtol=1e-10)

    def test_over_the_spring(self):
        path = self.trace_scene("--parameter", "k", "--from", "0", "--to", "40")
        self.check_frequencies(path, lambda k: [steady(0.4, k)[1]], [0.0, 5.0, 15.0, 40.0])

    def test_three_conditions_are_redundant(self):
        self.assertEqual(self.redundant(), (36, 38, 3, 1))

    def test_the_numbers_do_not_depend_on_redundancy(self):
        """One hinge as a ball joint, another as a universal one: nothing redundant, the same frequency."""
        universal = edited(self.scene_text(), '[[revolute]]\nname = "B"',
                           '[[universal]]\nname = "B"\ncross_axis = "coupler.z"')
        ball = universal.replace('[[revolute]]\nname = "C"\nfrom = "coupler.end"\nto = "rocker.end"\naxis = [0, 1, 0]',
                                 '[[ball]]\nname = "C"\nfrom = "coupler.end"\nto = "rocker.end"')
        self.assertNotEqual(ball, universal)
        self.assertEqual(self.redundant(ball), (36, 35, 0, 1))
        self.check_frequencies(self.trace_text(ball), lambda a: [steady(a)[1]], [0.4, 0.7, 1.0])


if __name__ == "__main__":
    unittest.main()
