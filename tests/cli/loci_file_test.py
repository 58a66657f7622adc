"""The loci file of the rotating mass, read with h5py, and with xarray without additional code."""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np
import xarray

from program import BIRTH, PROGRAM, SCENES, TIME_LIMIT, ProgramTest, datasets

SCENE = SCENES / "rotating_mass.toml"
MASS, LENGTH, HINGE = 50.0, 5.0, np.array([1.0, 0.0, 0.0])
ROUNDING = 1e-12

# Dimensions and unit of every dataset with data; the traced parameter is omega.
LAYOUT = {
    "omega": (("node",), "rad/s"),
    "eigenvalue": (("node", "mode"), "1/s"),
    "eigenvalue_derivative": (("node", "mode"), "1/s/(rad/s)"),
    "frequency": (("node", "mode"), "rad/s"),
    "damped_frequency": (("node", "mode"), "rad/s"),
    "damping_ratio": (("node", "mode"), "1"),
    "mode_shape": (("node", "mode", "coordinate"), "1"),
    "residual": (("node", "mode"), "1"),
    "condition": (("node", "mode"), "1"),
    "rounding": (("node", "mode"), "1/s"),
    "growing_unfollowed": (("node",), "1"),
    "equilibrium": (("node", "coordinate"), "m"),
    "multiplier": (("node", "constraint"), "1"),
    "coordinate_unit": (("coordinate",), "1"),
    "kinetic_energy_share": (("end", "mode", "motion"), "1"),
    "mode_name": (("mode",), "1"),
    "step_length": (("step",), "1"),
    "step_parameter": (("step", "end", "order"), "rad/s"),
    "dense_output": (("step", "function", "end", "order"), "1"),
    "dense_block": (("step", "function"), "1"),
    "dense_chart": (("step", "function"), "1"),
    "mode_block": (("step", "mode"), "1"),
    "certified": (("step", "mode"), "1"),
    "events": (("event",), "1"),
    "event_parameter": (("event",), "rad/s"),
    "event_eigenvalue": (("event",), "1/s"),
    "event_half_width": (("event",), "rad/s"),
    "event_puiseux": (("event",), "1/s"),
    "event_node": (("event",), "1"),
    "event_direction": (("event",), "1"),
    "event_value": (("event",), "1"),
    "event_shape": (("event", "coordinate"), "1"),
    "event_sensitivity": (("event", "scene_parameter"), "1/s per scene_parameter_unit"),
    "event_shift": (("event", "scene_parameter"), "rad/s per scene_parameter_unit"),
    "scene_parameter_unit": (("scene_parameter",), "1"),
    "stable_from": (("range",), "rad/s"),
    "stable_to": (("range",), "rad/s"),
    "stable_kind": (("range",), "1"),
    "stable_cause": (("range", "end"), "1"),
    "stable_margin": (("range", "end"), "1/s"),
    "stable_mode": (("range", "end"), "1"),
    "stable_least_margin": (("range",), "1/s"),
    "stable_largest_margin": (("range",), "1/s"),
    "stable_largest_at": (("range",), "rad/s"),
    "stable_whole": (("range",), "1"),
}
DIMENSIONS = {"node", "step", "mode", "function", "end", "coordinate", "constraint", "order", "event", "range",
              "scene_parameter", "motion"}
COMPLEX = {"eigenvalue", "eigenvalue_derivative", "mode_shape", "dense_output", "event_eigenvalue", "event_puiseux",
           "event_shape", "event_sensitivity"}
WHOLE = {"dense_block", "dense_chart", "mode_block", "certified", "event_node", "event_direction", "stable_mode",
         "stable_whole", "growing_unfollowed"}
TEXTS = {"events", "stable_kind", "stable_cause", "scene_parameter_unit", "coordinate_unit", "mode_name"}
OF_MASSES = {"kinetic_energy_share", "mode_name"}  # not in files of families of matrices


def type_of(name):
    if name in TEXTS:
        return np.dtype(object)
    return np.dtype(np.complex128 if name in COMPLEX else np.int64 if name in WHOLE else np.float64)


def setUpModule():
    global folder, path
    folder = tempfile.mkdtemp(prefix="eigentrail-")
    path = pathlib.Path(folder) / "blade.h5"
    subprocess.run([PROGRAM, "trace", SCENE, "-o", path, "--quiet"], check=True, timeout=TIME_LIMIT)


def tearDownModule():
    shutil.rmtree(folder)


