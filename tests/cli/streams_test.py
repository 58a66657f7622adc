"""What is printed arrives, or the exit code says that it did not; pipes and devices are no input; cells of tables are no formulas."""

import csv
import os
import subprocess
import unittest

import numpy as np

from command_test_case import CommandTest
from program import EXIT_BAD_INPUT, EXIT_NUMBERS_FAILED, FAMILY, PROGRAM, edited


class Printing(CommandTest):
    def setUp(self):
        super().setUp()
        self.trace(FAMILY)

    def printing(self, output, **how):
        return subprocess.run([PROGRAM, "eval", "loci.h5", "--at", "0:0.001:1"], cwd=self.folder, stdout=output, stderr=subprocess.PIPE,
                              text=True, check=False, **how)

    def test_a_full_disk_is_an_error(self):
        with open("/dev/full", "w") as full:
            run = self.printing(full)
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
        self.assertIn("not all could be printed", run.stderr)

    def test_a_closed_output_is_an_error_and_no_file_takes_its_place(self):
        run = self.printing(None, preexec_fn=lambda: os.close(1))
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
        self.assertIn("not all could be printed", run.stderr)
        command = f"'{PROGRAM}' trace scene.toml -o other.h5 >&-"
        self.assertEqual(subprocess.run(["sh", "-c", command], cwd=self.folder, stderr=subprocess.DEVNULL, check=False).returncode,
                         EXIT_NUMBERS_FAILED)
        self.run_well("verify", "other.h5")

    def test_a_reader_that_leaves_is_no_error_to_speak_of(self):
        for ignored in (False, True):
            prefix = "trap '' PIPE; " if ignored else ""
            run = subprocess.run(["bash", "-c", f"{prefix}'{PROGRAM}' eval loci.h5 --at 0:0.001:1 | head -n 1"], cwd=self.folder,
                                 capture_output=True, text=True, check=True)
            self.assertEqual(run.stderr, "")
            self.assertEqual(run.stdout.count("\n"), 1)


class Pipes(CommandTest):
    def test_are_refused_by_every_reader(self):
        os.mkfifo(self.folder / "pipe")
        self.write("table.toml", edited(FAMILY, "M = [[[1, 0], [0, 1]]]\nK = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]", 'file = "pipe"'))
        imports = [("import", form, "pipe", "-o", "new") for form in ("matlab", "nastran", "numpy", "openfast")]
        for command in (("trace", "pipe"), ("trace", "table.toml"), ("events", "pipe"), ("info", "pipe"), ("report", "pipe", "-o", "a.html"),
                        ("merge", "pipe", "-o", "a.h5"), *imports):
            with self.subTest(command):
                run = self.run_program(*command)
                self.assertEqual((run.returncode, run.stdout), (EXIT_BAD_INPUT, ""), run.stderr)
                self.assertIn("no plain file", run.stderr.replace("not a plain file", "no plain file"))

    def test_devices_are_refused(self):
        self.assert_refused(self.run_program("trace", "/dev/zero"), ["/dev/zero: is not a plain file"])


class Formulas(CommandTest):
    def test_cells_that_a_spreadsheet_would_execute_are_texts(self):
        names = ["=1+2", "-1.5", "+x", "@SUM(A1)", "plain", 'a "b", c']
        scene = "\n".join(['[trace]', 'parameter = "p"', "from = 0", "to = 1", "[matrix_family]", f"state_names = {names}",
                           f"M = [{np.eye(6).tolist()}]", f"K = [{np.diag(np.arange(1.0, 7.0)).tolist()}, {np.eye(6).tolist()}]"])
        self.trace(scene)
        self.run_well("export", "loci.h5", "-o", "tables", "--csv")
        with open(self.folder / "tables" / "mode_shapes.csv", newline="", encoding="utf-8") as file:
            found = {row["coordinate"] for row in csv.DictReader(file)}
        self.assertEqual(found, {"'=1+2", "-1.5", "'+x", "'@SUM(A1)", "plain", 'a "b", c'})


if __name__ == "__main__":
    unittest.main()
