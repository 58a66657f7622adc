"""The functions of the reader: opening, selecting, tables, curves, and error messages."""

import pathlib
import re
import tempfile
import unittest

import eigentrail
import h5py
import numpy as np
import xarray

from program import BIRTH, SCENES, ProgramTest


class FileTest(ProgramTest):
    """One run of the program for all tests of a class."""

    arguments = ()

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="eigentrail-")
        cls.addClassCleanup(folder.cleanup)
        cls.path = pathlib.Path(folder.name) / "out.h5"
        command, scene, *options = cls.arguments
        ProgramTest.run_well(_InFolder(folder.name), command, SCENES / scene, "-o", cls.path, "--quiet", *options)
        cls.file = eigentrail.open(cls.path)


class _InFolder(ProgramTest):
    def __init__(self, folder):
        super().__init__("run_well")
        self.folder = pathlib.Path(folder)


class Loci(FileTest):
    arguments = ("trace", "rotating_mass.toml")

    def test_it_is_the_plain_dataset_with_labels(self):
        plain = xarray.load_dataset(self.path, engine="h5netcdf")
        xarray.testing.assert_identical(self.file.drop_vars(["event_kind", "event_modes", "natural_frequency"]).reset_coords(),
                                        plain.reset_coords())
        self.assertLessEqual(set(plain.coords), set(self.file.coords))
        self.assertEqual(self.file.mode_name.dims, ("mode",))
        self.assertIn("mode_name", self.file.frequency.coords)

    def test_both_frequencies_have_their_names(self):
        np.testing.assert_array_equal(self.file.natural_frequency, self.file.frequency)
        np.testing.assert_array_equal(self.file.damped_frequency, np.abs(self.file.eigenvalue.imag))
        found = self.file.eigentrail.sel(omega=[12.5, 40])
        np.testing.assert_allclose(found.natural_frequency, np.abs(found.eigenvalue), rtol=1e-15)
        np.testing.assert_array_equal(found.damped_frequency, np.abs(found.eigenvalue.imag))

    def test_the_file_is_free_again(self):
        with h5py.File(self.path, "r+"):
            pass

    def test_sel_has_the_dimensions_of_what_is_asked_for(self):
        sel = self.file.eigentrail.sel
        self.assertEqual(dict(sel(omega=12.5).sizes), {"mode": 2})
        self.assertEqual(dict(sel(omega=[12.5, 40]).sizes), {"omega": 2, "mode": 2})
        self.assertEqual(dict(sel(omega=np.linspace(5, 100, 7), mode="lag").sizes), {"omega": 7})
        self.assertEqual(dict(sel(omega=[40], mode=["mode 2", "lag"]).sizes), {"omega": 1, "mode": 2})
        self.assertEqual(dict(sel(omega=self.file.event_parameter).sizes), {"event": 1, "mode": 2})

    def test_order_and_repetition_of_the_values_are_kept(self):
        frequency = self.file.eigentrail.sel(omega=[40, 12.5, 40, 5]).frequency
        self.assertEqual(frequency.omega.values.tolist(), [40, 12.5, 40, 5])
        self.assertEqual(frequency.values[0].tolist(), frequency.values[2].tolist())

    def test_modes_are_selected_by_label_or_by_name(self):
        sel = self.file.eigentrail.sel
        by_name, by_label = sel(omega=40, mode="lag"), sel(omega=40, mode="mode 1")
        xarray.testing.assert_identical(by_name, by_label)
        self.assertEqual(sel(omega=40, mode=["flap", "lag"]).mode.values.tolist(), ["mode 2", "mode 1"])

    def test_stored_points_come_back_exactly(self):
        at_points = self.file.eigentrail.sel(omega=self.file.omega.values)
        for name in ("eigenvalue", "frequency", "damping_ratio"):
            np.testing.assert_allclose(at_points[name], self.file[name], rtol=1e-15)

    def test_axes_of_plots_have_names_and_units(self):
        found = self.file.eigentrail.sel(omega=[12.5, 40])
        units = {name: found[name].attrs["units"] for name in found.variables if "units" in found[name].attrs}
        expected = {"omega": "rad/s", "eigenvalue": "1/s", "frequency": "rad/s",
                    "natural_frequency": "rad/s", "damped_frequency": "rad/s", "damping_ratio": "1", "certified": "1"}
        self.assertEqual({name: units[name] for name in expected}, expected)
        self.assertTrue(all(found[name].attrs["long_name"] for name in found.variables))

    def test_certified_is_that_of_the_steps(self):
        self.assertTrue(np.all(self.file.eigentrail.sel(omega=np.linspace(5, 100, 50)).certified == 1))

    def test_nearest_has_shapes_of_a_stored_point(self):
        found = self.file.eigentrail.nearest(omega=12.5, mode="lag")
        node = int(found.node)
        self.assertEqual(np.abs(self.file.omega.values - 12.5).argmin(), node)
        np.testing.assert_array_equal(found.mode_shape, self.file.mode_shape[node, 0])

    def test_events_are_a_table(self):
        events = self.file.eigentrail.events
        self.assertEqual(events.kind.tolist(), ["flutter"])
        self.assertEqual(events.modes.tolist(), ["lag"])
        self.assertAlmostEqual(events.omega[0], 12.4393882230095, places=10)
        self.assertAlmostEqual(events.eigenvalue[0].real, 0.0, places=12)

    def test_stable_ranges_are_a_table(self):
        ranges = self.file.eigentrail.stable_ranges
        self.assertEqual(ranges[["kind", "cause_from", "cause_to"]].values.tolist(), [["stable", "start", "flutter"]])
        self.assertEqual(ranges["to"][0], self.file.eigentrail.events.omega[0])

    def test_modes_have_numbers_labels_and_names(self):
        sel = self.file.eigentrail.sel
        for mode in (2, np.int64(2), "mode 2", "flap"):
            self.assertTrue(sel(omega=40, mode=mode).identical(sel(omega=40).isel(mode=1)), mode)
        self.assertTrue(sel(omega=40, mode=[2, "lag"]).identical(sel(omega=40).isel(mode=[1, 0])))
        with self.assertRaisesRegex(ValueError, "^mode=3: the modes have the numbers 1 to 2"):
            sel(omega=40, mode=3)


