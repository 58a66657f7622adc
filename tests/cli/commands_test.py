"""Output and exit codes of the commands that only read: eval, events, info and explain."""

import csv
import io
import json
import math
import re
import unittest

import h5py
import numpy as np

from command_test_case import DEFAULT_TOLERANCE, CommandTest, blade_eigenvalues
from program import BIRTH, BLADE, CROSSING, EXIT_BAD_INPUT, EXIT_NUMBERS_FAILED, FAMILY, SCENES, edited

COMMANDS = ["trace", "spectrum", "eval", "events", "boundary", "map", "info", "explain", "accuracy"]

MASSLESS_SHAFT = """
parameters = { speed = 0.0 }
trace = { parameter = "speed", from = 0, to = 2000 }
disc = [{ node = 2, mass = 0.8, Id = 0.00066, Ip = 0.0012 }]
bearing = [{ node = [1, 4], kxx = 1e8, kxy = "10*speed", kyx = "-10*speed" }]
[[shaft]]
stations = { length = 0.24, outer = 0.012 }
elements = 4
E = 2.1e11
nu = 0.3
density = 0
speed = "speed"
internal_damping = 2.4e-6
"""


class Program(CommandTest):
    def test_version_names_the_program_and_a_number(self):
        self.assertRegex(self.run_well("--version"), r"^eigentrail \d+\.\d+\.\d+\n$")

    def test_libraries_are_not_those_of_the_current_folder(self):
        self.write("libz.so.1", "no library")
        self.run_well("--version")

    def test_help_names_every_command_and_the_exit_codes(self):
        text = self.run_well("--help")
        for fragment in [*COMMANDS, "Exit codes"]:
            self.assertIn(fragment, text)


class UnknownNames(CommandTest):
    """Names that mean nothing are errors with a suggestion, and point to the help of the command."""

    def test_options(self):
        self.write("scene.toml", FAMILY)
        for command, *fragments in ((["trace", "scene.toml", "--tolerence", "1e-8"], "unknown option '--tolerence'; did you mean '--tolerance'?",
                                     "(see eigentrail trace --help)"),
                                    (["trace", "scene.toml", "--tolerence=1e-8"], "did you mean '--tolerance'?"),
                                    (["trace", "scene.toml", "--harmonics", "2"], "unknown option '--harmonics'; it is an option of plot"),
                                    (["eval", "loci.h5", "--ta", "3"], "did you mean '--at'?", "(see eigentrail eval --help)"),
                                    (["import", "numpy", "a.npz", "--digit", "3"], "did you mean '--digits'?", "(see eigentrail import numpy --help)"),
                                    (["trace"], "SCENE is required", "(see eigentrail trace --help)"),
                                    (["trace", "a.toml", "b.toml"], "b.toml", "(see eigentrail trace --help)"),
                                    (["--versoin"], "did you mean '--version'?", "(see eigentrail --help)"),
                                    (["sweep", "scene.toml", "--vary", "q=1,2"], "--vary q: no parameter is called 'q'"),
                                    (["trace", "scene.toml", "--parameter", "q"], "no parameter is called 'q'; known: p")):
            with self.subTest(command):
                self.assert_refused(self.run_program(*command), fragments)

    def test_tables(self):
        for table, *fragments in (("[[cable]]", "cable: unknown key, not supported;", "docs/scene-tables.md"),
                                  ("[[wheel]]", "wheel: unknown key, not supported;", "docs/scene-tables.md"),
                                  ("[[sprng]]", "sprng: unknown key, not supported; did you mean 'spring'?")):
            self.write("scene.toml", BLADE + f"\n{table}\nratio = 2\n")
            with self.subTest(table):
                self.assert_refused(self.run_program("trace", "scene.toml"), fragments)

    def test_scenes_are_no_results(self):
        self.write("scene.toml", FAMILY)
        for command in (["events"], ["eval", "--at", "1"], ["info"], ["verify"], ["report", "-o", "a.html"], ["export"]):
            with self.subTest(command):
                self.assert_refused(self.run_program(command[0], "scene.toml", *command[1:]),
                                    ["scene.toml: is a scene, no result; trace it first: eigentrail trace scene.toml -o scene.h5"])

    def test_programs_are_no_texts(self):
        self.assert_refused(self.run_program("trace", "/bin/ls"), ["/bin/ls: is not a text file"])
        self.write("scene.toml", BLADE.replace('drag   = 2.0', 'drag   = "2**3"'))
        self.assert_refused(self.run_program("trace", "scene.toml"), ["at character 2: powers are written with '^', as in x^2, not with '**'"])

    def test_a_band_without_modes(self):
        self.write("scene.toml", BLADE)
        run = self.run_program("trace", "scene.toml", "-q", "--modes", "band = ['900 Hz', '901 Hz']")
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
        self.assertIn("no mode lies in the band", run.stderr)
        run = self.run_program("spectrum", "scene.toml", "--modes", "band = ['900 Hz', '901 Hz']")
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
        self.assertIn("none of the modes with Im s between", run.stderr)
        self.run_well("trace", "scene.toml", "-q", "--force", "--modes", "band = ['1 Hz', '2 Hz']")


