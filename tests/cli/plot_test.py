"""`eigentrail plot`: files of every kind, options, and what is refused."""

import os
import subprocess
import unittest

from program import BLADE, EXIT_BAD_INPUT, PROGRAM, SCENES, TIME_LIMIT, ProgramTest

BEGINNINGS = {"svg": b"<?xml", "pdf": b"%PDF", "png": b"\x89PNG"}


class Plot(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", BLADE)
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def test_every_kind_of_file(self):
        for ending, beginning in BEGINNINGS.items():
            self.assertIn(f"wrote blade.{ending}", self.run_well("plot", "loci.h5", "-o", f"blade.{ending}"))
            self.assertTrue(self.bytes_of(f"blade.{ending}").startswith(beginning), ending)

    def test_names_options_and_files_that_exist(self):
        self.run_well("plot", "loci.h5")
        self.run_well("plot", "loci.h5", "-o", "blade.svg")
        plain = self.bytes_of("blade.svg")
        self.assertEqual(self.bytes_of("loci.svg"), plain, "the same files give the same bytes")
        self.assert_refused(self.run_program("plot", "loci.h5", "-o", "blade.svg"), ["exists already", "--force"])
        self.run_well("plot", "loci.h5", "-o", "blade.svg", "--force", "--harmonics", "1,2", "--unit", "Hz", "--log", "--size", "5x4")
        self.run_well("plot", "loci.h5", "-o", "shape.svg", "-q", "--kind", "shape", "--at", "40", "--mode", "2", "--view", "xz")
        self.assertEqual(len({plain, self.bytes_of("blade.svg"), self.bytes_of("shape.svg")}), 3)
        self.write("drawing.svg", "<?xml version='1.0'?><svg/>")
        self.assert_refused(self.run_program("plot", "loci.h5", "-o", "drawing.svg", "--force"), ["no readable picture"])

    def test_planes_and_studies(self):
        scene = SCENES / "rotating_mass.toml"
        window = ("--second", "a_n", "--second-from", "200", "--second-to", "3000", "--quiet")
        self.run_well("boundary", scene, *window, "-o", "flutter.h5")
        self.run_well("map", scene, *window, "--grid", "5x6", "-o", "map.h5")
        self.run_well("accuracy", scene, "--tolerances", "1e-3", "--orders", "2", "--grids", "25", "--repeat", "1",
                      "-o", "study.h5")
        for files in (("map.h5", "flutter.h5"), ("study.h5",)):
            self.run_well("plot", *files, "-o", "picture.svg", "--force")

    def test_what_is_refused(self):
        for options, fragments in [
            (("-o", "x.jpg"), ["x.jpg", ".svg, .pdf, .png"]),
            (("-o", "x.html"), [".svg, .pdf, .png", "eigentrail report"]),
            (("-o", "x.svg", "--kind", "plane"), ["loci.h5", "needs a file of the kind map or boundary"]),
            (("-o", "x.svg", "--kind", "pie"), ["--kind", "campbell"]),
            (("-o", "nowhere/x.svg"), ["folder nowhere does not exist"]),
        ]:
            with self.subTest(options):
                self.assert_refused(self.run_program("plot", "loci.h5", *options), fragments)
        self.assert_refused(self.run_program("plot", "nothing.h5", "-o", "x.svg"), ["nothing.h5", "No such file"])
        self.assertFalse((self.folder / "x.svg").exists())

    def test_without_python_it_says_what_to_install(self):
        for python, words in (("/nowhere/python3", "apt install python3-matplotlib"),
                              (self.without_matplotlib(), "no matplotlib")):
            run = subprocess.run([PROGRAM, "plot", "loci.h5", "-o", "x.svg"], cwd=self.folder, capture_output=True, text=True,
                                 timeout=TIME_LIMIT, env={**os.environ, "EIGENTRAIL_PYTHON": str(python)})
            self.assertEqual(run.returncode, EXIT_BAD_INPUT)
            self.assertIn(words, run.stderr)
            self.assertIn("EIGENTRAIL_PYTHON", run.stderr)

    def without_matplotlib(self):
        """An interpreter that finds no matplotlib."""
        (self.folder / "missing" / "matplotlib").mkdir(parents=True)
        (self.folder / "missing" / "matplotlib" / "__init__.py").write_text("raise ImportError('no matplotlib')\n")
        script = self.folder / "python"
        script.write_text(f'#!/bin/sh\nPYTHONPATH="{self.folder}/missing:$PYTHONPATH" exec /usr/bin/python3 "$@"\n')
        script.chmod(0o755)
        return script


if __name__ == "__main__":
    unittest.main()
