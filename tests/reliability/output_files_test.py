"""What becomes of the files that commands write: remains of killed runs, permissions, links, files that appear meanwhile, full disks."""

import os
import resource
import signal
import subprocess
import unittest

import h5py
import numpy as np

from command_test_case import CommandTest
from program import BLADE, EXIT_NUMBERS_FAILED, FAMILY, PROGRAM, TIME_LIMIT


def few_bytes():
    """Files of this process may have 4096 bytes; beyond that the system sends SIGXFSZ."""
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


class OutputFiles(CommandTest):
    def names(self):
        return {path.name for path in self.folder.iterdir()}

    def commands(self):
        """Commands that write to a file, and their outputs."""
        self.trace(FAMILY)
        plane = ("--second", "drag", "--second-from", "1", "--second-to", "3")
        self.write("blade.toml", BLADE)
        return ((("trace", "scene.toml"), "out.h5"), (("report", "loci.h5"), "out.html"), (("export", "loci.h5"), "out.csv"),
                (("export", "loci.h5"), "out.json"), (("map", "blade.toml", *plane, "--grid", "2x2"), "out.h5"),
                (("boundary", "blade.toml", *plane, "--lines", "1"), "out.h5"),
                (("accuracy", "blade.toml", "--tolerances", "1e-3", "--orders", "1", "--grids", "none", "--samples", "1", "--repeat", "1"), "out.h5"))

    def test_what_killed_runs_have_left_is_cleaned_by_the_next(self):
        for command, output in self.commands():
            with self.subTest(command):
                before = self.names()
                for ending in (".partial", ".lock"):
                    self.write(output + ending, "left")
                self.run_well(*command, "-o", output, "-q")
                (self.folder / f"{output}.lock").unlink(missing_ok=True)  # of a trace only
                self.assertEqual(self.names(), before | {output})
                (self.folder / output).unlink()

    def test_force_replaces_and_quiet_says_nothing_and_permissions_and_links_stay(self):
        for command, output in self.commands():
            with self.subTest(command):
                self.assertEqual(self.run_well(*command, "-o", f"real_{output}", "-q"), "")
                real, link = self.folder / f"real_{output}", self.folder / output
                real.chmod(0o640)
                link.symlink_to(real.name)
                os.utime(real, (0, 0))
                self.assertEqual(self.run_well(*command, "-o", output, "-q", "--force"), "")
                self.assertTrue(link.is_symlink())
                self.assertGreater(real.stat().st_mtime, 0.0)
                self.assertEqual(real.stat().st_mode & 0o777, 0o640)
                link.unlink()
                real.unlink()

    def test_a_link_to_nothing_is_not_replaced(self):
        self.write("scene.toml", FAMILY)
        (self.folder / "out.h5").symlink_to("missing.h5")
        self.assert_refused(self.run_program("trace", "scene.toml", "-o", "out.h5"), ["out.h5: exists already"])
        self.assertTrue((self.folder / "out.h5").is_symlink())

    def test_what_appears_meanwhile_is_kept(self):
        self.write("scene.toml", BLADE)
        with subprocess.Popen([PROGRAM, "accuracy", "scene.toml", "-o", "out.h5", "-q", "--tolerances", "1e-3", "--orders", "1", "--grids",
                               "none", "--repeat", "50"], cwd=self.folder, stderr=subprocess.PIPE, text=True) as run:
            self.wait_for("out.h5.unfinished")
            self.write("out.h5", "mine")
            said = run.communicate(timeout=TIME_LIMIT)[1]
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED, said)
        self.assertIn("out.h5: a file that has appeared here since the run began is kept; what was computed is in out.h5.partial", said)
        self.assertEqual((self.folder / "out.h5").read_text(), "mine")
        with h5py.File(self.folder / "out.h5.partial") as file:
            self.assertEqual(file.attrs["format"], "eigentrail-accuracy")

    def test_a_limit_on_the_size_of_files_is_a_full_disk(self):
        for command, output in self.commands():
            with self.subTest(command):
                before = self.names()
                run = subprocess.run([PROGRAM, *command, "-o", output, "-q"], cwd=self.folder, capture_output=True, text=True, check=False,
                                     preexec_fn=few_bytes, env={**os.environ, "LLVM_PROFILE_FILE": "/dev/null"})
                if run.returncode != 0:
                    self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED, run)
                    self.assertRegex(run.stderr, r"^eigentrail: .*File too large.*\n$")
                    if f"{output}.unfinished" not in self.names():
                        self.assertEqual(self.names(), before)
                        continue
                    self.run_well(*command, "-o", output, "-q", "--resume")
                (self.folder / output).unlink()
                self.assertEqual(self.names(), before)

    def test_half_of_an_import_is_completed(self):
        np.savez(self.folder / "model.npz", M=np.eye(2), K=np.eye(2))
        command = ("import", "numpy", "model.npz", "-o", "new")
        self.run_well(*command)
        new = self.folder / "new"
        whole = {path.name: path.read_bytes() for path in new.iterdir()}
        (new / "model.toml").rename(new / "model.toml.partial")  # as a kill between both leaves it
        self.run_well(*command)
        self.assertEqual({path.name: path.read_bytes() for path in new.iterdir()}, whole)
        (new / "model.toml").unlink()
        self.assert_refused(self.run_program(*command), ["model.h5: exists already"])

    def test_imports_stay_in_their_folder(self):
        np.savez(self.folder / "model.npz", M=np.eye(2), K=np.eye(2))
        before = self.names()
        for name in ("../out", "a/b", "/tmp/out", ".."):
            self.assert_refused(self.run_program("import", "numpy", "model.npz", "-o", "new", "--name", name),
                                [f"--name {name}: expected a name without folders"])
        self.assertEqual(self.names(), before)


if __name__ == "__main__":
    unittest.main()