class Spectrum(CommandTest):
    def write_blade(self):
        self.write("scene.toml", BLADE)
        return "scene.toml"

    def test_csv_and_json_hold_the_closed_form(self):
        scene = self.write_blade()
        rows = json.loads(self.run_well("spectrum", scene, "--at", "50", "7.5", "--json"))
        lines = self.run_well("spectrum", scene, "--at", "50", "7.5", "--csv").splitlines()
        self.assertEqual(lines[0], "parameter,mode,real,imag,natural_frequency_hz,damped_frequency_hz,damping_ratio,"
                                   "log_decrement,condition,rounding,what_moves")
        self.assertEqual(len(rows), 4)
        for row, line in zip(rows, lines[1:]):
            s = complex(row["real"], row["imag"])
            self.assertEqual([float(x) for x in line.split(",")[2:4]], [s.real, s.imag])
            self.assertLess(min(abs(s - exact) for exact in blade_eigenvalues(row["parameter"])), 1e-12 * abs(s))
            self.assertAlmostEqual(row["natural_frequency_hz"] * 2 * np.pi, abs(s), delta=1e-12 * abs(s))
            self.assertAlmostEqual(row["damping_ratio"], -s.real / abs(s), delta=1e-12)

    def test_a_value_does_not_depend_on_the_others(self):
        # From the equilibrium at 5 rad/s Newton's method comes to another one at 40 rad/s.
        scene = SCENES / "rotating_mass.toml"
        alone, behind = (self.run_well("spectrum", scene, "--at", *values).split("omega = 40 ")[1] for values in (["40"], ["5", "40"]))
        self.assertEqual(alone, behind)

    def test_begins_where_the_trace_does_and_names_what_moves(self):
        lines = self.run_well("spectrum", self.write_blade()).splitlines()
        self.assertTrue(any(line.startswith("omega = 100") for line in lines))
        self.assertTrue(any(line.endswith("flap") for line in lines))

    def test_modes_that_grow_are_shown_whatever_is_chosen(self):
        self.write("scene.toml", FAMILY.replace("K = ", "C = [[[0.1, 0], [0, -0.2]]]\nK = ", 1))
        summary = self.run_well("spectrum", "scene.toml", "--at", "0", "--modes", "1")
        self.assertIn("modes that grow: 2", summary)
        self.assertIn("0.1 + 1.4106736j", summary)  # i sqrt(2 - 0.01)

    def test_a_singular_mass_of_an_independent_part_has_no_large_eigenvalues(self):
        """A shaft without mass, a disc on it: 4 freedoms with mass, 16 with damping only, in each plane half of them."""
        self.write("scene.toml", MASSLESS_SHAFT)
        rows = json.loads(self.run_well("spectrum", "scene.toml", "--modes", "all", "--json"))
        self.assertLess(max(row["real"] for row in rows), 0.0)
        self.assertLess(max(abs(complex(row["real"], row["imag"])) for row in rows), 1e9)
        self.assertIn("stable  speed = 0 -> 1682.4378949", self.run_well("trace", "scene.toml", "--modes", "4", "-o", "loci.h5"))

    def test_modes_are_chosen_in_the_same_words(self):
        rows = json.loads(self.run_well("spectrum", self.write_blade(), "--at", "50", "--modes", "count = 1, near = '1 kHz'",
                                        "--json"))
        self.assertEqual(len(rows), 1)

    def test_a_choice_that_cannot_be_read_is_bad_input(self):
        self.assert_refused(self.run_program("spectrum", self.write_blade(), "--modes", "band = ['1 m', '2 m']"),
                            ["expected a frequency"])


