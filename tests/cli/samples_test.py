"""Samples of matrices as other programs write them: what is read, what is said about them, and bad input."""

import json
import unittest

import h5py
import numpy as np

from command_test_case import CommandTest
from program import EXIT_NUMBERS_FAILED, FAMILY, SCENES, each_case

SPEEDS = [80.0, 125.0, 170.0, 215.0, 260.0]
NAMES = ["plunge", "pitch", "plunge velocity", "pitch velocity"]

WING = """\
title = "Wing"
[parameters]
V = { value = 80, unit = "m/s" }
[sampled_family]
file = "samples.h5"
[trace]
parameter = "V"
from = 80
to = 260
"""
ONE = WING.replace("from = 80\nto = 260\n", "from = 170\n")


def state_matrix(V):
    return np.array([[0, 0, 1, 0], [0, 0, 0, 1], [-100 - 0.002 * V**2, 0.02 * V**2, -0.1 - 0.01 * V, 0],
                     [0.01 * V**2 * np.sin(V / 99), -400 + 0.012 * V**2, 0, -0.2 - 0.005 * V]])


def fill(file, speeds=SPEEDS):
    file["parameter"] = speeds
    file["parameter"].attrs["units"] = "m/s"
    file["A"] = [state_matrix(V) for V in speeds]
    file["state_names"] = NAMES


def like_matlab(file):
    """Rows and columns exchanged, texts of fixed length, every number a double, every list a row."""
    file["parameter"] = np.array(SPEEDS)[None, :]
    file["parameter"].attrs["units"] = np.bytes_("m/s")
    file["A"] = [state_matrix(V).T for V in SPEEDS]
    file["state_names"] = np.array(NAMES, dtype="S20")[None, :]
    file["derivative_order"] = np.array([[2.0, 2.0, 2.0, 2.0]])
    file.attrs["matrix_order"] = np.bytes_("columns")
    file.attrs["digits"] = np.array([[12.0]])
    file.attrs["source"] = np.array(["MATLAB"], dtype="S10")


def like_julia(file):
    """Texts padded with spaces, or in ASCII; a column of values."""
    file["parameter"] = np.array(SPEEDS)[:, None]
    file["parameter"].attrs["units"] = "m/s"
    file["A"] = [state_matrix(V).T for V in SPEEDS]
    padded = h5py.h5t.C_S1.copy()
    padded.set_size(20)
    padded.set_strpad(h5py.h5t.STR_SPACEPAD)
    names = h5py.h5d.create(file.id, b"state_names", padded, h5py.h5s.create_simple((4,)))
    names.write(h5py.h5s.ALL, h5py.h5s.ALL, np.array([n.ljust(20) for n in NAMES], dtype="S20"), mtype=padded)
    file.attrs.create("matrix_order", "columns", dtype=h5py.string_dtype("ascii"))
    file.attrs["digits"] = np.int64(12)


class SamplesTest(CommandTest):
    def samples(self, write=fill, name="samples.h5"):
        with h5py.File(self.folder / name, "w") as file:
            write(file)
        return self.folder / name


class OtherProgramsTest(SamplesTest):
    def spectrum(self, write):
        self.samples(write)
        self.write("wing.toml", WING)
        return json.loads(self.run_well("spectrum", "wing.toml", "--at", "100", "--json"))

    def test_files_of_matlab_and_julia_are_read_as_those_of_python(self):
        expected = self.spectrum(fill)
        for write in (like_matlab, like_julia):
            with self.subTest(write.__name__):
                for row, other in zip(expected, self.spectrum(write), strict=True):
                    self.assertAlmostEqual(row["imag"], other["imag"], 9)
                    self.assertEqual(row["what_moves"], other["what_moves"])
                    self.assertGreater(other["digits_error"], 0.0)

    def test_a_single_sample_of_matlab_has_no_dimension_for_it(self):
        def write(file):
            file["parameter"] = np.array([[170.0]])
            file["A"] = state_matrix(170.0)
        self.samples(write)
        self.write("one.toml", ONE)
        rows = json.loads(self.run_well("spectrum", "one.toml", "--json"))
        self.assertEqual(len(rows), 3)


