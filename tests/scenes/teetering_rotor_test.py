"""A teetering rotor with precone, undersling and a spring on its hinge."""

import math
import unittest

import numpy as np

from rotor_test_case import RotorTest
from scene_test_case import CLOSE


def moments(p):
    """A = integral x^2, B = integral z^2 and z of the centre of mass, of both slender blades."""
    s, c, R, u = math.sin(p["precone"]), math.cos(p["precone"]), p["radius"], p["undersling"]
    return (2 * p["mass"] * R**2 * c**2 / 3, 2 * p["mass"] * (R**2 * s**2 / 3 - R * u * s + u**2), R * s / 2 - u)


def teeter(p):
    """The potential -omega^2/2 integral (x cos b + z sin b)^2 + 2 m g z_c cos b + k b^2/2, inertia A + B."""
    A, B, z = moments(p)
    squared = (p["omega"]**2 * (A - B) + p["spring"] - 2 * p["mass"] * p["g"] * z) / (A + B)
    return np.array([1j * math.sqrt(squared)])


class TeeteringRotor(RotorTest):
    scene = "teetering_rotor"

    def check(self, parameter, begin, end, unit=1.0, text=None, **changes):
        file = self.trace_text(text or self.scene_text(), "--parameter", parameter, "--from", repr(begin), "--to", repr(end))
        self.assert_follows(file, lambda q: teeter(self.parameters(**changes, **{parameter: q * unit})), parameter,
                            np.linspace(begin, end, 20))
        return file

    def test_frequency_against_speed(self):
        self.check("omega", 5.0, 60.0)

    def test_frequency_against_spring(self):
        self.check("spring", 0.0, 1e5)

    def test_frequency_against_precone(self):
        self.check("precone", 0.5, 30.0, math.pi / 180.0)

    def test_frequency_against_undersling(self):
        self.check("undersling", 0.0, 1.0)

    def test_flat_rotor_without_spring_teeters_once_per_revolution(self):
        flat = {"precone": 0.0, "undersling": 0.0, "spring": 0.0}
        text = self.changed(**flat)
        file = self.check("omega", 5.0, 60.0, text=text[:text.index("[events]")] + text[text.index("[frame]"):], **flat)
        for omega, s in zip(np.linspace(5, 60, 20), self.spectra(file, np.linspace(5, 60, 20))):
            self.assertAlmostEqual(s[0] / omega, 1j, delta=CLOSE)

    def test_once_per_revolution_is_where_spring_and_cone_balance(self):
        p = self.parameters()
        _, B, z = moments(p)
        expected = math.sqrt((p["spring"] - 2 * p["mass"] * p["g"] * z) / (2 * B))
        (omega, s), = self.special_points(self.trace_scene(), "resonance")
        self.assertAlmostEqual(omega, expected, delta=CLOSE * expected)
        self.assertAlmostEqual(s.imag, expected, delta=CLOSE * expected)


if __name__ == "__main__":
    unittest.main()
