"""Shafts of beam elements against closed forms: a shaft on pins that spins (Timoshenko), its convergence, the slender limit,
a Jeffcott rotor with internal damping, an overhung disc, and a shaft that nothing holds."""

import math
import re
import unittest

import numpy as np

from rotor_test_case import RotorTest
from scene_test_case import CLOSE

E, NU, DENSITY = 2.1e11, 0.3, 7850.0
G = E / (2.0 * (1.0 + NU))

PINNED = """
[parameters]
speed = {{ value = 0, unit = "rad/s" }}
[trace]
parameter = "speed"
from = 0
to = {to}
modes = 8
[[shaft]]
stations = {{ length = {length}, outer = {outer}, inner = {inner} }}
elements = {elements}
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"
refined = {refined}
[[support]]
node = [1, {last}]
"""


def section(outer, inner):
    """Area, second moment and Cowper's shear coefficient."""
    m2 = (inner / outer)**2
    both = (1.0 + m2)**2
    shear = 6.0 * (1.0 + NU) * both / ((7.0 + 6.0 * NU) * both + (20.0 + 12.0 * NU) * m2)
    return math.pi / 4.0 * (outer**2 - inner**2), math.pi / 64.0 * (outer**4 - inner**4), shear


def pinned(length, outer, inner, speed, n):
    """Whirl frequencies of a pinned Timoshenko shaft with n half waves, u = U sin(kz) e^(iwt) and t = T cos(kz) e^(iwt) with
    u = x + iy, exactly:
      rho A w^2 U = kGA (k^2 U - k T),   (rho I w^2 - 2 rho I speed w) T = E I k^2 T - kGA (k U - T)
    Positive frequencies are forward whirl, negative ones backward."""
    A, I, shear = section(outer, inner)
    k, s = n * math.pi / length, shear * G * A
    mass, rotary = DENSITY * A, DENSITY * I
    M, D = np.diag([mass, rotary]), np.diag([0.0, -2.0 * rotary * speed])
    K = np.array([[s * k * k, -s * k], [-s * k, E * I * k * k + s]])
    companion = np.block([[np.zeros((2, 2)), np.eye(2)], [np.linalg.solve(M, K), -np.linalg.solve(M, D)]])
    return np.linalg.eigvals(companion).real


def lowest(length, outer, inner, speed, count):
    """The lowest frequencies of both senses, ascending."""
    return np.sort(np.abs(np.concatenate([pinned(length, outer, inner, speed, n) for n in range(1, count + 1)])))[:count]


