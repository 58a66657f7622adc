"""Goland's wing: flutter and divergence of a beam with strips against the differential equations of the wing, solved by an
exponential of a matrix, with R. T. Jones' and with Theodorsen's function."""

import unittest

import h5py
import numpy as np
from scipy.linalg import expm
from scipy.optimize import fsolve
from scipy.special import hankel2

from program import edited
from rotor_test_case import RotorTest

LENGTH, CHORD, MASS, INERTIA = 6.096, 1.8288, 35.71, 8.64
EI, GJ, GA, DENSITY = 9.77e6, 0.987e6, 1e10, 1.225
HALF, AXIS, UNBALANCE = CHORD / 2, -0.34, 0.1 * CHORD * MASS


def jones(sb):
    return 1 - 0.165 * sb / (sb + 0.0455) - 0.335 * sb / (sb + 0.3)


def theodorsen(sb):
    k = sb / 1j
    return hankel2(1, k) / (hankel2(1, k) + 1j * hankel2(0, k))


def boundary_determinant(s, V, C, density=DENSITY):
    """Zero at eigenvalues: forces and moments at the tip, of three solutions that are clamped at the root. Along the span: the
    deflection h (down), the slope, bending moment, shear force, pitch, torque."""
    b, a, air, c = HALF, AXIS, np.pi * density * HALF**2, C(s * HALF / V)
    around = V + b * (1 / 2 - a) * s  # downwash per pitch
    lift = [air * s**2 + 2 * air * V / b * c * s, air * (V * s - b * a * s**2) + 2 * air * V / b * c * around]
    moment = [air * b * a * s**2 + 2 * air * V * (a + 1 / 2) * c * s,
              air * (-V * b * (1 / 2 - a) * s - b**2 * (1 / 8 + a**2) * s**2) + 2 * air * V * (a + 1 / 2) * c * around]
    slope = np.zeros((6, 6), complex)
    slope[0, 1], slope[0, 3] = 1, 1 / GA
    slope[1, 2], slope[2, 3], slope[4, 5] = 1 / EI, -1, 1 / GJ
    slope[3, 0], slope[3, 4] = MASS * s**2 + lift[0], UNBALANCE * s**2 + lift[1]
    slope[5, 0], slope[5, 4] = UNBALANCE * s**2 - moment[0], INERTIA * s**2 - moment[1]
    return np.linalg.det(expm(slope * LENGTH)[np.ix_([2, 3, 5], [2, 3, 5])])


def flutter(C, density=DENSITY, guess=(137.0, 70.0)):
    """Speed and frequency."""
    def equations(x):
        value = boundary_determinant(1j * x[1], x[0], C, density)
        return [value.real, value.imag]
    return fsolve(equations, guess, xtol=1e-12)


def standard_density(altitude):
    """ISO 2533: hydrostatic equilibrium of an ideal gas that cools by 6.5 K/km."""
    return DENSITY * (1 - 0.0065 * altitude / 288.15)**(9.80665 / (287.05287 * 0.0065) - 1)


