"""`eigentrail trace`: its options, its summary, its file, and traces that end early."""

import csv
import io
import json
import math
import os
import re
import subprocess
import sys
import unittest
import unittest.mock

import h5py
import numpy as np

from command_test_case import DEFAULT_TOLERANCE, CommandTest, blade_eigenvalues
from program import BIRTH, BLADE, CROSSING, EXIT_BAD_INPUT, EXIT_NUMBERS_FAILED, FAMILY, OTHER_KERNEL, SCENES, edited

# Of two oscillators one is followed; the other one grows from p = damping / 0.2 on.
UNFOLLOWED = """
[trace]
parameter = "p"
from = 0
to = {to}
modes = 1
[matrix_family]
M = [[[1, 0], [0, 1]]]
C = [[[0.1, 0], [0, {damping}]], [[0, 0], [0, -0.2]]]
K = [[[1, 0], [0, 4]], [[0.1, 0], [0, 0]]]
"""


class Trace(CommandTest):
    def test_every_scene_of_the_project_is_traced_and_counts_every_active_effect_and_no_absent_one(self):
        scenes = sorted(SCENES.glob("*.toml"))
        self.assertTrue(scenes)
        for scene in scenes:
            with self.subTest(scene.name):
                summary = self.run_well("trace", scene, "--tolerance", "1e-2", "--no-certify", "--verbose", "-o", f"{scene.stem}.h5")
                self.assertIn(f"wrote {scene.stem}.h5; next: ", summary)
                evaluations = re.search(r"^ +evaluations +(.*)$", summary, re.MULTILINE)[1]
                self.assertNotRegex(evaluations, r" 0\b")
                counted = [entry.split()[0] for entry in evaluations.split(", ")]
                explained = self.run_well("explain", scene)
                effects, _, absent = explained[:explained.index("structure of")].partition("absent, never evaluated: ")
                active = re.findall(r"^ +(\w+) +\d+  ", effects[effects.index("effects"):], re.MULTILINE)
                self.assertEqual(counted, active)
                self.assertFalse(set(counted) & set(absent.strip().split(", ")))

    def test_blade_in_air_evaluates_its_parts_equally_often_and_nothing_else(self):
        """Twenty elements, two strips on each, and one inflow; lag of lift, gravity, springs ... are not in the scene."""
        writer = SCENES.parents[1] / "tests" / "bench" / "blade_in_air.py"
        for lag in ([], ["--lag"]):
            with self.subTest(lag):
                self.write("blade.toml", subprocess.run([sys.executable, writer, "--nodes", "2", *lag], check=True, capture_output=True, text=True).stdout)
                summary = self.run_well("trace", "blade.toml", "--to", "10.1", "--modes", "2", "--tolerance", "1e-3", "--no-certify", "--verbose", "-o", "blade.h5", "--force")
                entries = re.search(r"^ +evaluations +(.*)$", summary, re.MULTILINE)[1].split(", ")
                counts = {name: int(count) for name, count in (entry.split() for entry in entries)}
                passes = counts["inflow"]
                self.assertGreater(passes, 0)
                parts = {"body": 21, "frame": 21, "beam": 20, "strips": 40, "inflow": 1, "directors": 21, "weld": 1}
                if lag:
                    parts["lift_lag"] = 40
                self.assertEqual(counts, {name: number * passes for name, number in parts.items()})

    def test_veerings_are_listed_unless_the_scene_does_without(self):
        def events(scene):
            self.trace(scene, "--force")
            return list(csv.DictReader(io.StringIO(self.run_well("events", "loci.h5", "--csv"))))

        for coupling in (3e-3, 1e-6):  # half the width of the veering; the second one is met by the trace itself
            with self.subTest(coupling):
                scene = CROSSING.replace("K = [[[1, 0], [0, 2]]", f"K = [[[1, {coupling}], [{coupling}, 2]]")
                veering, = events(scene)
                self.assertEqual(veering["kind"], "veering")
                self.assertAlmostEqual(float(veering["parameter"]), 0.5, delta=1e-9)
                self.assertEqual(events(scene + "[events]\nveerings = false\n"), [])

    def test_mode_that_grows_on_the_first_step_is_followed_from_the_first_point_on(self):
        """s^2 + (0.1 - 0.2 p) s + 4 = 0 is none of the modes asked for; it grows from p = 1/2 on, or from the start."""
        for damping in (0.1, 0.0):
            with self.subTest(damping):
                self.trace(UNFOLLOWED.format(damping=damping, to=10.3), "--force")
                s = self.eval_at("loci.h5", [0.0])[0]
                np.testing.assert_allclose(s, [-0.05 + 1j * math.sqrt(1.0 - 0.0025), -damping / 2 + 1j * math.sqrt(4.0 - damping**2 / 4)],
                                           rtol=1e-12)
                with h5py.File(self.folder / "loci.h5") as file:
                    self.assertFalse(np.isnan(file["eigenvalue"][:]).any())
                for command in (["info"], ["events"], ["verify"], ["report", "-o", "page.html", "--force"]):
                    self.run_well(command[0], "loci.h5", *command[1:])

    def test_flutter_of_an_unfollowed_mode_exactly_at_a_point_is_an_event(self):
        self.trace(UNFOLLOWED.format(damping=0.1, to=10), "--force")
        with h5py.File(self.folder / "loci.h5") as file:
            self.assertIn(0.5, file["p"])  # a mode that is zero there is not followed yet
            self.assertEqual([line.split(",")[0] for line in file["events"].asstr()], ["flutter"])
            np.testing.assert_allclose(file["event_parameter"], [0.5], rtol=1e-12)

    def test_critical_speeds_near_an_operating_range_are_named(self):
        scene = edited((SCENES / "overhung_disc.toml").read_text(encoding="utf-8"), 'excitation = "omega"', "operating_range = [400, 520]\n§")
        near = "critical speed 2x at omega = 557.174: 7.15 % from the operating range 400 to 520, {} % wanted"
        for margin, expected in (("separation_margin = 0.15", near.format(15)), ("", near.format(26)),
                                 ("separation_margin = 0.07", "all critical speeds keep their distance from the operating range 400 to 520 (7 %)")):
            with self.subTest(margin):
                self.write("scene.toml", scene.replace("§", margin))
                lines = [line for line in self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force").splitlines() if "margin  " in line and "oper" in line]
                self.assertEqual(lines, ["  margin  " + expected])
        self.write("scene.toml", scene.replace("[400, 520]", "[400, 600]").replace("§", ""))
        self.assertIn("critical speed 2x at omega = 557.174: in the operating range 400 to 600\n", self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force"))

    def test_operating_ranges_may_have_units(self):
        scene = (SCENES / "two_disc_rotor.toml").read_text(encoding="utf-8")
        given = [self.margins(scene, text) for text in ('[2400, 3000]', '["40 Hz", "3000 rpm"]', '[["40 rev/s", 3000]]')]
        self.assertIn("operating range 2400 to 3000", given[0])
        self.assertEqual(given, given[:1] * 3)
        self.write("scene.toml", self.with_range(scene, '["40 N", 3000]'))
        self.assert_refused(self.run_program("trace", "scene.toml"), ["operating_range: 40 N does not fit", "which is in rpm"])

    def with_range(self, scene, text):
        return edited(scene, "[events]\n", f"[events]\noperating_range = {text}\n")

    def margins(self, scene, text):
        self.write("scene.toml", self.with_range(scene, text))
        summary = self.run_well("trace", "scene.toml", "--force")
        return "\n".join(line for line in summary.splitlines() if line.startswith("  margin"))

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

    def test_another_parameter_does_not_have_the_range_of_the_scene(self):
        """In rad/s, where that of the mass is in kg."""
        self.write("scene.toml", BLADE)
        for given in ((), ("--from", "10"), ("--to", "60")):
            with self.subTest(given):
                run = self.run_program("trace", "scene.toml", "--parameter", "mass", *given)
                self.assert_refused(run, ["[trace]", "is missing", "--"])
        self.assertIn("mass = 50\n", self.run_well("spectrum", "scene.toml", "--parameter", "mass"))

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
        self.assertIn("identity of modes not certified (--no-certify)\n", summary)
        self.assertNotIn("certified on every step", summary)
        with h5py.File(self.folder / "loci.h5") as file:
            certified, exists = file["certified"][:], file["mode_block"][:] >= 0
            np.testing.assert_array_equal(certified, np.where(exists, 0, -1))
            self.assertTrue(np.any(exists))
            self.assertEqual(file.attrs["option_certify"], "false")
            self.assertEqual(file.attrs["count_certified_mode_steps"], 0)
            self.assertEqual(file.attrs["count_certificate_factorizations"], 0)
        info = json.loads(self.run_well("info", "loci.h5", "--json"))
        self.assertEqual(info["certified_share"], {mode: 0 for mode in info["modes"]})
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
            self.assertIn("identity of modes certified on every step\n", self.trace_loudly(scene))
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


class TraceWithOtherRounding(CommandTest):
    # Coleman's equations of ground resonance (Hammond 1974), undamped: pairs meet on the imaginary axis.
    SCENE = """[trace]
parameter = "p"
from = 40
to = 5
tolerance = 1e-4
order = 3
first_step = 0.035
[matrix_family]
M = [[[800, 0, 0, -65], [0, 800, 65, 0], [0, 130, 576, 0], [-130, 0, 0, 251]]]
C = [[[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]], [[0, 1600, 0, 0], [-1600, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]]
K = [[[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 85000, 0], [0, 0, 0, 85000]], [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
     [[-735, 0, 0, 0], [0, -735, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]]
"""

    def test_collisions_on_the_axis_are_no_flutter_whatever_the_kernel_of_blas(self):
        self.write("scene.toml", self.SCENE)
        for kernel in ("Prescott", OTHER_KERNEL, ""):
            with self.subTest(kernel), unittest.mock.patch.dict(os.environ, OPENBLAS_CORETYPE=kernel):
                self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force", "--quiet")
                events = list(csv.DictReader(io.StringIO(self.run_well("events", "loci.h5", "--csv"))))
                self.assertEqual([event["kind"] for event in events], 4 * ["collision"])


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
        self.assertIn("branch_point", [event["kind"] for event in events])
        for event in events:
            self.assertAlmostEqual(float(event["parameter"]), 13.08, places=6)
        k = 20.0
        expected = math.sqrt(k / 2.0) * math.sqrt(1.0 - (13.08 / k) ** 2)
        rows = list(csv.DictReader(io.StringIO(self.run_well("eval", "loci.h5", "--at", k, "--csv"))))
        self.assertGreaterEqual(len(rows), 1)
        for row in rows:
            self.assertAlmostEqual(float(row["imag"]), expected, places=7)

    def test_at_a_pitchfork_another_branch_can_be_taken(self):
        """From the pitchfork on the straight path, s^2 = -(m g / l - k) / m. The output lists the paths to choose from."""
        run = self.run_program("trace", SCENES / "spring_pendulum.toml", "-o", "loci.h5", "--to", "10", "--branch", "2")
        self.assertEqual(run.returncode, 0, run.stderr)
        for text in ("branch 1 is straight on", "branch 2 leaves it (k falls)", "branch 3", "the trace took 2"):
            self.assertIn(text, run.stdout)
        events = list(csv.DictReader(io.StringIO(self.run_well("events", "loci.h5", "--csv"))))
        self.assertEqual([event["kind"] for event in events], ["branch_point"])
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