EVAL_COLUMNS = ["parameter", "mode", "real", "imag", "natural_frequency", "damped_frequency", "damping_ratio", "log_decrement"]


class Eval(CommandTest):
    def test_csv_has_the_promised_header_and_a_row_per_place_and_mode(self):
        self.trace(BLADE)
        lines = self.run_well("eval", "loci.h5", "--at", "50", "7.5", "--csv").splitlines()
        self.assertEqual(lines[0], ",".join(EVAL_COLUMNS))
        self.assertEqual([line.split(",")[:2] for line in lines[1:]],
                         [["50", "mode 1"], ["50", "mode 2"], ["7.5", "mode 1"], ["7.5", "mode 2"]])

    def test_json_holds_the_numbers_of_the_csv(self):
        self.trace(BLADE)
        rows = json.loads(self.run_well("eval", "loci.h5", "--at", "50", "7.5", "--json"))
        self.assertEqual([list(row) for row in rows], [EVAL_COLUMNS] * 4)
        self.assertEqual([(row["parameter"], row["mode"], complex(row["real"], row["imag"])) for row in rows],
                         self.eval_rows("loci.h5", [50, 7.5]))

    def test_table_for_people_names_its_columns(self):
        self.trace(BLADE)
        lines = self.run_well("eval", "loci.h5", "--at", "50").splitlines()
        self.assertRegex(lines[0], r"omega +mode +s, 1/s +natural, rad/s +damped, rad/s +damping +decrement")
        self.assertEqual(len(lines), 3)

    def test_stored_points_come_back_exactly(self):
        with h5py.File(self.trace(BLADE)) as file:
            p, stored = file["omega"][:], file["eigenvalue"][:]
        np.testing.assert_array_equal(self.eval_at("loci.h5", p), stored)

    def test_everywhere_within_the_tolerance_of_the_closed_form(self):
        self.trace(BLADE)
        places = np.linspace(5.0, 100.0, 137)
        expected = np.array([blade_eigenvalues(omega) for omega in places])
        self.assert_within(self.eval_at("loci.h5", places), expected, DEFAULT_TOLERANCE)

    def test_negative_and_exponential_numbers_are_places(self):
        self.trace(FAMILY, "--from", "-1")
        places = [-1.0, -5e-1, 1e-1]
        text = self.run_well("eval", "loci.h5", "--csv", "--at", "-1", "-5e-1", "1e-1")
        self.assertEqual([float(line.split(",")[0]) for line in text.splitlines()[1::2]], places)

    def test_modes_that_do_not_exist_are_left_out(self):
        self.trace(BIRTH)
        rows = self.eval_rows("loci.h5", [0.5, 0.997, 0.998, 1.2])
        self.assertEqual([row[:2] for row in rows],
                         [(0.5, "mode 1"), (0.997, "mode 1"), (0.998, "mode 1"), (0.998, "mode 2"),
                          (1.2, "mode 1"), (1.2, "mode 2")])
        roots = [complex(-0.05, math.sqrt(0.9975 - p)) for p in (0.5, 0.997)]
        roots += [-0.05 + sign * math.sqrt(p - 0.9975) for p in (0.998, 1.2) for sign in (1, -1)]
        self.assert_within(np.array([s for *_, s in rows]), np.array(roots), DEFAULT_TOLERANCE)
        self.assertEqual([row["mode"] for row in json.loads(self.run_well("eval", "loci.h5", "--at", "0.5", "--json"))],
                         ["mode 1"])
        self.assertEqual(len(self.run_well("eval", "loci.h5", "--at", "0.5").splitlines()), 2)


