"""Whirl flutter of a propeller on a nacelle: all roots against yaw and pitch of the nacelle with derivatives of the propeller in
closed form, for panels and for the integral over the span; an isotropic mount; the boundary over both stiffnesses."""

import unittest

import h5py
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from program import edited
from rotor_test_case import RotorTest, companion

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])


class Propeller:
    """Rotations (about x, about y) of the nacelle on the ground. A section at r and azimuth psi of a blade along its helix, at
    the angle phi to the disc, feels the downwash w = c/2 d'.e_r - d'.g + V sin phi d.e_r, and its lift rho c a W w/2 has the
    moment times g = h sin phi e_r - r cos phi e_psi. Averages over three blades or more: of e_r e_r^T and e_psi e_psi^T half the
    unit matrix, of e_psi e_r^T half a quarter turn."""

    blades, lift_slope = 4, 2 * np.pi

    def __init__(self, p):
        self.p = p
        self.length = p["radius"] - p["root"]

    def section(self, r, V):
        """Stiffness and damping per length of span, all blades together."""
        p, turn = self.p, V / (self.p["advance"] * self.p["radius"])
        W = np.hypot(turn * r, V)
        axial, along = p["ahead"] * V / W, r * turn * r / W
        force = 0.25 * self.blades * p["density"] * p["chord"] * self.lift_slope * W
        arm = axial * np.eye(2) - along * QUARTER_TURN
        return -force * V**2 / W * arm, force * ((axial**2 + along**2) * np.eye(2) - 0.5 * p["chord"] * arm)

    def matrices(self, V, panels=4):
        p = self.p
        mass, h, middle = p["blade_mass"], p["ahead"], 0.5 * (p["root"] + p["radius"])
        blade = mass * (self.length**2 / 12 + middle**2)
        M = (p["nacelle"] + self.blades * (mass * h**2 + 0.5 * blade)) * np.eye(2)
        turn = V / (p["advance"] * p["radius"])
        C = -self.blades * blade * turn * QUARTER_TURN + p["damping"] * np.eye(2)
        K = np.diag([p["k_yaw"], p["k_pitch"]])
        for i in range(panels):
            stiffness, damping = self.section(p["root"] + (i + 0.5) * self.length / panels, V)
            K, C = K + stiffness * self.length / panels, C + damping * self.length / panels
        return M, C, K

    def roots(self, V, panels=4):
        return companion(*self.matrices(V, panels))

    def flutter(self, guess, panels=4):
        return brentq(lambda V: np.max(self.roots(V, panels).real), *guess, xtol=1e-13)


class WhirlFlutter(RotorTest):
    scene = "whirl_flutter"

    def propeller(self, **changes):
        return Propeller(self.parameters(**changes))

    def test_roots_against_speed(self):
        file = self.trace_scene()
        self.assert_follows(file, self.propeller().roots, "V", np.linspace(20, 140, 30))

    def test_roots_against_the_stiffness_in_yaw(self):
        """A mount that is not isotropic: nothing stands still in any frame but the ground."""
        file = self.trace_scene("--parameter", "k_yaw", "--from", "0.8e5", "--to", "4e5")
        self.assert_follows(file, lambda k: self.propeller(k_yaw=k).roots(60.0), "k_yaw", np.linspace(0.8e5, 4e5, 30))

    def test_isotropic_mount_whirls_backward(self):
        """With z = d_x + j d_y two quadratics remain, one for each sense of whirl; it is the backward one that flutters."""
        (event,) = self.special_points(self.trace_scene(), "flutter")
        V = self.propeller().flutter([60, 110])
        self.assertAlmostEqual(event[0], V, delta=1e-9 * V)
        M, C, K = self.propeller().matrices(V)
        one = lambda A: A[0, 0] + 1j * A[1, 0]
        unstable = max(np.roots([one(M), one(C), one(K)]), key=lambda s: s.real)
        self.assertAlmostEqual(unstable.real, 0.0, delta=1e-9)
        self.assertLess(unstable.imag, 0.0)  # the propeller turns in the positive sense
        self.assertAlmostEqual(-unstable.imag, event[1].imag, delta=1e-8)

    def test_panels_converge_to_the_integral_over_the_span(self):
        p = self.propeller()
        V = 80.0
        def integral(k, i, j):
            return quad(lambda r: p.section(r, V)[k][i, j], p.p["root"], p.p["radius"], epsabs=1e-12)[0]
        M, C, K = p.matrices(V, 0)
        C = C + [[integral(1, i, j) for j in (0, 1)] for i in (0, 1)]
        K = K + [[integral(0, i, j) for j in (0, 1)] for i in (0, 1)]
        exact = companion(M, C, K)
        errors = [np.max(abs(np.sort_complex(p.roots(V, n)) - np.sort_complex(exact))) for n in (4, 8)]
        self.assertLess(errors[0], 0.05)
        self.assertAlmostEqual(errors[0] / errors[1], 4.0, delta=0.3)

    def test_rotors_without_gyroscopic_moments_would_not_flutter(self):
        """What whirl flutter is: the rival model leaves the angular momentum of the propeller out."""
        p = self.propeller()
        V = p.flutter([60, 110])
        M, C, K = p.matrices(1.2 * V)
        self.assertGreater(np.max(companion(M, C, K).real), 0.0)
        C = 0.5 * (C + C.T)
        self.assertLess(np.max(companion(M, C, K).real), 0.0)

    def test_boundary_over_both_stiffnesses(self):
        """Symmetric in yaw and pitch, and furthest out where both are equal."""
        out = self.folder / "mount.h5"
        self.write("whirl.toml", self.changed(V=100.0))
        self.run_well("boundary", "whirl.toml", "--parameter", "k_pitch", "--from", "5e4", "--to", "6e5", "--second",
                      "k_yaw", "--second-from", "5e4", "--second-to", "6e5", "-o", out, "--quiet", "--force")
        with h5py.File(out) as file:
            kinds = {kind.decode() for kind in file["curve_kind"][:]}
            pitch, yaw = file["k_pitch"][:], file["k_yaw"][:]
        self.assertEqual(kinds, {"flutter"})
        for k_pitch, k_yaw in zip(pitch, yaw):
            M, C, K = self.propeller(k_pitch=k_pitch, k_yaw=k_yaw).matrices(100.0)
            self.assertLess(abs(np.max(companion(M, C, K).real)), 1e-6)
        equal = brentq(lambda k: np.max(companion(*self.propeller(k_pitch=k, k_yaw=k).matrices(100.0)).real), 2e5, 6e5)
        self.assertLess(np.max(np.minimum(pitch, yaw)), 1.0001 * equal)


if __name__ == "__main__":
    unittest.main()
