"""verify: a correct file passes, and every kind of wrong file fails with exit code 1."""

import unittest

import h5py
import numpy as np

from program import BLADE, ProgramTest

FREE_ALONG_ITS_AXIS = """
parameters = { speed = 0.0 }
trace = { parameter = "speed", from = 0, to = 1000 }
bearing = [{ node = [1, 3], kxx = 5e5 }]
[[shaft]]
stations = { length = 0.4, outer = 0.04 }
elements = 2
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"
axial = true
"""


class Verify(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", BLADE)
        self.assertEqual(self.run_program("trace", "scene.toml", "-o", "blade.h5").returncode, 0)

    def verify(self, *options):
        return self.run_program("verify", "blade.h5", *options)

    def change(self, edit):
        with h5py.File(self.folder / "blade.h5", "r+") as file:
            edit(file)

    def test_honest_file_passes(self):
        run = self.verify("--samples", "300")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("worst discrepancy", run.stdout)

    def test_the_same_seed_gives_the_same_report(self):
        self.assertEqual(self.verify("--seed", "7").stdout, self.verify("--seed", "7").stdout)

    def assert_passes(self, scene):
        self.write("scene.toml", scene)
        self.assertEqual(self.run_program("trace", "scene.toml", "-o", "blade.h5", "--force").returncode, 0)
        self.assertEqual(self.verify().returncode, 0)

    def test_a_mode_that_comes_from_infinity_passes(self):
        # s^2 = 0.09 / p - 1: beside p = 0 no mode is followed, so that none decays there.
        self.assert_passes("""[trace]
parameter = "p"
from = 1
to = -1
tolerance = 1e-6
[matrix_family]
M = [[[1, 0], [0, 0]]]
K = [[[1, 0.3], [0.3, 0]], [[0, 0], [0, 1]]]
""")

    def test_collisions_of_growing_and_decaying_modes_at_neighbouring_points_pass(self):
        # At each of them two modes are stored whose pair is one behind it.
        self.write("scene.toml", """[trace]
parameter = "p"
from = 0
to = 0.3
[matrix_family]
M = [[[1, 0], [0, 1]]]
C = [[[0.02, 0], [0, 0.022]]]
K = [[[-1, 0], [0, -1.2]], [[0, 1], [-1, 0]]]
""")
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")
        self.assertIn("2 special points against the spectrum there", self.run_well("verify", "loci.h5"))

    def test_equal_real_eigenvalues_that_come_as_a_pair_pass(self):
        """24 equal blades on a ring with drag: QZ makes a pair with a small imaginary part of some of the double real
        eigenvalues."""
        n = 24
        turn = np.roll(np.eye(n), 1, axis=0)
        stiffness = np.eye(n) + 0.3 * (2 * np.eye(n) - turn - turn.T)
        with h5py.File(self.folder / "ring.h5", "w") as file:
            file["M/0"] = file["C/1"] = np.eye(n)
            file["C/0"] = np.zeros((n, n))
            file["K/0"] = stiffness
        self.assert_passes("[trace]\nparameter = \"p\"\nfrom = 0.1\nto = 4\n[matrix_family]\nfile = \"ring.h5\"\n")

    def states_of_mixed_units(self):
        """x' = A x with eight states whose units lie up to 1e8 apart: QZ knows the eigenvalues to 1e-7, the trace to
        1e-10."""
        n = 8
        rate = np.diag(2.0 + np.arange(n)) + 0.1 * np.cos(np.arange(n * n).reshape(n, n))
        units = 10.0 ** np.linspace(-4, 4, n)
        with h5py.File(self.folder / "states.h5", "w") as file:
            file["M/0"] = np.zeros((n, n))
            file["C/0"] = file["K/1"] = np.eye(n)
            file["K/0"] = rate * units[None, :] / units[:, None]
        return ("[trace]\nparameter = \"p\"\nfrom = 0\nto = 4\ntolerance = 1e-10\n"
                "[matrix_family]\nfile = \"states.h5\"\n")

    def test_zeros_that_qz_makes_a_pair_pass_and_one_too_few_does_not(self):
        """A shaft in two bearings that moves freely along its axis: two zeros in its file."""
        self.assert_passes(FREE_ALONG_ITS_AXIS)
        with h5py.File(self.folder / "blade.h5", "r+") as file:
            zeros = np.flatnonzero((file["eigenvalue"][:] == 0.0).all(axis=0))
            self.assertEqual(len(zeros), 2)
            for name in ("eigenvalue", "dense_output"):
                values = file[name][:]
                values[:, zeros[0]] += 1.0  # 1/s
                file[name][:] = values
        self.assertEqual(self.verify().returncode, 1)

    def test_where_qz_is_off_extended_precision_judges(self):
        self.assert_passes(self.states_of_mixed_units())
        self.assertIn("of them refined", self.verify().stdout)

    def test_extended_precision_does_not_forgive(self):
        self.assert_passes(self.states_of_mixed_units())

        def spoil(file):
            file["dense_output"][:, 0] = file["dense_output"][:, 0] * (1 + 3e-10)

        self.change(spoil)
        self.assertEqual(self.verify().returncode, 1)

    def test_a_double_eigenvalue_on_the_whole_range_passes(self):
        """(s + 2 (1 + p))^2"""
        self.assert_passes("[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\ntolerance = 1e-11\n[matrix_family]\n"
                           "M = [[[1]]]\nC = [[[4]], [[4]]]\nK = [[[4]], [[8]], [[4]]]\n")

    def assert_fails(self):
        run = self.verify()
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertIn("the check failed", run.stderr)

    def test_a_slightly_wrong_eigenvalue_or_derivative_fails(self):
        with h5py.File(self.folder / "blade.h5") as file:
            right, tolerance = file["dense_output"][...], file.attrs["tolerance"]
        for function, order, factor in ((0, 0, 1 + 2 * tolerance), (1, 1, 1.01)):  # of BLADE: a function for each mode
            def edit(file):
                series = right.copy()  # step, function, end, order
                series[:, function, :, order] *= factor
                file["dense_output"][...] = series
            with self.subTest(order=order):
                self.change(edit)
                self.assert_fails()

    def test_an_eigenvalue_that_is_not_at_the_edge_of_its_band_fails(self):
        self.assert_passes("[trace]\nparameter = \"p\"\nfrom = 0\nto = 3\nmodes = { band = [3.5, 6] }\n[matrix_family]\n"
                           "M = [ [[1, 0], [0, 1]] ]\nK = [ [[1, 0], [0, 25]], [[2, 0], [0, -10]], [[1, 0], [0, 1]] ]\n")

        def edit(file):
            self.assertTrue(all(b"band_edge" in line for line in file["events"][()]))
            file["event_value"][...] = 3.6
        self.change(edit)
        self.assertIn("has not the value 3.6", self.verify().stderr)

    def test_a_stable_range_behind_the_flutter_of_a_fast_mode_fails(self):
        """Between 0.55 and 0.6 the fast mode grows by 6e-9 of its size, which the dense output does not tell."""
        self.assert_passes("[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [[[1, 0], [0, 1]]]\n"
                           "C = [[[\"(p - 0.3) * (p - 0.55) * (0.6 - p)\", 0], [0, \"1e-3 * (0.45 - p)\"]]]\n"
                           "K = [[[1, 0], [0, 1e8]]]\n")

        def edit(file):
            self.assertEqual(len(file["stable_from"]), 1)
            file["stable_from"][0], file["stable_to"][0] = 0.55, 0.6

        self.change(edit)
        run = self.verify()
        self.assertEqual(run.returncode, 1)
        self.assertIn("a mode grows in the middle of the stable range from p = 0.55 on", run.stdout + run.stderr)

    def test_a_doubled_mode_fails(self):
        def edit(file):
            series = file["dense_output"][...]
            series[:, 1] = series[:, 0]
            file["dense_output"][...] = series
        self.change(edit)
        self.assert_fails()

    def test_another_scene_fails(self):
        def edit(file):
            scene = file.attrs["scene"]
            self.assertIn("length = 5.0", scene)
            file.attrs["scene"] = scene.replace("length = 5.0", "length = 5.01")
        self.change(edit)
        self.assert_fails()

    def assert_refused(self, message):
        run = self.verify()
        self.assertEqual(run.returncode, 2, run.stdout)
        self.assertIn(message, run.stderr)

    def test_a_scene_of_other_coordinates_is_refused(self):
        def edit(file):
            file.attrs["scene"] += "\n[[point]]\nname = \"more\"\nmass = 1\nposition = [0, 0, 0]\n"
        self.change(edit)
        self.assert_refused("its scene has 6 coordinates")

    def test_matrices_are_looked_for_beside_their_scene_only(self):
        with h5py.File(self.folder / "matrices.h5", "w") as file:
            file["M/0"] = file["K/1"] = [[1.0]]
            file["K/0"] = [[4.0]]
        scene = "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nfile = \"matrices.h5\"\n"
        self.assert_passes(scene)
        self.write("scene.toml", scene + "# another one\n")
        self.assert_refused("was made from another scene than scene.toml is now")


if __name__ == "__main__":
    unittest.main()
