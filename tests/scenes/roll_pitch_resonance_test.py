"""Three flapping and lagging blades on a fuselage that rolls and pitches: Floquet multipliers of the periodic equations blade
by blade, also about blades that droop under gravity, and loads that the hub carries."""

import math
import unittest

import h5py
import numpy as np
from scipy.optimize import brentq

from periodic_rotor import PeriodicRotor, on_a_line
from rotor_test_case import RotorTest

RPM = math.pi / 30.0
GRAVITY = "\n[gravity]\nacceleration = [0, 0, -9.81]\n"


class RollPitchResonance(RotorTest):
    scene = "roll_pitch_resonance"

    def periodic(self, p, blades=3, gravity=0.0):
        free = list(range(2, 4 + 2 * blades))
        droop = lambda b: math.cos(b) * (p["first"] * gravity + p["second"] * p["omega"]**2 * math.sin(b)) + \
            p["offset"] * p["first"] * p["omega"]**2 * math.sin(b)
        rotor = PeriodicRotor(blades, p["omega"], p["offset"], p["height"],
                              on_a_line(p["blade_mass"], p["first"], p["second"]), free,
                              flap=brentq(droop, -1.0, 1.0, xtol=1e-15), gravity=gravity)
        for at, name in ((2, "roll"), (3, "pitch")):
            rotor.M[at, at], rotor.C[at, at], rotor.K[at, at] = p[name], p["c_" + name], p["k_" + name]
        for blade in range(blades):
            rotor.C[4 + 2 * blade, 4 + 2 * blade] = p["flap_damper"]
            rotor.C[5 + 2 * blade, 5 + 2 * blade] = p["lag_damper"]
        return rotor

    def test_floquet_multipliers(self):
        file = self.trace_scene()
        for rpm in (90.0, 175.0, 300.0):
            with self.subTest(rpm):
                rotor = self.periodic(self.parameters(omega=rpm * RPM))
                self.assert_multipliers(rotor, self.spectra(file, [rpm])[0])

    def test_floquet_multipliers_of_five_blades(self):
        """With second harmonics, which leave the fuselage at rest."""
        file = self.trace_text(self.scene_text().replace("blades = 3", "blades = 5"), "--from", "150", "--to", "200")
        self.assert_multipliers(self.periodic(self.parameters(omega=175 * RPM), blades=5), self.spectra(file, [175.0])[0])

    def test_floquet_multipliers_about_drooping_blades(self):
        file = self.trace_text(self.scene_text() + GRAVITY, "--from", "90", "--to", "200")
        p = self.parameters(omega=120 * RPM)
        rotor = self.periodic(p, gravity=9.81)
        self.assertLess(rotor.flap, -0.01)
        self.assert_multipliers(rotor, self.spectra(file, [120.0])[0])

    def test_it_is_unstable_where_the_multipliers_grow(self):
        speeds = sorted(rpm for rpm, _ in self.special_points(self.trace_scene(), "flutter"))
        self.assertEqual(len(speeds), 2)
        for rpm in speeds:
            largest = np.max(abs(self.periodic(self.parameters(omega=rpm * RPM)).multipliers()))
            self.assertAlmostEqual(largest, 1.0, delta=1e-8)

    def test_hub_carries_all_blades(self):
        """On a spring along the axis it sinks by the weight of the fuselage and of three blades."""
        text = self.scene_text().replace('[[universal]]\nname = "gear"', '''[[body]]
name = "strut"
mass = 0
position = [0, 0, 0]

[[prismatic]]
from = [0, 0, 0]
to = "strut"
axis = [0, 0, 1]

[[guided_spring]]
point = "strut"
direction = [0, 0, 1]
stiffness = 2e5

[[universal]]
name = "gear"''', 1).replace('from = [0, 0, 0]\nto = "fuselage"', 'from = "strut"\nto = "fuselage"')
        text = text.replace('hub    = "fuselage"', 'hub    = "fuselage"\nsupport = ["strut"]') + GRAVITY
        file = self.trace_text(text, "--from", "150", "--to", "200", "--modes", "4")
        sunk = self.equilibrium(file, "fuselage")[:, 2]
        np.testing.assert_allclose(sunk, -(2000 + 3 * 40) * 9.81 / 2e5, rtol=1e-12)

    def test_modes_are_named_as_waves(self):
        with h5py.File(self.trace_scene()) as file:
            names = [name.decode() for name in file["mode_name"][:]]
        for name in ("blade flap collective", "blade lag collective"):
            self.assertIn(name, names)
        self.assertTrue(any("progressive" in name for name in names), names)

    def test_explain_says_what_is_blade_and_support(self):
        self.write("scene.toml", self.scene_text())
        explained = self.run_well("explain", "scene.toml")
        self.assertIn("3 equal blades turn on 'fuselage'; one of them is blade. What stands: fuselage.", explained)
        self.assertEqual(self.redundant()[3], 8)


if __name__ == "__main__":
    unittest.main()