class GolandWing(RotorTest):
    scene = "goland_wing"

    def with_elements(self, n, strips=2):
        return edited(edited(self.scene_text(), "elements     = 8", f"elements = {n}"),
                      "[[strips]]", f"[[strips]]\nstrips = {strips}")

    def found_flutter(self, text):
        file = self.trace_text(text, "--from", "137", "--to", "137.6", "--modes", "band = ['10 Hz', '14 Hz'], count = 1",
                               tolerance=1e-6)
        (event,) = self.special_points(file, "flutter")
        return np.array([event[0], event[1].imag])

    def test_flutter_converges_to_the_differential_equations(self):
        exact = flutter(jones)
        errors = [abs(self.found_flutter(self.with_elements(n)) / exact - 1) for n in (3, 6, 12)]
        for coarse, fine in zip(errors, errors[1:]):
            np.testing.assert_array_less(np.log2(3.5), np.log2(coarse / fine))
        np.testing.assert_array_less(errors[2], 1e-6)

    def test_more_strips_change_nothing_that_the_elements_resolve(self):
        exact = flutter(jones)
        two, three = (self.found_flutter(self.with_elements(8, n)) for n in (2, 3))
        np.testing.assert_array_less(abs(two / exact - 1), 2e-6)
        np.testing.assert_array_less(abs(three / exact - 1), 2e-6)

    def test_published_flutter(self):
        """Goland and Luke; Theodorsen's function itself: 136.95 m/s, 70.0 rad/s. Jones' function is 0.3 % and 1 % off."""
        V, w = self.found_flutter(self.scene_text())
        exact = flutter(theodorsen)
        self.assertAlmostEqual(V, exact[0], delta=0.003 * exact[0])
        self.assertAlmostEqual(w, exact[1], delta=0.01 * exact[1])
        self.assertAlmostEqual(V, 137.0, delta=0.5)
        self.assertAlmostEqual(w, 70.0, delta=0.7)

    def test_divergence(self):
        """In closed form: a rod in torsion, its lift 8 % of the chord before it. The lag does not matter at rest."""
        pressure = (np.pi / 2)**2 * GJ / (0.08 * CHORD**2 * 2 * np.pi * LENGTH**2)
        expected = np.sqrt(2 * pressure / DENSITY)
        errors = []
        for n in (3, 6, 12):
            file = self.trace_text(self.with_elements(n), "--from", "252", "--to", "252.6", "--modes", "1", "--without",
                                   "lift_lag", "--reference", "10", tolerance=1e-6)
            (found,) = self.event_parameters(file, "branch_point")
            errors.append(abs(found / expected - 1))
        for coarse, fine in zip(errors, errors[1:]):
            self.assertGreater(np.log2(coarse / fine), 3.5)
        self.assertLess(errors[2], 1e-6)

    def over_altitude(self, text, kinds, begin, end):
        """Speeds, imaginary parts and altitudes of the first curve over the standard atmosphere; `kinds`: of all curves."""
        self.write("wing.toml", text)
        out = self.folder / "altitude.h5"
        self.run_well("boundary", "wing.toml", "--second", "altitude", "--second-from", "0", "--second-to", "11000", "--from", begin,
                      "--to", end, "--lines", "1", "--tolerance", "1e-6", "-o", out, "--quiet", "--force")
        with h5py.File(out) as file:
            self.assertEqual(list(file["curve_kind"][:]), kinds)
            is_on_it = file["point_curve"][:] == 0
            V, altitude, w = (file[name][:][is_on_it] for name in ("V", "altitude", "eigenvalue"))
            w = w.imag
        self.assertEqual((round(np.min(altitude)), round(np.max(altitude))), (0, 11000))
        return V, w, altitude

    def test_flutter_over_altitude(self):
        """Three elements, as exact as their convergence tells."""
        for *found, altitude in zip(*self.over_altitude(self.with_elements(3), [b"flutter"], 100, 250)):
            exact = flutter(jones, standard_density(altitude), found)
            np.testing.assert_array_less(abs(np.array(found) / exact - 1), 3e-4)

    def test_divergence_over_altitude(self):
        """Its dynamic pressure is the same at all altitudes."""
        text = edited(edited(self.with_elements(3), 'modes = { band = ["1 Hz", "60 Hz"], count = 4 }', "modes = 2"),
                      "[[lift_lag]]", "#")
        V, _, altitude = self.over_altitude(text, [b"divergence", b"flutter"], 200, 500)
        pressure = (np.pi / 2)**2 * GJ / (0.08 * CHORD**2 * 2 * np.pi * LENGTH**2)
        np.testing.assert_allclose(V, np.sqrt(2 * pressure / standard_density(altitude)), rtol=2e-4)

    def test_twist_of_a_wing_at_incidence_grows_towards_divergence(self):
        """alpha_0 (1/cos(lambda L) - 1) at the tip, lambda^2 = q e a c / GJ."""
        text = edited(self.with_elements(6), "[[strips]]", "[[strips]]\nincidence = 1e-4\nlift_slope = 6.0")
        file = self.trace_text(text, "--from", "150", "--to", "240", "--modes", "1", "--without", "lift_lag, apparent_mass",
                               tolerance=1e-4)
        V, _ = self.nodes(file)
        twist = self.equilibrium(file, "wing.tip.y_axis")[:, 2]
        rate = LENGTH * np.sqrt(DENSITY / 2 * V**2 * 0.08 * CHORD**2 * 6.0 / GJ)
        np.testing.assert_allclose(twist, 1e-4 * (1 / np.cos(rate) - 1), rtol=1e-4)


if __name__ == "__main__":
    unittest.main()
