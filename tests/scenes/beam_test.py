"""Beams against closed forms: frequencies and their order of convergence, no locking, large rotations, buckling and flutter."""

import io
import csv
import math
import pathlib
import unittest

import numpy as np

from rotor_test_case import RotorTest

CANTILEVER = (1.875104068711961, 4.694091132974174, 7.854757438237613)  # roots of cos x cosh x = -1
SLENDER = 1e-6  # of EI/(EA L^2), EI/(GA L^2) and the section's inertia over m L^2, where the beam is meant to be slender


def beam(elements=4, degree=2, slender=SLENDER, lag=20.0, trace="", rest="", **changes):
    """A uniform cantilever of length 1 along x with m = EI_flap = 1. `slender`: see SLENDER."""
    keys = {"name": '"beam"', "from": "[0, 0, 0]", "to": "[1, 0, 0]", "elements": elements, "degree": degree, "mass": 1.0,
            "EA": 1.0 / slender, "GA_flap": 1.0 / slender, "GA_lag": 1.0 / slender, "EI_flap": 1.0, "EI_lag": lag, "GJ": 0.8,
            "inertia_flap": slender, "inertia_lag": slender} | changes  # None: left out
    table = "\n".join(f"{key} = {value}" for key, value in keys.items() if value is not None)
    return f"[trace]\n{trace or USUAL_TRACE}\n[[beam]]\n{table}\n{rest}\n"


USUAL_TRACE = 'parameter = "omega"\nfrom = 0\nto = 1\n[parameters]\nomega = 0\n[frame]\nangular_velocity = [0, 0, "omega"]'


def timoshenko(count, slender, bending=1.0):
    """Frequencies of the cantilever with shear and rotary inertia: free shear force and moment at the tip."""
    def free_end(w):
        state = np.array([[0, 1, 0, slender], [0, 0, 1 / bending, 0], [0, -slender * w * w, 0, -1], [-w * w, 0, 0, 0]])
        values, vectors = np.linalg.eig(state.astype(complex))
        transfer = (vectors * np.exp(values)) @ np.linalg.inv(vectors)
        return np.linalg.det(transfer[2:, 2:]).real

    found = []
    for root in CANTILEVER[:count]:
        a, b = math.sqrt(bending) * root**2 * 0.999, math.sqrt(bending) * root**2
        for _ in range(40):
            fa, fb = free_end(a), free_end(b)
            if fa == fb or abs(b - a) < 1e-13 * b:
                break
            a, b = b, b - fb * (b - a) / (fb - fa)
        found.append(b)
    return np.array(found)


class BeamTest(RotorTest):
    def spectrum(self, text, at=0.0, modes=4):
        """Name and eigenvalue of the lowest modes at one value of the parameter."""
        self.write("beam.toml", text)
        rows = csv.DictReader(io.StringIO(self.run_well("spectrum", "beam.toml", "--at", at, "--modes", modes, "--csv")))
        return [(row["what_moves"], complex(float(row["real"]), float(row["imag"]))) for row in rows]

    def frequencies(self, kind, count, text, at=0.0, modes=6):
        found = [s.imag for name, s in self.spectrum(text, at, modes) if name.split()[-1] == kind or name.split()[-2:-1] == [kind]]
        self.assertGreaterEqual(len(found), count)
        return np.array(found[:count])


class Frequencies(BeamTest):
    def errors(self, degree, elements, slender=SLENDER):
        """Of two flap frequencies."""
        exact = timoshenko(2, slender)
        return [np.abs(self.frequencies("flap", 2, beam(n, degree, slender), modes=4) / exact - 1.0) for n in elements]

    def test_order_of_convergence(self):
        for degree, elements, order in ((1, (8, 16), 2.0), (2, (4, 8), 4.0)):
            coarse, fine = self.errors(degree, elements)
            np.testing.assert_allclose(np.log2(coarse / fine), order, atol=0.25)

    def test_no_locking(self):
        """The relative error of the mesh is the same when the beam is a hundred times as slender."""
        for degree in (1, 2):
            thick, thin = (self.errors(degree, (4,), slender)[0][0] for slender in (1e-4, 1e-8))
            self.assertLess(abs(thin / thick - 1.0), 0.1)