class Events(CommandTest):
    def events(self):
        return list(csv.DictReader(io.StringIO(self.run_well("events", "loci.h5", "--csv"))))

    def test_csv_has_the_promised_header_and_a_row_per_event(self):
        self.trace(BIRTH)
        self.assertEqual(self.run_well("events", "loci.h5", "--csv").splitlines()[0], "kind,parameter,real,imag,modes")
        collision, divergence = self.events()
        self.assertEqual((collision["kind"], divergence["kind"]), ("collision", "divergence"))
        self.assertAlmostEqual(float(collision["parameter"]), 0.9975, delta=1e-12)
        self.assertAlmostEqual(float(collision["real"]), -0.05, delta=1e-7)
        self.assertAlmostEqual(float(collision["imag"]), 0.0, delta=1e-7)
        self.assertAlmostEqual(float(divergence["parameter"]), 1.0, delta=1e-12)
        self.assertEqual((float(divergence["real"]), float(divergence["imag"])), (0.0, 0.0))
        self.assertEqual(collision["modes"], "1;2")

    def test_a_collision_names_both_modes_whether_one_begins_or_ends_there(self):
        for way in ((), ("--from", "1.5", "--to", "0")):
            self.trace(BIRTH, "--force", *way)
            collisions = [event["modes"] for event in self.events() if event["kind"] == "collision"]
            self.assertEqual(collisions, ["1;2"], way)

    def test_csv_is_what_the_file_holds(self):
        for scene in (BIRTH, CROSSING, BLADE):
            with h5py.File(self.trace(scene, "--force")) as file:
                self.assertEqual(self.run_well("events", "loci.h5", "--csv").splitlines()[1:],
                                 file["events"].asstr()[:].tolist())

    def test_json_holds_the_numbers_of_the_csv(self):
        self.trace(BIRTH)
        rows = json.loads(self.run_well("events", "loci.h5", "--json"))
        keys = ["kind", "parameter", "real", "imag", "modes"]
        texts = ("kind", "modes")
        self.assertEqual([{key: str(row[key]) for key in texts} for row in rows],
                         [{key: row[key] for key in texts} for row in self.events()])
        for key in ("parameter", "real", "imag"):
            self.assertEqual([row[key] for row in rows], [float(row[key]) for row in self.events()])
        self.assertEqual([list(row) for row in rows],
                         [keys + ["puiseux", "sensitivity"], keys + ["direction", "sensitivity"]])
        self.assertEqual(rows[1]["direction"], 1)

    def test_collision_has_its_puiseux_coefficient(self):
        """s = -0.05 +- sqrt(p - 0.9975): the coefficient is 1, or its other root."""
        self.trace(BIRTH)
        collision = json.loads(self.run_well("events", "loci.h5", "--json"))[0]
        self.assertAlmostEqual(complex(*collision["puiseux"]) ** 2, 1.0, places=9)

    def test_crossing_names_both_modes(self):
        self.trace(CROSSING)
        crossing, = self.events()
        self.assertEqual((crossing["kind"], crossing["modes"]), ("crossing", "1;2"))
        self.assertAlmostEqual(float(crossing["parameter"]), 0.5, delta=1e-9)
        self.assertAlmostEqual(float(crossing["imag"]), math.sqrt(1.5), delta=1e-9)

    def test_veering_has_its_half_width(self):
        """s^2 = -3/2 +- sqrt((p - 1/2)^2 + c^2): modes meet at p = 1/2 +- i c."""
        self.trace(edited(CROSSING, "[[1, 0], [0, 2]]", "[[1, 0.003], [0.003, 2]]"))
        veering, = json.loads(self.run_well("events", "loci.h5", "--json"))
        self.assertEqual((veering["kind"], veering["modes"]), ("veering", "1;2"))
        self.assertAlmostEqual(veering["parameter"], 0.5, delta=1e-6)
        self.assertAlmostEqual(veering["half_width"], 0.003, delta=1e-6)

    def test_table_for_people_names_its_columns(self):
        self.trace(BIRTH)
        lines = self.run_well("events", "loci.h5").splitlines()
        self.assertRegex(lines[0], r"^ *kind +p +s +modes +remark$")
        self.assertRegex(lines[1], r"^ *collision +0\.9975 +-0\.05 \+ \S+j +\S.* +Puiseux coefficient ")
        self.assertRegex(lines[2], r"^ *divergence +1 +0 \+ 0j +1 +unstable above *$")
        self.assertEqual(len(lines), 3)

    def test_both_directions_find_the_same(self):
        self.trace(BIRTH, "--from", "1.5", "--to", "0")
        collision, divergence = self.events()
        self.assertEqual((collision["kind"], divergence["kind"]), ("collision", "divergence"))
        self.assertAlmostEqual(float(collision["parameter"]), 0.9975, delta=1e-12)
        self.assertAlmostEqual(float(divergence["parameter"]), 1.0, delta=1e-12)
        self.assertEqual((collision["modes"], divergence["modes"]), ("1;2", "1"))
        self.assertEqual([row[:2] for row in self.eval_rows("loci.h5", [0.5, 1.2])],  # mode 1 goes on as the pair
                         [(0.5, "mode 1"), (1.2, "mode 1"), (1.2, "mode 2")])

    def test_none_is_said_in_every_form(self):
        self.trace(FAMILY)
        self.assertEqual(self.run_well("events", "loci.h5"), "no special points between p = 0 and 1\n")
        self.assertEqual(self.run_well("events", "loci.h5", "--csv"), "kind,parameter,real,imag,modes\n")
        self.assertEqual(json.loads(self.run_well("events", "loci.h5", "--json")), [])

    def test_summary_and_info_point_to_them(self):
        self.write("scene.toml", BIRTH)
        summary = self.run_well("trace", "scene.toml", "-o", "loci.h5")
        self.assertRegex(summary, r"onset of instability\n +divergence +p = 1 .*\n +other special points\n +collision +p = 0\.9975 ")
        self.assertIn("2 special points; `eigentrail events` lists them", self.run_well("info", "loci.h5"))
        self.assertEqual(json.loads(self.run_well("info", "loci.h5", "--json"))["events"], 2)