class Births(ProgramTest):
    """Mode 2 of BIRTH begins at p = 0.9975."""

    def test_modes_that_do_not_exist_are_nan_and_without_certificate(self):
        self.write("scene.toml", BIRTH)
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")
        loci = eigentrail.open(self.folder / "loci.h5")
        birth = loci.eigentrail.events.p[0]
        found = loci.eigentrail.sel(p=[0.5, birth, 1.4], mode="mode 2")
        self.assertEqual(np.isnan(found.eigenvalue).values.tolist(), [True, False, False])
        self.assertEqual(found.certified.values.tolist(), [-1, 1, 1])
        self.assertNotIn("mode_name", loci.coords)  # a family of matrices without names


class Samples(ProgramTest):
    """A sampled family: errors that come from the data, and intervals of events."""

    def setUp(self):
        super().setUp()
        p = np.linspace(0.0, 1.0, 8)
        with h5py.File(self.folder / "samples.h5", "w") as file:
            file["parameter"] = p
            file["A"] = [[[0.05 * (x - 0.4), 1, 0], [-1, 0.05 * (x - 0.4), 0], [0, 0, -3]] for x in p]
            file["A_error"] = np.broadcast_to(np.diag([0.002, 0.002, 0.0]), (8, 3, 3))
            file["state_names"] = ["swing", "rate", "filter"]
        self.write("scene.toml", '[sampled_family]\nfile = "samples.h5"\n[trace]\nparameter = "p"\nfrom = 0\nto = 1\n')
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")
        self.loci = eigentrail.open(self.folder / "loci.h5")

    def test_selected_values_have_the_errors_of_the_data(self):
        found = self.loci.eigentrail.sel(p=[0.1, 0.7], mode="mode 1")
        self.assertTrue((found.digits_error > 0.001).all())
        self.assertEqual(found.digits_error.attrs["units"], "1/s")
        step = np.searchsorted(self.loci.p, [0.1, 0.7]) - 1
        np.testing.assert_array_equal(found.digits_error, self.loci.digits_error.sel(mode="mode 1")[step])
        np.testing.assert_array_equal(found.interpolation_error, self.loci.interpolation_error.sel(mode="mode 1")[step])

    def test_events_have_their_intervals(self):
        (event,) = self.loci.eigentrail.events.itertuples()
        self.assertTrue(0.0 < event.interval_from < 0.4 < event.interval_to < 1.0)


