"""The scene of the benchmarks with 40 bodies: the hub is held, so the blades are independent of each other."""

import pathlib
import sys
import unittest

import numpy as np

from rotor_test_case import RotorTest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bench"))

from three_blades import scene

PLACES = [1.0, 1.3, 1.9, 2.0]
TRACED, MET = 1e-9, 2e-9  # both traces may err by the tolerance


class ThreeBlades(RotorTest):
    def trace_blades(self, modes, **options):
        return self.trace_text(scene(**options), "--from", "1", "--to", "2", "--modes", modes, tolerance=TRACED)

    def test_sizes(self):
        self.assertEqual(self.redundant(scene()), (480, 402, 0, 78))

    def test_equal_blades_have_every_eigenvalue_three_times(self):
        one = self.spectra(self.trace_blades(2, mistuning=0.0, blades=1), PLACES)
        three = self.spectra(self.trace_blades(6, mistuning=0.0), PLACES)
        for alone, together in zip(one, three):
            self.assert_same_spectrum(together, np.repeat(alone, 3), MET)

    def test_mistuned_blades_have_their_own(self):
        first = self.spectra(self.trace_blades(2, blades=1), PLACES)
        both = self.spectra(self.trace_blades(4, blades=2), PLACES)
        for alone, together in zip(first, both):
            self.assert_same_spectrum([min(together, key=lambda s: abs(s - a)) for a in alone], alone, MET)
            self.assertGreater(np.min(abs(together[:, None] - together[None, :]) + np.eye(4)), 1e-3)


if __name__ == "__main__":
    unittest.main()
