"""Units: the same system in other units has the same eigenvalues, critical speeds and flutter."""

import csv
import io
import json
import math
import unittest

import numpy as np

from command_test_case import CommandTest
from program import BLADE, edited

# A rigid rotor on two bearings that cross-couple more and more with the speed: its critical speeds, and flutter at 95.66 rev/s
# (of the whole shaft) come from the speed in three places: the spin of the discs, the coupling, and the harmonics.
ROTOR = """\
prismatic = [
  { from = [0, 0, 0], to = "slide y", axis = [0, 1, 0] },
  { from = "slide y", to = "slide", axis = [0, 0, 1] },
]
body = [
  { name = "disc", mass = "m", inertia = ["Ip", "Id", "Id"], position = [0, 0, 0], markers = { left = [-0.3, 0, 0], right = [0.4, 0, 0] } },
  { name = "slide", mass = 0, position = [0, 0, 0] },
  { name = "slide y", mass = 0, position = [0, 0, 0] },
]

[parameters]
speed = { value = 100, unit = "UNIT" }
m   = 40
Id  = 2.0
Ip  = 0.4
kxy = "500*speed"

[trace]
parameter = "speed"
from = 0
to = "TO"
tolerance = 1e-9

[events]
harmonics = 1

[[spinning_disc]]
axis = "disc.x"
polar_inertia = "Ip"
speed = "speed"

[[bearing]]
point = "disc.left"
seat = [-0.3, 0, 0]
first = [0, 1, 0]
second = [0, 0, 1]
stiffness = [[2e6, "kxy"], ["-kxy", 1e6]]
damping = [[200, 0], [0, 150]]

[[bearing]]
point = "disc.right"
seat = [0.4, 0, 0]
first = [0, 1, 0]
second = [0, 0, 1]
stiffness = [[2e6, "kxy"], ["-kxy", 1e6]]
damping = [[200, 0], [0, 150]]

[[universal]]
from = { body = "slide", at = [0, 0, 0] }
to = "disc"
axis = [0, 1, 0]
cross_axis = [0, 0, 1]
"""

# Units of the speed: rad/s in one of them.
SPEEDS = {"rad/s": 1.0, "rpm": math.pi / 30, "rev/s": 2 * math.pi, "Hz": 2 * math.pi, "kHz": 2000 * math.pi, "deg/s": math.pi / 180}


class RotorSpeed(CommandTest):
    def events(self, unit):
        to = 200 * 2 * math.pi / SPEEDS[unit]
        self.trace(ROTOR.replace("UNIT", unit).replace('"TO"', repr(to)), "--force")
        rows = csv.DictReader(io.StringIO(self.run_well("events", "loci.h5", "--csv")))
        return [(row["kind"], float(row["parameter"]) * SPEEDS[unit], complex(float(row["real"]), float(row["imag"])))
                for row in rows]

    def test_has_the_same_critical_speeds_and_flutter_in_every_unit(self):
        expected = self.events("rad/s")
        kinds = [kind for kind, *_ in expected]
        self.assertIn("resonance", kinds)
        self.assertIn("flutter", kinds)
        for unit in SPEEDS:
            found = self.events(unit)
            self.assertEqual([kind for kind, *_ in found], kinds, unit)
            np.testing.assert_allclose([p for _, p, _ in found], [p for _, p, _ in expected], rtol=1e-8, err_msg=unit)
            np.testing.assert_allclose([s for *_, s in found], [s for *_, s in expected], atol=1e-5, err_msg=unit)

    def test_critical_speed_is_the_damped_frequency(self):
        """Im s of a resonance with the first harmonic is the speed itself."""
        for kind, speed, s in self.events("Hz"):
            if kind == "resonance":
                self.assertAlmostEqual(s.imag, speed, delta=1e-8 * speed)


class ValuesWithUnits(CommandTest):
    def rows(self, *at):
        return [(row["parameter"], row["imag"]) for row in json.loads(self.run_well("eval", "loci.h5", "--json", "--at", *at))]

    def test_lists_and_ranges_are_places(self):
        self.trace(BLADE)
        self.assertEqual(self.rows("10,20"), self.rows("10", "20"))
        self.assertEqual(self.rows("10:5:25"), self.rows("10", "15", "20", "25"))
        self.assertEqual(self.rows("25:-5:12"), self.rows("25", "20", "15"))
        self.assertEqual([p for p, _ in self.rows("10:0.1:10.3")][::2], [10.0, 10.1, 10.2, 10 + 3 * 0.1])

    def test_units_are_converted_to_that_of_the_parameter(self):
        self.trace(BLADE, "--from", "15 Hz", "--to", "100rpm")
        info = json.loads(self.run_well("info", "loci.h5", "--json"))
        np.testing.assert_allclose((info["from"], info["to"]), (30 * math.pi, math.pi / 0.3), rtol=1e-15)
        np.testing.assert_allclose([p for p, _ in self.rows("2,4 Hz")][::2], [4 * math.pi, 8 * math.pi], rtol=1e-15)

    def test_a_range_in_the_scene_may_have_units(self):
        self.trace(edited(BLADE, "from = 100.0", 'from = "900 rpm"'))
        self.assertAlmostEqual(json.loads(self.run_well("info", "loci.h5", "--json"))["from"], 30 * math.pi, delta=1e-12)


class Frequencies(CommandTest):
    def test_both_have_their_names(self):
        """At 1x the damped frequency is the speed; the natural one, abs(s), is larger."""
        self.trace(BLADE)
        for row in json.loads(self.run_well("eval", "loci.h5", "--json", "--at", "20", "30")):
            s = complex(row["real"], row["imag"])
            self.assertEqual(row["natural_frequency"], abs(s))
            self.assertEqual(row["damped_frequency"], s.imag)
            self.assertGreater(row["natural_frequency"], row["damped_frequency"])
            self.assertAlmostEqual(row["log_decrement"], -2 * math.pi * s.real / s.imag, delta=1e-14)
        with self.open("loci.h5") as file:
            s = file["eigenvalue"][:]
            np.testing.assert_array_equal(file["damped_frequency"][:], np.abs(s.imag))
            np.testing.assert_allclose(file["frequency"][:], np.abs(s), rtol=1e-15)


if __name__ == "__main__":
    unittest.main()