class PinnedShaft(RotorTest):
    def traced(self, elements, length=1.0, outer=0.1, inner=0.0, to=4000.0, refined="false"):
        return self.trace_text(PINNED.format(length=length, outer=outer, inner=inner, elements=elements, last=elements + 1,
                                             to=to, refined=refined), output=f"{elements}.h5")

    def errors(self, elements, speed, count, **shape):
        file = self.traced(elements, **shape)
        found = np.sort([s.imag for s in self.spectra(file, [speed])[0]])
        given = {"length": 1.0, "outer": 0.1, "inner": 0.0} | shape
        expected = lowest(given["length"], given["outer"], given["inner"], speed, 8)
        return np.abs(found[:count] / expected[:count] - 1.0)

    def frequencies(self, elements, speed, **shape):
        return np.sort([s.imag for s in self.spectra(self.traced(elements, **shape), [speed])[0]])

    def test_timoshenko_shaft_with_gyroscopic_splitting(self):
        """Solid and hollow, standing and spinning, a tenth as thick as long. The elements are shorter than thick, their error
        falls with the square of their length, and extrapolated to length zero three pairs are those of the closed form."""
        for inner in (0.0, 0.07):
            for speed in (0.0, 1500.0, 4000.0):
                few, more = (self.frequencies(n, speed, inner=inner)[:6] for n in (20, 40))
                exact = lowest(1.0, 0.1, inner, speed, 8)[:6]
                self.assertGreater(np.log2((few - exact) / (more - exact)).min(), 1.9)
                self.assertLess(np.abs((4.0 * more - few) / 3.0 / exact - 1.0).max(), 2e-5, (inner, speed))

    def test_order_of_convergence_is_four_while_elements_are_longer_than_thick(self):
        """Errors of the lowest pair with 4, 8 and 16 elements of a shaft of 100 diameters; both senses of whirl."""
        for speed in (0.0, 4000.0):
            few, more, most = (self.errors(n, speed, 2, outer=0.01) for n in (4, 8, 16))
            self.assertGreater(np.log2(few / more).min(), 3.9, speed)
            self.assertGreater(np.log2(more / most).min(), 3.5, speed)

    def test_order_of_convergence_of_refined_elements_is_four(self):
        """Also where they are shorter than thick: three pairs with 4, 8 and 16 elements, solid and hollow."""
        for inner in (0.0, 0.07):
            for speed in (0.0, 4000.0):
                few, more, most = (self.errors(n, speed, 6, inner=inner, refined="true") for n in (4, 8, 16))
                self.assertGreater(np.log2(few / more).min(), 3.9, (inner, speed))
                self.assertGreater(np.log2(more / most).min(), 3.9, (inner, speed))
                self.assertLess(most.max(), 3e-5, (inner, speed))

    def test_slender_limit_is_that_of_euler_and_bernoulli(self):
        """w = (n pi / l)^2 sqrt(E I / rho A); rotary inertia and shear fall with the square of the slenderness. Nothing
        locks: the error of the elements does not grow."""
        A, I, _ = section(1e-3, 0.0)
        file = self.traced(20, outer=1e-3, to=100.0)
        found = np.sort([s.imag for s in self.spectra(file, [0.0])[0]])
        expected = np.array([(n * math.pi)**2 * math.sqrt(E * I / (DENSITY * A)) for n in (1, 1, 2, 2)])
        self.assertLess(np.abs(found[:4] / expected - 1.0).max(), 2e-5)
        self.assertLess(np.abs(found[:2] / expected[:2] - 1.0).max(), 2e-6)

    def test_modes_have_the_names_of_the_trade(self):
        """The n-th pair splits into an n-th backward and an n-th forward bending mode."""
        summary = self.run_well("trace", self.write("named.toml", PINNED.format(
            length=1.0, outer=0.1, inner=0.0, elements=12, last=13, to=4000.0, refined="false").replace("from = 0", "from = 1000")))
        names = re.findall(r"^ +\d+ .* (\d\w\w (?:forward|backward) bending)", summary, re.MULTILINE)
        self.assertEqual(sorted(names), sorted(f"{n} {sense} bending" for n in ("1st", "2nd", "3rd", "4th")
                                               for sense in ("backward", "forward")))

    def test_orbits_are_circles(self):
        """`whirl` is 1 or -1 at every node but that where the shaft stands."""
        import h5py
        with h5py.File(self.traced(8, to=2000.0)) as loci:
            whirl, s, reverse = loci["whirl"][:], loci["eigenvalue"][:], loci["whirl_reverse"][:]
        self.assertTrue(np.isnan(whirl[0]).all())
        np.testing.assert_allclose(np.abs(whirl[1:]), 1.0, atol=1e-9)
        np.testing.assert_allclose(reverse[1:], 0.0, atol=1e-9)
        forward = s.imag[-1] > s.imag[0]
        np.testing.assert_array_equal(whirl[-1] > 0.0, forward)


# A disc in the middle of a shaft without mass, held on pins: the translation of the disc has the stiffness 48 E I / l^3.
JEFFCOTT = """
[parameters]
speed = {{ value = 0, unit = "rad/s" }}
external = {external}
[trace]
parameter = "speed"
from = 1
to = {to}
modes = {{ band = ["0.1 rad/s", "1e5 rad/s"], damping_below = 0.5 }}
[[shaft]]
stations = {{ length = 1.2, outer = 0.03 }}
elements = 2
E = 2.1e11
nu = 0.3
shear_coefficient = 1e12
density = 0
speed = "speed"
internal_damping = {internal}
[[disc]]
node = 2
mass = 20
[[bearing]]
node = 2
cxx = "external"
[[support]]
node = [1, 3]
"""


