"""`eigentrail sweep`: its loci files and index, runs that fail, parts, and bad input."""

import csv
import unittest

from command_test_case import CommandTest
from loci_comparison import differences
from program import BLADE, EXIT_DONE, EXIT_NUMBERS_FAILED, FAMILY, PUSHED_PENDULUM, SCENES, ProgramTest, each_case, edited

SWEEP = ("sweep", "scene.toml", "--vary", "drag=1,2,5", "--vary", "length=4:0.5:5")

# s^2 + (c - p) s + k = 0: flutter at p = c, least damping (c - 2) / (2 sqrt(k)) at p = 2; k = 1 - p/d: divergence at p = d.
OSCILLATOR = """\
[parameters]
p = 0.0
c = 1.0
d = 9.0

[trace]
parameter = "p"
from = 0
to = 2

[matrix_family]
M = [[[1]]]
C = [[["c - p"]]]
K = [[["1 - p/d"]]]
"""

ZIEGLER = """\
[parameters]
p = 0.0
k = 1.0

[trace]
parameter = "p"
from = 0
to = 5

[matrix_family]
M = [[[3, 1], [1, 1]]]
K = [[["2 * k - p", "p - k"], ["-k", "k"]]]
"""


class Sweep(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", BLADE)

    def index(self, name="out/index.csv"):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_every_run_is_the_trace_with_these_values(self):
        self.assertEqual(self.run_well(*SWEEP, "-o", "out"), "wrote out/index.csv: 9 runs, 0 of them failed\n")
        rows = self.index()
        self.assertEqual([(float(row["drag"]), float(row["length"])) for row in rows],
                         [(drag, length) for drag in (1, 2, 5) for length in (4, 4.5, 5)])
        self.assertEqual([row["file"] for row in rows], [f"run_{i:03}.h5" for i in range(1, 10)])
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()},
                         {"index.csv", *(row["file"] for row in rows)})
        for row in rows[::4]:
            self.run_well("trace", "scene.toml", "--set", f"drag={row['drag']}", "--set", f"length={row['length']}",
                          "-o", "one.h5", "--force", "--quiet")
            self.assertEqual(differences(self.folder / "one.h5", self.folder / "out" / row["file"]), [])
            self.assertEqual(int(row["points"]), len(self.open("one.h5")["omega"]))

    def test_index_has_final_values(self):
        self.write("scene.toml", OSCILLATOR)
        self.run_well("sweep", "scene.toml", "--vary", "c=0.5,1,3", "-o", "out", "--quiet")
        rows = self.index()
        self.assertEqual(list(rows[0]), ["run", "file", "c", "exit", "points", "reached", "flutter", "divergence",
                                         "least_damping", "least_damping_at", "reason"])
        self.assertEqual([(row["exit"], row["reached"], row["divergence"], row["reason"]) for row in rows],
                         [("0", "2", "", "")] * 3)
        self.assertEqual(rows[2]["flutter"], "")
        for row, c in zip(rows, (0.5, 1.0, 3.0)):
            if row["flutter"]:
                self.assertAlmostEqual(float(row["flutter"]), c, 9)
            self.assertAlmostEqual(float(row["least_damping"]), (c - 2) / 2 / (1 - 2 / 9) ** 0.5, 6)
            self.assertEqual(float(row["least_damping_at"]), 2)
        self.run_well("sweep", "scene.toml", "--vary", "d=1,1.5,5", "--set", "c=3", "-o", "out", "--quiet", "--force")
        self.assertEqual([row["divergence"] != "" for row in self.index()], [True, True, False])
        for row in self.index()[:2]:
            self.assertAlmostEqual(float(row["divergence"]), float(row["d"]), 9)

    def test_index_has_onsets_of_undamped_systems(self):
        # s^2 + 1 - p/d = 0: divergence at p = d.
        self.write("scene.toml", OSCILLATOR.replace('C = [[["c - p"]]]', "C = [[[0]]]"))
        self.run_well("sweep", "scene.toml", "--vary", "d=1,1.5", "-o", "out", "--quiet")
        for row in self.index():
            self.assertEqual(row["flutter"], "")
            self.assertAlmostEqual(float(row["divergence"]), float(row["d"]), 9)
        # Follower force on two links (M = [[3, 1], [1, 1]], K = [[2 - p, p - 1], [-1, 1]]): flutter at 7/2 - sqrt(2).
        self.write("scene.toml", ZIEGLER)
        self.run_well("sweep", "scene.toml", "--vary", "k=1,2", "-o", "links", "--quiet")
        for row in self.index("links/index.csv"):
            self.assertEqual(row["divergence"], "")
            self.assertAlmostEqual(float(row["flutter"]), float(row["k"]) * (3.5 - 2 ** 0.5), 9)
        # A pendulum on a hinge that turns about the vertical leaves it at sqrt(g / length).
        pendulum = (SCENES / "whirling_pendulum.toml").read_text(encoding="utf-8")
        self.write("scene.toml", edited(pendulum, "branch = 2", "branch = 1"))
        self.run_well("sweep", "scene.toml", "--vary", "length=0.5,0.6", "-o", "pendulum", "--quiet")
        for row in self.index("pendulum/index.csv"):
            self.assertAlmostEqual(float(row["divergence"]), ((9.81 / float(row["length"]))) ** 0.5, 9)

    def test_number_of_threads_does_not_matter(self):
        self.run_well(*SWEEP, "-o", "out", "--jobs", "1", "--quiet")
        self.run_well(*SWEEP, "-o", "more", "--jobs", "4", "--quiet")
        for i in range(1, 10):
            self.assertEqual(differences(self.folder / f"out/run_{i:03}.h5", self.folder / f"more/run_{i:03}.h5"), [])
        self.assertEqual((self.folder / "out/index.csv").read_bytes(), (self.folder / "more/index.csv").read_bytes())

    def test_run_that_fails_is_listed_and_stops_no_other(self):
        run = self.run_program("sweep", "scene.toml", "--vary", "mass=-1,50", "-o", "out")
        self.assertEqual((run.returncode, run.stdout), (EXIT_NUMBERS_FAILED, "wrote out/index.csv: 2 runs, 1 of them failed\n"))
        self.assertEqual(run.stderr, "eigentrail: 1 of 2 runs failed, first run 1; out/index.csv has the reasons\n")
        bad, good = self.index()
        self.assertEqual((bad["file"], bad["exit"], bad["points"], bad["reached"]), ("", "2", "0", ""))
        self.assertIn("mass: must not be negative; found -1", bad["reason"])
        self.assertEqual((good["file"], good["exit"], good["reason"]), ("run_002.h5", "0", ""))
        self.assertFalse((self.folder / "out/run_001.h5").exists())

    def test_trace_that_ends_early_keeps_its_points(self):
        """There is no equilibrium beyond p = 1: the path turns back."""
        self.write("scene.toml", edited(PUSHED_PENDULUM, "tolerance = 1e-2", "max_nodes = 3"))
        self.assertEqual(self.run_program("sweep", "scene.toml", "--vary", "g=9,10", "-o", "out").returncode,
                         EXIT_NUMBERS_FAILED)
        for row in self.index():
            self.assertEqual((row["exit"], row["points"]), ("1", "3"))
            self.assertTrue(row["reason"])
            self.run_well("info", f"out/{row['file']}")

    def test_options_settings_and_units(self):
        self.run_well("sweep", "scene.toml", "--vary", "drag=1,2", "--set", "length=4", "--to", "20", "--tolerance",
                      "1e-7", "-o", "out", "--quiet")
        self.run_well("trace", "scene.toml", "--set", "length=4", "--set", "drag=2", "--to", "20", "--tolerance", "1e-7",
                      "-o", "one.h5", "--quiet")
        self.assertEqual(differences(self.folder / "one.h5", self.folder / "out/run_002.h5"), [])
        self.write("scene.toml", edited(BLADE, "length = 5.0", 'length = { value = 5.0, unit = "m" }'))
        self.run_well("sweep", "scene.toml", "--vary", "length=400,450 cm", "-o", "units", "--quiet")
        self.assertEqual([row["length"] for row in self.index("units/index.csv")], ["4", "4.5"])

    def test_parts_give_the_same_files_and_index(self):
        self.run_well(*SWEEP, "-o", "out", "--quiet")
        for count in (2, 4):
            for i in range(1, count + 1):
                self.run_well(*SWEEP, "-o", f"shared_{count}", "--part", f"{i}/{count}", "--quiet")
            self.run_well("merge", *(f"shared_{count}/part-{i}-of-{count}" for i in range(1, count + 1)),
                          "-o", f"shared_{count}/index.csv", "--quiet")
            for i in range(1, 10):
                name = f"run_{i:03}.h5"
                self.assertEqual(differences(self.folder / "out" / name, self.folder / f"shared_{count}" / name), [])
            self.assertEqual((self.folder / f"shared_{count}/index.csv").read_bytes(),
                             (self.folder / "out/index.csv").read_bytes())

    def test_force_replaces_and_its_absence_protects(self):
        self.run_well(*SWEEP, "-o", "out", "--quiet")
        before = self.contents()
        self.assert_refused(self.run_program(*SWEEP, "-o", "out"), ["out/run_001.h5: exists already", "--force"])
        self.assertEqual(self.contents(), before)
        self.assertEqual(self.run_program(*SWEEP, "-o", "out", "--force", "--quiet").returncode, EXIT_DONE)

    def test_matrices_without_declared_parameters(self):
        self.write("scene.toml", FAMILY)
        self.assert_refused(self.run_program("sweep", "scene.toml", "--vary", "p=1,2", "-o", "out"),
                            ["--vary p: 'p' is the traced parameter"])


