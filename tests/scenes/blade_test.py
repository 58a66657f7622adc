"""The blade of the NREL 5 MW turbine against a beam of Euler and Bernoulli that shares no code with the program, and against
published values; the keys of [[blade]]; a hingeless blade against the closed form of its couplings."""

import csv
import io
import math
import pathlib
import os
import unittest

import numpy as np
from scipy.linalg import eigh

from beam_test import BeamTest

DATA = pathlib.Path(os.environ["EIGENTRAIL_DATA"]) / "scenes"
RPM = math.pi / 30.0


def stations():
    """Columns of the table of the scene by their names without units; twist in rad."""
    lines = [line for line in (DATA / "nrel_5mw_blade.csv").read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    names = [name.split("[")[0].strip() for name in lines[0].split(",")]
    columns = dict(zip(names, np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]]).T))
    return columns | {"twist": np.radians(columns["twist"])}


def hermite(t, h):
    """Cubics of a bent element at t in [0, 1]: values, slopes and curvatures for deflection and slope of both ends."""
    value = [1 - 3 * t**2 + 2 * t**3, h * (t - 2 * t**2 + t**3), 3 * t**2 - 2 * t**3, h * (t**3 - t**2)]
    slope = [(6 * t**2 - 6 * t) / h, 1 - 4 * t + 3 * t**2, (6 * t - 6 * t**2) / h, 3 * t**2 - 2 * t]
    bend = [(12 * t - 6) / h**2, (6 * t - 4) / h, (6 - 12 * t) / h**2, (6 * t - 2) / h]
    return np.array(value), np.array(slope), np.array(bend)


def euler_bernoulli(columns, length, hub_radius, speed, elements=120, points=4):
    """Frequencies (rad/s) of a twisted blade that bends in two planes under its centrifugal tension: without extension, shear,
    twisting and inertia of the sections, and without Coriolis forces, which couple bending with extension only.
    v is the displacement along the motion of the rotor, w along its axis."""
    n = 2 * (elements + 1)
    M, K = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, 2 * n))
    h = length / elements
    nodes, weights = np.polynomial.legendre.leggauss(points)
    fine = np.linspace(0.0, 1.0, 20001)
    load = np.interp(fine, columns["span"], columns["mass"]) * (hub_radius + length * fine)
    inboard = np.concatenate([[0.0], np.cumsum(0.5 * (load[1:] + load[:-1]) * length / (len(fine) - 1))])
    tension = speed**2 * (inboard[-1] - inboard)
    for e in range(elements):
        v = np.arange(2 * e, 2 * e + 4)
        for x, weight in zip(0.5 * (nodes + 1.0), 0.5 * h * weights):
            s = (e + x) / elements
            mass, flap, lag, twist = (np.interp(s, columns["span"], columns[key]) for key in ("mass", "EI_flap", "EI_lag", "twist"))
            value, slope, bend = hermite(x, h)
            c, si = math.cos(twist), math.sin(twist)
            EI = np.array([[lag * c * c + flap * si * si, (lag - flap) * c * si], [(lag - flap) * c * si, lag * si * si + flap * c * c]])
            stiff = weight * np.outer(bend, bend)
            geometric = weight * np.interp(s, fine, tension) * np.outer(slope, slope)
            inertia = weight * mass * np.outer(value, value)
            for a in range(2):
                M[np.ix_(v + a * n, v + a * n)] += inertia
                K[np.ix_(v + a * n, v + a * n)] += geometric - (speed**2 * inertia if a == 0 else 0.0)
                for b in range(2):
                    K[np.ix_(v + a * n, v + b * n)] += EI[a, b] * stiff
    free = np.delete(np.arange(2 * n), [0, 1, n, n + 1])
    return np.sqrt(eigh(K[np.ix_(free, free)], M[np.ix_(free, free)], subset_by_index=[0, 3], eigvals_only=True))


class BladeTest(BeamTest):
    """Scenes with a blade."""

    def blade(self, trace='parameter = "omega"\nfrom = 0\nto = 1\n[parameters]\nomega = 0', rest="", **changes):
        keys = {"name": '"blade"', "hub_radius": 0.1, "length": 1.0, "elements": 4, "mass": 1.0, "EI_flap": 1.0, "EI_lag": 20.0}
        table = "\n".join(f"{key} = {value}" for key, value in (keys | changes).items() if value is not None)
        return f'[trace]\n{trace}\n[frame]\nangular_velocity = [0, 0, "omega"]\n[[blade]]\n{table}\n{rest}\n'