class Notes(CommandTest):
    def test_a_path_that_turns_back_says_that_its_end_was_not_reached(self):
        # Two springs of length sqrt(5)/2 push the load up: over the fold at P = 4.29 there is no equilibrium near them.
        spring = f'[[spring]]\nfrom = [{{}}, 0, 0]\nto = "load"\nstiffness = 100\nfree_length = {5**0.5 / 2}\n'
        self.write("scene.toml", """[parameters]
P = 0
[trace]
parameter = "P"
from = 0
to = 8
[[point]]
name = "load"
mass = 1
position = [0, 0, 0.5]
[[fixed]]
point = "load"
coordinate = "x"
[[fixed]]
point = "load"
coordinate = "y"
[[force]]
point = "load"
components = [0, 0, "-P"]
[[drag]]
point = "load"
coefficient = 0.3
""" + spring.format(-1) + spring.format(1))
        summary = self.run_well("trace", "scene.toml", "-o", "loci.h5")
        self.assertIn("the path turned back, and the trace ended where it began: P = 8 was not reached", summary)
        self.assertRegex(summary, r"onset of instability\n +fold +P = 4\.29")
        self.assertNotIn("turned back", self.run_well("trace", "scene.toml", "--to", "4", "-o", "loci.h5", "--force"))


class Info(CommandTest):
    def test_for_people_names_status_sizes_range_and_counts(self):
        self.trace(BLADE)
        text = self.run_well("info", "loci.h5")
        for fragment in ["Blade", "schema 1", "run completed", "3 coordinates, 1 constraints, 2 modes",
                         "omega  100 -> 5 rad/s, tolerance 1e-06", "mode 2", "certified", "100 %",
                         "counts  certificate_bases", "equilibrium_factorizations"]:
            self.assertIn(fragment, text)

    def test_json_is_one_object_that_agrees_with_the_file(self):
        path = self.trace(BLADE)
        info = json.loads(self.run_well("info", "loci.h5", "--json"))
        with h5py.File(path) as file:
            self.assertEqual(info["nodes"], len(file["omega"]))
            self.assertEqual(set(info["attributes"]), set(file.attrs))
        self.assertEqual((info["parameter"], info["unit"], info["from"], info["to"]), ("omega", "rad/s", 100, 5))
        self.assertEqual(info["modes"], ["mode 1", "mode 2"])
        self.assertEqual(info["coordinates"], ["blade.x", "blade.y", "blade.z"])
        self.assertEqual(info["constraints"], ["rod 1"])
        self.assertEqual(info["certified_share"], {"mode 1": 1, "mode 2": 1})
        self.assertEqual(info["events"], 0)

    def test_stable_ranges_are_in_the_summary_in_info_and_in_its_json(self):
        self.write("scene.toml", BIRTH)
        line = r"\n  stable ranges\n +stable +p = 0 -> 1 +from start, mode 1, margin 0\.05 +to divergence, mode \d"
        self.assertRegex(self.run_well("trace", "scene.toml", "-o", "loci.h5"), line)
        self.assertRegex(self.run_well("info", "loci.h5"), line)
        [stable] = json.loads(self.run_well("info", "loci.h5", "--json"))["stable_ranges"]
        self.assertEqual((stable["kind"], stable["from"]["cause"], stable["to"]["cause"]),
                         ("stable", "start", "divergence"))
        self.assertAlmostEqual(stable["to"]["parameter"], 1.0, delta=1e-9)

    def test_stable_ranges_of_some_modes_are_those_of_the_whole_model(self):
        self.trace(CROSSING, "--modes", "1")
        self.assertIn("stable ranges\n    marginal  p = 0 -> 1  ", self.run_well("info", "loci.h5"))
        ranges = json.loads(self.run_well("info", "loci.h5", "--json"))["stable_ranges"]
        self.assertEqual([entry["whole_model"] for entry in ranges], [True])

    def test_what_is_known_of_the_followed_modes_only_says_so(self):
        self.trace(CROSSING, "--modes", "1")
        with h5py.File(self.folder / "loci.h5", "r+") as file:
            file["stable_whole"][:] = 0
        self.assertIn("    marginal among the followed modes  p = 0 -> 1  ", self.run_well("info", "loci.h5"))

    def test_no_stable_range_is_said(self):
        self.trace(BIRTH, "--from", "1.1")
        self.assertIn("stable ranges  none", self.run_well("info", "loci.h5"))

    def test_mode_that_does_not_exist_at_an_end_is_a_dash(self):
        self.trace(BIRTH)
        text = self.run_well("info", "loci.h5")
        self.assertRegex(text, r"\n +mode 2 +- +-0\.75887234 [+-] 0j +100 % ")

    def test_scene_comes_back_as_written(self):
        self.trace(BLADE)
        self.assertEqual(self.run_well("info", "loci.h5", "--scene"), BLADE)


