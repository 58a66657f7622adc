"""Ground resonance: the spectrum of Coleman & Feingold's equations, and the speeds between which the rotor is unstable."""

import math
import unittest

import numpy as np

from rotor_test_case import RotorTest, upper
from scene_test_case import CLOSE

BLADES = 4
RPM = math.pi / 30.0


def coleman_feingold(p):
    """Roots of the equations in the ground's frame (NACA Report 1351, 1958), in z = x + jy and
    xi = (2/N) sum lag e^(j psi)."""
    S, shift = p["first"], 1j * p["omega"]
    hinge = p["offset"] * S * p["omega"]**2 + p["lag_spring"]
    M = np.array([[p["hub_mass"] + BLADES * p["blade_mass"], BLADES / 2 * 1j * S], [-1j * S, p["second"]]])
    C = np.diag([p["damper"] + 0j, p["lag_damper"] - 2 * shift * p["second"]])
    K = np.diag([p["support"] + 0j, p["second"] * shift**2 - p["lag_damper"] * shift + hinge])
    return np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]]))


def spectrum(p):
    """In the turning frame; with the collective and the differential lag mode, which leave the hub at rest."""
    whirl = coleman_feingold(p) - 1j * p["omega"]
    alone = upper(np.roots([p["second"], p["lag_damper"], p["offset"] * p["first"] * p["omega"]**2 + p["lag_spring"]]))
    return np.concatenate([np.where(whirl.imag < 0, whirl.conj(), whirl), *(BLADES - 2) * [alone]])


def boundary(growth, stable, unstable):
    """The zero of a function between two places, by bisection."""
    for _ in range(100):
        middle = 0.5 * (stable + unstable)
        stable, unstable = (stable, middle) if growth(middle) > 0.0 else (middle, unstable)
    return 0.5 * (stable + unstable)


class GroundResonance(RotorTest):
    scene = "ground_resonance"

    def test_spectrum_against_speed(self):
        self.assert_follows(self.trace_scene(), lambda rpm: spectrum(self.parameters(omega=rpm * RPM)), "omega",
                            np.linspace(50, 450, 60))

    def test_spectrum_against_dampers_and_support(self):
        for parameter, begin, end in (("lag_damper", 100.0, 8000.0), ("damper", 0.0, 1e5), ("lag_spring", 0.0, 1e5)):
            with self.subTest(parameter):
                file = self.trace_scene("--parameter", parameter, "--from", repr(begin), "--to", repr(end))
                self.assert_follows(file, lambda q: spectrum(self.parameters(**{parameter: q})), parameter,
                                    np.linspace(begin, end, 30))

    def test_unstable_between_the_speeds_of_coleman_and_feingold(self):
        growth = lambda rpm: np.max(coleman_feingold(self.parameters(omega=rpm * RPM)).real)
        speeds = np.linspace(50, 450, 401)
        worst = speeds[np.argmax([growth(rpm) for rpm in speeds])]
        self.assertGreater(growth(worst), 0.05)
        expected = [boundary(growth, 50.0, worst), boundary(growth, 450.0, worst)]
        events = sorted(self.special_points(self.trace_scene(), "flutter"))
        self.assertEqual(len(events), 2)
        np.testing.assert_allclose([rpm for rpm, _ in events], expected, rtol=CLOSE)

    def test_damping_that_suffices_is_the_one_of_coleman_and_feingold(self):
        """The instability shrinks to one speed where the largest growth over all speeds is zero."""
        def unstable(damper):
            return any(np.max(coleman_feingold(self.parameters(omega=rpm * RPM, lag_damper=damper)).real) > 0.0
                       for rpm in np.linspace(150, 200, 501))
        for damper in (1245.0, 1250.0):
            found = self.special_points(self.trace_text(self.changed(lag_damper=damper), tolerance=1e-8), "flutter")
            self.assertEqual(len(found), 2 if unstable(damper) else 0, damper)
        self.assertTrue(unstable(1245.0))
        self.assertFalse(unstable(1250.0))

    def test_overdamped_lag_meets_once_for_each_free_blade(self):
        """Collective and differential lag leave the hub at rest: two equal pairs, each of which is born on the real axis
        where c = 2 sqrt(I e S) omega. Nothing else happens there, however close the copies are."""
        p = self.parameters()
        for damper in (3500.0, 3667.0, 4000.0):
            file = self.trace_text(self.changed(lag_damper=damper), tolerance=1e-8)
            met = damper / (2.0 * math.sqrt(p["second"] * p["offset"] * p["first"])) / RPM
            collisions = self.event_parameters(file, "collision")
            np.testing.assert_allclose(collisions, [met, met], rtol=1e-8)
            veerings = np.array(self.event_parameters(file, "veering"))
            self.assertGreater(np.min(np.abs(veerings - met)), 0.1, damper)

    def test_full_dampers_keep_it_stable(self):
        """Hammond (1974): with 4068 N m s/rad at every blade there is no instability."""
        file = self.trace_text(self.changed(lag_damper=4067.5), "--from", "100")
        self.assertEqual(self.special_points(file, "flutter"), [])

    def test_damping_that_turned_with_the_rotor_would_not_do(self):
        """With support damping relative to the turning frame the boundaries differ by far more than the tolerance."""
        turned = self.scene_text().replace('speed = "-omega"', 'speed = 0')
        right = sorted(rpm for rpm, _ in self.special_points(self.trace_scene(), "flutter"))
        wrong = sorted(rpm for rpm, _ in self.special_points(self.trace_text(turned), "flutter"))
        self.assertFalse(len(right) == len(wrong) and np.allclose(right, wrong, rtol=1e-3))

    def test_elastomeric_dampers(self):
        """Spring k and dashpot c in series in place of every lag damper. In the ground's frame the dashpot's angles obey
        c (d/dt - j omega) eta = k (xi - eta), and give one more root to every lag mode."""
        k = 40000.0
        text = self.scene_text().replace("[[torsional_damper]]", f"[[torsional_maxwell_damper]]\nstiffness = {k!r}")

        def with_elastomer(rpm):
            p = self.parameters(omega=rpm * RPM)
            S, I, c, shift = p["first"], p["second"], p["lag_damper"], 1j * p["omega"]
            hinge = p["offset"] * S * p["omega"]**2 + p["lag_spring"] + k
            M = np.array([[p["hub_mass"] + BLADES * p["blade_mass"], BLADES / 2 * 1j * S], [-1j * S, I]])
            C = np.diag([p["damper"] + 0j, -2 * shift * I])
            K = np.diag([p["support"] + 0j, I * shift**2 + hinge])
            left, below = np.linalg.solve(M, K), np.linalg.solve(M, C)
            force = np.linalg.solve(M, [0.0, k])[:, None]
            dashpot = np.array([[0, k / c, 0, 0, shift - k / c]])
            whirl = np.linalg.eigvals(np.vstack([np.hstack([np.zeros((2, 2)), np.eye(2), np.zeros((2, 1))]),
                                                 np.hstack([-left, -below, force]), dashpot])) - shift
            alone = upper(np.roots([I * c, I * k, c * hinge, (hinge - k) * k]))
            return np.concatenate([np.where(whirl.imag < 0, whirl.conj(), whirl), *(BLADES - 2) * [alone]])

        self.assert_follows(self.trace_text(text), with_elastomer, "omega", np.linspace(50, 450, 40))


if __name__ == "__main__":
    unittest.main()