class Names(BeamTest):
    def test_modes_have_the_names_of_the_field(self):
        text = beam(3, GJ=0.1, inertia_flap=1e-3, inertia_lag=1e-3)
        self.assertEqual([name for name, _ in self.spectrum(text, modes=6)],
                         ["1st flap", "1st torsion", "1st lag", "2nd flap", "2nd torsion", "3rd torsion"])

    def test_a_beam_among_other_bodies(self):
        hub = """
[[body]]
name = "hub"
mass = 50
inertia = [9, 9, 9]
position = [0, 0, 0]
[[ball]]
from = [0, 0, 0]
to = "hub"
[[revolute]]
from = [0, 0, 0]
to = "hub"
axis = [0, 0, 1]
angle = 0
"""
        names = [name for name, _ in self.spectrum(beam(3, rest=hub, **{"from": '"hub"'}), modes=2)]
        self.assertEqual(names, ["beam 1st flap", "beam 1st lag"])


class Wright(BeamTest):
    """Uniform cantilever that rotates about an axis through its root, normal to its plane of lag: published flap frequencies
    over speed (Wright, Smith, Thresher & Wang 1982), both in units of sqrt(EI/(m L^4))."""

    published = {0: (3.5160, 22.0345, 61.6972), 1: (3.6817, 22.1810, 61.8418), 2: (4.1373, 22.6149, 62.2732),
                 3: (4.7973, 23.3203, 62.9850), 4: (5.5850, 24.2733, 63.9668), 5: (6.4495, 25.4461, 65.2050),
                 10: (11.2023, 33.6404, 74.6493)}

    def limit(self, speed):
        """Extrapolated from two meshes and two slendernesses to the beam of Euler and Bernoulli."""
        by_mesh = {}
        for n in (5, 10):
            found = [self.frequencies("flap", 3, beam(n, 2, k * SLENDER, lag=400.0), speed, modes=4) for k in (1.0, 2.0)]
            by_mesh[n] = 2.0 * found[0] - found[1]
        return by_mesh[10] + (by_mesh[10] - by_mesh[5]) / 15.0

    def test_published_frequencies(self):
        for speed, expected in self.published.items():
            found = self.limit(float(speed))
            np.testing.assert_allclose(found[:2], expected[:2], rtol=2e-5, err_msg=f"speed {speed}")
            np.testing.assert_allclose(found[2], expected[2], rtol=1e-4, err_msg=f"speed {speed}")

    def test_southwell(self):
        """Frequencies exceed those of the two systems with bending alone and with the centrifugal force alone:
        w^2 > w_0^2 + k (2 k - 1) speed^2, by little in the first mode."""
        at_rest = self.frequencies("flap", 2, beam(6, lag=400.0), 0.0, modes=3)
        for speed in (2.0, 10.0):
            turning = self.frequencies("flap", 2, beam(6, lag=400.0), speed, modes=3)
            bound = np.sqrt(at_rest**2 + np.array([1.0, 6.0]) * speed**2)
            self.assertTrue(np.all(turning > bound * (1.0 - 1e-4)), (turning, bound))
            self.assertLess(turning[0] / bound[0], 1.06)


