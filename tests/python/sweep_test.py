"""Sweeps over other parameters, and derivatives for optimizers."""

import unittest

import eigentrail as et
import numpy as np
import xarray

from program import BLADE, CROSSING, PUSHED_PENDULUM, SCENES

BLADE_SCENE = SCENES / "rotating_mass.toml"


class Sweeps(unittest.TestCase):
    def test_a_sweep_is_its_traces_side_by_side(self):
        drags = [1, 2, 5]
        swept = et.sweep(BLADE_SCENE, {"drag": drags}, points=[20, 60, 90], tolerance=1e-9)
        self.assertEqual(swept.eigenvalue.dims, ("drag", "omega", "mode"))
        for drag in drags:
            alone = et.trace(BLADE_SCENE, drag=drag, tolerance=1e-9)
            expected = alone.eigentrail.sel(omega=[20, 60, 90])
            for name in ("eigenvalue", "damping_ratio", "damped_frequency", "certified"):
                np.testing.assert_array_equal(swept[name].sel(drag=drag), expected[name])
            flutter = alone.eigentrail.events.query("kind == 'flutter'").omega.iloc[0]
            self.assertEqual(swept.flutter.sel(drag=drag), flutter)
            self.assertEqual(swept.status.sel(drag=drag), "completed")
            run = swept.eigentrail.runs[(drag,)]
            self.assertTrue(run.assign_attrs(seconds=0).identical(alone.assign_attrs(seconds=0)))  # seconds: the time it took

    def test_traces_of_different_lengths_are_nan_behind_their_ends(self):
        """The equilibrium of the second one ends in a fold at p = 0.5."""
        scene = PUSHED_PENDULUM.replace("p = 0.0", "p = 0.0\npush = 1.0").replace('"p*g"', '"p*push*g"')
        swept = et.sweep(scene, {"push": [1.0, 2.0]}, points=[0.2, 0.49, 0.51], tolerance=1e-8)
        self.assertEqual(swept.certified.values[:, :, 0].tolist(), [[1, 1, 1], [1, 1, -1]])
        push = np.outer([1, 2], swept.p)
        hanging = np.sqrt(9.81) * np.where(push < 1, 1 - np.minimum(push, 1) ** 2, np.nan) ** 0.25
        np.testing.assert_allclose(swept.damped_frequency[..., 0], hanging, rtol=1e-6)

    def test_two_parameters_give_two_dimensions(self):
        swept = et.sweep(BLADE, {"drag": [1.0, 2.0], "mass": [40.0, 50.0, 60.0]}, points=11, jobs=2)
        self.assertEqual(dict(swept.sizes), {"drag": 2, "mass": 3, "omega": 11, "mode": 2})
        alone = et.trace(BLADE, drag=2.0, mass=60.0).eigentrail.sel(omega=swept.omega.values)
        np.testing.assert_array_equal(swept.eigenvalue[1, 2], alone.eigenvalue)
        self.assertEqual(swept.drag.attrs, {"units": "1"})

    def test_modes_keep_their_place_where_their_order_changes(self):
        """The modes of two independent oscillators, s^2 = -k and -2: the first one is the second one from k = 2 on."""
        scene = CROSSING.replace("[trace]", "[parameters]\nk = 1\np = 0\n[trace]").replace("K = [[[1, 0], [0, 2]], [[1, 0], [0, -1]]]",
                                                                                  'K = [[["k", 0], [0, 2]], [[0.1, 0], [0, 0]]]')
        swept = et.sweep(scene, {"k": [1.0, 1.6, 2.4, 3.0]}, points=3)
        np.testing.assert_allclose(swept.natural_frequency.isel(p=0), np.transpose([np.sqrt([1, 1.6, 2.4, 3]), np.sqrt([2] * 4)]),
                                   rtol=1e-6)

    def test_what_cannot_be_traced_is_listed_and_stops_nothing(self):
        scene = PUSHED_PENDULUM.replace("p = 0.0", "p = 0.0\npush = 1.0").replace('"p*g"', '"p*push*g"').replace("to = 1.2", "to = 0.5")
        scene = scene.replace("from = 0\n", "from = 0.25\n")
        swept = et.sweep(scene, {"push": [1.0, 5.0]}, points=[0.3, 0.4])
        self.assertEqual(list(swept.status.values), ["completed", "not traced"])
        self.assertIn("equilibrium", str(swept.message.values[1]))
        self.assertTrue(np.isfinite(swept.natural_frequency.values[0]).all())
        self.assertTrue(np.isnan(swept.natural_frequency.values[1]).all())
        self.assertIsInstance(swept.eigentrail.runs[(5.0,)], et.TraceError)

    def test_values_that_are_bad_input_stop_nothing(self):
        swept = et.sweep(BLADE, {"length": [5, -1]}, points=3)
        self.assertEqual(list(swept.status.values), ["completed", "not traced"])
        self.assertIn("length: must be positive; found -1", str(swept.message.values[1]))
        self.assertIsInstance(swept.eigentrail.runs[(-1,)], et.SceneError)


