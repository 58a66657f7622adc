"""Traces, boundaries, maps and studies from Python are those of the program, bit for bit."""

import os
import pathlib
import re
import shutil
import tempfile
import tomllib
import unittest

import eigentrail as et
import numpy as np

from loci_comparison import differences
from program import BLADE, FAMILY, PUSHED_PENDULUM, SCENES, ProgramTest


class Scenes(ProgramTest):
    def test_every_scene_of_the_library_gives_the_file_of_the_program(self):
        """Beams have few elements."""
        shutil.copy(SCENES / "nrel_5mw_blade.csv", self.folder)
        for path in sorted(SCENES.glob("*.toml")):
            with self.subTest(path.stem):
                scene = self.write(path.name, re.sub(r"(?m)^elements  .*", "elements = 2", path.read_text(encoding="utf-8")))
                self.run_well("trace", scene, "-o", "program.h5", "--quiet", "--force")
                et.trace(scene).eigentrail.save(self.folder / "python.h5", overwrite=True)
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
        self.run_well("boundary", scene, "--second", "drag", "--second-from", "0.5", "--second-to", "20", "-o", "program.h5", "--quiet")
        et.boundary(scene, drag=(0.5, 20)).eigentrail.save(self.folder / "python.h5")
        self.assertEqual(differences(self.folder / "program.h5", self.folder / "python.h5"), [])

    def test_a_map_is_that_of_the_program(self):
        scene = SCENES / "rotating_mass.toml"
        self.run_well("map", scene, "--second", "drag", "--second-from", "0.5", "--second-to", "20", "--from", "80", "--to", "5",
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

    def test_the_spectrum_is_by_default_where_the_trace_begins_or_at_the_value_given(self):
        self.assertEqual(set(et.spectrum(SCENES / "rotating_mass.toml").omega), {100.0})
        self.assertEqual(set(et.spectrum(SCENES / "rotating_mass.toml", omega=20).omega), {20.0})
        self.assertEqual(set(et.spectrum(SCENES / "rotating_mass.toml", omega=(30, 5)).omega), {30.0})


class Faults(unittest.TestCase):
    def assert_fails(self, error, text, function, *arguments, **keywords):
        with self.assertRaises(error) as caught:
            function(*arguments, **keywords)
        self.assertIn(text, str(caught.exception))

    def test_bad_scenes_say_what_the_program_says(self):
        self.assert_fails(et.SceneError, "scene:9:1: [trace] from: is missing", et.trace, BLADE.replace("from = 100", "frum = 100"))
        self.assert_fails(et.SceneError, "missing.toml: no such file", et.trace, "missing.toml")
        self.assert_fails(et.SceneError, "/bin/sh: is not a text file", et.trace, "/bin/sh")
        self.assert_fails(TypeError, "expected a scene", et.trace, 3)
        self.assert_fails(et.SceneError, "tolerance", et.trace, BLADE, tolerance=2)
        self.assert_fails(TypeError, "drag: expected a number", et.trace, BLADE, drag=None)
        self.assert_fails(et.SceneError, "at: expected finite numbers", et.spectrum, BLADE, at="x")
        self.assert_fails(ValueError, "is no HDF5 file", et.open, __file__)
        self.assert_fails(FileNotFoundError, "no such folder", et.trace(FAMILY).eigentrail.save, "/nowhere/at/all.h5")

    def test_messages_have_the_words_of_python(self):
        as_dict = tomllib.loads(BLADE)
        for scene, names in (({**as_dict, "gear": [{"ratio": 2}]}, {}), (as_dict, {"drag": "2*dragg"}), (as_dict, {"length": -1}),
                             (as_dict, {"modes": {"band": [2]}}), ({**as_dict, "trace": {"parameter": "omega"}}, {}),
                             (et.Family(M=[[1.0]], K={0: [[1.0]], "k": [[1.0]]}, factors={"k": "q*"}, parameter="p"), {"p": (0, 1)})):
            with self.subTest(names=names), self.assertRaises(et.SceneError) as raised:
                et.trace(scene, **names)
            self.assertNotRegex(str(raised.exception), r"\.toml|:\d+:\d+|--|\.h5")
        self.assert_fails(et.SceneError, "damping_ratio: must lie", et.boundary, BLADE, drag=(1, 2), damping_ratio=3.0)
        self.assert_fails(et.SceneError, "grid: expected at least 2", et.map, BLADE, drag=(1, 2), grid=1)

    def test_a_band_without_modes_is_an_error(self):
        for function, text in ((et.trace, "no mode lies in the band"), (et.spectrum, "none of the modes with Im s between")):
            self.assert_fails(et.TraceError, text, function, BLADE, modes={"band": ["900 Hz", "901 Hz"]})

    def test_all_errors_have_one_base(self):
        for error in (et.SceneError, et.TraceError, et.NotResolved, et.NotProjected):
            self.assertTrue(issubclass(error, et.Error), error)
        self.assertTrue(issubclass(et.NotResolved, et.TraceError))

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

    def test_files_that_exist_are_kept_unless_they_shall_be_replaced(self):
        samples, family = et.Samples([0, 1], M=[[1]], K=[[[1]], [[2]]], parameter="p"), et.Family(M=[[1]], K=[[1]], parameter="p")
        for result, name in ((et.trace(FAMILY).eigentrail, "out.h5"), (family, "family.toml"), (samples, "samples.toml")):
            (self.folder / name).write_text("mine")
            with self.subTest(name), self.assertRaisesRegex(FileExistsError, f"{name}: exists already; .*overwrite=True"):
                result.save(self.folder / name)
            self.assertEqual((self.folder / name).read_text(), "mine")
            self.assertFalse((self.folder / name.replace(".toml", ".h5")).exists() and name != "out.h5")
            result.save(self.folder / name, overwrite=True)
            self.assertNotEqual((self.folder / name).read_bytes(), b"mine")
        self.assertEqual(len(list(self.folder.iterdir())), 5)

    def test_a_pair_that_was_cut_short_is_completed(self):
        family, scene = et.Family(M=[[1]], K=[[1]], parameter="p"), self.folder / "family.toml"
        family.save(scene)
        scene.rename(f"{scene}.partial")  # as a kill between both files leaves it
        family.save(scene)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"family.toml", "family.h5"})
        scene.unlink()
        with self.assertRaises(FileExistsError):
            family.save(scene)

    def test_pipes_are_not_replaced(self):
        os.mkfifo(self.folder / "out.h5")
        with self.assertRaisesRegex(FileExistsError, "no regular file"):
            et.trace(FAMILY).eigentrail.save(self.folder / "out.h5", overwrite=True)

    def test_a_part_of_a_result_cannot_be_saved(self):
        with self.assertRaisesRegex(ValueError, "part or a change"):
            et.trace(FAMILY).isel(mode=[0]).eigentrail.save(self.folder / "out.h5")


if __name__ == "__main__":
    unittest.main()