class InH5py(unittest.TestCase):
    def setUp(self):
        self.file = h5py.File(path)
        self.addCleanup(self.file.close)

    def test_datasets_are_those_of_the_schema(self):
        self.assertEqual(set(datasets(self.file)), set(LAYOUT) | DIMENSIONS)

    def test_every_dimension_has_its_scale(self):
        for name, (dimensions, _) in LAYOUT.items():
            with self.subTest(name):
                dataset = self.file[name]
                self.assertEqual(dataset.shape, tuple(len(self.file[d]) for d in dimensions))
                self.assertEqual([[scale.name for scale in dim.values()] for dim in dataset.dims],
                                 [["/" + d] for d in dimensions])

    def test_dimensions_are_labelled(self):
        labels = {name: self.file[name].asstr()[:].tolist() for name in ("mode", "coordinate", "constraint", "end")}
        self.assertEqual(labels, {"mode": ["mode 1", "mode 2"], "coordinate": ["blade.x", "blade.y", "blade.z"],
                                  "constraint": ["rod 1"], "end": ["left", "right"]})
        for name in ("node", "step", "function", "order", "event", "range"):
            np.testing.assert_array_equal(self.file[name][:], np.arange(len(self.file[name])))

    def test_a_step_joins_a_point_and_the_next(self):
        self.assertEqual(len(self.file["step"]), len(self.file["node"]) - 1)
        self.assertEqual(len(self.file["order"]), self.file.attrs["series_order"] + 1)

    def test_everything_has_units_and_a_long_name(self):
        for name, dataset in datasets(self.file).items():
            with self.subTest(name):
                self.assertEqual(dataset.attrs["units"], LAYOUT.get(name, ((), "1"))[1])
                self.assertTrue(dataset.attrs["long_name"])

    def test_complex_and_whole_numbers_read_as_such(self):
        for name in LAYOUT:
            with self.subTest(name):
                self.assertEqual(self.file[name].dtype, type_of(name))

    def test_root_says_how_the_file_was_made(self):
        attributes = self.file.attrs
        self.assertEqual(attributes["format"], "eigentrail-loci")
        self.assertEqual(attributes["schema_version"], 1)
        self.assertRegex(attributes["program_version"], r"^\d+\.\d+\.\d+$")
        self.assertEqual(attributes["title"], "Rotating point mass: lag and flap")
        self.assertEqual(attributes["scene"], SCENE.read_text(encoding="utf-8"))
        self.assertEqual((attributes["parameter"], attributes["tolerance"]), ("omega", 1e-8))
        self.assertEqual((attributes["status"], attributes["message"]), ("completed", ""))
        options = {name[7:]: text for name, text in attributes.items() if name.startswith("option_")}
        self.assertEqual(options, {
            "parameter": "omega", "from": "100", "to": "5", "tolerance": "1e-08", "modes": "all", "order": "auto",
            "constant_modes": "list",
            "reference": "auto", "first_step": "auto", "max_step": "auto", "max_nodes": "100000",
            "branch": "auto", "without": "none", "certify": "true"})
        self.assertGreater(attributes["reference"], 0.0)
        self.assertEqual(attributes["notes"], "")

    def test_counts_fit_the_data(self):
        counts = {name[6:]: int(n) for name, n in self.file.attrs.items() if name.startswith("count_")}
        n_nodes, n_modes = self.file["eigenvalue"].shape
        self.assertEqual((counts["nodes"], counts["modes_available"]), (n_nodes, n_modes))
        self.assertEqual(counts["events"], len(self.file["events"]))
        self.assertEqual(counts["mode_steps"], np.sum(self.file["mode_block"][:] >= 0))
        self.assertEqual(counts["certified_mode_steps"], np.sum(self.file["certified"][:] == 1))
        points = n_nodes + counts["rejected_steps"]
        # All modes are followed: the first point mode by mode, the others by a basis of all modes or two.
        self.assertGreaterEqual(counts["mode_factorizations"], n_modes)
        self.assertGreaterEqual(counts["modal_bases"], 2 * (n_nodes - 1))
        self.assertGreaterEqual(counts["mode_iterations"], n_nodes * n_modes)
        self.assertGreaterEqual(counts["modal_solves"], n_nodes - 1)
        self.assertGreaterEqual(counts["equilibrium_factorizations"], n_nodes)
        self.assertLessEqual(counts["mode_factorizations"], 2 * points * n_modes)

    def test_points_run_down_the_range_to_its_very_ends(self):
        self.assertEqual(self.file["omega"][0], 100.0)
        self.assertEqual(self.file["omega"][-1], 5.0)
        self.assertTrue(np.all(np.diff(self.file["omega"][:]) < 0.0))


class Numbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with h5py.File(path) as file:
            cls.data = {name: file[name][:] for name in LAYOUT}

    def test_frequency_and_damping_ratio_follow_from_the_eigenvalue(self):
        s = self.data["eigenvalue"]
        np.testing.assert_allclose(self.data["frequency"], np.abs(s), rtol=ROUNDING)
        np.testing.assert_allclose(self.data["damping_ratio"], -s.real / np.abs(s), rtol=ROUNDING)

    def test_every_mode_is_a_block_of_its_own_that_follows_s(self):
        for name in ("dense_block", "mode_block"):
            np.testing.assert_array_equal(self.data[name], np.tile([0, 1], (len(self.data["step_length"]), 1)))
        self.assertFalse(np.any(self.data["dense_chart"]))

    def test_every_step_is_certified(self):
        self.assertTrue(np.all(self.data["certified"] == 1))

    def test_series_begin_with_eigenvalue_and_derivative(self):
        for end, nodes in enumerate((slice(None, -1), slice(1, None))):
            series = self.data["dense_output"][:, :, end]
            np.testing.assert_array_equal(series[..., 0], self.data["eigenvalue"][nodes])
            np.testing.assert_array_equal(series[..., 1], self.data["eigenvalue_derivative"][nodes])

    def test_away_from_folds_the_parameter_is_the_coordinate(self):
        omega, series = self.data["omega"], self.data["step_parameter"]
        np.testing.assert_array_equal(series[:, 0, 0], omega[:-1])
        np.testing.assert_array_equal(series[:, 1, 0], omega[1:])
        np.testing.assert_array_equal(series[..., 1], 1.0)
        np.testing.assert_array_equal(series[..., 2:], 0.0)
        np.testing.assert_allclose(self.data["step_length"], np.diff(omega), rtol=ROUNDING)

    def test_the_blade_flutters_once(self):
        flutter, = self.data["events"]
        kind, place, real, imag, modes = flutter.decode().split(",")
        self.assertEqual((kind, modes), ("flutter", "1"))
        self.assertEqual(float(place), self.data["event_parameter"][0])
        self.assertEqual(complex(float(real), float(imag)), self.data["event_eigenvalue"][0])
        self.assertAlmostEqual(float(place), 12.44, delta=0.005)
        self.assertAlmostEqual(self.data["event_eigenvalue"][0].real, 0.0, delta=1e-8)
        self.assertEqual(self.data["event_direction"].tolist(), [-1])
        self.assertTrue(np.isnan(self.data["event_value"][0]))
        self.assertTrue(np.isnan(self.data["event_half_width"][0]))
        self.assertTrue(np.isnan(self.data["event_puiseux"][0]))
        node, omega = self.data["event_node"][0], self.data["omega"]
        self.assertTrue(omega[node] <= self.data["event_parameter"][0] < omega[node - 1])
        self.assertTrue(self.data["eigenvalue"][node - 1, 0].real < 0.0 <= self.data["eigenvalue"][node, 0].real)

    def test_stable_range_ends_at_flutter(self):
        data = self.data
        self.assertEqual([text.decode() for text in data["stable_kind"]], ["stable"])
        self.assertEqual([text.decode() for text in data["stable_cause"][0]], ["start", "flutter"])
        self.assertEqual(data["stable_from"].tolist(), [100.0])
        self.assertEqual(data["stable_to"][0], data["event_parameter"][0])
        self.assertEqual(data["stable_margin"][0].tolist(), [-data["eigenvalue"].real[0].max(), 0.0])
        self.assertEqual(data["stable_mode"][0, 1], 1)

    def test_series_leads_to_the_next_point(self):
        """The truncation error of the series is far below their linear term."""
        series = self.data["dense_output"][:, :, 0]
        step = self.data["step_length"][:, np.newaxis]
        predicted = sum(series[..., k] * step**k for k in range(series.shape[-1]))
        miss = np.abs(predicted - self.data["eigenvalue"][1:])
        self.assertLess(np.max(miss / np.abs(series[..., 1] * step)), 1e-2)

    def test_a_pair_is_its_member_above_the_real_axis(self):
        self.assertTrue(np.all(self.data["eigenvalue"].imag >= 0.0))

    def test_modes_and_equilibria_are_accurate(self):
        self.assertLess(np.max(self.data["residual"]), 1e-13)
        self.assertTrue(np.all(self.data["condition"] >= 0.0))
        self.assertTrue(np.all(np.isfinite(self.data["condition"])))

    def test_shapes_have_unit_mass_norm(self):
        norms = MASS * np.sum(np.abs(self.data["mode_shape"]) ** 2, axis=2)
        np.testing.assert_allclose(norms, 1.0, rtol=ROUNDING)

    def test_consecutive_shapes_are_in_phase(self):
        shape = self.data["mode_shape"]
        overlap = MASS * np.sum(np.conj(shape[:-1]) * shape[1:], axis=2)
        self.assertTrue(np.all(overlap.real > 0.8))
        np.testing.assert_allclose(overlap.imag, 0.0, atol=ROUNDING)

    def test_shapes_satisfy_the_constraint(self):
        """A = 2 (x - hinge)^T, so A v = 0 keeps the mass on its sphere."""
        arm = (self.data["equilibrium"] - HINGE) / LENGTH
        along = np.einsum("nc,nmc->nm", arm, self.data["mode_shape"]) * np.sqrt(MASS)
        np.testing.assert_allclose(np.abs(along), 0.0, atol=ROUNDING)

    def test_equilibrium_keeps_the_rods_length(self):
        np.testing.assert_allclose(np.linalg.norm(self.data["equilibrium"] - HINGE, axis=1), LENGTH, rtol=ROUNDING)

    def test_equilibrium_balances_centrifugal_transverse_and_rod_force(self):
        """Centrifugal force m omega^2 (x, y, 0), the a_t, a_n force of the scene, rod force -A^T lambda."""
        x, omega = self.data["equilibrium"], self.data["omega"][:, np.newaxis]
        arm, (a_t, a_n) = x - HINGE, (-100.0, 1000.0)
        centrifugal = MASS * omega**2 * x * [1.0, 1.0, 0.0]
        transverse = np.column_stack([-a_t * arm[:, 1] - a_n * arm[:, 2], a_t * arm[:, 0], a_n * arm[:, 0]])
        rod = -2.0 * arm * self.data["multiplier"]
        sum_of_forces = np.linalg.norm(centrifugal + transverse + rod, axis=1)
        self.assertLess(np.max(sum_of_forces / np.linalg.norm(rod, axis=1)), 1e-11)


