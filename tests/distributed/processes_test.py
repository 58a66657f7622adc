"""Commands that several processes carry out together by MPI: the results are those of one process."""

import unittest

from loci_comparison import differences
from program import BLADE, CURVES, EXIT_BAD_INPUT, EXIT_NUMBERS_FAILED, ProgramTest, edited
from together import run_together

MAP = ("map", "scene.toml", "--second", "drag", "--second-from", "0.5", "--second-to", "20", "--grid", "13x9")
BOUNDARY = ("boundary", "scene.toml", "--second", "q", "--second-from", "-1", "--second-to", "1")
SWEEP = ("sweep", "scene.toml", "--vary", "drag=1,2,5", "--vary", "length=4:0.5:5")


class Processes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", BLADE)

    def run_together(self, count, *arguments):
        return run_together(self.folder, count, *arguments)

    def run_well_together(self, count, *arguments):
        run = self.run_together(count, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""), run.args)
        return run.stdout

    def test_map_is_the_same_byte_for_byte(self):
        self.run_well(*MAP, "-o", "one.h5", "--quiet")
        for count in (1, 2, 4, 7):
            with self.subTest(count):
                said = self.run_well_together(count, *MAP, "-o", f"map_{count}.h5")
                self.assertEqual(said.count("wrote"), 1)
                self.assertEqual((self.folder / f"map_{count}.h5").read_bytes(), (self.folder / "one.h5").read_bytes())
        self.run_well_together(3, *MAP, "-o", "threads.h5", "--quiet", "--jobs", "3")
        self.assertEqual((self.folder / "threads.h5").read_bytes(), (self.folder / "one.h5").read_bytes())

    def test_more_processes_than_lines(self):
        few = (*MAP[:-1], "2x3")
        self.run_well(*few, "-o", "one.h5", "--quiet")
        self.run_well_together(5, *few, "-o", "map.h5", "--quiet")
        self.assertEqual((self.folder / "map.h5").read_bytes(), (self.folder / "one.h5").read_bytes())

    def test_boundary_is_the_same(self):
        self.write("scene.toml", CURVES)
        self.run_well(*BOUNDARY, "-o", "one.h5", "--quiet")
        for count in (2, 4):
            self.run_well_together(count, *BOUNDARY, "-o", f"curves_{count}.h5", "--quiet")
            self.assertEqual(differences(self.folder / f"curves_{count}.h5", self.folder / "one.h5"), [])

    def test_sweep_is_the_same(self):
        self.run_well(*SWEEP, "-o", "one", "--quiet")
        self.run_well_together(3, *SWEEP, "-o", "three", "--quiet")
        self.assertEqual((self.folder / "three/index.csv").read_bytes(), (self.folder / "one/index.csv").read_bytes())
        for i in range(1, 10):
            name = f"run_{i:03}.h5"
            self.assertEqual(differences(self.folder / "three" / name, self.folder / "one" / name), [])

    def test_run_of_a_sweep_that_fails_is_listed(self):
        run = self.run_together(2, "sweep", "scene.toml", "--vary", "mass=-1,50,60", "-o", "out")
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
        self.assertIn("eigentrail: 1 of 3 runs failed, first run 1; out/index.csv has the reasons\n", run.stderr)

    def test_parts_and_processes_together(self):
        self.run_well(*MAP, "-o", "one.h5", "--quiet")
        for i in (1, 2):
            self.run_well_together(2, *MAP, "--part", f"{i}/2", "-o", f"part_{i}.h5", "--quiet")
        self.run_well_together(2, "merge", "part_1.h5", "part_2.h5", "-o", "merged.h5", "--quiet")
        self.assertEqual((self.folder / "merged.h5").read_bytes(), (self.folder / "one.h5").read_bytes())
        self.write("scene.toml", CURVES)
        self.run_well(*BOUNDARY, "-o", "curves.h5", "--quiet")
        for i in (1, 2):
            self.run_well_together(2, *BOUNDARY, "--part", f"{i}/2", "-o", f"lines_{i}.h5", "--quiet")
        self.run_well_together(2, "merge", "lines_1.h5", "lines_2.h5", "-o", "merged_curves.h5", "--quiet")
        self.assertEqual(differences(self.folder / "merged_curves.h5", self.folder / "curves.h5"), [])

    def test_errors_are_told_once_and_end_all(self):
        self.write("bad.toml", edited(BLADE, 'coefficient = "drag"', 'coefficient = "darg"'))
        self.write("folder_in_the_way", "")
        cases = [
            ("bad scene", [word.replace("scene.toml", "bad.toml") for word in MAP] + ["-o", "new.h5"], EXIT_BAD_INPUT),
            ("existing output, which the first process alone looks at", [*MAP, "-o", "scene.toml"], EXIT_BAD_INPUT),
            ("output that cannot be created", [*MAP, "-o", "none/new.h5"], EXIT_BAD_INPUT),
            ("missing part", ["merge", "scene.toml", "-o", "new.h5"], EXIT_BAD_INPUT),
        ]
        for name, arguments, code in cases:
            with self.subTest(name):
                before = self.contents()
                run = self.run_together(3, *arguments)
                self.assertEqual(run.returncode, code)
                self.assertEqual(run.stdout, "")
                said = [line for line in run.stderr.splitlines() if line.startswith("eigentrail: ")]
                self.assertEqual(len(said), 1, run.stderr)
                self.assertEqual(self.contents(), before)

    def test_other_commands_do_not_need_mpi(self):
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")
        self.run_well(*MAP, "-o", "map.h5", "--quiet")


if __name__ == "__main__":
    unittest.main()
