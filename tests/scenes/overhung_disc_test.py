"""The overhung disc: whirl frequencies with gyroscopic splitting, and critical speeds."""

import math
import re
import unittest

import numpy as np

from rotor_test_case import RotorTest
from scene_test_case import CLOSE


def stiffness(p):
    """Of a clamped shaft's free end: displacement, coupling, slope."""
    return tuple(a * p["bending"] / p["length"]**n for a, n in ((12, 3), (-6, 2), (4, 1)))


def whirl(p):
    """s^2 diag(m, I_d) + s diag(0, -j I_p omega) + k in x + jy and its slope (Genta, Dynamics of Rotating Systems, 2005)."""
    k11, k12, k22 = stiffness(p)
    M, K = np.diag([p["mass"], p["diametral"]]), np.array([[k11, k12], [k12, k22]])
    C = np.diag([0.0, -1j * p["polar"] * p["omega"]])
    s = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]]))
    return 1j * np.abs(s.imag)  # backward whirl has Im < 0


def critical_speeds(p, harmonic, directions=("forward", "backward")):
    """Whirl with w = +-n omega: a quadratic in omega^2 for either direction."""
    k11, k12, k22 = stiffness(p)
    n, speeds = harmonic, []
    for polar in (p["polar"] * {"forward": 1, "backward": -1}[direction] for direction in directions):
        inertia = n * polar - n**2 * p["diametral"]
        squares = np.roots([-p["mass"] * n**2 * inertia, k11 * inertia - p["mass"] * n**2 * k22, k11 * k22 - k12**2])
        speeds += [math.sqrt(x) for x in squares if x > 0.0]
    return sorted(speeds)


class OverhungDisc(RotorTest):
    scene = "overhung_disc"

    def check(self, parameter, begin, end):
        file = self.trace_scene("--parameter", parameter, "--from", repr(begin), "--to", repr(end))
        self.assert_follows(file, lambda q: whirl(self.parameters(**{parameter: q})), parameter,
                            np.linspace(begin, end, 50))

    def test_whirl_frequencies_against_speed(self):
        self.check("omega", 0.0, 2000.0)

    def test_whirl_frequencies_against_inertia_and_length(self):
        self.check("polar", 0.01, 0.2)
        self.check("length", 0.2, 1.0)

    def test_critical_speeds(self):
        p = self.parameters()
        found = sorted(omega for omega, _ in self.special_points(self.trace_scene(), "resonance"))
        expected = sorted(omega for n in (1, 2) for omega in critical_speeds(p, n) if omega <= 2000.0)
        self.assertEqual(len(found), len(expected), (found, expected))
        self.assertGreater(len(found), 3)
        np.testing.assert_allclose(found, expected, rtol=CLOSE)

    def table_of_critical_speeds(self, *options, old="", new=""):
        """(harmonic, direction, speed) of the rows of the summary."""
        self.write("disc.toml", self.scene_text().replace(old, new))
        summary = self.run_well("trace", "disc.toml", "--force", *options)
        rows = re.findall(r"^ +(\d)x, (\w+) +omega = (\S+) ", summary, re.MULTILINE)
        return [(int(n), direction, float(speed)) for n, direction, speed in rows]

    def test_critical_speeds_are_forward_or_backward(self):
        found = self.table_of_critical_speeds()
        self.assertEqual(len(found), 6)
        for n, direction, speed in found:
            least = min(abs(speed - omega) for omega in critical_speeds(self.parameters(), n, [direction]))
            self.assertLess(least, CLOSE * speed, (n, direction, speed))
        self.assertEqual(found, sorted(found, key=lambda row: row[2]))

    def test_direction_is_told_by_the_sense_of_the_spin(self):
        """The disc turns the other way: the same speeds, and the same words."""
        there = self.table_of_critical_speeds()
        back = self.table_of_critical_speeds(old='speed = "omega"', new='speed = "-omega"')
        self.assertEqual([row[:2] for row in back], [row[:2] for row in there])
        np.testing.assert_allclose([row[2] for row in back], [row[2] for row in there], rtol=CLOSE)

    def test_disc_that_does_not_spin_has_pairs_of_equal_frequencies(self):
        s = np.sort(self.spectra(self.trace_scene(), [0.0])[0].imag)
        np.testing.assert_allclose(s[::2], s[1::2], rtol=CLOSE)


if __name__ == "__main__":
    unittest.main()