class States(BeamTest):
    """Loaded beams at rest: tip against closed forms."""

    def tip(self, text, trace_parameter="load"):
        file = self.trace_text(text, "--modes", "1", tolerance=1e-3)
        self.loads = self.nodes(file)[0]
        return np.array([self.coordinate(file, f"beam.tip.{axis}")[-1] for axis in "xyz"])

    def loaded(self, load, to=1.0, **changes):
        trace = f'parameter = "load"\nfrom = 0\nto = {to}\n[parameters]\nload = 0'
        return beam(trace=trace, rest=load, **({"slender": 1e-3} | changes))

    def test_extension_is_exact(self):
        for degree in (1, 2):
            text = self.loaded('[[force]]\npoint = "beam.tip"\ncomponents = ["load", 0, 0]', 3.0, elements=2, degree=degree,
                               EA=10.0)
            np.testing.assert_allclose(self.tip(text), [1.3, 0, 0], atol=1e-12)

    def test_roll_up_converges_with_the_order_of_the_elements(self):
        """A moment at the end bends the beam into an arc of the angle M L/EI, here a quarter of a circle."""
        exact = np.array([2.0 / math.pi, 2.0 / math.pi, 0.0])
        moment = '[[moment]]\nbody = "beam.tip"\nalong = [0, 0, 1]\nmagnitude = "load"'
        for degree, elements, order in ((1, (4, 8), 2.0), (2, (2, 4), 4.0)):
            errors = [np.linalg.norm(self.tip(self.loaded(moment, math.pi / 2, elements=n, degree=degree, EI_lag=1.0,
                                                         EI_flap=4.0)) - exact)
                      for n in elements]
            self.assertGreater(math.log2(errors[0] / errors[1]), order - 0.5, errors)

    def test_small_twist_and_shear(self):
        twist = self.loaded('[[moment]]\nbody = "beam.tip"\nalong = [1, 0, 0]\nmagnitude = "load"', 1e-3, elements=3)
        file = self.trace_text(twist, "--modes", "1", tolerance=1e-3)
        self.assertAlmostEqual(self.coordinate(file, "beam.tip.y_axis.z")[-1] / (1e-3 / 0.8), 1.0, places=6)
        shear = self.loaded('[[force]]\npoint = "beam.tip"\ncomponents = [0, 0, "load"]', 1e-3, elements=3, GA_flap=5.0)
        self.assertAlmostEqual(self.tip(shear)[2] / (1e-3 * (1.0 / 3.0 + 1.0 / 5.0)), 1.0, places=5)


class Bend(BeamTest):
    """An arc of 45 degrees with radius 100, clamped at one end, under a force across its plane at the other: Bathe & Bolourchi
    (1979) find the tip at (15.9, 47.2, 53.4), Simo & Vu-Quoc (1986) at (15.79, 47.23, 53.37)."""

    def tip(self, elements):
        """Places of the tip without and with the load."""
        stations = np.linspace(0.0, 1.0, 17)
        chord = 200.0 * math.sin(math.pi / 8)
        sweep = np.sqrt(1e4 - (chord * (stations - 0.5)) ** 2) - 100.0 * math.cos(math.pi / 8)
        tip = 100.0 * np.array([1.0 - math.cos(math.pi / 4), math.sin(math.pi / 4)])
        text = f"""
[trace]
parameter = "load"
from = 0
to = 600
[parameters]
load = 0
[[beam]]
name = "beam"
from = [0, 0, 0]
to = [{tip[0]}, {tip[1]}, 0]
y_axis = [{-tip[1]}, {tip[0]}, 0]
elements = {elements}
span = {stations.tolist()}
sweep = {sweep.tolist()}
mass = 1
EA = 1e7
GA_flap = 5e6
GA_lag = 5e6
EI_flap = {1e7 / 12}
EI_lag = {1e7 / 12}
GJ = {5e6 / 6}
[[force]]
point = "beam.tip"
components = [0, 0, "load"]
"""
        file = self.trace_text(text, "--modes", "1", tolerance=1e-2)
        found = [self.coordinate(file, f"beam.tip.{axis}") for axis in "xyz"]
        np.testing.assert_allclose([axis[0] for axis in found], [tip[0], tip[1], 0.0], atol=1e-9)  # free of stress
        return np.array([axis[-1] for axis in found])

    def test_tip(self):
        """Within the scatter of published values, which is 0.7 percent in x; the finer mesh has a tenth of it."""
        coarse, fine = self.tip(4), self.tip(6)
        np.testing.assert_allclose(fine, [15.79, 47.23, 53.37], rtol=8e-3)
        np.testing.assert_allclose(coarse, fine, rtol=2.5e-3)


