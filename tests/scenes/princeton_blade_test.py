"""The Princeton beam as a chain of links: bent equilibrium and frequencies of the same chain in its joint angles."""

import math
import unittest

import numpy as np

from rotor_test_case import RotorTest
from scene_test_case import CLOSE

DEGREE = math.pi / 180.0


def turn(axis, angle):
    """Rotation about axis y or z of a link."""
    s, c, o, e = np.sin(angle), np.cos(angle), 0 * angle, 1 + 0 * angle
    return np.array([[c, o, s], [o, e, o], [-s, o, c]] if axis == "y" else [[c, -s, o], [s, c, o], [o, o, e]])


class Chain:
    """Links in the angles q = (flap 1, lag 1, flap 2, ...), each about y of the link before and z of the link itself."""

    def __init__(self, p):
        self.n = n = int(p["links"])
        self.h = h = p["length"] / n
        w, t = p["width"], p["thickness"]
        self.m, self.tip, self.g = p["density"] * w * t * h, p["tip"], p["g"]
        self.inertia = self.m / 12 * np.diag([w * w + t * t, h * h + w * w, h * h + t * t])
        flap, lag = p["modulus"] * w * t**3 / (12 * h), p["modulus"] * t * w**3 / (12 * h)
        self.springs = np.array([2 * flap, 2 * lag] + [flap, lag] * (n - 1))
        s, c = math.sin(p["pitch"]), math.cos(p["pitch"])
        self.root = np.array([[1, 0, 0], [0, s, -c], [0, c, s]])

    def posture(self, q):
        """Hinges' places and axes in the order of q; centres and orientations of the links; the tip."""
        R, at = self.root.astype(q.dtype), np.zeros(3, dtype=q.dtype)
        places, axes, centres, turns = [], [], [], []
        for i in range(self.n):
            axes.append(R[:, 1])
            R = R @ turn("y", q[2 * i]) @ turn("z", q[2 * i + 1])
            axes.append(R[:, 2])
            places += [at, at]
            centres.append(at + 0.5 * self.h * R[:, 0])
            turns.append(R)
            at = at + self.h * R[:, 0]
        return places, axes, centres, turns, at

    def gradient(self, q):
        """Of the energy of springs and weights."""
        places, axes, centres, _, tip = self.posture(q)
        places, axes = np.array(places), np.array(axes)
        moved = np.repeat(np.arange(self.n, 0, -1), 2)[:, None]  # links beyond a hinge
        centre = np.repeat(np.cumsum(centres[::-1], axis=0)[::-1], 2, axis=0)
        arm = self.m * (centre - moved * places) + self.tip * (tip - places)
        return self.springs * q + self.g * (axes[:, 0] * arm[:, 1] - axes[:, 1] * arm[:, 0])

    def hessian(self, q):
        """By complex steps, exact to rounding."""
        n = len(q)
        return np.array([self.gradient(q + 1e-30j * np.eye(n)[k]).imag / 1e-30 for k in range(n)])

    def equilibrium(self):
        q = np.zeros(2 * self.n)
        for _ in range(30):
            step = np.linalg.solve(self.hessian(q), self.gradient(q))
            q = q - step
            if np.max(np.abs(step)) < 1e-13:
                return q
        raise AssertionError("Newton's method did not converge")

    def mass_matrix(self, q):
        places, axes, centres, turns, tip = self.posture(q)
        M = np.zeros((len(q), len(q)))
        for i in range(self.n):
            used = range(2 * i + 2)
            move = np.array([np.cross(axes[k], centres[i] - places[k]) if k in used else np.zeros(3) for k in range(len(q))])
            spin = np.array([turns[i].T @ axes[k] if k in used else np.zeros(3) for k in range(len(q))])
            M += self.m * move @ move.T + spin @ self.inertia @ spin.T
        move = np.array([np.cross(axes[k], tip - places[k]) for k in range(len(q))])
        return M + self.tip * move @ move.T

    def frequencies(self):
        q = self.equilibrium()
        L = np.linalg.inv(np.linalg.cholesky(self.hessian(q)))  # of K, so that the lowest keep their digits
        return 1.0 / np.sqrt(np.linalg.eigvalsh(L @ self.mass_matrix(q) @ L.T)[::-1])


class PrincetonBlade(RotorTest):
    scene = "princeton_blade"

    def test_tip_of_the_bent_bar_against_pitch(self):
        file = self.trace_scene()
        pitch, _ = self.nodes(file)
        for degrees, found in zip(pitch, self.equilibrium(file, "weight")):
            chain = Chain(self.parameters(pitch=degrees * DEGREE))
            *_, tip = chain.posture(chain.equilibrium())
            np.testing.assert_allclose(found, tip, atol=CLOSE * chain.h)
        self.assertLess(self.equilibrium(file, "weight")[-1][2], -0.1)  # bent far

    def check(self, parameter, begin, end, unit=1.0, **held):
        places = np.linspace(begin, end, 8)
        file = self.trace_text(self.changed(**held), "--parameter", parameter, "--from", repr(begin), "--to", repr(end))
        for p, s in [*zip(*self.nodes(file)), *zip(places, self.eval_at(file, places))]:
            chain = Chain(self.parameters(**{name: a * DEGREE if name == "pitch" else a for name, a in held.items()},
                                          **{parameter: p * unit}))
            self.assert_same_spectrum(s, 1j * chain.frequencies()[:len(s)], message=f"{parameter} = {p}")

    def test_frequencies_against_pitch(self):
        self.check("pitch", 0.0, 90.0, DEGREE)

    def test_frequencies_against_weight(self):
        self.check("tip", 0.1, 1.8, pitch=45.0)

    def test_unloaded_bar_is_a_clamped_beam(self):
        """3.516 sqrt(EI/(mu L^4)) and 22.034 (Blevins 1979) in both planes; the error of n links falls with 1/n^2."""
        p = self.parameters()
        text = self.changed(tip=1e-9, g=1e-9)
        bending = math.sqrt(p["modulus"] / (12 * p["density"])) / p["length"]**2
        s = self.spectra(self.trace_text(text, "--modes", "all", tolerance=1e-8), [30.0])[0]
        frequencies = np.sort(s.imag)
        for size, first in ((p["thickness"], 0), (p["width"], 2)):
            for factor, tolerance in ((3.5160, 0.01), (22.0345, 0.06)):
                near = frequencies[np.argmin(abs(frequencies - factor * size * bending))]
                self.assertAlmostEqual(near / (factor * size * bending), 1.0, delta=tolerance)

    def test_small_loads_bend_it_as_beam_theory_says(self):
        """P L^3/(3 EI) in the soft plane; n links give it but for 1/n^2."""
        p = self.parameters(pitch=math.pi / 2)
        text = self.changed(pitch=90.0, g=1e-4)
        deflection = self.equilibrium(self.trace_text(text, "--parameter", "tip", "--from", "0.9", "--to", "1.0"), "weight")
        EI = p["modulus"] * p["width"] * p["thickness"]**3 / 12
        own = p["density"] * p["width"] * p["thickness"] * p["length"]
        expected = -1e-4 * p["length"]**3 / EI * (0.9 / 3 + own / 8)
        self.assertAlmostEqual(deflection[0][2] / expected, 1.0, delta=0.01)


if __name__ == "__main__":
    unittest.main()