class Jeffcott(RotorTest):
    STIFFNESS = 48.0 * E * math.pi / 64.0 * 0.03**4 / 1.2**3
    MASS, INTERNAL, EXTERNAL = 20.0, 2e-5, 3.0

    def test_onset_of_instability_by_internal_damping(self):
        """m u'' + (c_i + c_e) u' + (k - i c_i speed) u = 0 loses its stability at speed = w (1 + c_e / c_i)."""
        w = math.sqrt(self.STIFFNESS / self.MASS)
        onset = w * (1.0 + self.EXTERNAL / (self.INTERNAL * self.STIFFNESS))
        file = self.trace_text(JEFFCOTT.format(internal=self.INTERNAL, external=self.EXTERNAL, to=2.0 * onset))
        found = self.special_points(file, "flutter")
        self.assertEqual(len(found), 1)
        self.assertLess(abs(found[0][0] / onset - 1.0), CLOSE)
        self.assertLess(abs(found[0][1].imag / w - 1.0), CLOSE)

    def test_eigenvalues_follow_the_closed_form(self):
        file = self.trace_text(JEFFCOTT.format(internal=self.INTERNAL, external=self.EXTERNAL, to=300.0))
        c_i = self.INTERNAL * self.STIFFNESS
        for speed, found in zip((10.0, 150.0, 280.0), self.spectra(file, [10.0, 150.0, 280.0])):
            roots = np.roots([self.MASS, c_i + self.EXTERNAL, self.STIFFNESS - 1j * c_i * speed])
            expected = [s if s.imag > 0.0 else s.conjugate() for s in roots]
            self.assert_same_spectrum(found, expected)


# A disc at the end of a clamped shaft without mass (Stodola and Green).
OVERHUNG = """
[parameters]
omega = {{ value = 0, unit = "rad/s" }}
[trace]
parameter = "omega"
from = 0
to = 2000
[events]
harmonics = 1
[[shaft]]
stations = {{ length = 0.5, outer = {outer} }}
E = 2.1e11
nu = 0.3
shear_coefficient = 1e12
density = 0
speed = "omega"
[[disc]]
node = 2
mass = 10
Id = 0.1
Ip = 0.18
[[support]]
node = 1
holds = ["x", "y", "rx", "ry"]
"""


class OverhungDisc(RotorTest):
    BENDING = 2.5e4

    def traced(self):
        outer = (self.BENDING / E * 64.0 / math.pi)**0.25
        return self.trace_text(OVERHUNG.format(outer=repr(outer)))

    def whirl(self, omega):
        """(12 EI/l^3 - m w^2)(4 EI/l - Id w^2 + Ip omega w) - (6 EI/l^2)^2 = 0 in u = x + iy, its slope, w of either sign."""
        k11, k12, k22 = (a * self.BENDING / 0.5**n for a, n in ((12, 3), (-6, 2), (4, 1)))
        M, K = np.diag([10.0, 0.1]), np.array([[k11, k12], [k12, k22]])
        C = np.diag([0.0, -1j * 0.18 * omega])
        s = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)],
                                        [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]]))
        return 1j * np.abs(s.imag)

    def test_whirl_frequencies_and_critical_speeds(self):
        file = self.traced()
        self.assert_follows(file, self.whirl, "omega", np.linspace(0.0, 2000.0, 21))
        found = sorted(omega for omega, _ in self.special_points(file, "resonance"))
        # The page of the scene "overhung disc" has them: backward, forward, backward tilt.
        np.testing.assert_allclose(found, [217.369862922, 254.025974970, 952.384406098], rtol=1e-11)