class InXarray(unittest.TestCase):
    def setUp(self):
        self.set = xarray.open_dataset(path, engine="h5netcdf")
        self.addCleanup(self.set.close)

    def test_variables_have_the_dimensions_of_the_schema(self):
        for name, (dimensions, unit) in LAYOUT.items():
            with self.subTest(name):
                self.assertEqual(self.set[name].dims, dimensions)
                self.assertEqual(self.set[name].attrs["units"], unit)
                self.assertEqual(self.set[name].dtype, type_of(name))

    def test_traced_parameter_is_a_coordinate_of_everything_along_the_path(self):
        for name, (dimensions, _) in LAYOUT.items():
            if dimensions[0] == "node":
                self.assertIn("omega", self.set[name].coords, name)

    def test_labels_select(self):
        lag = self.set.eigenvalue.sel(mode="mode 1")
        self.assertEqual(lag.dims, ("node",))
        sideways = self.set.mode_shape.sel(mode="mode 1", coordinate="blade.y")
        np.testing.assert_array_equal(sideways.values, self.set.mode_shape.values[:, 0, 1])

    def test_parameter_selects_after_swapping_dimensions(self):
        at = self.set.frequency.swap_dims(node="omega").sortby("omega").sel(omega=100.0, mode="mode 1")
        self.assertAlmostEqual(float(at), 100.0 / np.sqrt(5.0), places=2)

    def test_what_a_plot_needs_is_there(self):
        """The labels and arrays that set.frequency.plot(x="omega", hue="mode") would draw."""
        frequency = self.set.frequency
        self.assertEqual(frequency.transpose("node", "mode").shape, (frequency.sizes["node"], 2))
        self.assertEqual([frequency.omega.attrs[key] for key in ("long_name", "units")],
                         ["traced parameter omega", "rad/s"])
        self.assertEqual([frequency.attrs[key] for key in ("long_name", "units")], ["natural frequency abs(s)", "rad/s"])

    def test_stability_boundary_is_one_expression(self):
        """The lag mode becomes unstable near 12.44 rad/s."""
        growth = self.set.eigenvalue.real.sel(mode="mode 1").swap_dims(node="omega").sortby("omega")
        unstable = growth.omega[growth > 0.0].max()
        stable = growth.omega[growth < 0.0].min()
        self.assertTrue(float(unstable) < 12.44 < float(stable))

    def test_steps_and_events_are_read_by_their_labels(self):
        left = self.set.dense_output.sel(step=0, function=0, end="left", order=0)
        self.assertEqual(complex(left), complex(self.set.eigenvalue.sel(node=0, mode="mode 1")))
        self.assertEqual(str(self.set.events.sel(event=0).values).split(",")[0], "flutter")
        drag = self.set.event_shift.sel(event=0, scene_parameter="drag")
        self.assertAlmostEqual(float(drag), -1.174, delta=0.001)

    def test_root_attributes_arrive(self):
        self.assertEqual(self.set.attrs["format"], "eigentrail-loci")
        self.assertEqual(self.set.attrs["scene"], SCENE.read_text(encoding="utf-8"))