class Gradients(unittest.TestCase):
    """Against central differences of two traces."""

    STEP = 1e-4

    def differences(self, names, value_of):
        values = {name: value for name, _, value in et.engine.engine().read_scene(str(BLADE_SCENE)).parameters}
        for name in names:
            h = self.STEP * abs(values[name])
            low, high = (value_of(et.trace(BLADE_SCENE, tolerance=1e-12, **{name: values[name] + h * sign})) for sign in (-1, 1))
            yield name, (high - low) / (2 * h)

    def test_of_a_flutter_point(self):
        loci = et.trace(BLADE_SCENE, tolerance=1e-10)
        gradient = et.gradient(loci, "flutter")
        for name, expected in self.differences(("drag", "mass", "length", "a_t"),
                                               lambda run: run.eigentrail.events.query("kind == 'flutter'").omega.iloc[0]):
            self.assertAlmostEqual(gradient[name] / expected, 1.0, delta=1e-6)
        self.assertNotIn("omega", gradient.index)

    def test_of_a_mode_at_a_speed(self):
        loci = et.trace(BLADE_SCENE, tolerance=1e-10)
        for quantity, column in (("damping_ratio", "damping_ratio"), ("frequency", "damped_frequency")):
            gradient = et.gradient(loci, quantity, mode="lag", omega=30)
            self.assertAlmostEqual(gradient.attrs["value"], loci.eigentrail.sel(omega=30, mode="lag")[column].item(), places=8)
            for name, expected in self.differences(("drag", "offset"),
                                                   lambda run: run.eigentrail.sel(omega=30, mode="lag")[column].item()):
                self.assertAlmostEqual(gradient[name] / expected, 1.0, delta=1e-5)

    def test_of_the_least_damping_where_it_lies_within_the_range(self):
        """s^2 + 2 z s + 1 with z = a + (p - 0.3)^2: the least damping ratio is a, at p = 0.3."""
        scene = """[parameters]
        a = 0.1
        p = 0
        [trace]
        parameter = "p"
        from = 0
        to = 1
        tolerance = 1e-10
        [matrix_family]
        M = [[[1]]]
        C = [[["2*(a + (p - 0.3)^2)"]]]
        K = [[[1]]]
        """
        loci = et.trace(scene)
        least = et.least_damping(loci)
        self.assertAlmostEqual(least.value, 0.1, places=9)
        self.assertAlmostEqual(least.at, 0.3, places=4)
        self.assertEqual(least.mode, 1)
        gradient = et.gradient(loci, "damping_ratio")
        self.assertAlmostEqual(gradient["a"], 1.0, places=6)
        self.assertEqual(list(gradient.index), ["a"])

    def test_of_nearly_equal_minima(self):
        """damping 0.2 + 0.1 (cos 40 p + 1e-4 p): of six minima the first one is the least, by 1.6e-6."""
        scene = """[trace]
        parameter = "p"
        from = 0
        to = 1
        tolerance = 1e-10
        [matrix_family]
        M = [[[1]]]
        C = [[["2*(0.2 + 0.1*(cos(40*p) + 1e-4*p))"]]]
        K = [[[1]]]
        """
        at = np.linspace(0, 1, 2_000_001)
        exact = 0.2 + 0.1 * (np.cos(40 * at) + 1e-4 * at)
        least = et.least_damping(et.trace(scene))
        self.assertAlmostEqual(least.value, exact.min(), delta=1e-9)
        self.assertAlmostEqual(least.at, at[exact.argmin()], delta=1e-4)

    def test_of_a_mode_that_is_double_for_all_parameters(self):
        """Two equal freedoms, s^2 + k = 0: both have ds/dk = 1j/(2 sqrt(k)). Coupled by c they separate: none has a derivative."""
        scene = """[parameters]
        k = 4
        c = 0
        p = 0
        [trace]
        parameter = "p"
        from = 0
        to = 1
        [matrix_family]
        M = [[[1, 0], [0, 1]]]
        K = [[["k + p", "c"], ["c", "k + p"]]]
        """
        slope = et.gradient(et.trace(scene), "frequency", mode="mode 1", p=0.5)
        self.assertAlmostEqual(slope["k"], 0.5 / np.sqrt(4.5), places=9)
        self.assertTrue(np.isnan(slope["c"]))

    def test_of_a_family_in_memory(self):
        family = et.Family(M=np.eye(2), K={0: np.diag([1.0, 3.0]), "k": np.array([[1.0, 0.2], [0.2, 0.0]]), 1: np.eye(2)},
                           parameter="p", factors={"k": "k"}, parameters={"k": 0.5})
        gradient = et.gradient(et.trace(family, p=(0, 1)), "frequency", mode="mode 1", p=0.5)
        values, vectors = np.linalg.eigh(np.diag([1.5, 3.5]) + 0.5 * np.array([[1.0, 0.2], [0.2, 0.0]]))
        z = vectors[:, 0]
        expected = z @ np.array([[1.0, 0.2], [0.2, 0.0]]) @ z / (2 * np.sqrt(values[0]))
        self.assertAlmostEqual(gradient["k"], expected, places=9)

    def test_mistakes(self):
        loci = et.trace(BLADE_SCENE)
        for arguments, keywords, text in ((("flatter",), {}, "expected one of"), (("flutter",), {"event": 3}, "has 1 flutter"),
                                          (("frequency",), {}, "value of the traced parameter"),
                                          (("frequency",), {"omega": 30}, "expected the mode"),
                                          (("frequency",), {"omega": 30, "mode": "wag"}, "expected one of")):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                et.gradient(loci, *arguments, **keywords)


if __name__ == "__main__":
    unittest.main()
