"""Resuming traces that were interrupted, killed, or stopped by a full disk."""

import os
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from loci_comparison import differences
from program import BLADE, OTHER_KERNEL, PROGRAM, TIME_LIMIT, ProgramTest, edited

# Long enough to be met in the middle: a thousand points and more.
LONG = edited(BLADE, "to = 5.0", "to = 5.0\norder = 1\ntolerance = 1e-9\nmax_step = 0.02")


# A rotor, whose modes have a whirl and names from where the shaft first turns.
ROTOR = """
parameters = { speed = { value = 3000, unit = "rpm" } }
trace = { parameter = "speed", from = 0, to = 9000, order = 1, tolerance = 1e-9, max_step = 4 }
disc = [{ node = 2, mass = 20, Id = 0.2, Ip = 0.3 }]
bearing = [{ node = [1, 3], kxx = 1e7, kyy = 2e7, cxx = 100 }]
[[shaft]]
stations = { length = 1, outer = 0.05 }
elements = 2
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"
"""

# Equal pendulums on rods that rise as their frame turns faster: one is traced, in coordinates that turn with it.
PENDULUMS = """
[parameters]
omega = { value = 5, unit = "rad/s" }
[trace]
parameter = "omega"
from = 5
to = 9
order = 1
tolerance = 1e-9
max_step = 0.001
[frame]
angular_velocity = [0, 0, "omega"]
[gravity]
acceleration = [0, 0, -9.81]
""" + "".join(f"""
[[point]]
name = "mass {x}"
mass = 2
position = [{0.9 * x}, 0, -0.5]
[[rod]]
from = [{0.3 * x}, 0, 0]
to = "mass {x}"
length = 0.8
[[drag]]
point = "mass {x}"
coefficient = 0.1
""" for x in (1, -1))