BAD_SWEEPS = [
    ("no parameter of this name", ["darg=1,2"], ["--vary darg: no parameter is called 'darg'; did you mean 'drag'?"]),
    ("the traced parameter", ["omega=1,2"], ["--vary omega: 'omega' is the traced parameter"]),
    ("no values", ["drag="], ["--vary drag=: expected NAME=VALUES"]),
    ("no name", ["=1,2"], ["--vary =1,2: expected NAME=VALUES"]),
    ("a name alone", ["drag"], ["--vary drag: expected NAME=VALUES"]),
    ("a word as value", ["drag=1,x"], ["--vary drag"]),
    ("a parameter twice", ["drag=1,2", "drag=3"], ["--vary drag: is there twice"]),
    ("too many combinations", ["drag=1:1:5000", "mass=1:1:5000"], ["--vary: more than 1000000 combinations"]),
]


@each_case(BAD_SWEEPS)
class BadSweep(ProgramTest):
    def check(self, varied, fragments):
        self.write("scene.toml", BLADE)
        before = self.contents()
        options = [word for one in varied for word in ("--vary", one)]
        self.assert_refused(self.run_program("sweep", "scene.toml", *options, "-o", "out"), fragments)
        self.assertEqual(self.contents(), before)


class BadFolder(ProgramTest):
    def refuse(self, output, fragments, *options):
        before = self.contents()
        self.assert_refused(self.run_program(*SWEEP, "-o", output, *options), fragments)
        self.assertEqual(self.contents(), before)

    def test_outputs_that_cannot_be_written(self):
        self.write("scene.toml", BLADE)
        self.refuse("scene.toml", ["scene.toml: cannot be made a folder"])
        self.refuse("none/out", ["none/out: cannot be made a folder"])
        (self.folder / "out").mkdir()
        self.write("out/index.csv", "somebody's list\n")
        self.refuse("out", ["out/index.csv: exists already"])
        self.refuse("out", ["out/index.csv: is no readable index of a sweep"], "--force")


if __name__ == "__main__":
    unittest.main()
