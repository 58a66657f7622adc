"""`eigentrail boundary`: its file as h5py and xarray read it, its curves compared with closed forms, and bad input."""

import unittest

import h5py
import numpy as np
import xarray

from command_test_case import CommandTest
from program import BLADE, EXIT_NUMBERS_FAILED, PUSHED_PENDULUM, SCENES, datasets, edited

ACCURATE = 1e-8
ROUNDING = 1e-12


def freedoms(*damping_and_stiffness, extra=""):
    """A scene of independent freedoms s^2 + c s + k, with P from -1 to 1 and Q."""
    def diagonal(entries):
        return [["0"] * i + [entry] + ["0"] * (len(entries) - i - 1) for i, entry in enumerate(entries)]

    damping, stiffness = zip(*damping_and_stiffness)
    return f"""\
[parameters]
P = 0.0
Q = 0.0

[trace]
parameter = "P"
from = -1
to = 1
tolerance = 1e-9

{extra}

[matrix_family]
M = [{diagonal(["1"] * len(damping))}]
C = [{diagonal(damping)}]
K = [{diagonal(stiffness)}]
"""


CROSSING_LINES = freedoms(("Q / 2 - P", "1"), ("0.3 - Q - P", "4"))
ISLAND = freedoms(("(P - 0.13)^2 + (Q + 0.21)^2 - 0.16", "1"))
CALM = freedoms(("3 + P + Q", "1"))

# Without equilibrium for p > 1, whatever the drag.
DAMPED_PENDULUM = edited(PUSHED_PENDULUM, "p = 0.0", "p = 0.0\ndrag = 1.0") + """
[[drag]]
point = "bob"
coefficient = "drag"
"""
NO_EQUILIBRIUM = edited(DAMPED_PENDULUM, "from = 0\n", "from = 1.1\n")

# Name: dimensions and units, of a file in load and damping.
LAYOUT = {
    "load": (("point",), "1"),
    "damping": (("point",), "1"),
    "eigenvalue": (("point",), "1/s"),
    "tangent": (("point", "parameter"), "1"),
    "other_unstable": (("point",), "1"),
    "mode_shape": (("point", "coordinate"), "1"),
    "equilibrium": (("point", "coordinate"), "1"),
    "flags": (("point",), "1"),
    "point_curve": (("point",), "1"),
    "step_curve": (("step",), "1"),
    "step_point": (("step",), "1"),
    "step_length": (("step",), "1"),
    "dense_output": (("step", "function", "end", "order"), "1"),
    "curve_kind": (("curve",), "1"),
    "curve_mode": (("curve",), "1"),
    "curve_begin": (("curve",), "1"),
    "curve_end": (("curve",), "1"),
    "curve_closed": (("curve",), "1"),
    "curve_first": (("curve",), "1"),
    "curve_points": (("curve",), "1"),
    "curve_extent": (("curve", "parameter", "bound"), "1"),
    "corner_kind": (("corner",), "1"),
    "corner_parameter": (("corner", "parameter"), "1"),
    "corner_eigenvalue": (("corner", "member"), "1/s"),
    "corner_curve": (("corner", "member"), "1"),
}


def hermite(near, far, h, t):
    """The formula of docs/loci-file.md; series of shape function x order, `near` at t = 0, `far` at t = 1."""
    if t > 0.5:
        return hermite(far, near, -h, 1.0 - t)
    q = near.shape[1] - 1
    table = {}
    for i in range(1, q + 2):
        table[i, 0], table[0, i] = near[:, i - 1] * h ** (i - 1), far[:, i - 1] * h ** (i - 1)
    for i in range(1, q + 2):
        for j in range(1, q + 2):
            table[i, j] = table[i - 1, j] - table[i, j - 1]
    return sum((t * (t - 1.0)) ** k * (table[k + 1, k] + table[k + 1, k + 1] * t) for k in range(q + 1))


