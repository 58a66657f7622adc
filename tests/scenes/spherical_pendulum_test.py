"""The same pendulums seen from a frame at rest and from a turning one: every s becomes s +- j Omega."""

import math
import unittest

import numpy as np

from program import edited
from scene_test_case import SceneTest

G = 9.81

ONE = """\
[parameters]
omega = 0.0
length = 1.3
[trace]
parameter = "omega"
from = 0
to = 6
[frame]
angular_velocity = [0, 0, "omega"]
[gravity]
acceleration = [0, 0, -9.81]
[[point]]
name = "bob"
mass = 2.0
position = [0, 0, "-length"]
[[rod]]
from = [0, 0, 0]
to = "bob"
length = "length"
"""

TWO = ONE + """\
[[point]]
name = "second"
mass = 0.7
position = [0, 0, "-length - 0.6"]
[[rod]]
from = "bob"
to = "second"
length = 0.6
"""

# A body hung from a ball joint turns with the frame: seen from outside it spins.
HANGING_TOP = """\
[parameters]
omega = 0.0
[trace]
parameter = "omega"
from = 0
to = 6
[gravity]
acceleration = [0, 0, -9.81]
[[body]]
name = "top"
mass = 2.0
centre = [0, 0, -0.5]
inertia = [0.1, 0.1, 0.15]
position = [0, 0, 0]
[[universal]]
from = [0, 0, 0]
to = "top"
axis = [1, 0, 0]
cross_axis = "top.y"
"""
FRAME = '[frame]\nangular_velocity = [0, 0, "omega"]\n'
DISC = '[[spinning_disc]]\naxis = "top.z"\npolar_inertia = 0.15\nspeed = "omega"\n'


def double_pendulum(m1=2.0, l1=1.3, m2=0.7, l2=0.6):
    M = np.array([[(m1 + m2) * l1**2, m2 * l1 * l2], [m2 * l1 * l2, m2 * l2**2]])
    K = G * np.diag([(m1 + m2) * l1, m2 * l2])
    return np.sqrt(np.linalg.eigvals(np.linalg.solve(M, K)).real)


class TwoFrames(SceneTest):
    def check(self, path, at_rest, places):
        """`at_rest(omega)`: frequencies of circular motions, both senses as signs, seen from the frame at rest."""
        for omega, s in zip(places, self.eval_at(path, places)):
            expected = np.sort(np.abs(np.asarray(at_rest(omega)) - omega))
            np.testing.assert_allclose(np.sort(s.imag), expected, rtol=1e-10, atol=1e-9)
            self.assertLess(np.abs(s.real).max(), 1e-9)

    def test_spherical_pendulum(self):
        w = math.sqrt(G / 1.3)
        path = self.trace_text(ONE, "--to", "2.5")
        self.check(path, lambda omega: [w, -w], [0.0, 1.0, 2.5])

    def test_double_spherical_pendulum(self):
        w = double_pendulum()
        path = self.trace_text(TWO, "--to", "2")
        self.check(path, lambda omega: [*w, *-w], [0.0, 0.5, 1.3, 2.0])

    def test_at_rest_all_frequencies_are_double(self):
        text = edited(ONE, FRAME, "")
        path = self.trace_text(text.replace("omega = 0.0\n", ""), "--parameter", "length", "--from", "1", "--to", "3")
        for length, s in zip((1.0, 2.2), self.eval_at(path, [1.0, 2.2])):
            np.testing.assert_allclose(s.imag, [math.sqrt(G / length)] * 2, rtol=1e-10)

    def test_hanging_top(self):
        """I1 q'' - j I3 W q' + m g l q = 0 in the frame at rest, from both descriptions."""
        tip = 0.1 + 2.0 * 0.25

        def at_rest(omega):
            root = math.sqrt((0.15 * omega) ** 2 + 4.0 * tip * 2.0 * G * 0.5)
            return [(0.15 * omega + root) / (2.0 * tip), (0.15 * omega - root) / (2.0 * tip)]

        places = [0.0, 1.0, 2.4, 3.3]
        turning = self.trace_text(HANGING_TOP + FRAME, "--to", "3.3", output="turning.h5")
        self.check(turning, at_rest, places)
        resting = self.trace_text(HANGING_TOP + DISC, "--to", "3.3", output="resting.h5")
        for omega, s in zip(places, self.eval_at(resting, places)):
            np.testing.assert_allclose(np.sort(s.imag), np.sort(np.abs(at_rest(omega))), rtol=1e-10)


if __name__ == "__main__":
    unittest.main()
