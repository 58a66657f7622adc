"""The Jeffcott rotor with internal damping: complex roots at all speeds, and where the forward whirl becomes unstable."""

import math
import unittest

import numpy as np

from rotor_test_case import RotorTest
from scene_test_case import CLOSE


def whirl(p):
    """Roots of m s^2 + (c_e + c_i) s + k - j omega c_i; those with Im < 0 whirl backward and are conjugated."""
    roots = np.roots([p["mass"], p["external"] + p["internal"], p["k"] - 1j * p["omega"] * p["internal"]])
    return np.where(roots.imag < 0.0, roots.conj(), roots)


class Jeffcott(RotorTest):
    scene = "jeffcott"

    def test_roots_at_all_speeds(self):
        file = self.trace_scene()
        self.assert_follows(file, lambda omega: whirl(self.parameters(omega=omega)), "omega", np.linspace(0, 500, 100))

    def test_roots_against_internal_damping(self):
        file = self.trace_scene("--parameter", "internal", "--from", "1", "--to", "2000")
        self.assert_follows(file, lambda c: whirl(self.parameters(internal=c)), "internal", np.linspace(1, 2000, 50))

    def check_threshold(self, external):
        p = self.parameters(external=external)
        text = self.changed(external=external)
        expected = math.sqrt(p["k"] / p["mass"]) * (1 + external / p["internal"])
        (omega, s), = self.special_points(self.trace_text(text), "flutter")
        self.assertAlmostEqual(omega, expected, delta=CLOSE * expected)
        self.assertAlmostEqual(s.imag, math.sqrt(p["k"] / p["mass"]), delta=CLOSE * s.imag)

    def test_threshold_speed(self):
        for external in (10.0, 60.0, 120.0, 155.0):
            with self.subTest(external=external):
                self.check_threshold(external)

    def test_threshold_moves_with_each_parameter(self):
        """Sensitivities of omega_s = sqrt(k/m) (1 + c_e/c_i)."""
        import h5py
        p = self.parameters()
        with h5py.File(self.trace_scene()) as loci:
            kinds = [text.decode().split(",")[0] for text in loci["events"][:]]
            shift = dict(zip([name.decode() for name in loci["scene_parameter"][:]],
                             loci["event_shift"][:][kinds.index("flutter")]))
        natural, ratio = math.sqrt(p["k"] / p["mass"]), 1 + p["external"] / p["internal"]
        expected = {"k": natural * ratio / (2 * p["k"]), "mass": -natural * ratio / (2 * p["mass"]),
                    "external": natural / p["internal"], "internal": -natural * p["external"] / p["internal"]**2}
        for name, slope in expected.items():
            self.assertAlmostEqual(shift[name] / slope, 1.0, places=8, msg=name)

    def test_without_internal_damping_it_is_stable_at_all_speeds(self):
        text = self.changed(internal=0.0)
        self.assertEqual(self.special_points(self.trace_text(text), "flutter"), [])


if __name__ == "__main__":
    unittest.main()
