"""The contract of the commands: what they print, write and return."""

import csv
import io
import json
import math
import re
import unittest

import h5py
import numpy as np

from program import BIRTH, BLADE, CROSSING, EXIT_BAD_INPUT, EXIT_NUMBERS_FAILED, FAMILY, SCENES, ProgramTest, edited

COMMANDS = ["trace", "eval", "events", "info", "explain"]
DEFAULT_TOLERANCE = 1e-6


def blade_eigenvalues(omega):
    """Lag and flap of BLADE: s^2 + (drag/mass) s + omega^2 {e, 1 + e} = 0 with e = offset/length = 1/5."""
    decay = 0.5 * 2.0 / 50.0
    return np.array([complex(-decay, math.sqrt(omega**2 * ratio - decay**2)) for ratio in (0.2, 1.2)])


class CommandTest(ProgramTest):
    def trace(self, scene, *options, output="loci.h5"):
        """Traces a scene given as text; returns the path of the loci file."""
        self.write("scene.toml", scene)
        self.run_well("trace", "scene.toml", "-o", output, "--quiet", *options)
        return self.folder / output

    def eval_rows(self, file, places):
        text = self.run_well("eval", file, "--csv", "--at", *map(repr, map(float, places)))
        return [(float(row["parameter"]), row["mode"], complex(float(row["real"]), float(row["imag"])))
                for row in csv.DictReader(io.StringIO(text))]

    def eval_at(self, file, places):
        """Eigenvalues, places x modes."""
        return np.array([s for _, _, s in self.eval_rows(file, places)]).reshape(len(places), -1)

    def assert_within(self, actual, expected, tolerance, reference=0.0):
        bound = tolerance * np.maximum(np.abs(expected), reference)
        np.testing.assert_array_less(np.abs(actual - expected), bound)


class Program(CommandTest):
    def test_version_names_the_program_and_a_number(self):
        self.assertRegex(self.run_well("--version"), r"^eigentrail \d+\.\d+\.\d+\n$")

    def test_help_names_every_command_and_the_exit_codes(self):
        text = self.run_well("--help")
        for fragment in [*COMMANDS, "Exit codes"]:
            self.assertIn(fragment, text)

    def test_help_of_every_command_has_an_example(self):
        for command in COMMANDS:
            with self.subTest(command):
                self.assertIn(f"  eigentrail {command} ", self.run_well(command, "--help").split("Example")[1])


class Eval(CommandTest):
    def test_csv_has_the_promised_header_and_a_row_per_place_and_mode(self):
        self.trace(BLADE)
        lines = self.run_well("eval", "loci.h5", "--at", "50", "7.5", "--csv").splitlines()
        self.assertEqual(lines[0], "parameter,mode,real,imag")
        self.assertEqual([line.split(",")[:2] for line in lines[1:]],
                         [["50", "mode 1"], ["50", "mode 2"], ["7.5", "mode 1"], ["7.5", "mode 2"]])

    def test_json_holds_the_numbers_of_the_csv(self):
        self.trace(BLADE)
        rows = json.loads(self.run_well("eval", "loci.h5", "--at", "50", "7.5", "--json"))
        self.assertEqual([list(row) for row in rows], [["parameter", "mode", "real", "imag"]] * 4)
        self.assertEqual([(row["parameter"], row["mode"], complex(row["real"], row["imag"])) for row in rows],
                         self.eval_rows("loci.h5", [50, 7.5]))

    def test_table_for_people_names_its_columns(self):
        self.trace(BLADE)
        lines = self.run_well("eval", "loci.h5", "--at", "50").splitlines()
        self.assertRegex(lines[0], r"omega +mode +s +frequency +damping ratio")
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
        self.assertIn("1", collision["modes"].split(";"))
        self.assertEqual(divergence["modes"], "1")

    def test_csv_is_what_the_file_holds(self):
        for scene in (BIRTH, CROSSING, BLADE):
            with h5py.File(self.trace(scene, "--force")) as file:
                self.assertEqual(self.run_well("events", "loci.h5", "--csv").splitlines()[1:],
                                 file["events"].asstr()[:].tolist())

    def test_json_holds_the_numbers_of_the_csv(self):
        self.trace(BIRTH)
        rows = json.loads(self.run_well("events", "loci.h5", "--json"))
        keys = ["kind", "parameter", "real", "imag", "modes"]
        self.assertEqual([{
key: str(row[key]) for key in ("kind", "modes")} for row in rows],
                         [{
key: row[key] for key in ("kind", "modes")} for row in self.events()])
        for key in ("parameter", "real", "imag"):
            self.assertEqual([row[key] for row in rows], [float(row[key]) for row in self.events()])
        self.assertEqual([list(row) for row in rows], [keys + ["puiseux"], keys])

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
        self.assertRegex(lines[2], r"^ *divergence +1 +0 \+ 0j +1 *$")
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
        self.assertRegex(summary, r"special points\n +collision +p = 0\.9975 .*\n +divergence +p = 1 ")
        self.assertIn("2 special points; `eigentrail events` lists them", self.run_well("info", "loci.h5"))
        self.assertEqual(json.loads(self.run_well("info", "loci.h5", "--json"))["events"], 2)


