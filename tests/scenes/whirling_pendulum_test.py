"""A pendulum on a hinge that turns about the vertical. With T = (I a'^2 + m l^2 W^2 sin^2 a)/2, I = m l^2 + 2 m r^2/5:
hanging, w^2 = (g/l - W^2) m l^2/I; standing out at cos a = g/(l W^2), w^2 = W^2 sin^2 a  m l^2/I."""

import math
import re
import unittest

import h5py
import numpy as np

from program import SCENES
from scene_test_case import SceneTest

G, LENGTH, RADIUS = 9.81, 0.5, 0.1
SHARE = LENGTH**2 / (LENGTH**2 + 0.4 * RADIUS**2)  # m l^2 / I
BRANCH_POINT = math.sqrt(G / LENGTH)


def hanging(speed):
    """s with Im s >= 0; the positive one of two real roots."""
    square = SHARE * (G / LENGTH - speed**2)
    return 1j * math.sqrt(square) if square >= 0 else math.sqrt(-square)


def angle(speed):
    return math.acos(G / (LENGTH * speed**2))


def standing_out(speed):
    return 1j * math.sqrt(SHARE) * speed * math.sin(angle(speed))


class WhirlingPendulum(SceneTest):
    scene = "whirling_pendulum"

    def check_near_and_far(self, path, places, closed_form):
        """Relative to 1e-10, of the frequency at rest where it is small: s itself is a root at the branch point."""
        for p in places:
            for s in self.eval_at(path, [p])[0]:
                if not math.isnan(s.real):
                    expected = closed_form(p)
                    self.assertLess(min(abs(s - expected), abs(s + expected)), 1e-10 * max(abs(expected), BRANCH_POINT), p)

    def test_the_branch_that_leaves(self):
        path = self.trace_scene()
        self.check_near_and_far(path, [0.0, 1.0, 3.0, 4.0], hanging)
        self.check_near_and_far(path, [4.5, 5.0, 6.0, 8.0, 10.0], standing_out)
        with h5py.File(path) as file:
            omega, x_axis = file["omega"][:], file["equilibrium"][:, 3:6]
        beyond = omega > BRANCH_POINT + 1e-3
        self.assertGreater(np.count_nonzero(beyond), 3)
        for speed, axis in zip(omega[beyond], x_axis[beyond]):
            self.assertAlmostEqual(axis[0], math.cos(angle(speed)), delta=1e-11)
        np.testing.assert_allclose(x_axis[omega < BRANCH_POINT - 1e-3], [[1, 0, 0]] * np.sum(omega < BRANCH_POINT - 1e-3),
                                   atol=1e-12)

    def test_the_other_way(self):
        """Branch 3 is the mirror image: the same frequencies, the ball on the other side."""
        two, three = self.trace_scene(), self.trace_scene("--branch", "3", output="three.h5")
        places = [5.0, 7.0, 10.0]
        self.assert_within(self.eval_at(two, places), self.eval_at(three, places), 1e-10)
        x = [self.coordinate(path, "ball.x")[-1] for path in (two, three)]
        self.assertAlmostEqual(abs(x[0]), LENGTH * math.sin(angle(10.0)), delta=1e-11)
        self.assertAlmostEqual(x[0], -x[1], delta=1e-11)

    def test_straight_on_it_falls(self):
        path = self.trace_scene("--branch", "1")
        self.check_near_and_far(path, [0.0, 2.0, 4.0, 4.5, 6.0, 10.0], hanging)
        roots = self.eval_at(path, [6.0])[0]
        roots = roots[~np.isnan(roots.real)]
        self.assertEqual(len(roots), 2)
        self.assertGreater(max(roots.real), 3.9)
        self.assertLess(abs(sum(roots)), 1e-9)

    def test_the_pitchfork(self):
        for branch in "123":
            pitchforks = self.event_parameters(self.trace_scene("--branch", branch), "branch_point")
            self.assertEqual(len(pitchforks), 1)
            self.assertAlmostEqual(pitchforks[0], BRANCH_POINT, delta=1e-9)
            summary = self.run_well("trace", SCENES / "whirling_pendulum.toml", "--branch", branch, "-o", f"{branch}.h5")
            said = re.findall(r"onset of instability\n +branch_point .*unstable above", summary)
            self.assertEqual(len(said), 1 if branch == "1" else 0)

    def test_from_above(self):
        text = self.scene_text().replace('position = [0, 0, "-length"]',
                                         'position = ["-0.8*length", 0, "-0.6*length"]\n'
                                         'axis_angle = { axis = [0, 1, 0], angle = "acos(0.6)" }')
        path = self.trace_text(text, "--from", "10", "--to", "4.5")
        self.check_near_and_far(path, [10.0, 6.0, 4.6, 4.5], standing_out)

    def test_what_is_simulated(self):
        self.assertEqual(self.redundant(), (12, 11, 0, 1))


if __name__ == "__main__":
    unittest.main()