class Nrel5MW(BladeTest):
    names = ("1st flap", "1st lag", "2nd flap")

    def scene(self, elements):
        self.write("nrel_5mw_blade.csv", (DATA / "nrel_5mw_blade.csv").read_text(encoding="utf-8"))
        return (DATA / "nrel_5mw_blade.toml").read_text(encoding="utf-8").replace("elements     = 12", f"elements = {elements}")

    def hertz(self, rpm, elements=12, mass=1.0, **changes):
        columns = stations()
        text = self.scene(elements)
        extra = {"mass": (mass * columns["mass"]).tolist()} | changes
        text += "\n".join(f"{key} = {value}" for key, value in extra.items()) + "\n"
        found = dict(self.spectrum(text, rpm, modes=4))
        return np.array([abs(found[name]) for name in self.names]) / (2.0 * math.pi)

    def test_published_modes(self):
        """With the mass factor of the turbine, 1.04536. Jonkman et al. (2009, Table 9-1) have 0.63 to 0.70 Hz for the modes of
        first flap of the turbine at rest, 1.07 to 1.09 Hz for first edge and 1.65 to 2.02 Hz for second flap, from two programs."""
        flap, edge, second = self.hertz(0.0, mass=1.04536)
        self.assertTrue(0.63 < flap < 0.70 and 1.065 < edge < 1.095 and 1.65 < second < 2.02, (flap, edge, second))

    def test_converges_with_the_elements(self):
        coarse, middle, fine = (self.hertz(12.1, n) for n in (4, 12, 24))
        np.testing.assert_allclose(middle, fine, rtol=2e-3)
        self.assertTrue(np.all(np.abs(middle - fine) < 0.1 * np.abs(coarse - fine)), (coarse, middle, fine))

    def test_nothing_grows_at_rest(self):
        """Its mass falls from 46 to 10 kg/m over the last 1.3 m. With the integrals of quadratic shape functions alone the tip has a
        negative mass, and up to three modes grow."""
        for elements in (2, 4, 8, 12, 16):
            text = self.scene(elements)
            s = np.array([s for _, s in self.spectrum(text, 0.0, modes="all")])
            self.assertGreater(len(s), 10 * elements)
            self.assertLess(np.max(s.real / np.abs(s)), 1e-9, elements)
        self.assertIn("stable  rotor_speed = 0 -> 14", self.run_well("trace", "beam.toml", "-o", "blade.h5"))
        # Energy tells it without spectra behind the start, although extension has gyroscopic forces and no damping.
        self.assertEqual(self.open("blade.h5").attrs["count_spectra"], 1)

    def test_beam_without_shear_and_inertia_of_the_sections(self):
        """The program's blade made slender and stiff in torsion: extension, shear, torsion and the inertia of the sections
        then change frequencies by less than 1e-4, which is the order of EI/(EA L^2) at the root."""
        columns = stations()
        for rpm in (0.0, 12.1):
            found = self.hertz(rpm, 40, EA=(100.0 * columns["EA"]).tolist(), GJ=(1e3 * columns["GJ"]).tolist(),
                               inertia_flap=(1e-2 * columns["inertia_flap"]).tolist(),
                               inertia_lag=(1e-2 * columns["inertia_lag"]).tolist())
            expected = euler_bernoulli(columns, 61.5, 1.5, rpm * RPM)[:3] / (2.0 * math.pi)
            np.testing.assert_allclose(found, expected, rtol=5e-4, err_msg=f"{rpm} rpm")

    def test_shear_and_inertia_of_the_sections_lower_frequencies_by_their_order(self):
        """In proportion to the squared radius of gyration over the squared length: a quarter of it, a quarter of the effect."""
        columns = stations()
        for rpm in (0.0, 12.1):
            slender = euler_bernoulli(columns, 61.5, 1.5, rpm * RPM)[:3] / (2.0 * math.pi)
            effects = [slender - self.hertz(rpm, 40, EA=(share * columns["EA"]).tolist(), GJ=(1e3 * columns["GJ"]).tolist(),
                                            inertia_flap=(columns["inertia_flap"] / share).tolist(),
                                            inertia_lag=(columns["inertia_lag"] / share).tolist()) for share in (1.0, 4.0)]
            self.assertTrue(np.all(effects[0] > 0.0), effects)
            np.testing.assert_allclose(effects[0] / effects[1], 4.0, rtol=0.15)