class Explain(CommandTest):
    def test_active_and_absent_effects_are_told_apart(self):
        self.write("scene.toml", BLADE)
        text = self.run_well("explain", "scene.toml")
        effects = text[text.index("effects"):text.index("structure of")]
        active, absent = effects.split("absent, never evaluated: ")
        self.assertEqual(re.findall(r"^ +(\w+) +1  ", active, re.MULTILINE), ["point", "frame", "drag", "rod"])
        self.assertEqual(set(absent.strip().split(", ")), {
            "body", "gravity", "force", "follower_force", "transverse_force", "moment", "spring", "guided_spring",
            "torsional_spring", "damper", "torsional_damper", "maxwell_damper",
            "torsional_maxwell_damper", "internal_damping", "bearing", "spinning_disc",
            "blade_element", "beam", "beam_damping", "strips", "lift_lag", "apparent_mass", "inflow", "directors", "plane", "fixed", "ball", "revolute", "universal", "cylindrical", "prismatic",
            "weld", "point_on_line", "point_on_plane", "coupler", "gear"})

    def test_sizes_structure_and_solvers_follow(self):
        self.write("scene.toml", BLADE)
        text = self.run_well("explain", "scene.toml", "--order", "2")
        for fragment in ["2 freedoms: 3 coordinates, 1 constraint.",
                         "symmetric K", "KINSOL", "series of order 2", "Hermite interpolation of degree 5"]:
            self.assertIn(fragment, text)

    def test_whirls_of_an_isotropic_shaft_are_told(self):
        text = self.run_well("explain", str(SCENES / "two_disc_rotor.toml"))
        self.assertIn("parts 1 and 2 are a conjugate pair of complex parts, as forward and backward whirl", text)
        self.assertIn("LU of size 15 per mode", text)  # half of 28 freedoms, and one

    def test_order_that_is_not_given_is_chosen_and_told(self):
        self.write("scene.toml", BLADE)
        self.assertRegex(self.run_well("explain", "scene.toml"), r"series of order [1-4] \(auto\)")
        self.assertNotIn("(auto)", self.run_well("explain", "scene.toml", "--order", "2"))
        text = self.run_well("trace", "scene.toml", "--order", "auto", "-o", "auto.h5")
        order = re.search(r", (order [1-4] \(auto\)), ", text)[1]
        self.assertIn(order, self.run_well("info", "auto.h5"))

    def test_unsymmetric_mass_matrix_is_not_called_symmetric(self):
        self.write("scene.toml", edited(FAMILY, "M = [[[1, 0], [0, 1]]]", "M = [[[1, 0.5], [0, 1]]]"))
        run = self.run_program("explain", "scene.toml")
        self.assertNotRegex(run.stdout, r"mass +symmetric M")

    def test_scene_without_equilibrium_is_explained_and_refused(self):
        self.write("scene.toml", BLADE + '\n[[fixed]]\npoint = "blade"\ncoordinate = "x"\nvalue = 50\n')
        run = self.run_program("explain", "scene.toml")
        self.assertEqual(run.returncode, EXIT_BAD_INPUT)
        self.assertRegex(run.stderr, r"\Aeigentrail: scene\.toml: no equilibrium found: [^\n]*\n\Z")
        self.assertIn("effects", run.stdout)


