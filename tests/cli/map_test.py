"""`eigentrail map`: its file as other software reads it, its output, and bad input."""

import unittest

import h5py
import numpy as np
import xarray

from command_test_case import CommandTest
from program import BLADE, EXIT_NUMBERS_FAILED, PUSHED_PENDULUM, edited

# s^2 + (p^2 + q^2 - 1) s + 0.8 - p - q = 0: a circle of flutter and a line of divergence.
CIRCLE = """\
title = "Circle"

[parameters]
p = { value = 0.0, unit = "m" }
q = { value = 0.0, unit = "rpm" }
one = 1.0  # stands for units that make the sums below possible

[trace]
parameter = "p"
from = -1.5
to = 1.5

[matrix_family]
M = [[[1]]]
C = [[["one*p*p + one*(30*q/pi)^2 - 1"]]]
K = [[["0.8 - one*p - one*30*q/pi"]]]
"""

# Traced along its damping; it has no equilibrium with p > 1.
PUSHED = edited(PUSHED_PENDULUM, "p = 0.0", "p = 0.0\nr = 0.1") + '[[drag]]\npoint = "bob"\ncoefficient = "r"\n'
ALONG_DAMPING = ("--parameter", "r", "--from", "0.1", "--to", "1", "--second", "p")

LAYOUT = {
    "q": (("q",), "rpm"),
    "p": (("p",), "m"),
    "unstable": (("q", "p"), "1"),
    "margin": (("q", "p"), "1/s"),
    "damping_ratio": (("q", "p"), "1"),
    "line_status": (("q",), "1"),
    "line_reached": (("q",), "m"),
    "line_work": (("q",), "1"),
    "axis_point": (("axis_point",), "1"),
    "axis_line": (("axis_point",), "1"),
    "axis_parameter": (("axis_point",), "m"),
    "axis_kind": (("axis_point",), "1"),
    "axis_frequency": (("axis_point",), "rad/s"),
}
WHOLE = {"unstable", "line_work", "axis_point", "axis_line"}
TEXTS = {"line_status", "axis_kind"}


def circle_unstable(q, p):
    """Modes with Re s > 0 of CIRCLE, pairs counted once."""
    c, k = p**2 + q**2 - 1, 0.8 - p - q
    root = np.sqrt(c**2 / 4 - k + 0j)
    upper, lower = -c / 2 + root, -c / 2 - root
    return (upper.real > 0).astype(int) + ((lower.real > 0) & (root.imag == 0))


