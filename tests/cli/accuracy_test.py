"""`eigentrail accuracy`: its file as other software reads it, its output, and bad input."""

import unittest

import numpy as np
import xarray

from command_test_case import CommandTest, blade_eigenvalues
from program import BLADE

NARROW = ("--tolerances", "1e-3,1e-6", "--orders", "2,3", "--samples", "20", "--repeat", "1")
N_RUNS = 2 * 2 + 2 + 2 * 4 * 2

# Per dataset: dimensions and units.
LAYOUT = {
    "run": (("run",), "1"),
    "method": (("run",), "1"),
    "run_tolerance": (("run",), "1"),
    "order": (("run",), "1"),
    "status": (("run",), "1"),
    "points": (("run",), "1"),
    "error": (("run",), "1"),
    "error_parameter": (("run",), "rad/s"),
    "samples_measured": (("run",), "1"),
    "wall_time": (("run",), "s"),
    "factorizations": (("run",), "1"),
    "spectra": (("run",), "1"),
    "evaluations": (("run",), "1"),
    "file_size": (("run",), "byte"),
    "sample": (("sample",), "1"),
    "mode": (("mode",), "1"),
    "sample_parameter": (("sample",), "rad/s"),
    "reference_eigenvalue": (("sample", "mode"), "1/s"),
}


class Accuracy(CommandTest):
    def study(self, *options, grids="10,20"):
        """Runs a study of BLADE; returns the printed output."""
        self.write("scene.toml", BLADE)
        return self.run_well("accuracy", "scene.toml", *NARROW, "--grids", grids, *options)

    def test_datasets_have_dimensions_units_and_names(self):
        self.study("-o", "study.h5")
        file = self.open("study.h5")
        self.assert_layout(file, LAYOUT)
        self.assertEqual((file.attrs["format"], file.attrs["schema_version"]), ("eigentrail-accuracy", 1))
        self.assertEqual(file.attrs["scene"], BLADE)
        self.assertLess(file.attrs["reference_correction"], 1e-28)
        self.assertEqual(file.attrs["reference_unsolved"], 0)

    def test_xarray_opens_it_and_the_references_are_the_closed_form(self):
        self.study("-o", "study.h5")
        with xarray.open_dataset(self.folder / "study.h5", engine="h5netcdf") as data:
            self.assertEqual(data.sizes, {"run": N_RUNS, "sample": 20, "mode": 2})
            for omega, s in zip(data.sample_parameter.values, data.reference_eigenvalue.values):
                np.testing.assert_allclose(sorted(s, key=np.imag), blade_eigenvalues(omega), rtol=1e-14)
            own = np.isfinite(data.run_tolerance.values)
            self.assertEqual(np.count_nonzero(own), 6)
            self.assertTrue((data.error.values[own] <= data.run_tolerance.values[own]).all())
            self.assertTrue((data.file_size.values[own] > 0).all())
            self.assertTrue((data.status.values == "completed").all())
            self.assertTrue((data.samples_measured.values == 20).all())

    def test_table_and_conclusions(self):
        text = self.study()
        self.assertRegex(text, r"errors over 20 values of omega, against eigenvalues computed with 113 bits")
        self.assertRegex(text, r"\n +3 +1e-06 ")
        self.assertRegex(text, r"QZ +20 ")
        self.assertRegex(text, r"\n +1e-06 +order \d at ")
        self.assertRegex(text, r"6 of 6 traces kept their tolerance; order \d was the fastest at most tolerances; "
                               r"the certificate costs (\S+ %|less than the noise) of the time at tolerance 1e-06 "
                               r"and order 3 \(\d+ LU with it, \d+ without\)")
        self.assertEqual([path.name for path in self.contents()], ["scene.toml"])

    def test_quiet_says_nothing_and_grids_can_be_left_out(self):
        self.assertEqual(self.study("--quiet", "-o", "study.h5", grids="none"), "")
        self.assertEqual(len(self.open("study.h5")["run"]), 6)


if __name__ == "__main__":
    unittest.main()
