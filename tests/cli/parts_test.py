"""--part and `eigentrail merge`: parts of a run give together what the whole run gives, and nothing else is joined."""

import os
import pathlib
import subprocess
import time
import unittest
import unittest.mock

import h5py
import numpy as np

from loci_comparison import differences
from program import (BLADE, CURVES, EXIT_NUMBERS_FAILED, FAMILY, OTHER_KERNEL, PROGRAM, PUSHED_PENDULUM, TIME_LIMIT, ProgramTest, each_case,
                     edited)

MAP = ("map", "scene.toml", "--second", "drag", "--second-from", "0.5", "--second-to", "20", "--grid", "7x9")
BOUNDARY = ("boundary", "scene.toml", "--second", "q", "--second-from", "-1", "--second-to", "1")

# Many points a line: a line takes a twentieth of a second and more.
SLOW = edited(BLADE, "to = 5.0", "to = 5.0\norder = 1\ntolerance = 1e-9\nmax_step = 0.1")


class Parts(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", BLADE)

    def parts(self, command, count, prefix="part"):
        """Computes all parts; returns the names of their files."""
        names = [f"{prefix}_{i}_of_{count}" for i in range(1, count + 1)]
        for i, name in enumerate(names, start=1):
            self.run_well(*command, "--part", f"{i}/{count}", "-o", name, "--quiet")
        return names

    def test_parts_of_a_map_are_the_map_byte_for_byte(self):
        self.run_well(*MAP, "-o", "whole.h5", "--quiet")
        whole = (self.folder / "whole.h5").read_bytes()
        for count in (1, 2, 3, 7, 9):  # nine parts of seven lines: two are empty
            with self.subTest(count):
                names = self.parts(MAP, count)
                self.run_well("merge", *reversed(names), "-o", f"merged_{count}.h5", "--quiet")
                self.assertEqual((self.folder / f"merged_{count}.h5").read_bytes(), whole)

    def test_parts_of_a_boundary_are_the_boundary(self):
        self.write("scene.toml", CURVES)
        self.run_well(*BOUNDARY, "-o", "whole.h5", "--quiet")
        for count in (1, 2, 5):
            with self.subTest(count):
                names = self.parts(BOUNDARY, count)
                self.run_well("merge", *names, "-o", f"merged_{count}.h5", "--quiet")
                self.assertEqual(differences(self.folder / f"merged_{count}.h5", self.folder / "whole.h5"), [])

    def test_options_and_settings_of_the_command_line_reach_the_merged_file(self):
        options = (*MAP, "--set", "length=4", "--tolerance", "1e-7", "--no-certify", "--to", "10")
        self.run_well(*options, "-o", "whole.h5", "--quiet")
        self.run_well("merge", *self.parts(options, 2), "-o", "merged.h5", "--quiet")
        self.assertEqual(differences(self.folder / "merged.h5", self.folder / "whole.h5"), [])
        self.write("scene.toml", CURVES)
        options = (*BOUNDARY, "--from", "-0.5", "--tolerance", "1e-7", "--lines", "3", "--set", "q=0.1",
                   "--damping-ratio", "0.01")
        self.run_well(*options, "-o", "curves.h5", "--quiet")
        self.run_well("merge", *self.parts(options, 2, "lines"), "-o", "merged_curves.h5", "--quiet")
        self.assertEqual(differences(self.folder / "merged_curves.h5", self.folder / "curves.h5"), [])

    def test_merge_prints_the_summary_and_parts_say_what_is_next(self):
        said = self.run_well(*MAP, "--part", "2/3")
        self.assertEqual(said, "wrote scene_map.part-2-of-3: part 2 of 3, 2 of 7 pieces; eigentrail merge joins "
                               "the parts\n")
        for i in (1, 3):
            self.run_well(*MAP, "--part", f"{i}/3", "--quiet")
        said = self.run_well("merge", *(f"scene_map.part-{i}-of-3" for i in (1, 2, 3)), "-o", "map.h5")
        self.assertIn("7 x 9 cells: drag 0.5 -> 20", said)
        self.assertTrue(said.endswith("wrote map.h5\n"))

    def test_parts_of_other_kernels_of_blas_are_joined_with_a_warning(self):
        first = self.parts(MAP, 2)[0]
        with unittest.mock.patch.dict(os.environ, OPENBLAS_CORETYPE=OTHER_KERNEL):
            second = self.parts(MAP, 2, "other")[1]
        run = self.run_program("merge", first, second, "-o", "merged.h5", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stderr, rf"^eigentrail: warning: {second}: was computed with the kernel {OTHER_KERNEL} of BLAS, {first} with .*\n$")

    def test_maps_are_joined_without_the_files_of_the_scene(self):
        self.write("scene.toml", FAMILY.replace("[matrix_family]", '[parameters]\np = 0.0\nq = 1.0\n[matrix_family]')
                   .replace("K = [[[1, 0], [0, 2]]", 'K = [[["q", 0], [0, 2]]'))
        command = ("map", "scene.toml", "--second", "q", "--second-from", "1", "--second-to", "2", "--grid", "3")
        names = self.parts(command, 2)
        self.run_well(*command, "-o", "whole.h5", "--quiet")
        (self.folder / "scene.toml").unlink()
        self.run_well("merge", *names, "-o", "merged.h5", "--quiet")
        self.assertEqual(differences(self.folder / "merged.h5", self.folder / "whole.h5"), [])

    def test_killed_part_is_resumed_alone(self):
        self.write("scene.toml", SLOW)
        command = (*MAP, "--jobs", "1")
        self.run_well(*command, "-o", "whole.h5", "--quiet")
        names = self.parts(command, 2)
        part = self.folder / names[1]
        for delay in (0.02, 0.05, 0.1):
            with self.subTest(delay):
                part.unlink(missing_ok=True)
                before = self.contents()
                run = subprocess.Popen([PROGRAM, *command, "--part", "2/2", "-o", names[1], "--quiet", "--force"], cwd=self.folder)
                time.sleep(delay)
                run.kill()
                run.wait(timeout=TIME_LIMIT)
                now = self.contents()
                now.pop(pathlib.Path(f"{names[1]}.unfinished"), None)
                self.assertEqual(now, before)
                run = self.run_program("merge", *names, "-o", "merged.h5")
                self.assert_refused(run, [f"{names[1]}: no such file"])
        self.run_well(*command, "--part", "2/2", "-o", names[1], "--quiet", "--resume")
        self.run_well("merge", *names, "-o", "merged.h5", "--quiet")
        self.assertEqual((self.folder / "merged.h5").read_bytes(), (self.folder / "whole.h5").read_bytes())

    def test_complete_runs_are_left_alone(self):
        sweep = ("sweep", "scene.toml", "--vary", "drag=1,2")
        accuracy = ("accuracy", "scene.toml", "--tolerances", "1e-4", "--orders", "2", "--grids", "none", "--samples", "2", "--repeat", "1")
        self.write("curves.toml", CURVES)
        boundary = ("boundary", "curves.toml", *BOUNDARY[2:], "--lines", "3")
        for command, output in ((MAP, "map.h5"), ((*MAP, "--part", "2/2"), "part.h5"), (boundary, "curves.h5"), (accuracy, "study.h5"),
                                (sweep, "swept"), ((*sweep, "--part", "1/2"), "swept_parts")):
            with self.subTest(output):
                self.run_well(*command, "-o", output, "--quiet")
                before = self.contents()
                self.assertRegex(self.run_well(*command, "-o", output, "--resume"), r"^\S+: the run has come to its end already\n$")
                self.assert_refused(self.run_program(*command, "-o", output, "--resume", "--set", "length=3"
                                                     if command is not boundary else "q=0.3"), ["cannot be resumed: "])
                self.assertEqual(self.contents(), before)

    def test_merged_map_without_a_known_cell_is_not_written(self):
        """There is no equilibrium with p > 1."""
        self.write("scene.toml", edited(PUSHED_PENDULUM, "p = 0.0", "p = 0.0\nr = 0.1")
                   + '[[drag]]\npoint = "bob"\ncoefficient = "r"\n')
        command = ("map", "scene.toml", "--parameter", "r", "--from", "0.1", "--to", "1", "--second", "p",
                   "--second-from", "1.1", "--second-to", "1.5", "--grid", "3")
        names = self.parts(command, 2)
        whole = self.run_program(*command, "-o", "whole.h5")
        run = self.run_program("merge", *names, "-o", "merged.h5")
        self.assertEqual((run.returncode, run.stderr), (EXIT_NUMBERS_FAILED, whole.stderr))
        self.assertFalse((self.folder / "merged.h5").exists())

    def refuse(self, fragments, *arguments):
        before = self.contents()
        self.assert_refused(self.run_program(*arguments), fragments)
        self.assertEqual(self.contents(), before)

    def test_damaged_parts_are_refused(self):
        first, second = self.parts(MAP, 2)
        whole = (self.folder / second).read_bytes()
        for damage, place in (("cut", 0), ("cut", 100), ("cut", len(whole) // 2), ("cut", len(whole) - 1),
                              ("flip", 60), ("flip", len(whole) // 3), ("flip", len(whole) // 2),
                              ("flip", len(whole) - 60), ("flip", len(whole) - 20), ("flip", len(whole) - 1)):
            with self.subTest(damage=damage, place=place):
                bytes_ = bytearray(whole)
                if damage == "cut":
                    del bytes_[place:]
                else:
                    bytes_[place] ^= 1
                (self.folder / second).write_bytes(bytes_)
                self.refuse([f"{second}: is ", "damaged"], "merge", first, second, "-o", "new.h5")

    def test_data_files_that_changed_between_parts_are_noticed(self):
        self.write("scene.toml", FAMILY.split("[matrix_family]")[0].replace("[trace]", "[parameters]\np = 0.0\nq = 1.0\n[trace]")
                   + '[matrix_family]\nfile = "matrices.h5"\n')
        command = ("map", "scene.toml", "--second", "q", "--second-from", "1", "--second-to", "2", "--grid", "3")
        for i, stiffness in enumerate((1.0, 2.0), start=1):
            with h5py.File(self.folder / "matrices.h5", "w") as file:
                file["M/0"] = np.eye(2)
                file["K/0"] = stiffness * np.eye(2)
                file["K/1"] = np.array([[0.0, 1.0], [1.0, 0.0]])
            self.run_program(*command, "--part", f"{i}/2", "-o", f"part_{i}.h5", "--quiet")
        self.refuse(["part_2.h5: belongs to another run than part_1.h5: files of the scene: line 1 was 'matrices.h5"],
                    "merge", "part_1.h5", "part_2.h5", "-o", "new.h5")


BAD_MERGES = [
    ("a part is missing", ["a1", "a3"], ["part 2 of 3 is missing; give all files, or repeat the command with --part 2/3"]),
    ("two parts are missing", ["a2"], ["parts 1, 3 of 3 are missing", "--part 1/3, --part 3/3"]),
    ("a part twice", ["a1", "a2", "a3", "a2"], ["a2: is part 2 of 3, as a2 is; give each part once"]),
    ("the same part under two names", ["a1", "a2", "again"], ["again: is part 2 of 3, as a2 is"]),
    ("another division", ["a1", "b2", "a3"], ["b2: is part 2 of 2, but a1 is part 1 of 3"]),
    ("another scene", ["a1", "c2", "a3"], ["c2: belongs to another run than a1: scene: line 4 was 'omega  ="]),
    ("another window", ["a1", "d2", "a3"], ["d2: belongs to another run than a1: --second-to: was '20' and is '21'"]),
    ("another option", ["a1", "e2", "a3"],
     ["e2: belongs to another run than a1: option tolerance: was '' and is '1e-8'"]),
    ("another grid", ["a1", "f2", "a3"], ["f2: belongs to another run than a1: lines: was '7' and is '6'"]),
    ("another command", ["a1", "g2", "a3"], ["g2: belongs to another run", "command: was 'map' and is 'boundary'"]),
    ("a map", ["a1", "whole.h5", "a3"], ["whole.h5: is no part of a run"]),
    ("a scene", ["a1", "scene.toml", "a3"], ["scene.toml: is no part of a run"]),
    ("no such file", ["a1", "none", "a3"], ["none: no such file"]),
    ("a folder", ["a1", "folder", "a3"], ["folder: is a folder"]),
    ("an empty file", ["a1", "empty", "a3"], ["empty: is no part of a run, or damaged"]),
    ("an output that exists", ["a1", "a2", "a3", "-o", "whole.h5"], ["whole.h5: exists already", "--force"]),
    ("an output of another kind", ["a1", "a2", "a3", "-o", "scene.toml", "--force"],
     ["scene.toml: is no readable stability map"]),
]


@each_case(BAD_MERGES)
class BadMerge(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", BLADE)
        self.write("other.toml", edited(BLADE, "value = 40.0", "value = 41.0"))
        self.write("empty", "")
        (self.folder / "folder").mkdir()
        self.run_well(*MAP, "-o", "whole.h5", "--quiet")
        for i in (1, 2, 3):
            self.part(f"a{i}", f"{i}/3")
        self.part("again", "2/3")
        self.part("b2", "2/2")
        self.part("c2", "2/3", replaced={"scene.toml": "other.toml"})
        self.part("d2", "2/3", replaced={"20": "21"})
        self.part("e2", "2/3", "--tolerance", "1e-8")
        self.part("f2", "2/3", replaced={"7x9": "6x9"})
        self.run_well("boundary", "scene.toml", "--second", "drag", "--second-from", "0.5", "--second-to", "20", "--lines", "0",
                      "--part", "2/3", "-o", "g2", "--quiet")

    def part(self, name, part, *options, replaced=None):
        command = [(replaced or {}).get(word, word) for word in MAP]
        self.run_well(*command, *options, "--part", part, "-o", name, "--quiet")

    def check(self, arguments, fragments):
        if "-o" not in arguments:
            arguments = [*arguments, "-o", "new.h5"]
        before = self.contents()
        self.assert_refused(self.run_program("merge", *arguments), fragments)
        self.assertEqual(self.contents(), before)


BAD_PARTS = [(text, text) for text in ("0/3", "4/3", "3", "1/", "/3", "1/0", "-1/3", "1/3/3", "a/b", "1/3x", " ")]


@each_case([(f"part {number}: {text}", text) for number, (_, text) in enumerate(BAD_PARTS)])
class BadPart(ProgramTest):
    def check(self, text):
        self.write("scene.toml", BLADE)
        before = self.contents()
        self.assert_refused(self.run_program(*MAP, "--part", text, "-o", "new.h5"), ["--part: expected i/N"])
        self.assertEqual(self.contents(), before)


@unittest.skipIf(os.environ.get("EIGENTRAIL_MPI") == "1", "tests/distributed has the tests of a program with MPI")
class Launched(ProgramTest):
    """A program built without MPI that mpirun starts several times."""

    def test_processes_that_know_nothing_of_each_other_are_refused(self):
        self.write("scene.toml", BLADE)
        before = self.contents()
        for variable in ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE"):
            with self.subTest(variable), unittest.mock.patch.dict(os.environ, {variable: "4"}):
                self.assert_refused(self.run_program(*MAP, "-o", "new.h5"),
                                    ["4 processes were started together, but this eigentrail was built without MPI",
                                     "-DEIGENTRAIL_MPI=ON", "--part"])
                self.assert_refused(self.run_program("trace", "scene.toml", "-o", "new.h5"),
                                    ["4 processes were started together, but this eigentrail was built without PETSc",
                                     "-DEIGENTRAIL_PETSC=ON"])
                self.assertEqual(self.contents(), before)
        with unittest.mock.patch.dict(os.environ, {"PMI_SIZE": "1"}):
            self.run_well(*MAP, "-o", "new.h5", "--quiet")


if __name__ == "__main__":
    unittest.main()
