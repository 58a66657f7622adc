"""`eigentrail linearize`: matrices with the eigenvalues of `spectrum`, in every format, and back through `import`."""

import json
import re
import unittest

import numpy as np
import scipy.io

from command_test_case import CommandTest
from program import EXIT_BAD_INPUT, EXIT_NUMBERS_FAILED, FAMILY, PUSHED_PENDULUM, SCENES

G = 9.81


def backward_error(s, A, E):
    """
    How far A - s E is from a singular matrix, relative to its entries, with rows and columns scaled by them: at most as long as what
    it makes of some vector of length one. Nearly singular, its inverse turns any vector into one that it makes least of.
    """
    P, size = A - s * E, abs(A) + abs(s) * abs(E)
    rows = size.max(axis=1, keepdims=True)
    columns = (size / rows).max(axis=0, keepdims=True)
    try:
        return 1.0 / np.linalg.norm(np.linalg.solve(P / rows / columns, np.full(len(P), len(P)**-0.5)))
    except np.linalg.LinAlgError:  # it is singular
        return 0.0


class Linearize(CommandTest):
    def spectrum(self, scene, *options):
        rows = json.loads(self.run_well("spectrum", scene, "--modes", "all", "--json", *options))
        return [complex(row["real"], row["imag"]) for row in rows]

    def linearized(self, scene, *options, output="linear.npz"):
        self.run_well("linearize", scene, "-o", output, "--force", "-q", *map(str, options))
        return np.load(self.folder / output) if output.endswith(".npz") else self.folder / output

    def test_every_scene_has_the_eigenvalues_of_its_spectrum(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene.stem):
                model = self.linearized(scene)
                found = self.spectrum(scene)
                self.assertGreaterEqual(2 * len(found), len(model["M"]))
                for s in found:
                    self.assertLess(backward_error(s, model["state_A"], model["state_E"]), 1e-12)

    def test_full_matrices_reduce_to_the_others(self):
        model = self.linearized(SCENES / "hinged_blade.toml", "--at", "20", "40")
        T = model["T"]
        np.testing.assert_array_equal(model["omega"], [20, 40])
        np.testing.assert_allclose(T.transpose(0, 2, 1) @ T, np.broadcast_to(np.eye(3), (2, 3, 3)), atol=1e-14)
        np.testing.assert_allclose(model["constraints"] @ T, 0, atol=1e-13)
        for name in "MCK":
            full = model[name + "_full"]
            np.testing.assert_allclose(T.transpose(0, 2, 1) @ full @ T, model[name], atol=1e-13 * np.abs(full).max())
        self.assertEqual(model["x"].shape, (2, len(model["coordinate_names"])))
        self.assertEqual(model["lambda"].shape, (2, len(model["constraint_names"])))

    def test_pushed_pendulum_by_hand(self):
        # sin(angle) = p; along the circle m q'' + m g cos(angle) q = m g dp, and x = p, z = -cos(angle).
        self.write("scene.toml", PUSHED_PENDULUM)
        model = self.linearized("scene.toml", "--at", "0.6", "--inputs", "p")
        np.testing.assert_allclose(model["M"], [[1.0]], rtol=1e-14)
        np.testing.assert_allclose(model["C"], [[0.0]], atol=1e-14)
        np.testing.assert_allclose(model["K"], [[G * 0.8]], rtol=1e-13)
        np.testing.assert_allclose(np.abs(model["F"]), [[G]], rtol=1e-13)
        moves = model["T"] @ np.linalg.solve(model["K"], model["F"])
        names = list(model["coordinate_names"])
        np.testing.assert_allclose(moves[[names.index("bob.x"), names.index("bob.z")], 0], [1.0, 0.75], rtol=1e-13)
        np.testing.assert_array_equal(model["state_B"], np.vstack([np.zeros((1, 1)), model["F"]]))
        self.assertEqual(list(model["input_names"]), ["p"])

    def test_a_coordinate_without_mass_has_no_rate(self):
        model = self.linearized(SCENES / "lag_damper.toml")
        self.assertEqual(model["state_E"].shape, (3, 3))
        self.assertEqual(len(model["rate_names"]), 1)

    def test_states_are_the_same_at_all_values(self):
        """A coordinate that has no mass at one of them."""
        self.write("scene.toml", '[trace]\nparameter = "m"\nfrom = 0\nto = 1\n[matrix_family]\nM = [[[1, 0], [0, 0]], [[0, 0], [0, 1]]]\n'
                                 'C = [[[0, 0], [0, 1]]]\nK = [[[4, -1], [-1, 2]]]\n')
        model = self.linearized("scene.toml", "--at", "0", "1")
        self.assertEqual(model["state_E"].shape, (2, 4, 4))
        self.assertEqual(np.linalg.matrix_rank(model["state_E"]).tolist(), [3, 4])
        self.assertEqual(self.linearized("scene.toml", "--at", "0")["state_E"].shape, (3, 3))

    def test_formats_hold_the_same_numbers(self):
        scene = SCENES / "hinged_blade.toml"
        for values in (["20"], ["20", "40"]):
            model = self.linearized(scene, "--at", *values)
            mat = scipy.io.loadmat(self.linearized(scene, "--at", *values, output="linear.mat"))
            text = json.loads(self.linearized(scene, "--at", *values, output="linear.json").read_text())
            self.assertEqual(set(model), set(text))
            for name in model:
                with self.subTest(name, values=values):
                    in_matlab = mat[name]
                    if model[name].dtype.kind == "U":
                        self.assertEqual([str(one[0]) for one in in_matlab[:, 0]], list(model[name]))
                        self.assertEqual(text[name], list(model[name]))
                        continue
                    if len(values) > 1:
                        in_matlab = np.moveaxis(in_matlab, -1, 0)
                    np.testing.assert_array_equal(in_matlab.reshape(model[name].shape), model[name])
                    np.testing.assert_array_equal(np.array(text[name]), model[name])
        one = self.linearized(scene, "--at", "20")
        folder = self.linearized(scene, "--at", "20", output="folder")
        for name in ("M", "K_full", "constraints", "T"):
            np.testing.assert_array_equal(scipy.io.mmread(folder / f"{name}.mtx").toarray(), one[name])
        self.assertEqual(json.loads((folder / "model.json").read_text())["coordinate_names"], list(one["coordinate_names"]))

    def test_import_reads_them_back(self):
        scene = SCENES / "hinged_blade.toml"
        expected = self.spectrum(scene, "--at", "30")
        self.linearized(scene, "--at", "20:5:40", output="blade.npz")
        self.linearized(scene, "--at", "20:5:40", output="blade.mat")
        for form in ("numpy", "matlab"):
            self.run_well("import", form, "blade." + {"numpy": "npz", "matlab": "mat"}[form], "-o", form, "--unit", "rad/s")
            found = self.spectrum(f"{form}/blade.toml", "--at", "30")
            np.testing.assert_allclose(found, expected, rtol=1e-12)
        self.linearized(scene, "--at", "30", output="matrices")
        self.run_well("import", "matrix-market", *[f"matrices/{name}.mtx" for name in "MCK"], "-o", "market")
        found = self.spectrum("market/" + next((self.folder / "market").glob("*.toml")).name)
        np.testing.assert_allclose(found, expected, rtol=1e-12)

    def test_names_in_other_letters(self):
        self.write("scene.toml", FAMILY + 'state_names = ["Δφ", "x"]\n')
        self.assertEqual(list(self.linearized("scene.toml")["state_names"]), ["Δφ", "x"])
        mat = scipy.io.loadmat(self.linearized("scene.toml", output="linear.mat"))
        self.assertEqual(str(mat["state_names"][0, 0][0]), "Δφ")
        self.run_well("import", "matlab", "linear.mat", "-o", "back")
        self.assertIn("Δφ", self.run_well("spectrum", "back/linear.toml"))

    def test_mistakes(self):
        self.write("scene.toml", PUSHED_PENDULUM)
        self.write("family.toml", FAMILY)
        for options, message in [
                (["scene.toml", "--inputs", "q"], "input 'q': expected a parameter of the scene"),
                (["family.toml", "--inputs", "p"], "input 'p': a rotor, or a family of matrices, has no forces"),
                (["scene.toml", "--inputs", "p, p"], "input 'p': is given twice"),
                ([SCENES / "double_pendulum.toml", "--inputs", "l2"], "input 'l2': changes the constraint"),
                (["scene.toml", "-o", "linear.csv"], "linear.csv: expected a name that ends in .npz, .mat or .json"),
                (["scene.toml", "-o", "folder", "--at", "0", "0.5"], "holds the matrices of one value; found 2 values")]:
            with self.subTest(message):
                run = self.run_program("linearize", *map(str, options))
                self.assertEqual(run.returncode, EXIT_BAD_INPUT, run.stderr)
                self.assertIn(message, run.stderr)
        self.run_well("linearize", "scene.toml", "-o", "linear.npz")
        self.assertIn("exists already", self.run_program("linearize", "scene.toml", "-o", "linear.npz").stderr)
        np.savez(self.folder / "other.npz", M=np.eye(2))
        for name, text in (("other.json", '{"name": "a package"}'), ("other.mat", "MATLAB 5.0")):
            self.write(name, text)
        for name in ("other.npz", "other.json", "other.mat"):
            self.assertIn("is no readable ", self.run_program("linearize", "scene.toml", "-o", name, "--force").stderr)

    def test_a_folder_has_the_matrices_of_one_model(self):
        self.write("scene.toml", PUSHED_PENDULUM)
        self.run_well("linearize", "scene.toml", "--inputs", "p", "-o", "folder")
        run = self.run_program("linearize", "scene.toml", "-o", "folder", "--force")
        self.assertEqual(run.returncode, EXIT_BAD_INPUT)
        self.assertRegex(run.stderr, r"folder/(F|F_full|state_B)\.mtx: is a matrix of something else")
        self.run_well("linearize", "scene.toml", "--inputs", "p", "-o", "folder", "--force")

    def test_inputs_without_force_are_noted(self):
        """Drag where nothing moves: a column of zeros, and a warning."""
        run = self.run_program("linearize", SCENES / "watt_governor.toml", "--inputs", "dashpot", "-o", "linear.npz")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("input 'dashpot' exerts no force at this equilibrium", run.stderr)
        self.assertTrue((np.load(self.folder / "linear.npz")["F"] == 0).all())

    def test_a_trimmed_parameter_is_an_input(self):
        """Collective pitch: as the same parameter without its trim."""
        text = (SCENES / "air_resonance.toml").read_text(encoding="utf-8")
        self.write("scene.toml", text)
        model = self.linearized("scene.toml", "--inputs", "pitch")
        pitch = float(model["trimmed"][list(model["trimmed_names"]).index("pitch")])
        self.assertGreater(np.abs(model["F"]).max(), 1.0)
        self.write("free.toml", re.sub(r"(?m)^thrust .*$|^\[\[trim\]\]\n(.+\n)+", "", text))
        one = self.linearized("free.toml", "--set", f"pitch={pitch!r}", "--inputs", "pitch")
        np.testing.assert_allclose(one["F_full"], model["F_full"], rtol=1e-8, atol=1e-8 * np.abs(model["F_full"]).max())

    def test_a_parameter_with_the_name_of_a_matrix(self):
        self.write("scene.toml", '[trace]\nparameter = "E"\nfrom = 1\nto = 2\n[matrix_family]\nM = [[[1]]]\nK = [[[1]], [[1]]]\n')
        self.assertIn("parameter", self.linearized("scene.toml", "--at", "1", "1.5", "2"))
        self.run_well("import", "numpy", "linear.npz", "-o", "back")

    def test_a_value_without_equilibrium_is_left_out(self):
        self.write("scene.toml", PUSHED_PENDULUM)
        run = self.run_program("linearize", "scene.toml", "--at", "0.5", "1.1", "-o", "linear.npz")
        self.assertEqual(run.returncode, EXIT_NUMBERS_FAILED)
        self.assertIn("p = 1.1: ", run.stderr)
        self.assertEqual(np.load(self.folder / "linear.npz")["p"], 0.5)


if __name__ == "__main__":
    unittest.main()
