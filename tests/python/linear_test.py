"""Linearized equations from Python: those of the program, and state-space matrices with inputs and outputs."""

import unittest
import warnings

import eigentrail as et
import numpy as np

from program import BLADE, PUSHED_PENDULUM, SCENES, ProgramTest

G = 9.81


class Linearize(ProgramTest):
    def test_arrays_are_those_of_the_program(self):
        scene = SCENES / "hinged_blade.toml"
        for at in (30, [20, 40]):
            values = [str(value) for value in np.atleast_1d(at)]
            self.run_well("linearize", scene, "--at", *values, "-o", "linear.npz", "--force", "-q")
            of_program, model = np.load(self.folder / "linear.npz"), et.linearize(scene, at)
            self.assertEqual({*model, "eigentrail"}, set(of_program))
            for name, array in model.items():
                np.testing.assert_array_equal(array, of_program[name])
        np.testing.assert_array_equal(et.linearize(scene, omega=30).K, et.linearize(scene, 30).K)
        self.assertEqual(et.linearize(scene, [30]).K.ndim, 3)

    def test_state_space_of_a_pushed_pendulum(self):
        # About sin(angle) = p = 0.6: q'' + g cos(angle) q = g dp, dx = q cos(angle) and dz = q sin(angle), up to the sign of q.
        model = et.linearize(PUSHED_PENDULUM, 0.6, inputs=["p"])
        system = model.state_space(["bob.x", "rate of bob.z"])
        np.testing.assert_allclose(np.linalg.eigvals(system.A).imag.max(), np.sqrt(G * 0.8), rtol=1e-13)
        for s in (0.0, 1.0j, 2.0 + 1.0j):
            transfer = system.C @ np.linalg.solve(s * np.eye(2) - system.A, system.B) + system.D
            displacement = G / (s * s + G * 0.8)
            np.testing.assert_allclose(transfer[:, 0], [0.8 * displacement, 0.6 * s * displacement], rtol=1e-12)
        self.assertEqual(model.state_space().C.shape, (3, 2))

    def test_rates_without_mass_have_feedthrough(self):
        # A damper behind a spring: c x' + k x = 0 with x a coordinate of first order.
        family = et.Family(M=np.diag([1.0, 0.0]), C=np.diag([0.0, 0.5]), K=np.array([[3.0, -2.0], [-2.0, 2.0]]), names=["x", "damper"], parameter="p")
        model = et.linearize(family, 0)
        self.assertEqual(model.rate_names, ["x"])
        system = model.state_space(["rate of damper"])
        np.testing.assert_allclose(system.C, [[4.0, -4.0, 0.0]])
        for s in et.spectrum(family, 0).eigenvalue:
            self.assertLess(np.abs(np.linalg.eigvals(system.A) - s).min(), 1e-13)

    def test_equations_without_derivatives_are_solved(self):
        # The wing has rotations without inertia.
        model = et.linearize(SCENES / "goland_wing.toml")
        found = np.linalg.eigvals(model.state_space().A)
        modes = et.spectrum(SCENES / "goland_wing.toml").head(8)
        for s in modes.eigenvalue:
            self.assertLess(np.abs(found - s).min(), 1e-9 * abs(s))

    def test_equations_without_derivatives_feed_through(self):
        # x'' + 3 (x - y) = 0 and 0 = 3 (y - x) + y - u: y = (3 x + u) / 4.
        held = [{"point": point, "coordinate": axis} for point in ("a", "b") for axis in "yz"]
        model = et.linearize({"parameters": {"u": 0.0, "k": 1.0}, "trace": {"parameter": "k", "from": 1, "to": 2},
                              "point": [{"name": "a", "mass": 1, "position": [1, 0, 0]}, {"name": "b", "mass": 0, "position": [2, 0, 0]}],
                              "spring": [{"from": "a", "to": "b", "stiffness": 3, "free_length": 1},
                                         {"from": "b", "to": [3, 0, 0], "stiffness": "k", "free_length": 1}],
                              "force": [{"point": "b", "components": ["u", 0, 0]}], "fixed": held}, inputs=["u"])
        system = model.state_space(["a.x", "rate of a.x", "b.x"])
        self.assertEqual(system.A.shape, (2, 2))
        np.testing.assert_allclose(system.D[:, 0], [0, 0, 0.25], atol=1e-15)
        for s in (0.0, 1.0j, 2.0 + 1.0j):
            transfer = system.C @ np.linalg.solve(s * np.eye(2) - system.A, system.B) + system.D
            x = 0.75 / (s * s + 0.75)
            np.testing.assert_allclose(transfer[:, 0], [x, s * x, (3 * x + 1) / 4], rtol=1e-12)
        with self.assertRaisesRegex(et.SceneError, "output 'rate of b.x': contains the rate of an input"):
            model.state_space(["rate of b.x"])

    def test_mistakes(self):
        several = et.linearize(SCENES / "hinged_blade.toml", [20, 40])
        with self.assertRaisesRegex(et.SceneError, "expected the model of one value of the parameter, found 2"):
            several.state_space()
        with self.assertRaisesRegex(et.SceneError, "output 'blade.w': expected a coordinate, or 'rate of ' one; did you mean"):
            et.linearize(SCENES / "hinged_blade.toml").state_space(["blade.w"])
        with self.assertRaisesRegex(AttributeError, "no array 'F'; it has M, C, K"):
            several.F
        with self.assertRaisesRegex(et.SceneError, "input 'q': expected a parameter"):
            et.linearize(PUSHED_PENDULUM, inputs=["q"])
        twice = et.Family(E=np.diag([0.0, 1.0]), A=[[[0.0, 1.0], [1.0, 0.0]]], parameter="p")  # 0 = x2, x2' = x1
        with self.assertRaisesRegex(et.SceneError, "cannot be solved for as many states"):
            et.linearize(twice, 0).state_space()
        with self.assertRaisesRegex(et.TraceError, "1.1: "):
            et.linearize(PUSHED_PENDULUM, 1.1)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            self.assertEqual(et.linearize(PUSHED_PENDULUM, [0.5, 1.1]).p, [0.5])
            et.sweep(BLADE, {"drag": [1.0]}, options={"max_nodes": 2}, points=2)
        self.assertEqual([warning.filename for warning in told], [__file__, __file__])


if __name__ == "__main__":
    unittest.main()
