"""A hingeless rotor in hover: the trim against closed forms, the blade's own frequencies, and flap-lag-torsion flutter against
the same blade with pitch and inflow as numbers."""

import re
import unittest

import h5py
import numpy as np

from program import edited
from rotor_test_case import RotorTest

OMEGA, RADIUS, DENSITY = 40.0, 5.0, 1.225
AREA = np.pi * RADIUS**2
BENDING = 1e3  # rad/s: above the lowest modes in bending and torsion, below those of stretching


def without_tables(text, *names):
    """The text without these tables."""
    for name in names:
        text = re.sub(rf"(?ms)^\[\[{name}\]\].*?(?=^\[|\Z)", "", text)
    return text


class HingelessRotor(RotorTest):
    scene = "hingeless_rotor"

    def traced(self, text, *options, tolerance=1e-5):
        return self.trace_text(text, "--no-certify", *options, tolerance=tolerance)

    def flutter(self, text):
        """Thrusts between which the lag grows, and the frequencies there. Stretching modes, without damping of their own, may
        grow, too."""
        events = self.special_points(self.traced(text), "flutter")
        return [(event[0], event[1].imag) for event in events if abs(event[1]) < BENDING]

    def test_frequencies_of_the_blade_in_vacuo(self):
        """Those that Hodges & Ormiston's blade has, per revolution."""
        text = without_tables(self.changed(precone=0.0, pitch=0.0), "trim", "strips", "apparent_mass")
        text = edited(text, 'parameter = "thrust"', 'parameter = "omega"')
        text = edited(edited(text, "from      = 1000", "from = 40"), "to        = 30000", "to = 39.9")
        text = edited(text, '"mass * omega^2 * radius^4"', '"mass * 1600 * radius^4"')
        self.write("scene.toml", text)  # parameters of the air are not used, which is a warning
        self.assertEqual(self.run_program("trace", "scene.toml", "-o", "loci.h5", "--no-certify").returncode, 0)
        (s,) = self.spectra("loci.h5", [OMEGA])
        per_revolution = np.sort(abs(s.imag)) / OMEGA
        for expected, tolerance in ((1.15, 0.002), (1.5, 0.005), (5.0, 0.02)):
            self.assertLess(np.min(abs(per_revolution - expected)), tolerance, per_revolution)

    def test_inflow_is_that_of_momentum_theory(self):
        file = self.traced(self.scene_text(), tolerance=1e-4)
        with h5py.File(file) as loci:
            np.testing.assert_allclose(loci["inflow"][:], np.sqrt(loci["thrust"][:] / (2 * DENSITY * AREA)), rtol=1e-9)
            self.assertEqual(loci["pitch"].attrs["units"], "rad")
            self.assertIn("force(air, z) = thrust / blades", loci["pitch"].attrs["long_name"])
            self.assertTrue(np.all(np.diff(loci["pitch"][:]) > 0))

    def test_eigenvalues_are_those_of_the_blade_with_pitch_and_inflow_held(self):
        """The same blade without trim, its pitch and inflow numbers."""
        trimmed = self.traced(self.scene_text(), "--from", "9000", "--to", "11000", tolerance=1e-6)
        (expected,) = self.spectra(trimmed, [10000.0])
        values = {}
        for line in self.run_well("eval", trimmed, "--at", "10000", "--csv").splitlines():
            cells = line.split(",")
            if cells[0] == "parameter":
                names = cells
            else:
                values = {name: float(cells[names.index(name)]) for name in ("pitch", "inflow")}
        text = without_tables(self.changed(**values), "trim")
        text = edited(text, 'parameter = "thrust"', 'parameter = "inflow"')
        text = edited(edited(text, "from      = 1000", f"from = {values['inflow']!r}"), "to        = 30000", "to = 9")
        self.write("scene.toml", text)
        self.assertEqual(self.run_program("trace", "scene.toml", "-o", "held.h5", "--no-certify").returncode, 0)
        (held,) = self.spectra("held.h5", [values["inflow"]])
        self.assert_same_spectrum(held[abs(held) < BENDING], expected[abs(expected) < BENDING], 1e-5)

    def test_flutter_converges_with_elements(self):
        found = [self.flutter(edited(self.scene_text(), "elements     = 6", f"elements = {n}")) for n in (4, 6, 9)]
        for thrusts in found:
            self.assertEqual(len(thrusts), 2)
        coarse, middle, fine = np.array(found)
        np.testing.assert_allclose(middle, fine, rtol=0.02)
        np.testing.assert_array_less(3.0 * abs(middle - fine)[:, 0], abs(coarse - fine)[:, 0])
        # The lag mode grows between them.
        self.assertTrue(np.all(abs(fine[:, 1] / OMEGA - 1.47) < 0.03))

    def test_it_is_stable_without_precone(self):
        self.assertEqual(self.flutter(self.changed(precone=0.0)), [])


if __name__ == "__main__":
    unittest.main()
