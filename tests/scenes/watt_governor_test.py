"""Watt's governor: with the angle a of the arms, T = (m l^2 + 2 M l^2 sin^2 a) a'^2 + m l^2 W^2 sin^2 a,
V = -2 (m + M) g l cos a, and the dashpot's power c (2 l sin a a')^2. Steady at cos a = (1 + M/m) g/(l W^2), where
(1 + 2 M/m sin^2 a) s^2 + 2 c/m sin^2 a s + W^2 sin^2 a = 0."""

import cmath
import math
import unittest

import numpy as np

from program import SCENES
from scene_test_case import SceneTest

G, BALL, SLEEVE, ARM, DASHPOT = 9.81, 1.5, 6.0, 0.4, 20.0
RPM = 2.0 * math.pi / 60.0
LOWEST = math.sqrt((1.0 + SLEEVE / BALL) * G / ARM) / RPM  # rpm


def angle(rpm):
    return math.acos((LOWEST / rpm) ** 2)


def root(rpm, dashpot=DASHPOT, sleeve=SLEEVE):
    """The root with Im s > 0."""
    cosine = (1.0 + sleeve / BALL) * G / (ARM * (rpm * RPM) ** 2)
    sine2 = 1.0 - cosine**2
    a, b, c = 1.0 + 2.0 * sleeve / BALL * sine2, 2.0 * dashpot / BALL * sine2, (rpm * RPM) ** 2 * sine2
    return (-b + cmath.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)


class WattGovernor(SceneTest):
    scene = "watt_governor"

    def check(self, path, closed_form, places):
        p, s = self.nodes(path)
        self.assert_within(s[:, 0], np.array([closed_form(x) for x in p]), 1e-10)
        self.assert_within(self.eval_at(path, places)[:, 0], np.array([closed_form(x) for x in places]), 1e-10)

    def test_roots_and_angle_over_the_speed(self):
        path = self.trace_scene()
        self.check(path, root, np.linspace(110.0, 300.0, 20))
        p, _ = self.nodes(path)
        for side, sign in (("right", 1.0), ("left", -1.0)):
            x = self.coordinate(path, f"{side}.x_axis.x")
            np.testing.assert_allclose(x, [sign * math.sin(angle(n)) for n in p], rtol=1e-11)
        np.testing.assert_allclose(self.coordinate(path, "sleeve.z"), [-2 * ARM * math.cos(angle(n)) for n in p], rtol=1e-10)

    def test_without_the_dashpot(self):
        """W sin a / sqrt(1 + 2 M/m sin^2 a); `--without damper` never evaluates it."""
        path = self.trace_scene("--without", "damper")
        self.check(path, lambda n: root(n, dashpot=0.0), [110.0, 150.0, 299.0])

    def test_over_the_mass_of_the_sleeve(self):
        path = self.trace_scene("--parameter", "sleeve", "--from", "6", "--to", "0")
        self.check(path, lambda M: root(300.0, sleeve=M), [0.0, 1.0, 6.0])

    def test_conical_pendulums_without_sleeve(self):
        """M = 0: cos a = g/(l W^2), w = W sin a, as on the whirling pendulum."""
        s = self.eval_at(self.trace_scene("--parameter", "sleeve", "--from", "6", "--to", "0", "--without", "damper"), [0.0])
        self.assert_within(s[0, 0], 1j * 300 * RPM * math.sqrt(1 - (G / (ARM * (300 * RPM) ** 2)) ** 2), 1e-10)

    def test_close_to_the_lowest_speed(self):
        path = self.trace_scene("--to", "105.8", tolerance=1e-8)
        self.assert_within(self.eval_at(path, [105.8])[0, 0], root(105.8), 1e-7)

    def test_hanging_arms_are_a_singular_position(self):
        """At the lowest speed arms and links lie in one line: either side may then move by itself, and the path ends."""
        done = self.run_program("trace", SCENES / "watt_governor.toml", "-o", "loci.h5", "--quiet", "--to", "100")
        self.assertEqual(done.returncode, 1)
        self.assertIn("constraints come to depend on each other", done.stderr)
        p, s = self.nodes(self.folder / "loci.h5")
        self.assertAlmostEqual(p[-1], LOWEST, delta=1e-6)
        self.assertLess(abs(s[-1, 0]), 1e-3)

    def test_a_damping_ratio_is_largest_on_the_way(self):
        """zeta^2 = (c/m)^2 sin^2 a/(W^2 (1 + 2 M/m sin^2 a)); its maximum by golden section of the closed form."""
        ratio = lambda n: -root(n).real / abs(root(n))
        low, high, golden = 106.0, 200.0, (math.sqrt(5) - 1) / 2
        while high - low > 1e-6:
            a, b = high - golden * (high - low), low + golden * (high - low)
            low, high = (low, b) if ratio(a) > ratio(b) else (a, high)
        found = self.events(self.trace_scene(), "extremum")
        self.assertEqual(len(found), 1)
        self.assertAlmostEqual(float(found[0]["parameter"]), low, delta=1e-4)  # the maximum is flat

    def test_what_is_simulated(self):
        self.assertEqual(self.redundant(), (27, 26, 0, 1))


if __name__ == "__main__":
    unittest.main()