class Interrupted(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", LONG)

    def start(self, *options, output="out.h5", save_every="0.02", **settings):
        return subprocess.Popen([PROGRAM, "trace", "scene.toml", "-o", output, "--quiet", "--save-every", save_every, *options],
                                cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **settings)

    def whole(self):
        if not (self.folder / "whole.h5").exists():
            self.run_well("trace", "scene.toml", "-o", "whole.h5", "--quiet")
        return self.folder / "whole.h5"

    def assert_resumes_to_whole(self):
        self.run_well("trace", "scene.toml", "-o", "out.h5", "--quiet", "--resume")
        self.assertEqual(differences(self.folder / "out.h5", self.whole()), [])
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"scene.toml", "out.h5", "whole.h5"})

    def assert_goes_on_after_an_interruption(self):
        run = self.start()
        self.wait_for("out.h5")
        time.sleep(0.1)
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=TIME_LIMIT)
        self.assertEqual(run.returncode, 130)
        self.assert_resumes_to_whole()

    def test_a_rotor_goes_on_with_its_whirl_and_names(self):
        self.write("scene.toml", ROTOR)
        self.assert_goes_on_after_an_interruption()
        with h5py.File(self.folder / "out.h5") as file:
            self.assertIn("1st forward bending", [name.decode() for name in file["mode_name"][:]])
            self.assertTrue(np.isfinite(file["whirl"][-1]).all())

    def test_equal_parts_go_on_in_coordinates_that_turn(self):
        self.write("scene.toml", PENDULUMS)
        self.assertIn("part 1 stands for 2 equal ones", self.run_well("explain", "scene.toml"))
        self.assert_goes_on_after_an_interruption()

    def test_signals_save_and_say_how_to_go_on(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                run = self.start("--force")
                self.wait_for("out.h5")
                time.sleep(0.1)
                run.send_signal(number)
                said = run.communicate(timeout=TIME_LIMIT)[1]
                self.assertEqual(run.returncode, 128 + number)
                self.assertRegex(said, r"^eigentrail: interrupted at omega = [\d.]+; \d+ points are in out\.h5; "
                                       r"the same command with --resume goes on\n$")
                with h5py.File(self.folder / "out.h5") as file:
                    self.assertEqual(file.attrs["status"], "interrupted")
                    self.assertGreater(len(file["omega"]), 1)
                self.assertFalse((self.folder / "out.h5.lock").exists())
                self.assertIn("--resume goes on", self.run_well("info", "out.h5"))
                self.run_well("eval", "out.h5", "--at", "99.9")
                self.assert_resumes_to_whole()
                for name in ("out.h5", "whole.h5"):
                    (self.folder / name).unlink()

    def test_signals_end_a_step_that_takes_long(self):
        """The first spectrum of 700 freedoms takes much longer than a second."""
        n = 700
        with h5py.File(self.folder / "large.h5", "w") as file:
            random = np.random.default_rng(1)
            for name, matrices in (("M", [np.eye(n)]), ("K", [random.normal(size=(n, n)), np.eye(n)])):
                for degree, matrix in enumerate(matrices):
                    file[f"{name}/{degree}"] = matrix
        self.write("scene.toml", '[trace]\nparameter = "p"\nfrom = 0\nto = 1\n[matrix_family]\nfile = "large.h5"\n')
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                run = self.start("--force")
                time.sleep(1.0)
                self.assertIsNone(run.poll())
                run.send_signal(number)
                begin = time.monotonic()
                said = run.communicate(timeout=TIME_LIMIT)[1]
                self.assertLess(time.monotonic() - begin, 5.0)  # promised is a second; the machine may be busy
                self.assertEqual(run.returncode, 128 + number)
                self.assertIn("eigentrail: interrupted before anything was saved", said)

    def test_reader_sees_a_consistent_prefix(self):
        run = self.start(save_every="0.01")
        self.wait_for("out.h5")
        lengths = []
        while run.poll() is None:
            with h5py.File(self.folder / "out.h5") as file:
                n = len(file["omega"])
                self.assertEqual(file["eigenvalue"].shape[0], n)
                self.assertEqual(len(file["step_length"]), n - 1)
                self.assertTrue(np.isfinite(file["eigenvalue"][()]).all())
                lengths.append(n)
        run.communicate()
        self.assertEqual(run.returncode, 0)
        self.assertEqual(lengths, sorted(lengths))
        self.assertGreater(len(set(lengths)), 2)

    def test_second_writer_of_a_file_is_refused(self):
        first = self.start()
        self.wait_for("out.h5.lock")
        second = self.run_program("trace", "scene.toml", "-o", "out.h5", "--force")
        self.assert_refused(second, ["out.h5: another process writes it", "out.h5.lock is locked"])
        self.assertEqual(first.communicate(timeout=2 * TIME_LIMIT)[1], "")
        self.assertEqual(differences(self.folder / "out.h5", self.whole()), [])

    def test_finished_trace_is_left_alone(self):
        before = self.whole().read_bytes()
        said = self.run_well("trace", "scene.toml", "-o", "whole.h5", "--resume")
        self.assertEqual(said, "whole.h5: the trace has come to its end already\n")
        self.assertEqual((self.folder / "whole.h5").read_bytes(), before)

    def test_resume_without_a_file_begins(self):
        self.run_well("trace", "scene.toml", "-o", "out.h5", "--quiet", "--resume")
        self.assertEqual(differences(self.folder / "out.h5", self.whole()), [])

    def interrupted_file(self, **settings):
        run = self.start(**settings)
        self.wait_for("out.h5")
        run.kill()
        run.communicate()
        return (self.folder / "out.h5").read_bytes()

    def test_other_scene_options_or_version_are_refused_with_the_difference(self):
        before = self.interrupted_file()
        self.assert_refused(self.run_program("trace", "scene.toml", "-o", "out.h5", "--resume", "--to", "50"),
                            ["out.h5: cannot be resumed: to: was '5' and is '50'"])
        self.write("scene.toml", edited(LONG, "mass   = 50.0", "mass   = 51.0"))
        self.assert_refused(self.run_program("trace", "scene.toml", "-o", "out.h5", "--resume"),
                            ["scene: line 5 was 'mass   = 50.0' and is 'mass   = 51.0'"])
        self.write("scene.toml", LONG)
        self.assertEqual((self.folder / "out.h5").read_bytes(), before)
        with h5py.File(self.folder / "out.h5", "r+") as file:
            file.attrs["program_version"] = "0.0.1"
        self.assert_refused(self.run_program("trace", "scene.toml", "-o", "out.h5", "--resume"),
                            ["version: was '0.0.1' and is "])

    def test_another_kernel_of_blas_is_said_and_recorded(self):
        def kernel():
            with h5py.File(self.folder / "out.h5") as file:
                return file.attrs["blas_kernel"]

        self.interrupted_file(env={**os.environ, "OPENBLAS_CORETYPE": OTHER_KERNEL})
        self.assertEqual(kernel(), OTHER_KERNEL)
        resumed = self.run_program("trace", "scene.toml", "-o", "out.h5", "--resume", "--quiet")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertRegex(resumed.stderr, rf"^eigentrail: warning: out.h5: was computed with another kernel of BLAS \({OTHER_KERNEL}\).*\n$")
        self.assertRegex(kernel(), rf"^{OTHER_KERNEL}, \w+$")

    def test_damaged_state_is_refused(self):
        self.interrupted_file()
        path = self.folder / "out.h5"
        whole = path.read_bytes()
        with h5py.File(path) as file:
            value = whole.index(file["omega"][0].tobytes())
        for what, damaged in (("is damaged", whole[:value] + bytes([whole[value] ^ 1]) + whole[value + 1:]),
                              ("is damaged", whole[:-300] + bytes(100) + whole[-200:]),
                              ("holds no state", whole[:-1]), ("is damaged", whole[:-4] + b"\xff" * 4)):
            path.write_bytes(damaged)
            self.assert_refused(self.run_program("trace", "scene.toml", "-o", "out.h5", "--resume"),
                                ["out.h5: cannot be resumed: ", what, "begin anew with --force"])
            self.assertEqual(path.read_bytes(), damaged)

    def test_lock_of_a_killed_run_is_in_nobodys_way(self):
        run = self.start()
        self.wait_for("out.h5.lock")
        run.kill()
        run.communicate()
        (self.folder / "out.h5").unlink(missing_ok=True)
        self.run_well("trace", "scene.toml", "-o", "out.h5", "--quiet")
        self.assertFalse((self.folder / "out.h5.lock").exists())


if __name__ == "__main__":
    unittest.main()
