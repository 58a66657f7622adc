"""A top upright on its tip. With the complex tilt q = x + j y: I1 q'' - j I3 W q' - m g l q = 0, I1 about the tip, so
s = j v, v = (I3 W +- sqrt(I3^2 W^2 - 4 m g l I1))/(2 I1); in a frame that spins with the top s = j (v - W)."""

import math
import unittest

import numpy as np

from program import edited
from scene_test_case import SceneTest

G, MASS, HEIGHT, TRANSVERSE, POLAR = 9.81, 0.5, 0.04, 3e-4, 5e-4
TIP = TRANSVERSE + MASS * HEIGHT**2
LEAST_SPIN = math.sqrt(4.0 * MASS * G * HEIGHT * TIP) / POLAR

# The same top, its axis seen from a frame at rest: what spins is an angular momentum that turns with the axis.
AT_REST = '[[spinning_disc]]\naxis = "top.z"\npolar_inertia = "polar"\nspeed = "spin"\n'


def precession(spin):
    """Both v, complex below the least spin."""
    root = np.sqrt(complex((POLAR * spin) ** 2 - 4.0 * MASS * G * HEIGHT * TIP))
    return (POLAR * spin + np.array([1, -1]) * root) / (2.0 * TIP)


def upper(s):
    """Members with Im s >= 0 of the pairs, sorted: real parts that are equal but for rounding do not count."""
    s = np.where(s.imag < 0, s.conj(), s)
    return s[np.lexsort((s.imag, np.round(s.real, 6)))]


class SleepingTop(SceneTest):
    scene = "sleeping_top"

    def at_rest(self):
        return edited(self.scene_text(), '[frame]\nangular_velocity = [0, 0, "spin"]\n', AT_REST)

    def check_roots(self, path, shift, places):
        found = self.eval_at(path, places)
        for spin, s in zip(places, found):
            expected = 1j * (precession(spin) - shift * spin)
            np.testing.assert_allclose(upper(s), upper(expected), rtol=0, atol=1e-10 * abs(expected).max())

    PLACES = (100.0, 90.0, 70.0, 60.0, 55.0, 40.0, 30.0)

    def test_in_the_spinning_frame(self):
        self.check_roots(self.trace_scene(), 1.0, self.PLACES)

    def test_in_the_frame_at_rest(self):
        self.check_roots(self.trace_text(self.at_rest()), 0.0, self.PLACES)

    def test_one_view_is_the_other_shifted_by_the_spin(self):
        """All four eigenvalues of each: s -> s +- j W."""
        spinning, resting = self.trace_scene(), self.trace_text(self.at_rest(), output="rest.h5")
        for spin in (100.0, 80.0, 65.0):
            turned = self.eval_at(spinning, [spin])[0]
            still = self.eval_at(resting, [spin])[0]
            shifted = np.sort(np.abs(np.abs(still.imag) - spin))
            np.testing.assert_allclose(np.sort(turned.imag), shifted, rtol=1e-10)

    def test_the_least_spin(self):
        """Two frequencies meet there and leave the imaginary axis, in either view."""
        self.assertAlmostEqual(LEAST_SPIN, 58.763253824, places=8)
        for path in (self.trace_scene(), self.trace_text(self.at_rest(), output="rest.h5")):
            found = [event for event in self.events(path) if event["kind"] in ("collision", "flutter")]
            self.assertGreaterEqual(len(found), 1)
            for event in found:
                self.assertAlmostEqual(float(event["parameter"]), LEAST_SPIN, delta=1e-9)

    def test_how_the_least_spin_moves(self):
        """Logarithmic derivatives of sqrt(4 m g l (I + m l^2))/I3."""
        expected = {"g": 0.5 / G, "mass": 0.5 * (1.0 / MASS + HEIGHT**2 / TIP), "height": 0.5 / HEIGHT + MASS * HEIGHT / TIP,
                    "transverse": 0.5 / TIP, "polar": -1.0 / POLAR}
        file = self.open(self.trace_scene().name)
        names = [name.decode() for name in file["scene_parameter"]]
        shift = file["event_shift"][0]
        for name, slope in expected.items():
            unit = 1e-3 if name == "height" else 1.0  # per mm
            self.assertAlmostEqual(shift[names.index(name)] / (LEAST_SPIN * slope * unit), 1.0, delta=1e-6, msg=name)

    def test_stable_range_ends_there(self):
        text = self.run_well("info", self.trace_scene())
        self.assertRegex(text, r"marginal +spin = 100 -> 58\.76325382")

    def test_without_spin_it_falls(self):
        path = self.trace_text(self.at_rest(), "--from", "30", "--to", "0")
        s = self.eval_at(path, [0.0])[0]
        s = s[~np.isnan(s.real)]
        self.assertAlmostEqual(max(s.real), math.sqrt(MASS * G * HEIGHT / TIP), delta=1e-6)

    def test_on_a_ball_joint_the_spin_itself_is_neutral(self):
        text = edited(self.scene_text(), "[[universal]]", "[[ball]]")
        text = edited(edited(text, "axis = [1, 0, 0]\n", ""), 'cross_axis = "top.y"\n', "")
        self.assertEqual(self.redundant(text)[3], 3)
        path = self.trace_text(text, "--to", "70", tolerance=1e-8)
        for spin in (100.0, 85.0, 70.0):
            s = self.eval_at(path, [spin])[0]
            s = np.sort(s[~np.isnan(s.real)].imag)
            np.testing.assert_allclose(s[-2:], np.sort(abs(precession(spin).real - spin)), rtol=1e-7)
            np.testing.assert_allclose(s[:-2], 0.0, atol=1e-4)

    def test_what_is_simulated(self):
        self.assertEqual(self.redundant(), (12, 10, 0, 2))
        self.write("rest.toml", self.at_rest())
        explained = self.run_well("explain", "rest.toml")
        self.assertIn("spinning_disc  1", explained)


if __name__ == "__main__":
    unittest.main()
