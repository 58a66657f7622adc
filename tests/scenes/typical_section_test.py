"""The typical section with unsteady air: roots against state equations set up here (R. T. Jones' approximation of Wagner's
function, Theodorsen's apparent mass), flutter against Theodorsen's function itself, divergence in closed form."""

import unittest

import h5py
import numpy as np
from scipy.optimize import fsolve, least_squares
from scipy.special import hankel2

from program import SCENES, edited
from rotor_test_case import RotorTest, upper
from scene_test_case import CLOSE

A, RATES = np.array([0.165, 0.335]), np.array([0.0455, 0.3])


class Section:
    """Plunge h (down) and pitch of a thin airfoil about the axis at a b behind mid-chord (NACA Report 496)."""

    def __init__(self, p):
        self.b, self.a, self.span, rho = p["b"], p["a"], p["span"], p["density"]
        b, a = self.b, self.a
        self.air = np.pi * rho * b**2 * p["span"]
        m = p["mu"] * np.pi * rho * b**2 * p["span"]
        self.M = m * np.array([[1, p["x_a"] * b], [p["x_a"] * b, (p["r_a"] * b)**2]])
        self.K = m * np.diag([p["w_h"]**2, (p["r_a"] * b * p["w_a"])**2])
        self.air_mass = self.air * np.array([[1, -b * a], [-b * a, b**2 * (1 / 8 + a**2)]])
        self.lift = np.array([1, -b * (a + 1 / 2)])  # per lift, on h and pitch, on the left side
        self.arm = np.array([1, b * (1 / 2 - a)])    # downwash per rates

    def pencil(self, s, V, C):
        """With a function C(s b/V)."""
        b, a = self.b, self.a
        damping = self.air * V * np.array([[0, 1], [0, b * (1 / 2 - a)]])
        circulatory = 2 * self.air * V / b * C(s * b / V) * np.outer(self.lift, self.arm * s + np.array([0, V]))
        return (self.M + self.air_mass) * s**2 + damping * s + self.K + circulatory

    def states(self, V, A=A, rates=RATES):
        """Eigenvalues of the equations with two states behind the downwash."""
        b, a = self.b, self.a
        M = self.M + self.air_mass
        slope = 2 * self.air * V / b
        damping = self.air * V * np.array([[0, 1], [0, b * (1 / 2 - a)]])
        now = 1 - A.sum()
        C = damping + slope * now * np.outer(self.lift, self.arm)
        K = self.K + slope * now * np.outer(self.lift, [0, V])
        system = np.zeros((6, 6))
        system[:2, 2:4] = np.eye(2)
        system[2:4, :2], system[2:4, 2:4] = -np.linalg.solve(M, K), -np.linalg.solve(M, C)
        system[2:4, 4:] = -np.linalg.solve(M, slope * np.outer(self.lift, [1, 1]))
        for i in range(2):
            pace = rates[i] * V / b
            system[4 + i, 1], system[4 + i, 2:4], system[4 + i, 4 + i] = pace * A[i] * V, pace * A[i] * self.arm, -pace
        return upper(np.linalg.eigvals(system))

    def flutter(self, C, guess):
        """Speed and frequency, both with digits of the machine."""
        def real_and_imaginary(x):
            value = np.linalg.det(self.pencil(1j * x[1], x[0], C) / np.diag(self.K)[:, None])
            return [value.real, value.imag]
        return fsolve(real_and_imaginary, guess, xtol=1e-13)


def jones(sb):
    return 1 - sum(A * sb / (sb + RATES))


def theodorsen(sb):
    k = sb / 1j
    return hankel2(1, k) / (hankel2(1, k) + 1j * hankel2(0, k))


def fitted(start, k):
    """Shares and rates of exponentials whose function is closest to Theodorsen's at reduced frequencies."""
    n = len(start) // 2
    exact = theodorsen(1j * k)
    def misses(x):
        gap = (1 - (x[:n, None] * 1j * k / (1j * k + x[n:, None])).sum(axis=0) - exact) / abs(exact)
        return np.concatenate([gap.real, gap.imag])
    x = least_squares(misses, start, xtol=1e-15, ftol=1e-15).x
    return x[:n], x[n:]


def with_exponentials(text, shares, rates):
    return edited(text, "[[lift_lag]]", f"[[lift_lag]]\nA = {list(map(float, shares))}\nb = {list(map(float, rates))}")