# Friswell, Penny, Garvey & Lees, Dynamics of Rotating Machines, 2010, example 5.9.1. The numbers are those of the matrices that
# ROSS (petrobras/ross at 631a249a) makes of the same rotor, at 4000 rpm and where the frequency is once the speed, rad/s.
class FreeShaft(RotorTest):
    """Nothing holds it. Its stiffness exceeds its slow motions so far that they are known to a few digits only."""
    LENGTHS, OUTER = (0.23, 0.042, 0.18, 0.047), (0.207, 0.169, 0.042, 0.014)

    def test_precession_and_no_instability_but_rounding(self):
        text = PINNED.format(length=list(self.LENGTHS), outer=list(self.OUTER), inner=[0] * 4, to=1, elements=1, refined="false", last=5)
        text = text[:text.index("[[support]]")].replace("modes = 8", 'modes = "all"') + "internal_damping = 1.6e-7\n"
        self.write("scene.toml", text)
        summary = self.run_well("trace", "scene.toml", "-o", "loci.h5")
        for word in ("flutter", "divergence", "unstable", "Re s of mode"):
            self.assertNotIn(word, summary)
        # Slow as a rigid body: it precesses at the speed times the moment about the axis over that about a diameter.
        ends = np.concatenate([[0.0], np.cumsum(self.LENGTHS)])
        masses = DENSITY * math.pi / 4.0 * np.square(self.OUTER) * self.LENGTHS
        polar = masses * np.square(self.OUTER) / 8.0
        middle = 0.5 * (ends[1:] + ends[:-1])
        centre = masses @ middle / masses.sum()
        diametral = polar / 2.0 + masses * (np.square(self.LENGTHS) / 12.0 + (middle - centre)**2)
        speeds, s = self.nodes(self.folder / "loci.h5")
        precession = polar.sum() / diametral.sum()
        for speed, row in zip(speeds[1:], s[1:]):
            found = min(row[~np.isnan(row)], key=lambda one: abs(one.imag - precession * speed))
            self.assertAlmostEqual(found.imag, precession * speed, delta=1e-6 * precession * speed + 2e-6)

    def test_in_one_bearing(self):
        """It turns about the bearing freely: whether the two zeros of that are a pair is rounding, and asks for no short steps. Every
        other mode is damped, so that nothing grows."""
        for node in (1, 3):
            text = PINNED.format(length=1.0, outer=0.05, inner=0, to=500, elements=4, refined="false", last=5)
            text = text[:text.index("[[support]]")].replace("modes = 8", 'modes = "all"')
            self.write("scene.toml", text + "[[disc]]\nnode = 4\nmass = 10\nId = 0.1\nIp = 0.18\n"
                                            f"[[bearing]]\nnode = {node}\nkxx = 1e7\nkyy = 2e7\ncxx = 1e3\n")
            summary = self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force")
            self.assertNotIn("unstable", summary)
            self.assertIn("stable  speed = 0 -> 500", summary)
            self.assertLess(len(self.nodes(self.folder / "loci.h5")[0]), 50)

    def test_spectrum_claims_no_growth_that_is_rounding(self):
        """A short shaft with a flywheel in one soft bearing: rounding of its stiffness hides what its rigid-body motions do."""
        text = PINNED.format(length=[0.09277, 0.03521], outer=[0.02142, 0.1239], inner=[0, 0.06195], to=1, elements=2, refined="false",
                             last=5)
        self.write("scene.toml", text[:text.index("[[support]]")] + "axial = true\n[[bearing]]\nnode = 5\nkxx = 12550\nkyy = 1.032e7\n"
                                                                    "kxy = 323895\nkyx = 323895\ncxx = 292.7\ncyy = 246.6\n")
        self.assertNotIn("modes that grow", self.run_well("spectrum", "scene.toml", "--modes", "all"))


class TwoDiscs(RotorTest):
    scene = "two_disc_rotor"

    def test_frequencies_and_critical_speeds_of_example_5_9_1(self):
        file = self.trace_scene()
        found = np.sort([s.imag for s in self.spectra(file, [4000.0])[0]])
        np.testing.assert_allclose(found[:4], [85.389, 87.796, 251.785, 294.713], atol=6e-4)
        speeds = np.array(sorted(p for p, _ in self.special_points(file, "resonance"))) * math.pi / 30.0
        np.testing.assert_allclose(speeds, [86.4078, 86.9042, 260.517, 288.617], rtol=2e-6)

    def test_summary_names_modes_and_whirl(self):
        summary = self.run_well("trace", self.write("rotor.toml", self.scene_text()))
        for name in ("1st backward bending", "1st forward bending", "backward conical", "forward conical"):
            self.assertIn(name, summary)
        rows = re.findall(r"^ +1x, (\w+) +speed = ", summary, re.MULTILINE)
        self.assertEqual(rows, ["backward", "forward", "backward", "forward"])


if __name__ == "__main__":
    unittest.main()