class BoundaryTest(CommandTest):
    def boundary(self, scene, second, low, high, *options, output="boundary.h5"):
        """Runs the command with --quiet on a scene given as text; returns all datasets of its file."""
        self.write("scene.toml", scene)
        self.run_well("boundary", "scene.toml", "--second", second, "--second-from", low, "--second-to", high, "-o", output, "-q",
                      *options)
        with h5py.File(self.folder / output) as file:
            return {name: dataset[()] for name, dataset in datasets(file).items()}

    def square(self, scene, *options, **keywords):
        return self.boundary(scene, "Q", -1, 1, *options, **keywords)

    def places(self, data, curve, per_step=20):
        """The dense output at places along a whole curve: P, Q, tau, delta."""
        return np.array([hermite(data["dense_output"][i, :, 0], data["dense_output"][i, :, 1],
                                 data["step_length"][i], t)
                         for i in np.flatnonzero(data["step_curve"] == curve) for t in np.linspace(0, 1, per_step)])


class Curves(BoundaryTest):
    def test_zieglers_column_is_its_closed_form_everywhere(self):
        data = self.boundary((SCENES / "ziegler_column.toml").read_text(encoding="utf-8"), "damping", 0.01, 1)
        self.assertEqual(data["curve_kind"].tolist(), [b"flutter"])
        load, damping, tau, delta = self.places(data, 0).T
        np.testing.assert_allclose(load, 41 / 28 + damping**2 / 2, atol=ACCURATE)
        np.testing.assert_allclose(tau, 0.0, atol=ACCURATE)
        np.testing.assert_allclose(delta, -2 / 7, atol=ACCURATE)
        np.testing.assert_allclose(data["curve_extent"][0], [[41 / 28 + 0.01**2 / 2, 41 / 28 + 1 / 2], [0.01, 1]],
                                   atol=ACCURATE)

    def test_a_corner_lies_where_another_mode_takes_over(self):
        data = self.square(CROSSING_LINES)
        self.assertEqual(data["corner_kind"].tolist(), [b"intersection"])
        np.testing.assert_allclose(data["corner_parameter"], [[0.1, 0.2]], atol=ROUNDING)
        np.testing.assert_allclose(sorted(data["corner_eigenvalue"][0].imag), [1, 2], atol=ROUNDING)
        self.assertEqual(sorted(data["corner_curve"][0]), [0, 1])
        np.testing.assert_array_equal(
            data["other_unstable"] > 0, np.where(np.abs(data["eigenvalue"].imag - 1) < 0.1, 0.3 - data["Q"] - data["P"],
                                                 data["Q"] / 2 - data["P"]) < 0)

    def test_an_island_is_closed(self):
        data = self.square(ISLAND)
        self.assertEqual(data["curve_closed"].tolist(), [1])
        self.assertEqual(data["curve_end"].tolist(), [b"closed"])
        self.assertEqual((data["P"][0], data["Q"][0]), (data["P"][-1], data["Q"][-1]))
        P, Q = self.places(data, 0).T[:2]
        np.testing.assert_allclose(np.hypot(P - 0.13, Q + 0.21), 0.4, atol=ACCURATE)

    def test_a_damping_ratio_comes_from_the_scene_or_the_command_line(self):
        by_option = self.square(freedoms(("P", "1 + Q / 2")), "--damping-ratio", 0.2)
        by_scene = self.square(freedoms(("P", "1 + Q / 2"), extra="[events]\ndamping_ratio = 0.2"), output="scene.h5")
        self.assertEqual(by_option["curve_kind"].tolist(), [b"damping_ratio"])
        for name, data in by_option.items():
            np.testing.assert_array_equal(by_scene[name], data, name)
        P, Q = self.places(by_option, 0).T[:2]
        np.testing.assert_allclose(P, 0.4 * np.sqrt(1 + Q / 2), atol=ACCURATE)

    def test_nothing_to_find_is_said_and_leaves_empty_lists(self):
        self.write("scene.toml", CALM)
        text = self.run_well("boundary", "scene.toml", "--second", "Q", "--second-from", -1, "--second-to", 1, "-o", "none.h5")
        self.assertIn("no boundary in the window", text)
        with h5py.File(self.folder / "none.h5") as file:
            self.assertEqual({file[name].shape[0] for name in ("point", "step", "curve", "corner", "P")}, {0})
            self.assertEqual(file.attrs["count_curves"], 0)
        with xarray.open_dataset(self.folder / "none.h5", engine="h5netcdf") as data:
            self.assertEqual(data.sizes["curve"], 0)

    def test_summary_names_curves_and_corners(self):
        self.write("scene.toml", CROSSING_LINES)
        text = self.run_well("boundary", "scene.toml", "--second", "Q", "--second-from", -1, "--second-to", 1, "-o", "x.h5")
        self.assertRegex(text, r"curve +kind +mode +points +P +Q +ends +bounds the stable region")
        self.assertRegex(text, r"1 +flutter +mode \d +\d+ .* edge, edge +in part")
        self.assertRegex(text, r"intersection +0.1 +0.2 ")
        self.assertRegex(text, r"work +14 lines traced, \d+ changes of stability on them")
        self.assertTrue(text.endswith("wrote x.h5\n"))

    def test_where_there_is_no_equilibrium_the_summary_says_so(self):
        self.write("scene.toml", DAMPED_PENDULUM)
        text = self.run_well("boundary", "scene.toml", "--second", "drag", "--second-from", -1, "--second-to", 1, "--to", 1.3,
                             "-o", "x.h5")
        self.assertIn("folds of the equilibrium, which are not followed: 7, first p = 1, drag = -1", text)
        self.assertIn("lines that could not be begun: 2, first p = 1.3: no equilibrium found", text)
        with h5py.File(self.folder / "x.h5") as file:
            self.assertIn("folds of the equilibrium", file.attrs["notes"])
            self.assertTrue(any(end.startswith(b"equilibrium_ends: the equilibrium folds near p = ")
                                for end in (file["curve_begin"][0], file["curve_end"][0])))

    def test_a_curve_that_was_lost_is_kept_and_told(self):
        self.write("scene.toml", edited(ISLAND, "tolerance = 1e-9", "tolerance = 1e-12\nmax_nodes = 20"))
        run = self.run_program("boundary", "scene.toml", "--second", "Q", "--second-from", -1, "--second-to", 1, "-o", "x.h5", "-q")
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertRegex(run.stderr, r"^eigentrail: a curve was lost: stopped after 20 points; raise max_nodes; "
                                     r"what was found is in x.h5\n$")
        with h5py.File(self.folder / "x.h5") as file:
            self.assertEqual(file.attrs["status"], "incomplete")
            self.assertGreaterEqual(file["point"].shape[0], 20)


