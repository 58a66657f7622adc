"""Two rods on hinges against the 2 x 2 eigenproblem in their angles, derived from kinetic and potential energy."""

import math
import unittest

import numpy as np

from program import edited
from scene_test_case import SceneTest

G, M1, L1, M2, L2 = 9.81, 2.0, 1.0, 1.0, 0.8


def frequencies(m1=M1, l1=L1, m2=M2, l2=L2):
    """T = sum of m v^2/2 + J w^2/2 with centres at l1/2 and l1 + l2/2, V = -sum of m g (height), both to second order."""
    centres = np.array([[l1 / 2, 0.0], [l1, l2 / 2]])  # sideways displacement of each centre per angle
    M = sum(m * np.outer(c, c) for m, c in zip((m1, m2), centres)) + np.diag([m1 * l1**2, m2 * l2**2]) / 12.0
    K = G * np.diag([m1 * l1 / 2 + m2 * l1, m2 * l2 / 2])
    # det(K - w^2 M) = 0 by the quadratic formula; the smaller root from the product, which keeps its digits.
    a, c = np.linalg.det(M), np.linalg.det(K)
    b = K[0, 0] * M[1, 1] + K[1, 1] * M[0, 0] - K[0, 1] * M[1, 0] - K[1, 0] * M[0, 1]
    large = (b + math.sqrt(b * b - 4 * a * c)) / (2 * a)
    return [math.sqrt(c / (a * large)), math.sqrt(large)]


class DoublePendulum(SceneTest):
    scene = "double_pendulum"

    def test_frequencies_over_the_lower_length(self):
        self.check_frequencies(self.trace_scene(), lambda l2: frequencies(l2=l2), np.linspace(0.2, 3.0, 29))

    def test_frequencies_over_the_lower_mass(self):
        path = self.trace_scene("--parameter", "m2", "--from", "0.01", "--to", "20")
        self.check_frequencies(path, lambda m2: frequencies(m2=m2), [0.01, 0.1, 1.0, 7.7, 20.0])

    def test_of_equal_rods(self):
        """omega^2 = 3 g/l (1 +- 2/sqrt 7), a textbook's value."""
        text = edited(self.scene_text(), "m2 = { value = 1.0", "m2 = { value = 2.0")
        path = self.trace_text(text, "--from", "1", "--to", "1.5")
        expected = [math.sqrt(3 * G * (1 - 2 / math.sqrt(7))), math.sqrt(3 * G * (1 + 2 / math.sqrt(7)))]
        self.check_frequencies(path, lambda l2: expected if l2 == 1.0 else frequencies(m2=2.0, l2=l2), [1.0, 1.3])

    def test_turned_about_the_vertical_it_is_the_same(self):
        """Hinge axis and guesses turned by 0.7 rad; the guess of the lower rod is off by 0.1 rad as well."""
        text = self.scene_text().replace("y_axis = [0, 1, 0]", "y_axis = [\"-sin(0.7)\", \"cos(0.7)\", 0]")
        text = text.replace("axis = [0, 1, 0]", "axis = [\"-sin(0.7)\", \"cos(0.7)\", 0]")
        text = edited(text, 'position = [0, 0, "-l1 - l2 / 2"]\nx_axis = [0, 0, -1]',
                      'position = [0.05, 0, "-l1 - l2 / 2"]\nx_axis = ["0.1*cos(0.7)", "0.1*sin(0.7)", -1]')
        path = self.trace_text(text)
        self.check_frequencies(path, lambda l2: frequencies(l2=l2), np.linspace(0.2, 3.0, 9))

    def test_upside_down_it_falls(self):
        """Standing, s^2 of both modes changes sign."""
        text = edited(self.scene_text(), 'acceleration = [0, 0, "-g"]', 'acceleration = [0, 0, "g"]')
        p, s = self.nodes(self.trace_text(text, "--to", "0.5"))
        for l2, roots in zip(p, s):
            expected = frequencies(l2=l2)
            np.testing.assert_allclose(np.sort(roots.real), [-expected[1], -expected[0], *expected], rtol=1e-10)
            np.testing.assert_allclose(roots.imag, 0.0, atol=1e-10)

    def test_what_is_simulated(self):
        self.assertEqual(self.redundant(), (24, 22, 0, 2))


if __name__ == "__main__":
    unittest.main()