class TypicalSection(RotorTest):
    scene = "typical_section"

    def section(self, **changes):
        return Section(self.parameters(**changes))

    def check(self, parameter, begin, end):
        file = self.trace_scene("--parameter", parameter, "--from", repr(begin), "--to", repr(end), "--reference", "1")
        self.assert_follows(file, lambda q: Section(p := self.parameters(**{parameter: q})).states(p["V"]), parameter,
                            np.linspace(begin, end, 40), reference=1.0)

    def test_roots_against_speed_density_and_axis(self):
        for parameter, begin, end in (("V", 5.0, 110.0), ("density", 0.3, 1.3), ("a", -0.45, 0.2)):
            with self.subTest(parameter):
                self.check(parameter, begin, end)

    def test_flutter_speed_and_frequency(self):
        (event,) = self.special_points(self.trace_scene(), "flutter")
        V, w = self.section().flutter(jones, [68.0, 31.0])
        self.assertAlmostEqual(event[0], V, delta=1e-9 * V)
        self.assertAlmostEqual(event[1].imag, w, delta=1e-8 * w)

    def test_divergence_speed(self):
        p = self.parameters()
        I = p["mu"] * np.pi * p["density"] * p["b"]**4 * p["r_a"]**2
        V = np.sqrt(I * p["w_a"]**2 / (2 * np.pi * p["density"] * p["b"]**2 * (p["a"] + 1 / 2)))
        (event,) = self.special_points(self.trace_scene(), "branch_point")
        self.assertAlmostEqual(event[0], V, delta=1e-9 * V)
        summary = self.run_well("trace", SCENES / "typical_section.toml", "-o", "said.h5")
        self.assertRegex(summary, r"onset of instability\n +flutter .*\n +branch_point +V = \S+ .*unstable above")

    def test_jones_is_within_a_percent_of_theodorsen(self):
        """His function misses Theodorsen's by up to 2.4 %, and the flutter speed by half of that."""
        section = self.section()
        V, w = section.flutter(jones, [68.0, 31.0])
        exact_V, exact_w = section.flutter(theodorsen, [V, w])
        k = np.logspace(-2, 1, 200)
        self.assertLess(max(abs(jones(1j * x) - theodorsen(1j * x)) / abs(theodorsen(1j * x)) for x in k), 0.024)
        self.assertLess(abs(V - exact_V), 0.01 * exact_V)
        self.assertGreater(abs(V - exact_V), 0.005 * exact_V)
        self.assertLess(abs(w - exact_w), 0.001 * exact_w)

    def test_other_exponentials_come_closer(self):
        """Two exponentials fitted to Theodorsen's function near the reduced frequency of flutter: three digits."""
        section = self.section()
        exact_V, exact_w = section.flutter(theodorsen, [68.0, 31.0])
        shares, rates = fitted([*A, *RATES], exact_w * section.b / exact_V * np.array([0.8, 0.9, 1.0, 1.1, 1.2]))
        (event,) = self.special_points(self.trace_text(with_exponentials(self.scene_text(), shares, rates)), "flutter")
        self.assertLess(abs(event[0] - exact_V), 5e-4 * exact_V)
        self.assertLess(abs(event[1].imag - exact_w), 5e-4 * exact_w)

    def boundary(self, shares, rates):
        """Curve of flutter over the ratio of frequencies w_h/w_a, and its speeds and frequencies by Theodorsen's function."""
        text = self.changed(a=-0.4, mu=4.0)
        self.write("section.toml", with_exponentials(text, shares, rates))
        out = self.folder / "boundary.h5"
        self.run_well("boundary", "section.toml", "--second", "w_h", "--second-from", "2", "--second-to", "80", "--from", "5", "--to",
                      "50", "--tolerance", "1e-6", "-o", out, "--quiet", "--force")
        with h5py.File(out) as file:
            self.assertEqual(list(file["curve_kind"][:]), [b"flutter"])
            V, w_h, w = file["V"][:], file["w_h"][:], file["eigenvalue"][:].imag
        exact = np.array([self.section(a=-0.4, mu=4.0, w_h=at).flutter(theodorsen, guess) for at, *guess in zip(w_h, V, w)])
        self.assertLess(np.min(w_h), 2.001)
        self.assertGreater(np.max(w_h), 79.999)
        return np.column_stack([V, w]), exact

    def test_whole_boundary_over_the_ratio_of_frequencies(self):
        """The flutter boundary of a section with a = -0.4, x_a = 0.2, r_a = 0.5 and mu = 4: by Jones' function within 2.6 %, by
        four exponentials that are fitted to Theodorsen's function for reduced frequencies of 0.3 to 4.2, within 1e-4."""
        found, exact = self.boundary(A, RATES)
        errors = np.max(abs(found / exact - 1), axis=0)
        self.assertGreater(errors[0], 0.025)
        self.assertLess(errors[0], 0.026)
        self.assertLess(errors[1], 0.01)
        shares, rates = fitted([0.1, 0.2, 0.15, 0.05, 0.04, 0.12, 0.35, 1.0], np.geomspace(0.3, 4.2, 60))
        found, exact = self.boundary(shares, rates)
        self.assertLess(np.max(abs(found / exact - 1)), 1e-4)

    def test_without_lag_and_apparent_mass(self):
        """What is left is quasi-steady: C = 1, and no air is moved."""
        file = self.trace_scene("--without", "lift_lag, apparent_mass", "--to", "80")
        def roots(V):
            section = self.section()
            section.air_mass = np.zeros((2, 2))
            slope = 2 * section.air * V / section.b
            C = slope * np.outer(section.lift, section.arm)
            K = section.K + slope * np.outer(section.lift, [0, V])
            system = np.block([[np.zeros((2, 2)), np.eye(2)],
                               [-np.linalg.solve(section.M, K), -np.linalg.solve(section.M, C)]])
            return upper(np.linalg.eigvals(system))
        self.assert_follows(file, roots, "V", np.linspace(5, 80, 20))


if __name__ == "__main__":
    unittest.main()