class Birth(ProgramTest):
    """Mode 1 of BIRTH, a pair, becomes two real modes at p = 0.9975; the second one gets a column there."""

    def setUp(self):
        super().setUp()
        self.write("scene.toml", BIRTH)
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")
        with h5py.File(self.folder / "loci.h5") as file:
            self.data = {name: dataset[()] for name, dataset in datasets(file).items()}
        self.before = self.data["p"] < 0.9975 - 1e-9
        self.behind = self.data["p"] > 0.9975 + 1e-9

    def test_a_point_lies_on_either_side_and_one_on_the_meeting(self):
        self.assertTrue(np.any(self.before) and np.any(self.behind))
        self.assertEqual(np.sum(~self.before & ~self.behind), 1)

    def test_the_column_grows_in_every_dataset(self):
        self.assertEqual(self.data["mode"].tolist(), [b"mode 1", b"mode 2"])
        for name, (dimensions, _) in LAYOUT.items():
            if "mode" in dimensions and name not in OF_MASSES:
                self.assertEqual(self.data[name].shape[1], 2, name)

    def test_mode_2_is_nan_before_the_meeting_and_exists_from_there(self):
        for name in ("eigenvalue", "frequency", "damping_ratio", "residual", "condition", "mode_shape"):
            absent = np.isnan(self.data[name].reshape(len(self.data["p"]), 2, -1)).any(axis=2)
            self.assertFalse(np.any(absent[:, 0]), name)
            np.testing.assert_array_equal(absent[:, 1], self.before, name)
        self.assertTrue(np.all(np.isnan(self.data["eigenvalue_derivative"][self.before, 1])))
        self.assertTrue(np.all(np.isfinite(self.data["eigenvalue_derivative"][self.behind])))

    def test_steps_say_where_it_exists(self):
        for name in ("mode_block", "certified"):
            np.testing.assert_array_equal(self.data[name][:, 1] == -1, self.before[:-1], name)
            self.assertTrue(np.all(self.data[name][:, 0] >= 0), name)
        for blocks, functions in zip(self.data["mode_block"], self.data["dense_block"]):
            for block in set(blocks) - {-1}:
                self.assertGreaterEqual(np.sum(functions == block), np.sum(blocks == block))

    def test_eigenvalues_are_those_of_the_closed_form(self):
        root = np.sqrt(self.data["p"] - 0.9975 + 0j)
        away = self.before | self.behind
        np.testing.assert_allclose(self.data["eigenvalue"][away, 0], (-0.05 + root)[away], rtol=1e-9)
        np.testing.assert_allclose(self.data["eigenvalue"][self.behind, 1], (-0.05 - root)[self.behind], rtol=1e-9)
        at = ~away
        np.testing.assert_allclose(self.data["eigenvalue"][at], -0.05, atol=1e-6)  # uncertain as a double root is

    def test_derivative_is_nan_where_they_meet(self):
        self.assertTrue(np.all(np.isnan(self.data["eigenvalue_derivative"][~self.before & ~self.behind])))

    def test_collision_and_divergence_are_stored(self):
        kinds = [line.decode().split(",")[0] for line in self.data["events"]]
        self.assertEqual(kinds, ["collision", "divergence"])
        np.testing.assert_allclose(self.data["event_parameter"], [0.9975, 1.0], rtol=ROUNDING)
        np.testing.assert_allclose(self.data["event_eigenvalue"], [-0.05, 0.0], atol=1e-7)
        self.assertTrue(np.all(np.isnan(self.data["event_half_width"])))
        self.assertAlmostEqual(self.data["event_puiseux"][0] ** 2, 1.0, places=9)
        self.assertTrue(np.isnan(self.data["event_puiseux"][1]))
        for node, place in zip(self.data["event_node"], self.data["event_parameter"]):
            self.assertTrue(self.data["p"][node - 1] < place <= self.data["p"][node] + ROUNDING)


if __name__ == "__main__":
    unittest.main()