class InfoTest(SamplesTest):
    def test_samples_are_described(self):
        self.samples(like_matlab)
        text = self.run_well("info", "samples.h5")
        for part in ("5 of A, 4 x 4", "80, 125, 170, 215, 260 m/s", "plunge, pitch", "12 significant", "MATLAB"):
            self.assertIn(part, text)
        info = json.loads(self.run_well("info", "samples.h5", "--json"))
        self.assertEqual((info["values"], info["state_names"], info["digits"]), (SPEEDS, NAMES, 12))

    def test_faults_of_the_samples_are_told(self):
        self.samples(lambda file: file.create_dataset("parameter", data=[1.0, 2.0]))
        self.assert_refused(self.run_program("info", "samples.h5"), ["samples.h5: expected A"])

    def test_imported_samples_keep_name_and_unit_of_the_parameter(self):
        speeds = np.array(SPEEDS)
        np.savez(self.folder / "wing.npz", V=speeds, A=[state_matrix(V) for V in speeds])
        self.run_well("import", "numpy", "wing.npz", "-o", ".", "--unit", "m/s")
        self.assertIn("80, 125, 170, 215, 260 m/s", self.run_well("info", "wing.h5"))
        self.assertIn("V, m/s  error there", self.run_well("suggest", "wing.h5"))


class VerifyTest(SamplesTest):
    def setUp(self):
        super().setUp()
        (self.folder / "scenes").mkdir()
        self.samples(name="scenes/samples.h5")
        self.write("scenes/wing.toml", WING)
        self.run_well("trace", "scenes/wing.toml", "-o", "loci.h5", "--quiet")

    def test_the_scene_is_found_from_the_loci_file_too(self):
        self.run_well("verify", "loci.h5")
        elsewhere = self.folder
        self.folder = self.folder / "scenes"
        self.run_well("verify", elsewhere / "loci.h5")
        self.run_well("verify", "../loci.h5")

    def test_both_may_be_beside_the_loci_file(self):
        (self.folder / "copy").mkdir()
        for name in ("scenes/wing.toml", "scenes/samples.h5", "loci.h5"):
            (self.folder / name).rename(self.folder / "copy" / name.rpartition("/")[2])
        self.run_well("verify", "copy/loci.h5")

    def test_a_scene_that_is_nowhere_is_told_with_the_places_where_it_was_sought(self):
        (self.folder / "scenes/wing.toml").unlink()
        self.assert_refused(self.run_program("verify", "loci.h5"),
                            ["loci.h5: ", "samples.h5 beside scenes/wing.toml", "nor beside the loci file"])

    def test_changed_samples_are_told(self):
        def write(file):
            fill(file)
            file["A"][:, 3, 1] += 1.0
        self.samples(write, "scenes/samples.h5")
        run = self.run_program("verify", "loci.h5")
        self.assertEqual(run.returncode, 1)
        self.assertIn("do not fit the matrices in scenes/samples.h5: has this file changed", run.stderr)


@each_case([
    ("values outside the samples", WING, ["spectrum", "scene.toml", "--at", "100", "300"],
     ["scene.toml: V = 300 lies outside the samples, which reach from 80 to 260"]),
    ("a single sample cannot be traced", ONE, ["trace", "scene.toml", "-o", "x.h5"],
     ["to: is missing", "of a single sample, 'eigentrail spectrum'"]),
    ("a file of samples as scene", WING, ["spectrum", "samples.h5"],
     ["samples.h5: is an HDF5 file, no scene (TOML); 'eigentrail info' says what it holds"]),
    ("a file of samples as scene of a trace", WING, ["trace", "samples.h5", "-o", "x.h5"],
     ["samples.h5: is an HDF5 file, no scene"]),
    ("import without a format", WING, ["import"], ["expected a format (", "numpy"]),
    ("import of an ending", WING, ["import", "npz", "a.npz"], ["found 'npz'; did you mean 'numpy'?"]),
    ("import of a file without a format", WING, ["import", "a.mat", "-o", "x"],
     ["for this file: import matlab a.mat -o FOLDER"]),
])
class BadCommandsTest(SamplesTest):
    def check(self, scene, command, fragments):
        self.samples()
        self.write("scene.toml", scene)
        self.assert_refused(self.run_program(*command), fragments)


class OneSampleTest(SamplesTest):
    def test_a_range_beyond_one_sample_is_told_with_what_to_do(self):
        self.samples(lambda file: fill(file, [170.0]))
        self.write("one.toml", ONE)
        self.assert_refused(self.run_program("trace", "one.toml", "-o", "x.h5", "--to", "180"),
                            ["V = 180 lies outside the samples: there is one, at 170", "'eigentrail spectrum'"])
        self.assert_refused(self.run_program("suggest", "samples.h5"), ["samples.h5: has one sample; at least two"])


def line_samples(file):
    """Exact for a straight interpolant: flutter at p = 0.4, and a steady real root."""
    p = np.linspace(0.0, 1.0, 8)
    file["parameter"] = p
    file["A"] = [[[0.05 * (x - 0.4), 1, 0], [-1, 0.05 * (x - 0.4), 0], [0, 0, -3]] for x in p]
    file["state_names"] = ["swing", "rate", "filter"]