class File(BoundaryTest):
    def setUp(self):
        super().setUp()
        self.data = self.boundary((SCENES / "ziegler_column.toml").read_text(encoding="utf-8"), "damping", 0.01, 1)
        self.path = self.folder / "boundary.h5"

    def test_every_dataset_has_its_dimensions_and_labels(self):
        with h5py.File(self.path) as file:
            for name, (dimensions, units) in LAYOUT.items():
                with self.subTest(name):
                    self.assertEqual(tuple(scale.keys()[0] for scale in file[name].dims), dimensions)
                    self.assertEqual(file[name].attrs["units"], units)
                    self.assertTrue(file[name].attrs["long_name"])
            scales = {"point", "step", "curve", "corner", "coordinate", "parameter", "function", "end", "order", "bound",
                      "member"}
            self.assertEqual(set(datasets(file)) - set(LAYOUT), scales)

    def test_root_attributes(self):
        with h5py.File(self.path) as file:
            attributes = dict(file.attrs)
        for name, value in {"format": "eigentrail-boundary", "schema_version": 1, "parameter": "load",
                            "second_parameter": "damping", "second_from": 0.01, "second_to": 1.0, "status": "completed",
                            "damping_ratio": "none", "tolerance": 1e-8, "option_from": "0", "option_to": "3",
                            "count_curves": 1, "count_corners": 0, "notes": "", "message": ""}.items():
            self.assertEqual(attributes[name], value, name)
        self.assertTrue(attributes["scene"].startswith("title = \"Ziegler"))
        self.assertGreater(attributes["count_mode_factorizations"], 0)

    def test_xarray_opens_it_with_both_parameters_as_coordinates(self):
        with xarray.open_dataset(self.path, engine="h5netcdf") as data:
            for name, (dimensions, _) in LAYOUT.items():
                self.assertEqual(data[name].dims, dimensions, name)
            self.assertIn("load", data.eigenvalue.coords)
            self.assertIn("damping", data.eigenvalue.coords)
            self.assertEqual(data.eigenvalue.dtype, np.complex128)
            low = data.curve_extent.sel(curve=0, parameter="damping", bound="lowest")
            self.assertEqual(float(low), 0.01)

    def test_steps_join_the_points(self):
        for i, left in enumerate(self.data["step_point"]):
            for end, point in enumerate((left, left + 1)):
                place = self.data["dense_output"][i, :2, end, 0]
                np.testing.assert_array_equal(place, [self.data["load"][point], self.data["damping"][point]])

    def test_tangents_point_along_the_curve(self):
        tangent = self.data["tangent"]
        np.testing.assert_allclose(tangent[:, 0], tangent[:, 1] * self.data["damping"], atol=1e-9)
        np.testing.assert_allclose(np.hypot(tangent[:, 0] / 3.0, tangent[:, 1] / 0.99), 1.0, rtol=ROUNDING)

    def test_shapes_have_unit_mass_norm(self):
        mass = np.array([[3, 1], [1, 1]])
        norms = np.einsum("pi,ij,pj->p", self.data["mode_shape"].conj(), mass, self.data["mode_shape"])
        np.testing.assert_allclose(norms, 1.0, rtol=ROUNDING)

    def test_commands_for_loci_refuse_it_by_name(self):
        self.assert_refused(self.run_program("eval", "boundary.h5", "--at", 1),
                            ["boundary.h5: holds 'eigentrail-boundary', not loci; open it in h5py or xarray"])


