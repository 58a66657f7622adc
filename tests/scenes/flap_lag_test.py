"""Flap-lag in hover: equilibrium and eigenvalues of a model in flap and lag angles alone, written independently."""

import math
import unittest

import h5py
import numpy as np

from rotor_test_case import RotorTest, companion
from scene_test_case import CLOSE

DEGREE = math.pi / 180.0
NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)


class Blade:
    """A slender blade in the angles q = (flap up, then lag forward); loads at the Gauss points of the span."""

    def __init__(self, p):
        self.p = p
        self.omega = np.array([0.0, 0.0, p["omega"]])
        self.radius = p["offset"] + p["span"]
        self.slope = 2 * math.pi
        solidity = p["blades"] * p["chord"] / (math.pi * self.radius)
        induced = self.slope * solidity / 16 * (math.sqrt(1 + 24 * p["pitch"] / (self.slope * solidity)) - 1)
        self.inflow = np.array([0.0, 0.0, -induced * p["omega"] * self.radius])
        inertia = p["mass"] * p["span"]**2 / 3
        centrifugal = p["omega"]**2 * p["offset"] * p["mass"] * p["span"] / 2
        self.springs = np.array([inertia * p["omega"]**2 * (p["p"]**2 - 1) - centrifugal,
                                 inertia * p["omega"]**2 * p["w"]**2 - centrifugal])

    def axes(self, q):
        (sb, sz), (cb, cz) = np.sin(q), np.cos(q)
        span, leading = np.array([cb * cz, sz, sb * cz]), np.array([-cb * sz, cz, -sb * sz])
        lift = np.array([-sb, 0 * sb, cb])
        return span, leading, lift, np.array([[-sb * cz, 0 * sb, cb * cz], leading])

    def pressure(self, U, leading, lift):
        """Force per length of a section that moves with U through the air."""
        p = self.p
        t = math.cos(p["pitch"]) * leading + math.sin(p["pitch"]) * lift
        n = math.cos(p["pitch"]) * lift - math.sin(p["pitch"]) * leading
        Ut, Un = U @ t, U @ n
        half = 0.5 * p["rho"] * p["chord"]
        return half * self.slope * Un * (Un * t - Ut * n) - half * p["drag"] * np.sqrt(Ut**2 + Un**2) * (Ut * t + Un * n)

    def residual(self, q, rates, accelerations):
        """Moments about both hinges that are left over; rates to first order only, as for small motions."""
        p = self.p
        span, leading, lift, slopes = self.axes(q)  # slopes: of the span's direction in either angle
        moments = self.springs * q
        for node, weight in zip(NODES, WEIGHTS):
            x, width = 0.5 * p["span"] * (1 + node), 0.5 * p["span"] * weight
            place = np.array([p["offset"], 0, 0]) + x * span
            velocity, acceleration = x * rates @ slopes, x * accelerations @ slopes
            inertial = acceleration + 2 * np.cross(self.omega, velocity) + np.cross(self.omega, np.cross(self.omega, place))
            air = self.pressure(velocity + np.cross(self.omega, place) - self.inflow, leading, lift)
            moments = moments + x * width * (slopes @ (p["mass"] / p["span"] * inertial - air))
        return moments

    def jacobian(self, q, argument):
        """Derivatives by complex steps, exact to rounding: argument 0 angles, 1 rates, 2 accelerations."""
        columns = []
        for i in range(2):
            state = [np.array(q, dtype=complex), np.zeros(2, dtype=complex), np.zeros(2, dtype=complex)]
            state[argument][i] += 1e-30j
            columns.append(self.residual(*state).imag / 1e-30)
        return np.array(columns).T

    def equilibrium(self):
        q = np.zeros(2)
        for _ in range(30):
            step = np.linalg.solve(self.jacobian(q, 0), self.residual(q, np.zeros(2), np.zeros(2)))
            q = q - step
            if np.max(np.abs(step)) < 1e-14:
                break
        return q

    def spectrum(self):
        q = self.equilibrium()
        return companion(self.jacobian(q, 2), self.jacobian(q, 1), self.jacobian(q, 0))


class FlapLag(RotorTest):
    scene = "flap_lag"

    def blade(self, **changes):
        return Blade(self.parameters(**changes))

    def test_equilibrium_against_pitch(self):
        file = self.trace_scene()
        with h5py.File(file) as loci:
            pitch = loci["pitch"][:]
        axis = self.equilibrium(file, "blade.x_axis")
        for degrees, found in zip(pitch, axis):
            q = self.blade(pitch=degrees * DEGREE).equilibrium()
            np.testing.assert_allclose([math.atan2(found[2], found[0]), math.asin(found[1])], q, atol=1e-12)
        self.assertGreater(axis[-1][2], 0.1)  # the thrust lifts it
        self.assertLess(axis[-1][1], 0.0)     # and drag holds it back

    def test_eigenvalues_against_pitch(self):
        self.assert_follows(self.trace_scene(), lambda degrees: self.blade(pitch=degrees * DEGREE).spectrum(), "pitch",
                            np.linspace(0, 25, 40))

    def test_eigenvalues_against_frequencies_and_offset(self):
        for parameter, begin, end in (("p", 1.05, 1.4), ("w", 0.6, 1.6), ("offset", 0.0, 0.5)):
            with self.subTest(parameter):
                file = self.trace_text(self.changed(pitch=12.0), "--parameter", parameter, "--from", repr(begin),
                                       "--to", repr(end))
                self.assert_follows(file, lambda q: self.blade(**{"pitch": 12 * DEGREE, parameter: q}).spectrum(),
                                    parameter, np.linspace(begin, end, 30))

    def test_flutter_is_where_the_real_part_changes_sign(self):
        (pitch, s), = self.special_points(self.trace_scene(), "flutter")
        growth = lambda degrees: np.max(self.blade(pitch=degrees * DEGREE).spectrum().real)
        stable, unstable = pitch - 1.0, pitch + 1.0
        self.assertLess(growth(stable), 0.0)
        self.assertGreater(growth(unstable), 0.0)
        for _ in range(60):
            middle = 0.5 * (stable + unstable)
            stable, unstable = (middle, unstable) if growth(middle) < 0.0 else (stable, middle)
        self.assertAlmostEqual(pitch, stable, delta=CLOSE * pitch)
        self.assertAlmostEqual(s.imag, np.max(self.blade(pitch=pitch * DEGREE).spectrum().imag), delta=0.2 * s.imag)

    def test_without_air_the_frequencies_are_p_and_w(self):
        text = self.changed(rho=0.0, p=1.1, w=0.7)
        for s in self.spectra(self.trace_text(text), [3.0, 20.0]):
            np.testing.assert_allclose(np.sort(s.imag) / self.parameters()["omega"], [0.7, 1.1], rtol=CLOSE)


if __name__ == "__main__":
    unittest.main()
