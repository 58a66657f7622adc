"""Traces, boundaries, maps and studies from Python are those of the program, bit for bit."""

import pathlib
import tempfile
import unittest

import eigentrail as et
import numpy as np

from loci_comparison import differences
from program import BLADE, FAMILY, PUSHED_PENDULUM, SCENES, ProgramTest


class Scenes(ProgramTest):
    def test_every_scene_of_the_library_gives_the_file_of_the_program(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene.stem):
                self.run_well("trace", scene, "-o", "program.h5", "--quiet", "--force")
                et.trace(scene).eigentrail.save(self.folder / "python.h5")
                self.assertEqual(differences(self.folder / "program.h5", self.folder / "python.h5"), [])

    def test_settings_ranges_and_options_are_those_of_the_command_line(self):
        scene = SCENES / "rotating_mass.toml"
        self.run_well("trace", scene, "-o", "program.h5", "--quiet", "--set", "drag=3", "--set", "length=5.5", "--from", "80", "--to", "10",
                      "--tolerance", "1e-9", "--modes", "1", "--no-certify", "--order", "2")
        loci = et.trace(scene, drag=3, length="5.5", omega=(80, 10), tolerance=1e-9, modes=1, certify=False,
                        options={"order": 2})
        loci.eigentrail.save(self.folder / "python.h5")
        self.assertEqual(differences(self.folder / "program.h5", self.folder / "python.h5"), [])

    def test_a_scene_may_be_a_path_a_text_or_a_dict(self):
        (self.folder / "scene.toml").write_text(BLADE)
        as_dict = {"parameters": {"omega": {"value": 40.0, "unit": "rad/s"}, "mass": 50.0, "length": 5.0, "drag": 2.0},
                   "trace": {"parameter": "omega", "from": 100.0, "to": 5.0},
                   "frame": {"angular_velocity": [0, 0, "omega"]},
                   "point": [{"name": "blade", "mass": "mass", "position": ["1 + length", 0, 0]}],
                   "rod": [{"from": [1, 0, 0], "to": "blade", "length": "length"}],
                   "drag": [{"point": "blade", "coefficient": "drag"}]}
        loci = [et.trace(scene) for scene in (self.folder / "scene.toml", str(self.folder / "scene.toml"), BLADE, as_dict)]
        for other in loci[1:]:
            np.testing.assert_array_equal(loci[0].eigenvalue, other.eigenvalue)

    def test_a_boundary_is_that_of_the_program(self):
        scene = SCENES / "rotating_mass.toml"
        self.run_well("boundary", scene, "--second", "drag", "--from", "0.5", "--to", "20", "-o", "program.h5", "--quiet")
        et.boundary(scene, drag=(0.5, 20)).eigentrail.save(self.folder / "python.h5")
        self.assertEqual(differences(self.folder / "program.h5", self.folder / "python.h5"), [])

    def test_a_map_is_that_of_the_program(self):
        scene = SCENES / "rotating_mass.toml"
        self.run_well("map", scene, "--second", "drag", "--from", "0.5", "--to", "20", "--first-from", "80", "--first-to", "5",
                      "--grid", "6x9", "-o", "program.h5", "--quiet")
        et.map(scene, drag=(0.5, 20), omega=(80, 5), grid=(6, 9)).eigentrail.save(self.folder / "python.h5")
        self.assertEqual(differences(self.folder / "program.h5", self.folder / "python.h5"), [])

    def test_a_study_has_the_same_errors(self):
        study = et.accuracy(SCENES / "rotating_mass.toml", tolerances=[1e-4, 1e-8], orders=[4], grids=[25], samples=20, repeat=1)
        self.run_well("accuracy", SCENES / "rotating_mass.toml", "--tolerances", "1e-4,1e-8", "--orders", "4", "--grids", "25",
                      "--samples", "20", "--repeat", "1", "-o", "program.h5", "--quiet")
        theirs = et.open(self.folder / "program.h5")
        np.testing.assert_array_equal(study.method, theirs.method)
        np.testing.assert_array_equal(study.error, theirs.error)

    def test_explain_is_that_of_the_program(self):
        scene = SCENES / "rotating_mass.toml"
        printed = self.run_well("explain", scene, "--sensitivity")
        self.assertEqual(et.explain(scene, sensitivity=True) + printed[printed.index("next: "):], printed)

    def test_the_spectrum_is_that_of_the_trace(self):
        loci = et.trace(SCENES / "rotating_mass.toml", tolerance=1e-12)
        table = et.spectrum(SCENES / "rotating_mass.toml", at=[20, 60])
        self.assertEqual(list(table.columns[:3]), ["omega", "mode", "eigenvalue"])
        for omega, rows in table.groupby("omega"):
            np.testing.assert_allclose(rows.eigenvalue, loci.eigentrail.sel(omega=omega).eigenvalue, rtol=1e-11)
        np.testing.assert_allclose(table.damping_ratio, -table.eigenvalue.map(np.real) / table.natural_frequency)