class Help(CommandTest):
    def commands(self):
        listed = self.run_well("--help").split("Subcommands:\n")[1]
        return re.findall(r"^  (\w+) ", listed, re.MULTILINE)

    def test_no_line_is_wider_than_a_terminal(self):
        formats = re.findall(r"^  ([\w-]+) ", self.run_well("import", "--help").split("Subcommands:\n")[1].split("\n\n")[0], re.MULTILINE)
        self.assertGreaterEqual(len(formats), 4)
        for command in [[], *([name] for name in self.commands()), *(["import", name] for name in formats)]:
            with self.subTest(command):
                text = self.run_well(*command, "--help")
                self.assertEqual([line for line in text.splitlines() if len(line) > 80], [])
                self.assertNotIn("  \\\n", text)

    def test_every_command_has_an_example_and_a_section_of_the_documentation(self):
        sections = (SCENES.parent.parent / "docs" / "commands.md").read_text(encoding="utf-8")
        self.assertGreaterEqual(len(self.commands()), 12)
        for command in self.commands():
            with self.subTest(command):
                self.assertRegex(self.run_well(command, "--help"), rf"Examples?:\n  eigentrail {command}\b")
                self.assertIn(f"\n## {command}\n", sections)


if __name__ == "__main__":
    unittest.main()