class Stability(BeamTest):
    """Critical loads, extrapolated to the slender limit from SLENDERNESS and twice that, in which shear makes itself felt."""

    slenderness = 1e-4

    def test_beck_column(self):
        """A follower force along the last section: two frequencies meet at 20.0509536 EI/L^2 (Beck 1952)."""
        trace = 'parameter = "load"\nfrom = 17\nto = 21\n[parameters]\nload = 17'
        rest = ('[[follower_force]]\npoint = "beam.tip"\nfrom = { body = "beam.tip", at = [1, 0, 0] }\nto = "beam.tip"\n'
                'magnitude = "load"')

        def critical(n, factor):
            text = beam(n, trace=trace, rest=rest, lag=400.0, slender=factor * self.slenderness)
            file = self.trace_text(text, "--modes", "2", tolerance=1e-6)
            return min(load for load, s in self.special_points(file, "collision"))

        by_mesh = [2.0 * critical(n, 1.0) - critical(n, 2.0) for n in (3, 6)]
        errors = np.array(by_mesh) - 20.0509536
        self.assertLess(abs(math.log2(errors[0] / errors[1]) - 4.0), 0.3)
        self.assertLess(abs(by_mesh[1] + (by_mesh[1] - by_mesh[0]) / 15.0 - 20.0509536), 0.02)

    def test_euler_buckling(self):
        """A dead load along the axis: s^2 passes zero at pi^2/4 EI/L^2; it is nearly linear in the load."""
        trace = 'parameter = "load"\nfrom = 1\nto = 2.46\n[parameters]\nload = 1'
        rest = '[[force]]\npoint = "beam.tip"\ncomponents = ["-load", 0, 0]'
        found = []
        for factor in (1.0, 2.0):
            text = beam(6, trace=trace, rest=rest, lag=400.0, slender=factor * self.slenderness)
            a, b = (self.spectrum(text, at, modes=1)[0][1].imag ** 2 for at in (2.44, 2.46))
            found.append(2.46 + 0.02 * b / (a - b))
        self.assertAlmostEqual(2.0 * found[0] - found[1], math.pi**2 / 4.0, delta=2e-4)


class Stations(BeamTest):
    properties = {"span": [0.0, 20.0, 50.0], "mass": [2.0, 1.5, 1.0], "EA": [3e4, 2e4, 1e4], "EI_flap": [3.0, 2.0, 1.0],
                  "EI_lag": [30.0, 25.0, 20.0], "GJ": [2.0, 1.0, 1.0], "twist": [0.3, 0.1, 0.0], "prebend": [0.0, 0.01, 0.05]}
    kept = {"GA_flap": None, "GA_lag": None, "inertia_flap": None, "inertia_lag": None}

    def eigenvalues(self, **changes):
        return np.array([s for _, s in self.spectrum(beam(3, **(self.kept | changes)), at=1.0)])

    def test_a_file_of_stations_is_the_same_as_lists(self):
        table = self.properties | {"twist": np.degrees(self.properties["twist"]).tolist()}
        rows = [",".join(map(repr, row)) for row in zip(*table.values())]
        header = ", ".join("twist [deg]" if key == "twist" else key for key in table)
        self.write("stations.csv", "\n".join(["# a blade", header, *rows]) + "\n")
        by_file = self.eigenvalues(**dict.fromkeys(self.properties), file='"stations.csv"')
        np.testing.assert_allclose(by_file.imag, self.eigenvalues(**self.properties).imag, rtol=1e-9)

    def test_equal_stations_are_a_uniform_beam(self):
        uniform = {key: values[-1] for key, values in self.properties.items() if key not in ("span", "twist", "prebend")}
        stations = {key: [value] * 3 for key, value in uniform.items()} | {"span": self.properties["span"]}
        np.testing.assert_allclose(self.eigenvalues(**stations).imag, self.eigenvalues(**uniform).imag, rtol=1e-9)

    def test_a_section_matrix_is_the_same_as_its_stiffnesses(self):
        plain = {"EA": 1e4, "GA_lag": 5e3, "GA_flap": 4e3, "GJ": 0.8, "EI_flap": 1.0, "EI_lag": 20.0, "inertia_flap": 1e-3,
                 "inertia_lag": 1e-3}
        matrix = np.diag([1e4, 5e3, 4e3, 0.8, 1.0, 20.0]).tolist()
        full = dict.fromkeys(plain) | {"stiffness": matrix, "inertia_flap": 1e-3, "inertia_lag": 1e-3}
        np.testing.assert_allclose(self.eigenvalues(**full).imag, self.eigenvalues(**plain).imag, rtol=1e-9)


