"""A thin rod on a hinge: omega^2 = g d / (d^2 + k^2) with the distance d of the hinge from the centre and k^2 = L^2/12."""

import math
import unittest

import h5py
import numpy as np

from program import edited
from scene_test_case import CLOSE, SceneTest

G, MASS, LENGTH = 9.81, 2.0, 1.0
GYRATION = LENGTH / math.sqrt(12.0)


def frequency(offset):
    return math.sqrt(G * offset / (offset**2 + GYRATION**2))


def directors_of_a_hanging_bar(offset):
    """M, A, the force of gravity and the Hessians of the constraints, in the bar's origin and three directors."""
    moments = np.diag([MASS, MASS * GYRATION**2, 0.0, 0.0])  # of mass about the centre: 1, x^2 along the bar
    M = np.kron(moments, np.eye(3))
    q = np.concatenate([[0, 0, -offset], [0, 0, -1], [0, 1, 0], [1, 0, 0]]).astype(float)
    force = np.concatenate([[0, 0, -MASS * G], np.zeros(9)])
    rows, hessians = [], []
    block = lambda i: slice(3 * i, 3 * i + 3)
    for i in (1, 2, 3):  # the directors stay unit vectors at right angles
        for j in range(i, 4):
            H = np.zeros((12, 12))
            H[block(i), block(j)] += np.eye(3)
            H[block(j), block(i)] += np.eye(3)
            rows.append(H @ q)
            hessians.append(H)
    for axis in range(3):  # the hinge: origin - offset x_axis stays where it is
        row = np.zeros(12)
        row[axis], row[3 + axis] = 1.0, -offset
        rows.append(row)
        hessians.append(np.zeros((12, 12)))
    for i in (1, 3):  # its axis stays at right angles to x_axis and z_axis
        row = np.zeros(12)
        row[3 * i + 1] = 1.0
        rows.append(row)
        hessians.append(np.zeros((12, 12)))
    return M, np.array(rows), force, hessians


def reduced_frequency(offset, with_constraint_stiffness):
    M, A, force, hessians = directors_of_a_hanging_bar(offset)
    multipliers = np.linalg.lstsq(A.T, force, rcond=None)[0]  # the equilibrium: A^T lambda = force
    assert np.allclose(A.T @ multipliers, force)
    T = np.linalg.svd(A)[2][-1]
    assert np.linalg.matrix_rank(A) == 11
    K = np.zeros((12, 12))  # gravity is the same everywhere: no stiffness of its own
    if with_constraint_stiffness:
        K = sum(m * H for m, H in zip(multipliers, hessians))
    return math.sqrt((T @ K @ T) / (T @ M @ T))


class PhysicalPendulum(SceneTest):
    scene = "physical_pendulum"

    def test_frequency_over_the_offset(self):
        self.check_frequencies(self.trace_scene(), lambda d: [frequency(d)], np.linspace(0.05, 0.5, 19))

    def test_frequency_over_the_length_hung_by_the_end(self):
        text = edited(self.scene_text(), 'offset = { value = 0.5, unit = "m" }', 'offset = "length / 2"')
        path = self.trace_text(text, "--parameter", "length", "--from", "0.5", "--to", "4")
        self.check_frequencies(path, lambda L: [math.sqrt(1.5 * G / L)], np.linspace(0.5, 4.0, 15))

    def test_the_mass_does_not_matter(self):
        path = self.trace_scene("--parameter", "mass", "--from", "0.1", "--to", "1000")
        self.check_frequencies(path, lambda m: [frequency(0.5)], [0.1, 3.3, 1000.0])

    def test_it_swings_fastest_at_the_radius_of_gyration(self):
        path = self.trace_scene("--from", repr(GYRATION), "--to", "0.5")
        with h5py.File(path) as file:
            slopes = file["eigenvalue_derivative"][:, 0]
        self.assertLess(abs(slopes[0]), 1e-9 * abs(slopes[-1]))
        path = self.trace_scene()
        beside = GYRATION + np.array([-1e-3, 0.0, 1e-3])
        s = self.eval_at(path, beside)[:, 0].imag
        self.assertGreater(s[1], max(s[0], s[2]))

    def test_conjugate_hinges_swing_alike(self):
        """Huygens: hinges at d and k^2/d from the centre have the same period."""
        path = self.trace_scene()
        d = 0.4
        one, other = self.eval_at(path, [d, GYRATION**2 / d])[:, 0]
        self.assert_within(one, other, CLOSE)

    def test_the_stiffness_is_that_of_the_constraint_forces(self):
        """Gravity and hinge add nothing to K in directors; without (A^T lambda)_/x the bar would hang at 0 rad/s."""
        path = self.trace_scene()
        for offset in (0.5, 0.3, 0.07):
            found = self.eval_at(path, [offset])[0, 0].imag
            self.assert_within(found, reduced_frequency(offset, True), CLOSE)
            self.assertEqual(reduced_frequency(offset, False), 0.0)
            self.assertGreater(found, 2.0)

    def test_the_hinge_carries_the_weight(self):
        path = self.trace_scene()
        with h5py.File(path) as file:
            names = [name.decode() for name in file["constraint"]]
            along = np.abs(file["multiplier"][:, [names.index(f"hinge[{i}]") for i in range(3)]])
        np.testing.assert_allclose(along[:, 2], MASS * G, rtol=1e-12)
        np.testing.assert_allclose(along[:, :2], 0.0, atol=1e-10)

    def test_what_is_simulated(self):
        self.assertEqual(self.redundant(), (12, 11, 0, 1))


if __name__ == "__main__":
    unittest.main()