class Info(CommandTest):
    def test_for_people_names_status_sizes_range_and_counts(self):
        self.trace(BLADE)
        text = self.run_well("info", "loci.h5")
        for fragment in ["Blade", "schema 1", "run completed", "3 coordinates, 1 constraints, 2 modes",
                         "omega  100 -> 5 rad/s, tolerance 1e-06", "mode 2", "certified", "100 %",
                         "counts  certificate_factorizations", "equilibrium_factorizations"]:
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
        effects = text[text.index("effects"):text.index("sizes")]
        active, absent = effects.split("absent, never evaluated: ")
        self.assertEqual(re.findall(r"^ +(\w+) +1  ", active, re.MULTILINE), ["point", "frame", "drag", "rod"])
        self.assertEqual(set(absent.strip().split(", ")), {
            "gravity", "force", "follower_force", "transverse_force", "spring", "guided_spring", "plane", "fixed"})

    def test_sizes_structure_and_solvers_follow(self):
        self.write("scene.toml", BLADE)
        text = self.run_well("explain", "scene.toml", "--order", "2")
        for fragment in ["3 coordinates, 1 constraints, 0 of them redundant, 2 freedoms",
                         "symmetric K", "KINSOL", "series of order 2", "Hermite interpolation of degree 5"]:
            self.assertIn(fragment, text)

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


