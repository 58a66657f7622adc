"""Bad input of every kind: exit code 2, one line on stderr that names the place, what was expected and what was found,
nothing on stdout, no file left and none changed.

Each row of the tables is one fault: its name, the bad input, and what the message must contain. In a scene "§" stands where
the message must point; it is taken out before the run. Without it the message must name the file only.
"""

import collections
import os
import re
import resource
import shutil
import sys
import unittest
from importlib.util import find_spec

import eigentrail

import bodies
import files
import imports
import keys
import matrices
import texts
import usage
import values
from good import BLADE, FAMILY, MACHINE, TWO_SHORT_RODS
from program import ProgramTest, each_case


class BadScene(ProgramTest):
    """What traces the scene refuses it and, where the fault is in its text, what explains it does with the same words. Every
    eighth row is explained."""

    explained = True
    row = 0

    def check(self, scene, fragments, *more_edits):
        where = self.write_marked(scene, more_edits)
        matrices.write_files(self.folder, scene)
        before = self.contents()
        run = self.run_program("trace", "scene.toml", "-o", "loci.h5")
        self.assert_refused(run, fragments, f"eigentrail: scene.toml:{where} ")
        BadScene.row += 1
        if where and self.explained and BadScene.row % 8 == 0:
            again = self.run_program("explain", "scene.toml")
            self.assertEqual((again.returncode, again.stdout, again.stderr), (run.returncode, "", run.stderr))
        self.assertEqual(self.contents(), before)


@each_case(texts.SCENES)
class BadText(BadScene):
    explained = False


@each_case(values.SCENES)
class BadValue(BadScene):
    def test_residual_of_a_failed_equilibrium_is_not_above_that_of_the_guess(self):
        """At the guess the far rod is worst: c = 9025 of 2 |d| |x|_max = 950."""
        self.write("scene.toml", TWO_SHORT_RODS)
        message = self.run_program("trace", "scene.toml", "-o", "loci.h5").stderr
        self.assertLess(float(re.search("largest residual ([^ ]+) of its scale", message)[1]), 9.51)


@each_case(bodies.SCENES)
class BadBody(BadScene):
    pass


@each_case(matrices.SCENES)
class BadMatrix(BadScene):
    pass


@each_case(keys.SCENES)
class BadKey(BadScene):
    """Rows made from the program's own reference. The Python package, where there is one, reads all in one process, by the same code."""

    explained = False

    if find_spec("eigentrail._engine"):
        def check(self, scene, fragments):
            path, where = self.folder / "scene.toml", self.write_marked(scene, ())
            with self.assertRaises(eigentrail.SceneError) as refused:
                eigentrail.explain(path)
            self.assertTrue(str(refused.exception).startswith(f"{path}:{where} "), refused.exception)
            for fragment in fragments:
                self.assertIn(fragment, str(refused.exception))


class GoodScene(ProgramTest):
    """The good inputs from which the bad ones are made."""

    def test_it_is_good(self):
        for scene in (BLADE, FAMILY, MACHINE, *keys.GOOD):
            with self.subTest(scene):
                # The mechanisms are in a position in which constraints say the same.
                shared = 'reactions = "least squares"\n' if "[[body]]" in scene else ""
                self.write("scene.toml", shared + scene)
                self.run_well("explain", "scene.toml")


class WithFiles(ProgramTest):
    """Each test has good files of every kind: links to them, and copies of those that it changes."""

    @classmethod
    def setUpClass(cls):
        cls.good = files.make_files()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.good)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.good, self.folder, dirs_exist_ok=True, copy_function=os.link)

    def own(self, name):
        """The path of a file that the test may change."""
        path = self.folder / name
        path.unlink()
        shutil.copy(self.good / name, path)
        return path

    def contents(self):
        """Every path below the folder, with data that change if the file is written to."""
        status = {path: path.lstat() for path in self.folder.rglob("*")}
        return {path: (s.st_ino, s.st_size, s.st_mtime_ns, s.st_mode) for path, s in status.items()}

    def assert_all_refused(self, commands, fragments):
        before = self.contents()
        for command in commands:
            with self.subTest(command=" ".join(map(str, command))):
                self.assert_refused(self.run_program(*command), fragments)
                self.assertEqual(self.contents(), before)


class DamagedFile(WithFiles):
    def check(self, name, damage, commands, fragments):
        damage(self.own(name))
        self.assert_all_refused([command(name) for command in commands], [name, *fragments])


@each_case(files.ROWS)
class BadFile(DamagedFile):
    pass


@each_case(files.EACH_DATASET)
class BadDataset(DamagedFile):
    """Rows made from the datasets of good files."""


@each_case(usage.ROWS)
class BadUsage(WithFiles):
    def check(self, arguments, fragments, prepare=None):
        if prepare:
            prepare(self.folder)
        self.assert_all_refused([arguments], fragments)


@each_case(imports.ROWS)
class BadImport(ProgramTest):
    """Sizes that are announced, and archives that unpack to more than they should, take no memory."""

    MEMORY = 256 << 20

    def run_program(self, *arguments):
        if "EIGENTRAIL_SLOWDOWN" in os.environ:  # sanitizers reserve terabytes
            return super().run_program(*arguments)
        limits = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (self.MEMORY, limits[1]))
        try:
            return super().run_program(*arguments)
        finally:
            resource.setrlimit(resource.RLIMIT_AS, limits)

    def check(self, form, content, arguments, fragments):
        for name, bytes_or_text in content.items():
            path = self.folder / name
            if callable(bytes_or_text):
                bytes_or_text(path)
            elif isinstance(bytes_or_text, str):
                path.write_text(bytes_or_text)
            else:
                path.write_bytes(bytes_or_text)
        before = self.contents()
        self.assert_refused(self.run_program("import", form, *arguments, "-o", "new"), fragments)
        self.assertEqual(self.contents(), before)


def print_counts():
    """The number of rows of each table."""
    by_hand = collections.Counter({"scenes": sum(len(module.SCENES) for module in (texts, values, bodies, matrices)),
                                   "files": len(files.ROWS), "files of other programs": len(imports.ROWS),
                                   "command lines": len(usage.ROWS)})
    made = {"from the reference": len(keys.SCENES), "from the datasets of files": len(files.EACH_DATASET)}
    print(f"{by_hand.total()} bad inputs by hand ({', '.join(f'{n} {what}' for what, n in by_hand.items())}), and "
          + ", ".join(f"{n} made {what}" for what, n in made.items()), file=sys.stderr)
    if os.geteuid() == 0:
        print("root: those about permissions, which do not bind root, are skipped", file=sys.stderr)


if __name__ == "__main__":
    print_counts()
    unittest.main()