LINE = """\
[sampled_family]
file = "samples.h5"
[trace]
parameter = "p"
from = 0
to = 1
"""


class TraceOfSamplesTest(SamplesTest):
    def trace_line(self, write=line_samples, *options):
        self.samples(write)
        self.write("line.toml", LINE)
        return self.run_well("trace", "line.toml", "-o", "loci.h5", "--force", *options)

    def test_exact_data_leave_nothing_undecided(self):
        text = self.trace_line()
        self.assertNotIn("undecided", text)
        self.assertRegex(text, r"flutter .* unstable above\n")
        self.assertIn("to flutter, mode 1", text)

    def uncertain(self, file):
        """The real part, -0.02 + 0.05 p, may be off by more than 0.02 and less than 0.03."""
        line_samples(file)
        file["A_error"] = np.broadcast_to(np.diag([0.009, 0.009, 0.0]), (8, 3, 3))

    def test_intervals_cut_by_the_range_are_marked(self):
        self.assertRegex(self.trace_line(self.uncertain), r"flutter .* between 0 and 0.8\d*, or beyond 0 \(end of the range\)")
        self.assertIn("or beyond 0 (end of the range)", self.run_well("events", "loci.h5"))
        (event,) = json.loads(self.run_well("events", "loci.h5", "--json"))
        self.assertEqual(event["interval_cut"], [True, False])
        self.assertEqual(event["interval"][0], 0.0)

    def test_what_moves_is_named_by_the_states(self):
        self.assertRegex(self.trace_line(), r"1 .* swing 50 %, rate 50 %\n")
        self.assertIn("filter 100 %", self.run_well("info", "loci.h5"))
        with h5py.File(self.folder / "loci.h5") as file:
            self.assertEqual(file["mode_name"].asstr()[1], "filter 100 %")

    def trace_wave(self, digits, *options):
        self.samples(self.wavy(digits))
        self.write("line.toml", LINE + "[events]\nextrema = true\n")
        return self.run_well("trace", "line.toml", "-o", "loci.h5", "--force", *options)

    def wavy(self, digits):
        """A damping ratio that goes up and down by 1e-3."""
        def write(file):
            p = np.linspace(0.0, 1.0, 25)
            file["parameter"] = p
            file["A"] = [[[0, 1], [-1, -0.1 - 2e-3 * np.sin(9 * x)]] for x in p]
            if digits:
                file.attrs["digits"] = digits
        return write

    def test_extrema_that_are_shallower_than_the_errors_of_the_data_are_left_out(self):
        deep = self.trace_wave(None)
        self.assertRegex(deep, r"extremum .* damping ratio")
        shallow = self.trace_wave(2)
        self.assertNotIn("damping ratio 0.0", shallow)
        self.assertIn("extrema of damping ratios left out: no deeper than the errors of the data", shallow)
        self.assertIn("no special points", self.run_well("events", "loci.h5"))
        # Events that a save has written already are taken back.
        self.trace_wave(2, "--save-every", "0")
        self.assertIn("no special points", self.run_well("events", "loci.h5"))

    def test_a_band_without_a_mode_is_an_error(self):
        self.samples(line_samples)
        self.write("line.toml", LINE)
        for options in ([], ["--csv"]):
            run = self.run_program("spectrum", "line.toml", *options, "--modes", "band = ['100 Hz', '200 Hz']")
            self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
            self.assertIn("none of the modes with Im s between", run.stderr)

    def test_explain_describes_samples_and_interpolant(self):
        self.samples(lambda file: (line_samples(file), file.attrs.__setitem__("digits", 4)))
        self.write("line.toml", LINE.replace('samples.h5"', 'samples.h5"\nkinks = [1, 0]'))
        text = self.run_well("explain", "line.toml")
        for part in ("samples      8 at p = 0 to 1", "interpolant  degree 1, no poles", "kinks        none declared",
                     "digits       4 significant"):
            self.assertIn(part, text)

    def test_zero_eigenvalues_have_no_damping_ratio(self):
        def write(file):
            file["parameter"] = [0.0, 0.5, 1.0]
            file["A"] = [[[0, 1, 0], [-1 - x, -0.1, 0], [0, 0, 0]] for x in (0.0, 0.5, 1.0)]
        self.trace_line(write)
        self.assertNotIn("nan", self.run_well("eval", "loci.h5", "--at", "0.3"))