class Keys(BladeTest):
    def test_a_blade_is_the_beam_that_it_describes(self):
        blade = self.blade(EA=1e4, GJ=0.7, pitch=0.3, precone=0.2, azimuth=0.4, elements=3)
        along = np.array([math.cos(0.2) * math.cos(0.4), math.cos(0.2) * math.sin(0.4), math.sin(0.2)])
        tangent = np.array([-math.sin(0.4), math.cos(0.4), 0.0])
        y = math.cos(0.3) * tangent + math.sin(0.3) * np.cross(along, tangent)
        beam = (f'[trace]\nparameter = "omega"\nfrom = 0\nto = 1\n[parameters]\nomega = 0\n[frame]\nangular_velocity = [0, 0, "omega"]\n'
                f'[[beam]]\nname = "blade"\nfrom = {(0.1 * along).tolist()}\nto = {(1.1 * along).tolist()}\ny_axis = {y.tolist()}\n'
                "elements = 3\nmass = 1\nEI_flap = 1\nEI_lag = 20\nEA = 1e4\nGJ = 0.7\n")
        a, b = ([s for _, s in self.spectrum(text, 0.8)] for text in (blade, beam))
        np.testing.assert_allclose(np.imag(a), np.imag(b), rtol=1e-9)

    def test_defaults(self):
        given = {"EA": 1e4 * 20.0, "GJ": 21.0 / 2.6}
        a, b = ([s for _, s in self.spectrum(text, 0.5)] for text in (self.blade(), self.blade(**given)))
        np.testing.assert_allclose(np.imag(a), np.imag(b), rtol=1e-9)

    def test_mass_that_ends_thin(self):
        """Its tip would have a negative mass. Whatever the mesh, the mass and its centre stay: on a spring at its hinge the stiff blade
        swings as the rigid body does."""
        hub = ('[[body]]\nname = "hub"\nmass = 0\nposition = [0, 0, 0]\n[[revolute]]\nname = "hinge"\nfrom = [0, 0, 0]\nto = "hub"\n'
               'axis = [0, 1, 0]\n[[torsional_spring]]\njoint = "hinge"\nstiffness = 1\n')
        x = np.linspace(0.0, 1.0, 20001)
        swing = 1.0 / math.sqrt(np.trapz((0.1 + x)**2 * np.interp(x, [0.0, 0.5, 1.0], [1.0, 0.1, 1e-3]), x))
        for elements in (1, 2, 4):
            found = [s for _, s in self.spectrum(
                self.blade(rest=hub, hub='"hub"', elements=elements, EI_flap=1e6, EI_lag=1e6, span=[0.0, 0.5, 1.0],
                           mass=[1.0, 0.1, 1e-3], inertia_flap=0, inertia_lag=0), modes="all")]
            self.assertLess(max(s.real / abs(s) for s in found), 1e-9)
            self.assertAlmostEqual(abs(found[0]), swing, delta=0.1 / elements**4 * swing)

    def test_moments_that_no_section_has(self):
        self.write("beam.toml", self.blade(inertia_flap=1e-3, inertia_lag=1e-3, inertia_product=1.1e-3))
        self.assert_refused(self.run_program("spectrum", "beam.toml"),
                            ["inertia_product: no section has it: its square exceeds inertia_flap times inertia_lag"])
        self.spectrum(self.blade(inertia_flap=1e-3, inertia_lag=1e-3, inertia_product=1e-3))

    def test_on_a_hub(self):
        """A heavy hub that is held: the same blade, whatever the hub's axes are."""
        hub = ('[[body]]\nname = "hub"\nmass = 5\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n'
               'axis_angle = { axis = [0, 0, 1], angle = 0.7 }\n[[weld]]\nfrom = [0, 0, 0]\nto = "hub"\n')
        a = [s for _, s in self.spectrum(self.blade(), 0.5)]
        b = [s for _, s in self.spectrum(self.blade(rest=hub, hub='"hub"'), 0.5)]
        np.testing.assert_allclose(np.imag(a), np.imag(b), rtol=1e-9)

    def test_damping_ratios(self):
        """Of an untwisted blade at rest, for slender sections: those that are given. Higher modes of one motion have more in
        proportion to their frequency."""
        found = dict(self.spectrum(self.blade(elements=8, EA=1e7, damping_flap=0.01, damping_lag=0.02)))
        ratio = {name: -s.real / abs(s) for name, s in found.items()}
        self.assertAlmostEqual(ratio["1st flap"], 0.01, delta=2e-5)
        self.assertAlmostEqual(ratio["1st lag"], 0.02, delta=4e-5)
        growth = abs(found["2nd flap"]) / abs(found["1st flap"])
        self.assertAlmostEqual(ratio["2nd flap"] / ratio["1st flap"], growth, delta=1e-3 * growth)

    def test_no_damping_of_rigid_motion(self):
        """On a hub with a flap hinge a stiff blade swings as a rigid body, and its damping does not act."""
        hub = ('[[body]]\nname = "hub"\nmass = 0\nposition = [0, 0, 0]\n[[revolute]]\nfrom = [0, 0, 0]\nto = "hub"\naxis = [0, 1, 0]\n')
        text = self.blade(rest=hub, hub='"hub"', EI_flap=1e4, EI_lag=1e4, damping_flap=0.05, damping_lag=0.05)
        s = self.spectrum(text, 1.0, modes=1)[0][1]
        self.assertLess(abs(s.real), 1e-5)
        self.assertLess(abs(s.imag - 1.0), 1e-2)

    def test_section_matrices_of_a_file(self):
        """Columns S11, S22, ... are the stiffnesses that the keys give."""
        plain = {"EA": 1e4, "GA_lag": 5e3, "GA_flap": 4e3, "GJ": 0.8, "EI_flap": 1.0, "EI_lag": 20.0}
        names = ("S11", "S22", "S33", "S44", "S55", "S66")
        rows = [", ".join(["span", *names]), *(", ".join(map(repr, [span, *plain.values()])) for span in (0.0, 1.0))]
        self.write("sections.csv", "\n".join(rows) + "\n")
        given = {"inertia_flap": 1e-3, "inertia_lag": 2e-3}
        by_file = self.blade(file='"sections.csv"', EI_flap=None, EI_lag=None, **given)
        a, b = ([s for _, s in self.spectrum(text, 0.5)] for text in (by_file, self.blade(**plain, **given)))
        np.testing.assert_allclose(np.imag(a), np.imag(b), rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