class Map(CommandTest):
    def map(self, scene, *options, output="map.h5", grid="9x31"):
        """Maps a scene given as text; returns the printed output."""
        self.write("scene.toml", scene)
        return self.run_well("map", "scene.toml", "--grid", grid, "-o", output, *options)

    def circle(self, *options, output="map.h5"):
        return self.map(CIRCLE, "--second", "q", "--second-from", "-1.5", "--second-to", "1.5", *options, output=output)

    def test_former_names_of_the_ranges_work_with_a_warning(self):
        self.write("scene.toml", CIRCLE)
        command, rest = ("map", "scene.toml", "--second", "q"), ("--grid", "4x5", "-q", "-o")
        new = self.run_program(*command, "--second-from", "-1.5", "--second-to", "1.5", "--to", "1", *rest, "new.h5")
        old = self.run_program(*command, "--from", "-1.5", "--to", "1.5", "--first-to", "1", *rest, "old.h5")
        self.assertEqual((new.returncode, new.stderr, old.returncode), (0, "", 0))
        self.assertIn("write --second-from and --second-to", old.stderr)
        with self.open("new.h5") as one, self.open("old.h5") as other:
            for name in ("q", "p", "unstable", "margin"):
                np.testing.assert_array_equal(one[name][()], other[name][()])

    def test_datasets_have_dimensions_units_and_names(self):
        self.circle()
        file = self.open("map.h5")
        self.assert_layout(file, LAYOUT)
        for name in LAYOUT:
            with self.subTest(name):
                self.assertEqual(file[name].dtype, np.dtype(object if name in TEXTS else
                                                            np.int64 if name in WHOLE else np.float64))

    def test_root_says_how_the_file_was_made(self):
        self.circle("--tolerance", "1e-7")
        attributes = self.open("map.h5").attrs
        self.assertEqual((attributes["format"], attributes["schema_version"]), ("eigentrail-map", 1))
        self.assertEqual((attributes["title"], attributes["scene"]), ("Circle", CIRCLE))
        self.assertEqual((attributes["parameter"], attributes["second_parameter"]), ("p", "q"))
        self.assertEqual((attributes["tolerance"], attributes["option_tolerance"]), (1e-7, "1e-07"))
        self.assertEqual((attributes["count_lines"], attributes["count_cells"], attributes["notes"]), (9, 279, ""))
        self.assertEqual(sum(attributes[f"count_{kind}_cells"] for kind in
                             ("stable", "marginal", "unstable", "unknown")), 279)
        self.assertEqual(attributes["count_factorizations"], np.sum(self.open("map.h5")["line_work"]))

    def test_xarray_opens_it_and_the_cells_are_those_of_the_closed_form(self):
        self.circle()
        with xarray.open_dataset(self.folder / "map.h5", engine="h5netcdf") as data:
            self.assertEqual(data.unstable.dims, ("q", "p"))
            np.testing.assert_allclose(data.q, np.linspace(-1.5, 1.5, 9), atol=1e-15)
            np.testing.assert_allclose(data.p, np.linspace(-1.5, 1.5, 31), atol=1e-15)
            q, p = np.meshgrid(data.q, data.p, indexing="ij")
            # Cells on the boundary itself are decided by rounding here.
            clear = (np.abs(p**2 + q**2 - 1) > 1e-9) & (np.abs(0.8 - p - q) > 1e-9)
            np.testing.assert_array_equal(data.unstable.values[clear], circle_unstable(q, p)[clear])
            np.testing.assert_array_equal((data.margin.values < 0), data.unstable.values > 0)

    def test_axis_points_lie_on_the_boundary(self):
        self.circle()
        file = self.open("map.h5")
        p, q = file["axis_parameter"][:], file["q"][:][file["axis_line"][:]]
        flutter = file["axis_kind"].asstr()[:] == "flutter"
        self.assertTrue(flutter.any() and not flutter.all())
        np.testing.assert_allclose((p**2 + q**2)[flutter], 1, atol=1e-8)
        np.testing.assert_allclose((p + q)[~flutter], 0.8, atol=1e-8)

    def test_every_number_of_threads_writes_the_same_bytes(self):
        for jobs in (1, 2, 3, 8):
            self.circle("--jobs", jobs, "--quiet", output=f"map_{jobs}.h5")
        reference = (self.folder / "map_1.h5").read_bytes()
        for jobs in (2, 3, 8):
            self.assertEqual((self.folder / f"map_{jobs}.h5").read_bytes(), reference)
        file = self.open("map_1.h5")
        self.assertEqual([h5py.h5g.get_objinfo(file[name].id, b".").mtime for name in file], [0] * len(file))

    def test_summary_has_a_picture_shares_and_cost(self):
        text = self.circle()
        self.assertIn("9 x 31 cells: q -1.5 -> 1.5 rpm, p -1.5 -> 1.5 m", text)
        rows = [line.split("|")[1] for line in text.splitlines() if "|" in line]
        unstable = self.open("map.h5")["unstable"][:]
        self.assertEqual(rows, ["".join("." if n == 0 else str(n) for n in line) for line in unstable[::-1]])
        self.assertRegex(text, r"stable \S+ %, unstable \S+ %, unknown 0 % \(0 of 279 cells\)")
        self.assertRegex(text, r"9 traces for 279 cells, \d+ complex LU of size 2: \S+ per cell")
        self.assertTrue(text.endswith("wrote map.h5\n"))

    def test_one_number_makes_a_square_grid_and_the_window_goes_either_way(self):
        self.map(CIRCLE, "--second", "q", "--second-from", "1", "--second-to", "-1", "--from", "1", "--to", "-1",
                 grid="5")
        file = self.open("map.h5")
        for name in ("p", "q"):
            self.assertEqual(file[name][:].tolist(), [1, 0.5, 0, -0.5, -1])

    def test_lines_without_equilibrium_are_unknown_and_said(self):
        text = self.map(PUSHED, *ALONG_DAMPING, "--second-from", "0", "--second-to", "1.5", grid="4x5")
        self.assertIn("unknown 50 % (10 of 20 cells)", text)
        self.assertRegex(text, r"note  2 of 4 lines could not be begun; .*, first at p = 1: no equilibrium found")
        file = self.open("map.h5")
        self.assertEqual(file["unstable"][:].tolist(), [[0] * 5] * 2 + [[-1] * 5] * 2)
        self.assertEqual(np.isnan(file["margin"][:]).tolist(), [[False] * 5] * 2 + [[True] * 5] * 2)
        self.assertEqual([text == "completed" for text in file["line_status"].asstr()], [True, True, False, False])
        self.assertIn("could not be begun", file.attrs["notes"])

    def test_window_without_any_equilibrium_keeps_the_old_file(self):
        self.circle()
        self.write("scene.toml", PUSHED)
        before = self.contents()
        run = self.run_program("map", "scene.toml", *ALONG_DAMPING, "--second-from", "1.1", "--second-to", "1.5", "--grid", "3",
                               "-o", "map.h5", "--force")
        self.assertEqual((run.returncode, run.stdout), (EXIT_NUMBERS_FAILED, ""))
        self.assertRegex(run.stderr, r"\Aeigentrail: scene\.toml: no cell of the window is known, nothing is written; "
                                     r"[^\n]*no equilibrium found[^\n]*\n\Z")
        self.assertEqual(self.contents(), before)


if __name__ == "__main__":
    unittest.main()