class Refusals(BoundaryTest):
    def refuse(self, fragments, *, second="drag", low=1, high=2, scene=BLADE, options=(), output="x.h5"):
        self.write("scene.toml", scene)
        before = self.contents()
        self.assert_refused(self.run_program("boundary", "scene.toml", "--second", second, "--second-from", low, "--second-to", high,
                                             "-o", output, *options), fragments)
        self.assertEqual(self.contents(), before)

    def test_a_parameter_named_like_a_dataset(self):
        self.refuse(["[parameters] curve: a parameter of the plane cannot be called 'curve'", "rename it"],
                    second="curve", scene=BLADE.replace("drag ", "curve ").replace('"drag"', '"curve"'))

    def test_a_window_without_equilibrium(self):
        self.refuse(["scene.toml: no line of the window could be begun; choose another range"], second="drag",
                    scene=NO_EQUILIBRIUM, options=["-q"])

    def test_the_second_range_may_descend(self):
        curves = [self.boundary(ISLAND, "Q", *ends, "--force")["dense_output"] for ends in ((-1, 1), (1, -1))]
        np.testing.assert_array_equal(*curves)

    def test_bad_input_does_not_cost_an_existing_boundary_file(self):
        self.square(ISLAND)
        (self.folder / "boundary.h5").rename(self.folder / "x.h5")
        self.refuse(["the window is empty"], high=1, options=["--force"])
        self.refuse(["no line of the window could be begun", "no equilibrium found"], scene=NO_EQUILIBRIUM,
                    options=["--force", "-q"])


if __name__ == "__main__":
    unittest.main()
