"""Coefficients of airfoils from tables, and the factor of Prandtl and Glauert: a wing section on a spring, at rest and its
eigenvalues in closed form."""

import unittest

import numpy as np

from program import SCENES, edited
from rotor_test_case import RotorTest, upper

MASS, SPRING, CHORD, SPAN, DENSITY, SPEED, SOUND = 3.0, 2e5, 0.4, 2.0, 1.2, 60.0, 340.0

SCENE = f"""[parameters]
theta = 0.1
V = {SPEED}
[trace]
parameter = "theta"
from = -0.2
to = 0.3
[[body]]
name = "wing"
mass = {MASS}
inertia = [1, 1, 1]
position = [0, 0, 0]
[[prismatic]]
from = [0, 0, 0]
to = "wing"
axis = [0, 0, 1]
[[guided_spring]]
point = "wing"
direction = [0, 0, 1]
stiffness = {SPRING}
[[strips]]
on = "wing"
root = [0, 0, 0]
tip = [{SPAN}, 0, 0]
chord = {CHORD}
density = {DENSITY}
incidence = "theta"
wind = [0, "-V", 0]
polar = "airfoil.csv"
strips = 2
"""


def lift(a):
    return 0.2 + 5.8 * np.sin(a) - 9.0 * a**3


def lift_slope(a):
    return 5.8 * np.cos(a) - 27.0 * a**2


def odd(a):
    return 1.2 * np.tanh(5 * a) * np.exp(-2 * a**2)


def drag(a):
    return 0.008 + 0.9 * a**2


class Polar(RotorTest):
    def write_table(self, name="airfoil.csv", rows=121, function=lift):
        angles = np.linspace(-25.0, 25.0, rows)
        lines = [f"{a!r}, {function(np.radians(a))!r}, {drag(np.radians(a))!r}" for a in angles]
        self.write(name, "alpha [deg], lift, drag\n" + "\n".join(lines) + "\n")

    def pressure(self, V=SPEED):
        return 0.5 * DENSITY * V * CHORD * SPAN

    def roots(self, a, V=SPEED, factor=1.0):
        """m s^2 + rho/2 V c b (c_l' + c_d) s + k."""
        return upper(np.roots([MASS, self.pressure(V) * (factor * lift_slope(a) + drag(a)), SPRING]))

    def test_deflection_and_damping(self):
        self.write_table()
        file = self.trace_text(SCENE)
        self.assert_follows(file, self.roots, "theta", np.linspace(-0.2, 0.3, 30), tolerance=1e-8)
        p, _ = self.nodes(file)
        np.testing.assert_allclose(self.equilibrium(file, "wing")[:, 2], self.pressure() * SPEED * lift(p) / SPRING,
                                   rtol=1e-8, atol=1e-9)

    def test_error_of_the_interpolant_is_told_and_falls_with_the_rows(self):
        """With an odd function over symmetric rows, of which those that are left out have a mirror image."""
        errors = []
        for rows in (11, 21, 41):
            self.write_table(rows=rows, function=odd)
            text = self.run_well("explain", self.write_scene())
            self.assertIn(f"table of {rows} rows, alpha = -25 to 25 deg", text)
            errors.append(float(text.split("a row that is left out is missed by ")[1].split()[0]))
            file = self.trace_text(SCENE, "--max-step", "0.02", tolerance=1e-4)
            p, _ = self.nodes(file)
            missed = self.equilibrium(file, "wing")[:, 2] * SPRING / (self.pressure() * SPEED) - odd(p)
            self.assertLess(max(abs(missed)), 1.1 * errors[-1])
        self.assertLess(errors[1], errors[0] / 4)
        self.assertLess(errors[2], errors[1] / 4)

    def write_scene(self, text=SCENE):
        self.write("scene.toml", text)
        return self.folder / "scene.toml"

    def test_prandtl_glauert(self):
        self.write_table()
        text = edited(SCENE, "[[strips]]", f"[[strips]]\nspeed_of_sound = {SOUND}")
        text = edited(edited(edited(text, 'parameter = "theta"', 'parameter = "V"'), "from = -0.2", "from = 20"),
                      "to = 0.3", "to = 250")
        file = self.trace_text(text)
        factor = lambda V: 1 / np.sqrt(1 - (V / SOUND)**2)
        self.assert_follows(file, lambda V: self.roots(0.1, V, factor(V)), "V", np.linspace(20, 250, 30), tolerance=1e-8)
        V, _ = self.nodes(file)
        np.testing.assert_allclose(self.equilibrium(file, "wing")[:, 2], self.pressure(V) * V * factor(V) * lift(0.1) / SPRING,
                                   rtol=1e-8)

    def test_sound_is_not_passed(self):
        self.write_table()
        text = edited(SCENE, "[[strips]]", "[[strips]]\nspeed_of_sound = 50")
        self.write("fast.toml", text)
        run = self.run_program("trace", "fast.toml", "-o", "fast.h5")
        self.assertEqual(run.returncode, 2)
        self.assertIn("strips 1, strip 1", run.stderr)

    def test_angles_beyond_the_table_are_told(self):
        self.write_table()
        self.write("far.toml", edited(SCENE, "to = 0.3", "to = 0.6"))
        run = self.run_program("trace", "far.toml", "-o", "far.h5")
        self.assertEqual(run.returncode, 1)
        self.assertIn("strips 1, strip 1", run.stderr)

    def test_flutter_with_a_table_of_a_flat_plate(self):
        """The typical section with lift 2 pi sin alpha from a table, lag included, against the same without one."""
        text = (SCENES / "typical_section.toml").read_text(encoding="utf-8")
        rows = [f"{a!r}, {2 * np.pi * np.sin(a)!r}" for a in np.linspace(-0.3, 0.3, 61)]
        self.write("plate.csv", "alpha [rad], lift\n" + "\n".join(rows) + "\n")
        (expected,) = self.special_points(self.trace_text(text, "--to", "75", tolerance=1e-8), "flutter")
        file = self.trace_text(edited(text, "[[strips]]", '[[strips]]\npolar = "plate.csv"'), "--to", "75", tolerance=1e-8)
        (found,) = self.special_points(file, "flutter")
        self.assertAlmostEqual(found[0], expected[0], delta=1e-8 * expected[0])
        self.assertAlmostEqual(found[1].imag, expected[1].imag, delta=1e-8 * expected[1].imag)

    def test_refusals(self):
        for table, more, message in (
                (None, "", "[[strips]] 1 polar: "),
                ("alpha [deg], lift\n0, 0\n", "", "has one row"),
                ("alpha [deg], cl\n0, 0\n1, 1\n", "", "unknown column 'cl'"),
                ("alpha [m], lift\n0, 0\n1, 1\n", "", "is in m, but rad is expected"),
                ("alpha [deg], lift\n1, 0\n0, 1\n", "", "alpha must ascend"),
                ("lift, drag\n1, 0\n2, 1\n", "", "the first column is the angle of attack"),
                ("alpha [deg], lift\n0, 0\n1, 1\n", "lift_slope = 6\n", "lift_slope: is part of the polar")):
            with self.subTest(message):
                name = "none.csv" if table is None else "bad.csv"
                if table is not None:
                    self.write(name, table)
                run = self.run_program("explain", self.write_scene(SCENE.replace("airfoil.csv", name) + more))
                self.assertEqual(run.returncode, 2)
                self.assertIn(message, run.stderr)


if __name__ == "__main__":
    unittest.main()
