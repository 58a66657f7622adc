"""`explain --sensitivity` on the scenes: the influence of each effect on a mode at the start of the trace, with the change of
the equilibrium and the constraint forces, compared with differences of closed forms."""

import cmath
import math
import re
import unittest

import four_bar_test
import watt_governor_test
from program import SCENES
from scene_test_case import SceneTest

STEP = 1e-4  # of the strengths; differences are good to 1e-8
PRINTED = 6e-3  # three digits


class Influence(SceneTest):
    def influences(self, scene):
        """By effect, of the first mode: ds/s per relative growth of the effect."""
        text = self.run_well("explain", SCENES / f"{scene}.toml", "--sensitivity")
        first = text[text.index("  mode 1  "):].split("\n  mode ")[0]
        lines = re.findall(r"^ {6}(\w+) +(\S+) +real (\S+) +imag (\S+)$", first, re.MULTILINE)
        found = {name: complex(float(real), float(imag)) for name, _, real, imag in lines}
        for name, size, _, _ in lines:
            self.assertAlmostEqual(abs(found[name]), float(size), delta=PRINTED * abs(found[name]))
        sizes = [float(size) for _, size, _, _ in lines]
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        return found

    def check(self, scene, expected):
        found = self.influences(scene)
        self.assertEqual(sorted(found), sorted(expected))
        for name, value in expected.items():
            self.assertLess(abs(found[name] - value), PRINTED * abs(value) + 1e-9, f"{name}: {found[name]}, not {value}")

    def test_of_a_rod_on_a_hinge(self):
        """All stiffness is that of the hinge's force, which grows with gravity: s goes with the root of either."""
        self.check("physical_pendulum", {"body": -0.5j, "gravity": 0.5j})

    def test_of_a_linkage(self):
        def frequency(gravity, spring):
            usual = four_bar_test.G
            try:
                four_bar_test.G = usual * gravity
                return four_bar_test.steady(0.4, four_bar_test.STIFFNESS * spring)[1]
            finally:
                four_bar_test.G = usual

        def by(*shares):
            ahead, behind = (frequency(*(1 + side * STEP * share for share in shares)) for side in (1, -1))
            return math.log(ahead / behind) / (2 * STEP)

        gravity, spring = by(1, 0), by(0, 1)
        self.assertAlmostEqual(gravity + spring, 0.5, places=7)  # both together: the same equilibrium, all forces grown
        self.check("four_bar", {"body": -0.5j, "gravity": 1j * gravity, "spring": 1j * spring})

    def test_of_a_governor(self):
        """The arms rise as the frame's forces grow and sink as gravity does, and with them the sleeve's share of inertia."""
        g = watt_governor_test
        mass_ratio, square = g.SLEEVE / g.BALL, (300.0 * g.RPM) ** 2

        def root(body=1.0, point=1.0, damper=1.0, frame=1.0, gravity=1.0):
            sine2 = 1.0 - ((1.0 + mass_ratio) * g.G * gravity / (g.ARM * square * frame)) ** 2
            a, b = body + 2.0 * point * mass_ratio * sine2, 2.0 * damper * g.DASHPOT / g.BALL * sine2
            return (-b + cmath.sqrt(b * b - 4.0 * a * square * frame * sine2)) / (2.0 * a)

        s = root()
        self.assertAlmostEqual(s, g.root(300.0), places=12)
        self.check("watt_governor", {name: (root(**{name: 1 + STEP}) - root(**{name: 1 - STEP})) / (2 * STEP * abs(s))
                                     for name in ("body", "point", "damper", "frame", "gravity")})


if __name__ == "__main__":
    unittest.main()
