"""Ziegler's column from bodies, beside its matrices and its flutter load."""

import math
import unittest

import numpy as np

from program import SCENES
from rotor_test_case import RotorTest, companion
from scene_test_case import CLOSE


def spectrum(load, damping):
    """Angles of the rods; load in k/l, time in l sqrt(m/k)."""
    return companion(np.array([[3.0, 1], [1, 1]]), damping * np.array([[2.0, -1], [-1, 1]]),
                     np.array([[2.0 - load, load - 1], [-1, 1]]))


class ZieglerLinks(RotorTest):
    scene = "ziegler_links"

    def test_spectrum_against_load(self):
        # Without damping the frequencies meet at 7/2 - sqrt(2); with it they only come near.
        self.assert_follows(self.trace_scene(), lambda load: spectrum(load, 0.1), "load", np.linspace(0, 3, 40))

    def test_spectrum_against_damping(self):
        file = self.trace_text(self.changed(load=1.0), "--parameter", "damping", "--from", "0.01", "--to", "0.5")
        self.assert_follows(file, lambda damping: spectrum(1.0, damping), "damping", np.linspace(0.01, 0.5, 20))

    def test_flutter_load(self):
        for damping in (0.01, 0.1, 0.5):
            file = self.trace_text(self.changed(damping=damping))
            loads = [load for load, _ in self.special_points(file, "flutter")]
            self.assertEqual(len(loads), 1)
            self.assertAlmostEqual(loads[0], 41 / 28 + damping**2 / 2, delta=CLOSE)

    def test_without_damping_frequencies_meet_at_a_higher_load(self):
        """Ziegler's paradox: 7/2 - sqrt(2) = 2.086 without any damping, 41/28 = 1.464 with the least."""
        meetings = self.special_points(self.trace_text(self.changed(damping=0.0)), "collision")
        self.assertAlmostEqual(min(load for load, _ in meetings), 3.5 - math.sqrt(2.0), delta=1e-9)

    def test_matrices_of_the_library_are_the_same_column(self):
        self.run_well("trace", SCENES / "ziegler_column.toml", "-o", "matrices.h5", "--quiet", "--tolerance", "1e-11")
        self.assert_follows(self.trace_scene(), lambda load: self.spectra("matrices.h5", [load])[0], "load",
                            np.linspace(0, 3, 13))


if __name__ == "__main__":
    unittest.main()