class Trace(CommandTest):
    def test_every_scene_of_the_project_is_explained_and_traced(self):
        scenes = sorted(SCENES.glob("*.toml"))
        self.assertTrue(scenes)
        for scene in scenes:
            with self.subTest(scene.name):
                self.assertIn("effects", self.run_well("explain", scene))
                self.assertIn(f"wrote {scene.stem}.h5\n", self.run_well("trace", scene, "-o", f"{scene.stem}.h5"))

    def test_summary_counts_every_active_effect_and_no_absent_one(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene.name):
                summary = self.run_well("trace", scene, "-o", f"{scene.stem}.h5")
                evaluations = re.search(r"^ +evaluations +(.*)$", summary, re.MULTILINE)[1]
                counted = [entry.split()[0] for entry in evaluations.split(", ")]
                explained = self.run_well("explain", scene)
                effects, absent = explained[:explained.index("sizes")].split("absent, never evaluated: ")
                active = re.findall(r"^ +(\w+) +\d+  ", effects[effects.index("effects"):], re.MULTILINE)
                self.assertEqual(counted, active)
                self.assertFalse(set(counted) & set(absent.strip().split(", ")))

    def test_quiet_prints_nothing(self):
        self.write("scene.toml", BLADE)
        self.assertEqual(self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet"), "")

    def test_force_replaces_the_output(self):
        path = self.trace(BLADE)
        self.trace(BLADE, "--force", "--tolerance", "1e-9")
        with h5py.File(path) as file:
            self.assertEqual(file.attrs["tolerance"], 1e-9)

    def test_a_second_run_gives_the_same_numbers(self):
        with h5py.File(self.trace(BLADE)) as one, h5py.File(self.trace(BLADE, output="two.h5")) as two:
            for name in ["omega", "eigenvalue", "dense_output", "certified", "mode_shape", "equilibrium"]:
                np.testing.assert_array_equal(one[name][:], two[name][:])

    def test_up_and_down_agree_within_the_tolerance(self):
# At 5 rad / s, where the scene's own range ends, its guess leads to another equilibrium.
        scene = (SCENES / "rotating_mass.toml").read_text(encoding="utf-8")
        self.trace(scene, "--from", "100", "--to", "10", output="down.h5")
        self.trace(scene, "--from", "10", "--to", "100", output="up.h5")
        places = np.linspace(10.0, 100.0, 91)
        self.assert_within(self.eval_at("up.h5", places), self.eval_at("down.h5", places),
                           2.0 * 1e-8)  # each may err by the tolerance of the scene

    def test_options_override_the_scene(self):
        path = self.trace(BLADE, "--from", "20", "--to", "30", "--tolerance", "1e-9", "--modes", "1", "--order", "2",
                          "--max-step", "0.5")
        with h5py.File(path) as file:
            p = file["omega"][:]
            self.assertEqual((p[0], p[-1]), (20.0, 30.0))
            self.assertLessEqual(np.max(np.diff(p)), 0.5 * (1.0 + 1e-12))
            self.assertEqual(file["eigenvalue"].shape, (len(p), 1))
            self.assertEqual(file["dense_output"].shape, (len(p) - 1, 1, 2, 3))
            self.assertEqual(file["step_parameter"].shape, (len(p) - 1, 2, 3))
            self.assertEqual(file.attrs["tolerance"], 1e-9)
            for key, text in {"from": "20", "to": "30", "modes": "1", "order": "2", "max_step": "0.5"}.items():
                self.assertEqual(file.attrs["option_" + key], text)
            self.assert_within(file["eigenvalue"][:, 0], [blade_eigenvalues(omega)[0] for omega in p], 1e-9)

    def test_another_parameter_can_be_traced(self):
        path = self.trace(BLADE, "--parameter", "mass", "--from", "10", "--to", "20")
        with h5py.File(path) as file:
            self.assertEqual(file["mass"][-1], 20.0)
            self.assertNotIn("omega", file)

    def test_end_of_the_range_may_be_an_expression(self):
        with h5py.File(self.trace(BLADE, "--to", "5 * drag")) as file:
            self.assertEqual(file["omega"][-1], 10.0)

    def test_rpm_and_radians_per_second_give_the_same_eigenvalues(self):
        rpm = 60.0 / (2.0 * math.pi)
        scene = edited(BLADE, '40.0, unit = "rad/s"', f'{40.0 * rpm!r}, unit = "rpm"')
        path = self.trace(scene, "--from", repr(100.0 * rpm), "--to", repr(5.0 * rpm), output="rpm.h5")
        self.trace(BLADE, output="radians.h5")
        places = np.linspace(5.5, 99.5, 23)
        self.assert_within(self.eval_at("rpm.h5", places * rpm), self.eval_at("radians.h5", places),
                           2.0 * DEFAULT_TOLERANCE)  # each may err by the tolerance
        with h5py.File(path) as file:
            self.assertEqual(file["omega"].attrs["units"], "rpm")
            slope = math.sqrt(0.2) / rpm  # d|s|/d(omega in rpm), up to the small damping
            self.assertAlmostEqual(abs(file["eigenvalue_derivative"][0, 0]) / slope, 1.0, places=6)



class TraceWithoutCertificate(CommandTest):
    def trace_loudly(self, scene, *options):
        self.write("scene.toml", scene)
        return self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force", *options)

    def check(self, scene, *options):
        summary = self.trace_loudly(scene, *options)
        self.assertIn("  identity  not certified (--no-certify)\n", summary)
        self.assertNotIn("certified on every step", summary)
        with h5py.File(self.folder / "loci.h5") as file:
            certified, exists = file["certified"][:], file["mode_block"][:] >= 0
            np.testing.assert_array_equal(certified, np.where(exists, 0, -1))
            self.assertTrue(np.any(exists))
            self.assertEqual(file.attrs["option_certify"], "false")
            self.assertEqual(file.attrs["count_certified_mode_steps"], 0)
            self.assertEqual(file.attrs["count_certificate_factorizations"], 0)
        info = json.loads(self.run_well("info", "loci.h5", "--json"))
        self.assertEqual(info["certified_share"], {
mode: 0 for mode in info["modes"]})
        self.assertIn("identity of mode 1 not certified from ", self.run_well("info", "loci.h5"))

    def test_everything_is_marked_uncertified(self):
        for scene in (BLADE, FAMILY, BIRTH, CROSSING):
            self.check(scene, "--no-certify")

    def test_the_scene_can_ask_for_it(self):
        self.check(edited(BLADE, "to = 5.0", "to = 5.0\ncertify = false"))

    def test_the_numbers_keep_their_tolerance(self):
        self.trace(BLADE, "--no-certify")
        places = np.linspace(5.0, 100.0, 137)
        self.assert_within(self.eval_at("loci.h5", places), np.array([blade_eigenvalues(omega) for omega in places]),
                           DEFAULT_TOLERANCE)

    def test_without_the_flag_everything_here_is_certified(self):
        for scene in (BLADE, FAMILY, BIRTH, CROSSING):
            self.assertIn("  identity  certified on every step\n", self.trace_loudly(scene))
            with h5py.File(self.folder / "loci.h5") as file:
                np.testing.assert_array_equal(file["certified"][:], np.where(file["mode_block"][:] >= 0, 1, -1))
                self.assertEqual(file.attrs["option_certify"], "true")
            self.assertNotIn("not certified", self.run_well("info", "loci.h5"))


class TraceOfAFamily(CommandTest):
    def test_matrices_in_hdf5_equal_those_in_the_scene(self):
        expected_file = self.trace(FAMILY)
        scenes = self.folder / "scenes"
        (scenes / "data").mkdir(parents=True)
        with h5py.File(scenes / "data" / "m.h5", "w") as file:
            file["M/0"] = np.eye(2)
            file["K/0"] = np.diag([1.0, 2.0])
            file["K/1"] = [[0, 1], [1, 0]]  # whole numbers are read as well
        (scenes / "family.toml").write_text(FAMILY[:FAMILY.index("M =")] + 'file = "data/m.h5"\n', encoding="utf-8")
        self.run_well("trace", "scenes/family.toml", "-o", "from_hdf5.h5", "--quiet")
        with h5py.File(expected_file) as expected, h5py.File(self.folder / "from_hdf5.h5") as actual:
            for name in ["p", "eigenvalue", "dense_output", "mode_shape"]:
                np.testing.assert_array_equal(actual[name][:], expected[name][:])

    def test_system_without_mass_is_followed(self):
        """s + K = 0 with K = [[1, p], [p, 2]]: s = -3/2 +- sqrt(1/4 + p^2)."""
        massless = "M = [[[0, 0], [0, 0]]]\nC = [[[1, 0], [0, 1]]]"
        self.trace(edited(FAMILY, "M = [[[1, 0], [0, 1]]]", massless))
        places = np.linspace(0.0, 1.0, 11)
        root = np.sqrt(0.25 + places**2)
        self.assert_within(self.eval_at("loci.h5", places), np.column_stack([root - 1.5, -root - 1.5]),
                           DEFAULT_TOLERANCE)


class TraceThatEndsEarly(CommandTest):
    def check(self, run, message):
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
        self.assertRegex(run.stderr, rf"\Aeigentrail: {message}[^\n]*; the points before it are in loci\.h5\n\Z")
        self.assertIn("ended early", self.run_well("info", "loci.h5"))
        self.assertFalse((self.folder / "loci.h5.partial").exists())

    def test_at_the_bound_on_points_they_are_kept(self):
        self.write("scene.toml", BLADE)
        self.check(self.run_program("trace", "scene.toml", "-o", "loci.h5", "--max-nodes", "3"),
                   "stopped after 3 points")
        with h5py.File(self.folder / "loci.h5") as file:
            p, s = file["omega"][:], file["eigenvalue"][:]
        self.assertEqual(len(p), 3)
        np.testing.assert_array_equal(self.eval_at("loci.h5", p), s)
        self.assertEqual(self.run_program("eval", "loci.h5", "--at", "5").returncode, EXIT_BAD_INPUT)

    def test_at_a_pitchfork_the_path_stays_on_its_branch(self):
        """The spring pendulum's branch reaches its pitchfork at k = mass g / length = 13.08 N/m and runs back."""
        self.run_well("trace", SCENES / "spring_pendulum.toml", "-o", "loci.h5", "--to", "10", "--quiet")
        events = list(csv.DictReader(io.StringIO(self.run_well("events", "loci.h5", "--csv"))))
        self.assertIn("pitchfork", [event["kind"] for event in events])
        for event in events:
            self.assertAlmostEqual(float(event["parameter"]), 13.08, places=6)
        k = 20.0
        expected = math.sqrt(k / 2.0) * math.sqrt(1.0 - (13.08 / k) ** 2)
        rows = list(csv.DictReader(io.StringIO(self.run_well("eval", "loci.h5", "--at", k, "--csv"))))
        self.assertGreaterEqual(len(rows), 1)
        for row in rows:
            self.assertAlmostEqual(float(row["imag"]), expected, places=7)

    def test_at_a_pitchfork_another_branch_can_be_taken(self):
        """On from the pitchfork straight down, where s^2 = -(m g / l - k) / m; the run says what there was to choose."""
        run = self.run_program("trace", SCENES / "spring_pendulum.toml", "-o", "loci.h5", "--to", "10", "--branch", "2")
        self.assertEqual(run.returncode, 0, run.stderr)
        for text in ("branch 1 is straight on", "branch 2 leaves it (k falls)", "branch 3", "the trace took 2"):
            self.assertIn(text, run.stdout)
        events = list(csv.DictReader(io.StringIO(self.run_well("events", "loci.h5", "--csv"))))
        self.assertEqual([event["kind"] for event in events], ["pitchfork"])
        self.assertAlmostEqual(float(events[0]["parameter"]), 13.08, places=11)
        stiffness = {20.0: (20.0 - 13.08) * (20.0 + 13.08) / 40.0, 13.09: 0.01 * 26.17 / 26.18,
                     13.07: 0.005, 11.0: 1.04}
        for k, expected in stiffness.items():
            rows = list(csv.DictReader(io.StringIO(self.run_well("eval", "loci.h5", "--at", k, "--csv"))))
            self.assertEqual(len(rows), 1)
            self.assertAlmostEqual(float(rows[0]["imag"]), math.sqrt(expected), places=7)
        at_branch_point = self.run_well("eval", "loci.h5", "--at", float(events[0]["parameter"]), "--csv")
        for row in csv.DictReader(io.StringIO(at_branch_point)):
            self.assertAlmostEqual(float(row["imag"]), 0.0, places=6)


if __name__ == "__main__":
    unittest.main()