class OpenFastTest(SamplesTest):
    DATA = SCENES.parent.parent / "tests" / "import" / "data"

    def load(self, *options):
        files = sorted(self.DATA.glob("ws0*.lin"))
        return self.run_well("import", "openfast", *files, "-o", "x", "--force", *options)

    def test_title_and_name_are_the_common_part_of_the_files(self):
        self.assertIn("averaged over 1 to 3 azimuths", self.load())
        self.assertTrue((self.folder / "x" / "ws.toml").read_text().startswith('title = "ws, OpenFAST"'))

    def test_parameter_is_found_whatever_the_case(self):
        self.assertIn("nacelle yaw", self.load("--parameter", "NACELLE yaw"))

    def test_descriptions_in_arrays_become_short_names(self):
        names = ["ED 1st tower fore-aft bending mode DOF (internal DOF index = DOF_TFA1), m",
                 "ED First time derivative of 1st tower fore-aft bending mode DOF (internal DOF index = DOF_TFA1), m/s"]
        A = [[[0, 1], [-k, -0.1]] for k in (1.0, 2.0)]
        np.savez(self.folder / "t.npz", A=A, V=[1.0, 2.0], state_names=names)
        self.run_well("import", "numpy", "t.npz", "-o", ".")
        self.assertIn("1st tower fore-aft velocity", self.run_well("info", "t.h5"))
        self.assertNotIn("DOF", self.run_well("spectrum", "t.toml"))

    def test_long_names_are_cut_in_tables_only(self):
        names = ["a" * 120, "b" * 120]
        A = [[[0, 1], [-k, -0.1]] for k in (1.0, 2.0)]
        np.savez(self.folder / "t.npz", A=A, V=[1.0, 2.0], state_names=names)
        self.run_well("import", "numpy", "t.npz", "-o", ".")
        self.assertLess(max(map(len, self.run_well("spectrum", "t.toml").splitlines())), 240)
        self.assertIn(names[0], self.run_well("spectrum", "t.toml", "--csv"))


def changed(**changes):
    """Writes good samples with other datasets, and with attributes @name."""
    def write(file):
        fill(file)
        for name, value in changes.items():
            if name in file:
                del file[name]
            if name.startswith("at_"):
                file.attrs[name[3:]] = value
            else:
                file[name] = value
    return write


@each_case([
    ("misspelt order", changed(at_matrix_order="column"),
     ["matrix_order: expected 'rows' or 'columns'", "found 'column'"]),
    ("digits as text", changed(at_digits="six"), ["attribute digits: expected whole numbers"]),
    ("digits with a fraction", changed(at_digits=6.5), ["attribute digits: expected whole numbers"]),
    ("value twice", changed(parameter=[80.0, 125.0, 170.0, 125.0, 260.0]),
     ["parameter has the value 125 twice, at samples 2 and 4"]),
    ("too few names", changed(state_names=NAMES[:3]), ["state_names has 3 entries; expected 4"]),
    ("name twice", changed(state_names=["a", "b", "c", "b"]), ["state_names has 'b' twice, for states 2 and 4"]),
    ("names as numbers", changed(state_names=[1, 2, 3, 4]), ["state_names: expected texts"]),
    ("table of values", changed(parameter=np.ones((2, 5))), ["parameter: expected a list of values"]),
])
class BadSamplesTest(SamplesTest):
    def check(self, write, fragments):
        self.samples(write)
        self.write("scene.toml", WING)
        self.assert_refused(self.run_program("spectrum", "scene.toml"), ["samples.h5", *fragments])


class BadFamilyTest(SamplesTest):
    def test_states_of_a_polynomial_family_with_the_same_name_are_refused(self):
        family = FAMILY + 'state_names = ["a", "a"]\n'
        self.write("scene.toml", family)
        self.assert_refused(self.run_program("spectrum", "scene.toml"), ["state_names: has 'a' twice, for states 1 and 2"])


class BadArraysTest(SamplesTest):
    def refused(self, fragments, **arrays):
        np.savez(self.folder / "wing.npz", **arrays)
        self.assert_refused(self.run_program("import", "numpy", "wing.npz", "-o", "x"), fragments)

    def test_a_parameter_with_a_value_twice_is_named(self):
        A = [state_matrix(V) for V in SPEEDS]
        self.refused(["array wind has the value 5 twice"], A=A, wind=[3.0, 5.0, 5.0, 7.0, 9.0])
        self.refused(["array wind neither rises nor falls", "--parameter wind"], A=A, wind=[3.0, 7.0, 5.0, 6.0, 9.0])


if __name__ == "__main__":
    unittest.main()