class Turbine(BeamTest):
    """The blade of the NREL 5 MW turbine from its table of 49 stations. Jonkman et al. (2009, Table 9-1) have, for the turbine
    at rest and with two programs, 0.63 to 0.70 Hz for the modes of first flap, 1.07 to 1.09 Hz for those of first edge and 1.65
    to 2.02 Hz for those of second flap. The table has no EA and GJ: here they follow mass and EI_flap."""

    def frequencies_at(self, elements, rpm):
        table = (pathlib.Path(__file__).parent / "nrel5mw_blade.csv").read_text(encoding="utf-8")
        rows = [[float(cell) for cell in line.split(",")] for line in table.splitlines()[3:]]
        self.write("blade.csv", table)
        text = beam(elements, trace='parameter = "rpm"\nfrom = 0\nto = 14\n[parameters]\nrpm = { value = 0, unit = "rpm" }\n'
                                    '[frame]\nangular_velocity = [0, 0, "rpm"]',
                    file='"blade.csv"', **{"from": "[1.5, 0, 0]", "to": "[63, 0, 0]"}, GA_flap=None, GA_lag=None,
                    inertia_flap=None, inertia_lag=None, EI_flap=None, EI_lag=None, mass=[1.04536 * row[2] for row in rows],
                    EA=[1e10 * row[2] / rows[0][2] for row in rows], GJ=[5.56e9 * row[3] / rows[0][3] for row in rows])
        found = dict(self.spectrum(text, rpm, modes=3))
        return np.array([found[name].imag for name in ("1st flap", "1st lag", "2nd flap")]) / (2.0 * math.pi)

    def test_at_rest_and_at_rated_speed(self):
        at_rest = self.frequencies_at(12, 0.0)
        np.testing.assert_allclose(at_rest, [0.676, 1.082, 1.945], atol=4e-3)
        np.testing.assert_allclose(self.frequencies_at(12, 12.1), [0.728, 1.090, 2.004], atol=4e-3)
        np.testing.assert_allclose(self.frequencies_at(8, 0.0), at_rest, rtol=1e-2)


class Damping(BeamTest):
    def test_in_proportion_to_stiffness(self):
        """s^2 + time w^2 s + w^2 = 0 for every mode of the undamped beam."""
        plain = [s for _, s in self.spectrum(beam(3))]
        damped = [s for _, s in self.spectrum(beam(3, rest='[[beam_damping]]\nbeam = "beam"\ntime = 0.01'))]
        for undamped, s in zip(plain, damped):
            w = undamped.imag
            self.assertLess(abs(s * s + 0.01 * w * w * s + w * w) / w**2, 1e-6)

    def test_none_under_rigid_motion(self):
        """A beam on a hinge swings as a rigid body, undamped: s = j speed in lag is zero, in flap the speed."""
        rest = ('[[revolute]]\nfrom = [0, 0, 0]\nto = "beam.root"\naxis = [0, 1, 0]\n'
                '[[beam_damping]]\nbeam = "beam"\ntime = 0.01')
        found = self.spectrum(beam(3, rest=rest, ends='["free", "free"]', EI_flap=1e4, EI_lag=1e4, slender=1e-4), at=1.0, modes=1)
        self.assertLess(abs(found[0][1] - 1j), 1e-3)
        self.assertLess(abs(found[0][1].real), 1e-6)


if __name__ == "__main__":
    unittest.main()