class Faults(unittest.TestCase):
    def assert_fails(self, error, text, function, *arguments, **keywords):
        with self.assertRaises(error) as caught:
            function(*arguments, **keywords)
        self.assertIn(text, str(caught.exception))

    def test_bad_scenes_say_what_the_program_says(self):
        self.assert_fails(et.SceneError, "scene.toml:9:1: [trace] from: is missing", et.trace, BLADE.replace("from = 100", "frum = 100"))
        self.assert_fails(et.SceneError, "cannot be read", et.trace, "missing.toml")
        self.assert_fails(et.SceneError, "did you mean 'drag'", et.trace, BLADE, drug=3)
        self.assert_fails(TypeError, "expected a scene", et.trace, 3)
        self.assert_fails(et.SceneError, "tolerance", et.trace, BLADE, tolerance=2)
        self.assert_fails(TypeError, "drag: expected a number", et.trace, BLADE, drag=None)
        self.assert_fails(et.SceneError, "at: expected values", et.spectrum, BLADE, at="x")
        self.assert_fails(ValueError, "is no HDF5 file", et.open, __file__)
        self.assert_fails(FileNotFoundError, "no such folder", et.trace(FAMILY).eigentrail.save, "/nowhere/at/all.h5")

    def test_ranges(self):
        self.assert_fails(et.SceneError, "expected a range of two values", et.trace, BLADE, omega=(1, 2, 3))
        self.assert_fails(et.SceneError, "the range of one parameter", et.trace, BLADE, omega=(1, 2), drag=(1, 2))
        self.assert_fails(et.SceneError, "the ranges of two parameters", et.map, BLADE)
        self.assert_fails(TypeError, "numbers in the unit", et.map, BLADE, drag=("1", "2"))

    def test_what_has_no_effect_is_a_warning(self):
        with self.assertWarnsRegex(UserWarning, "has no effect"):
            et.trace(BLADE, viscosity=2)

    def test_what_cannot_be_traced_is_an_error(self):
        self.assert_fails(et.TraceError, "equilibrium", et.trace, PUSHED_TOO_FAR)

    def test_a_trace_that_ends_early_warns_and_keeps_its_points(self):
        with self.assertWarnsRegex(UserWarning, "ended early: .*max_nodes"):
            loci = et.trace(BLADE, tolerance=1e-10, options={"max_nodes": 3})
        self.assertEqual(loci.attrs["status"], "ended early")
        self.assertEqual(loci.sizes["node"], 3)

    def test_an_exception_of_the_progress_function_ends_the_trace(self):
        def fail(share, count):
            raise RuntimeError("enough")

        self.assert_fails(RuntimeError, "enough", et.trace, BLADE, progress=fail, tolerance=1e-12)

    def test_progress_is_told(self):
        seen = []
        et.map(BLADE, drag=(1, 5), grid=(8, 8), progress=lambda share, count: seen.append(share))
        self.assertTrue(seen and all(0 < share <= 1 for share in seen))


PUSHED_TOO_FAR = PUSHED_PENDULUM.replace("from = 0\nto = 1.2", "from = 1.5\nto = 2.0")


class Saving(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="eigentrail-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_a_saved_file_is_the_same_dataset(self):
        loci = et.trace(FAMILY)
        loci.eigentrail.save(self.folder / "out.h5")
        self.assertTrue(loci.identical(et.open(self.folder / "out.h5")))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["out.h5"])

    def test_only_files_of_the_same_kind_are_replaced(self):
        loci = et.trace(FAMILY)
        loci.eigentrail.save(self.folder / "out.h5")
        loci.eigentrail.save(self.folder / "out.h5")
        (self.folder / "notes.txt").write_text("mine")
        with self.assertRaisesRegex(FileExistsError, "force=True"):
            loci.eigentrail.save(self.folder / "notes.txt")
        self.assertEqual((self.folder / "notes.txt").read_text(), "mine")
        loci.eigentrail.save(self.folder / "notes.txt", force=True)

    def test_a_part_of_a_result_cannot_be_saved(self):
        with self.assertRaisesRegex(ValueError, "part or a change"):
            et.trace(FAMILY).isel(mode=[0]).eigentrail.save(self.folder / "out.h5")


if __name__ == "__main__":
    unittest.main()