class Boundary(FileTest):
    arguments = ("boundary", "ziegler_column.toml", "--second", "damping", "--second-from", "0.01", "--second-to", "1")

    def test_points_have_both_parameters_and_the_curve(self):
        self.assertEqual(set(self.file.eigenvalue.coords), {"point", "load", "damping", "point_curve"})

    def test_curves_are_smooth_between_the_points(self):
        """P = 41/28 + b^2/2, docs/boundaries.md."""
        curve = self.file.eigentrail.curve(0, points=100)
        self.assertEqual(curve.sizes["point"], 100)
        np.testing.assert_allclose(curve["load"], 41 / 28 + 0.5 * curve.damping**2, atol=1e-7)
        np.testing.assert_allclose(curve.eigenvalue.real, 0.0, atol=1e-7)
        self.assertEqual(curve["load"].attrs["units"], self.file["load"].attrs["units"])

    def test_no_such_curve_is_said(self):
        with self.assertRaisesRegex(ValueError, "^curve 7: "):
            self.file.eigentrail.curve(7)
        with self.assertRaisesRegex(ValueError, "^only loci files have this"):
            self.file.eigentrail.sel(load=1)


class Map(FileTest):
    arguments = ("map", "rotating_mass.toml", "--second", "drag", "--second-from", "0", "--second-to", "300", "--grid", "4x7")

    def test_parameters_are_the_axes(self):
        self.assertEqual(dict(self.file.margin.sizes), {"drag": 4, "omega": 7})
        self.assertEqual(float(self.file.margin.sel(drag=300, omega=5)), self.file.margin.values[-1, -1])
        self.assertEqual(set(self.file.axis_parameter.coords), {"axis_point", "axis_line", "axis_kind"})


class Accuracy(FileTest):
    arguments = ("accuracy", "pendulum.toml", "--tolerances", "1e-4,1e-8", "--orders", "2,3", "--samples", "20",
                 "--repeat", "1", "--grids", "25")

    def test_runs_are_labelled(self):
        self.assertTrue({"method", "run_tolerance", "order"} <= set(self.file.error.coords))
        self.assertIn("sample_parameter", self.file.reference_eigenvalue.coords)


class OtherFiles(ProgramTest):
    def test_names_that_are_no_text_are_told(self):
        path = self.folder / "damaged.h5"
        with h5py.File(path, "w") as file:
            file.attrs.update({"format": "eigentrail-map", "schema_version": 1})
            file[b"none\xff"] = h5py.SoftLink("/none")
        with self.assertRaisesRegex(eigentrail.Error, "damaged.h5: .*none\ufffd"):
            eigentrail.open(path)

    def assert_refused_with(self, attributes, text):
        path = self.folder / "other.h5"
        with h5py.File(path, "w") as file:
            file.attrs.update(attributes)
        with self.assertRaisesRegex(ValueError, re.escape(f"{path}: {text}")):
            eigentrail.open(path)

    def test_files_of_others_and_of_other_schemas_are_refused(self):
        self.assert_refused_with({}, "has no attribute 'format'; expected a file of eigentrail")
        self.assert_refused_with({"format": "eigentrail-x"}, "holds 'eigentrail-x'; expected a file of eigentrail")
        later = {"format": "eigentrail-loci", "schema_version": 2}
        self.assert_refused_with(later, "has schema 2, this reader knows schema 1")


if __name__ == "__main__":
    unittest.main()
