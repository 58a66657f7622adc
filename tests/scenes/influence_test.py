"""`explain --sensitivity` on the scenes: the influence of each effect on a mode at the start of the trace, with the change of
the equilibrium and the constraint forces, compared with differences of closed forms."""

import cmath
import json
import math
import re
import unittest

import numpy as np

import four_bar_test
import watt_governor_test
from program import SCENES, edited
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


# A rotor whose effects have factors of their own; the gyroscopic moments come from all inertia.
ROTOR = """\
parameters = { speed = { value = 3000, unit = "rpm" }, e = 1, b = 1, f = 1, i = 1 }
trace = { parameter = "speed", from = 3000, to = 4000, modes = 4 }
disc = [{ node = 3, mass = 60, Id = 1.5, Ip = 2.5 }]
bearing = [
  { node = 1, kxx = "b*2e7", kyy = "b*3e7", kxy = "b*1e6", kyx = "-b*1e6", cxx = "b*2e4" },
  { node = 5, kxx = "f*1e7", cxx = "f*1e4", mxx = "f*3" },
]
[[shaft]]
stations = { length = [0.5, 0.5], outer = [0.06, 0.08] }
elements = 2
E = "e*2e11"
nu = 0.3
density = 7850
speed = "speed"
internal_damping = "i*1e-5"
alpha = 2
"""


class InfluenceInARotor(SceneTest):
    def spectrum(self, scene, *options):
        self.write("scene.toml", scene)
        rows = json.loads(self.run_well("spectrum", "scene.toml", "--at", "3000", "--json", *options))
        return [complex(row["real"], row["imag"]) for row in rows]

    def influences(self):
        """By effect, per mode: ds/|s| per relative growth of the effect."""
        self.write("scene.toml", ROTOR)
        text = self.run_well("explain", "scene.toml", "--sensitivity")
        found = {}
        for mode in re.split(r"\n  mode ", text)[1:]:
            for name, real, imag in re.findall(r"^ {6}(\w+) +\S+ +real (\S+) +imag (\S+)$", mode, re.MULTILINE):
                found.setdefault(name, []).append(complex(float(real), float(imag)))
        return found

    def test_is_the_difference_of_eigenvalues(self):
        found = self.influences()
        self.assertEqual(set(found), {"shaft", "shaft_mass", "disc", "gyroscopic", "shaft_damping", "internal_damping",
                                      "bearing", "seal"})
        # Internal damping is a multiple of the stiffness: to grow the elastic forces alone it shrinks with E.
        for effect, factors in {"shaft": {"e": 1, "i": -1}, "bearing": {"b": 1}, "seal": {"f": 1}, "internal_damping": {"i": 1}}.items():
            ends = []
            for side in (1, -1):
                scene = ROTOR
                for name, power in factors.items():
                    scene = edited(scene, f" {name} = 1", f" {name} = {(1 + side * STEP) ** power!r}")
                ends.append(self.spectrum(scene))
            for given, ahead, behind in zip(found[effect], *ends):
                value = (ahead - behind) / (2 * STEP * abs(ahead))
                self.assertLess(abs(given - value), PRINTED * abs(value) + 1e-9, effect)

    def test_of_a_large_rotor_is_that_of_a_small_one(self):
        """Of 80 elements, whose matrices are sparse; elements are exact enough from eight on."""
        found = []
        for share in (4, 40):
            scene = edited(edited(ROTOR, "elements = 2", f"elements = {share}"), "node = 5,", f"node = {2 * share + 1},")
            scene = edited(scene, "node = 3,", f"node = {share + 1},")
            self.write("scene.toml", scene)
            found.append(self.run_well("explain", "scene.toml", "--sensitivity", "--modes", "1"))
        first, second = (re.findall(r"^ {6}(\w+) +\S+ +real (\S+) +imag (\S+)$", text, re.MULTILINE) for text in found)
        self.assertEqual(len(first), 8)
        for (name, *one), (other, *two) in zip(first, second):
            self.assertEqual(name, other)
            np.testing.assert_allclose(complex(*map(float, one)), complex(*map(float, two)), rtol=1e-2, atol=1e-7)

    def test_an_effect_left_out_is_one_that_the_scene_has_not(self):
        rigid = [("internal_damping", "#"), (", i = 1", "")]
        still = [('speed = "speed"', "#"), *rigid]  # the speed drives internal damping, too
        cases = {"internal_damping": rigid, "shaft_damping": [("alpha", "#")],
                 "seal": [("  { node = 5", "#"), (" f = 1,", "")], "gyroscopic,internal_damping": still,
                 "disc,gyroscopic,internal_damping": [("disc = [", "#"), *still]}
        for effects, edits in cases.items():
            scene = ROTOR
            for old, new in edits:
                scene = edited(scene, old, new)
            np.testing.assert_allclose(self.spectrum(ROTOR, "--without", effects), self.spectrum(scene), rtol=1e-8,
                                       err_msg=effects)


if __name__ == "__main__":
    unittest.main()
