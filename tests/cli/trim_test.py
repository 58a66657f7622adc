"""Trimmed rotors through all commands: sweeps, boundaries, verification, resuming, and mistakes."""

import csv
import io
import re
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from command_test_case import CommandTest
from loci_comparison import differences
from held_air import with_air_held
from program import EXIT_BAD_INPUT, PROGRAM, SCENES, TIME_LIMIT, edited

SCENE = with_air_held((SCENES / "air_resonance_fuselage.toml").read_text(encoding="utf-8"))
# Many points, to be met in the middle.
LONG = edited(SCENE, "tolerance = 1e-6", "tolerance = 1e-9\norder = 1\nmax_step = 0.02")


class Trim(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", SCENE)

    def flutter(self, *options):
        """Speed of the flutter of a trace."""
        self.run_well("trace", "scene.toml", "-o", "one.h5", "--force", "--quiet", "--no-certify", *options)
        rows = csv.DictReader(io.StringIO(self.run_well("events", "one.h5", "--csv")))
        (limit,) = [float(row["parameter"]) for row in rows if row["kind"] == "flutter"]
        return limit

    def test_explain_info_and_eval_have_the_unknowns(self):
        explained = self.run_well("explain", "scene.toml")
        self.assertRegex(explained, r"pitch +thrust\(air\) = weight +0\.34375\d* rad")
        self.run_well("trace", "scene.toml", "-o", "out.h5", "--quiet", "--no-certify")
        self.assertRegex(self.run_well("info", "out.h5"), r"pitch: thrust\(air\) = weight +rad +0\.34375")
        row = next(csv.DictReader(io.StringIO(self.run_well("eval", "out.h5", "--csv", "--at", "20"))))
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(float(row["pitch"]), file["pitch"][0])
            self.assertEqual(file.attrs["trimmed"], "pitch,inflow")

    def test_verify_solves_the_trim_again(self):
        self.run_well("trace", "scene.toml", "-o", "out.h5", "--quiet", "--no-certify")
        self.run_well("verify", "out.h5")

    def test_sweep_trims_every_run(self):
        self.run_well("sweep", "scene.toml", "--vary", "weight=12000,15000", "-o", "out", "--no-certify", "--quiet")
        with open(self.folder / "out" / "index.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["exit"] for row in rows], ["0", "0"])
        for row, weight in zip(rows, (12000.0, 15000.0)):
            with h5py.File(self.folder / "out" / row["file"]) as file:
                np.testing.assert_allclose(file["inflow"][:], np.sqrt(weight / (2 * 1.225 * np.pi * 25)), rtol=1e-10)

    def test_an_unknown_is_not_varied(self):
        for command in (("sweep", "scene.toml", "--vary", "pitch=0.1,0.2", "-o", "out"),
                        ("boundary", "scene.toml", "--second", "pitch", "--second-from", "0.1", "--second-to", "0.2", "-o", "out.h5"),
                        ("trace", "scene.toml", "--parameter", "pitch", "--from", "0.1", "--to", "0.2", "-o", "out.h5")):
            with self.subTest(command[0]):
                run = self.run_program(*command)
                self.assertEqual(run.returncode, EXIT_BAD_INPUT, run.stdout)
                self.assertIn("'pitch' is the unknown of a [[trim]]", run.stderr)

    def test_boundary_is_that_of_traces(self):
        self.run_well("boundary", "scene.toml", "--second", "weight", "--second-from", "12000", "--second-to", "15000", "--from", "44",
                      "--to", "46", "--lines", "1", "-o", "limits.h5", "--quiet")
        with h5py.File(self.folder / "limits.h5") as file:
            self.assertEqual([kind.decode() for kind in file["curve_kind"][:]], ["flutter"])
            omega, weight = file["omega"][:], file["weight"][:]
        for w in (12000.0, 15000.0):
            at = np.argmin(abs(weight - w))
            self.assertAlmostEqual(weight[at], w, delta=1e-6)
            limit = self.flutter("--from", "44", "--to", "46", "--set", f"weight={w}", "--tolerance", "1e-9")
            self.assertAlmostEqual(omega[at], limit, delta=2e-5)

    def test_an_interrupted_trace_goes_on(self):
        self.write("scene.toml", LONG)
        command = ("trace", "scene.toml", "--quiet", "--no-certify", "-o")
        run = subprocess.Popen([PROGRAM, *command, "out.h5"], cwd=self.folder, stderr=subprocess.PIPE)
        end = time.monotonic() + TIME_LIMIT
        while not (self.folder / "out.h5").exists():
            self.assertLess(time.monotonic(), end, "nothing is published")
            time.sleep(0.002)
        time.sleep(0.1)
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=TIME_LIMIT)
        self.assertEqual(run.returncode, 130)
        self.run_well(*command, "out.h5", "--resume")
        self.run_well(*command, "whole.h5")
        self.assertEqual(differences(self.folder / "out.h5", self.folder / "whole.h5"), [])

    def test_thrust_is_that_of_strips_on_the_blade(self):
        for condition, message in (("thrust(fuselage) = weight", "no strips or inflow is called 'fuselage'; known: air"),
                                   ("thrust(air) = pitch", "N is expected"),
                                   ("thrust(air, z) = weight", "expected one name in the brackets")):
            with self.subTest(condition):
                self.write("scene.toml", edited(SCENE, "thrust(air) = weight", condition))
                run = self.run_program("explain", "scene.toml")
                self.assertEqual(run.returncode, EXIT_BAD_INPUT)
                self.assertIn(message, run.stderr)
                self.assertTrue(re.search(r"scene\.toml:\d+:\d+: \[\[trim\]\] 1 condition", run.stderr), run.stderr)


if __name__ == "__main__":
    unittest.main()
