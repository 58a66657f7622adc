"""Coefficients of bearings from tables over the speed: the same rotor with the closed form, and the errors that are stated."""

import math
import unittest

import h5py
import numpy as np

from rotor_test_case import RotorTest

SCENE = """
[parameters]
speed = {{ value = 3000, unit = "rpm" }}
{parameters}
[trace]
parameter = "speed"
from = 500
to = 9000
modes = {modes}
[events]
harmonics = 1
excitation = "speed"
[[shaft]]
stations = {{ length = [0.3, 0.9, 0.3], outer = [0.06, 0.1, 0.06] }}
elements = [1, 4, 1]
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"
[[disc]]
node = [3, 5]
outer = 0.4
inner = 0.1
width = 0.06
density = 7850
[[bearing]]
node = [1, 7]
{bearing}
"""

MODES = 4
PARAMETERS = """
turn = { value = 9000, unit = "rpm" }
u = "speed / turn"
k = { value = 2e7, unit = "N/m" }
c = { value = 4e3, unit = "N s/m" }
"""

# With u from 0 to 1: bearings that stiffen with the speed and lose their damping, cross-coupled.
EXPRESSIONS = """
kxx = "k * (1 + u^2 / (1 + u))"
kyy = "1.5 * k"
kxy = "0.4 * k * sinh(u) / (1 + u)"
kyx = "-0.3 * k * u"
cxx = "c / (1 + 2 * u)"
cyy = "c * exp(-u)"
"""


def coefficients(rpm):
    u, k, c = rpm / 9000.0, 2e7, 4e3
    return [k * (1 + u**2 / (1 + u)), 0.4 * k * math.sinh(u) / (1 + u), -0.3 * k * u, 1.5 * k, c / (1 + 2 * u), c * math.exp(-u)]


def table(rows):
    speeds = np.linspace(0.0, 9000.0, rows)
    lines = [",".join(map(repr, map(float, [rpm, *coefficients(rpm)]))) for rpm in speeds]
    return "\n".join(["speed [rpm],kxx [N/m],kxy [N/m],kyx [N/m],kyy [N/m],cxx [N s/m],cyy [N s/m]", *lines, ""])


def with_table(more="", parameters=""):
    return SCENE.format(modes=MODES, bearing='table = "bearing.csv"' + more, parameters=parameters)


class BearingTable(RotorTest):
    def traced(self, rows):
        self.write("bearing.csv", table(rows))
        return self.trace_text(with_table(), output=f"{rows}.h5", tolerance=1e-9)

    def closed(self):
        return self.trace_text(SCENE.format(modes=MODES, bearing=EXPRESSIONS, parameters=PARAMETERS), output="closed.h5", tolerance=1e-9)

    def chosen(self, file, places):
        """The eigenvalues of the chosen modes, places x modes."""
        found = {(p, mode): s for p, mode, s in self.eval_rows(file, places)}
        return np.array([[found[p, f"mode {i + 1}"] for i in range(MODES)] for p in places])

    def test_stated_errors_hold_and_fall_with_more_rows(self):
        """The true error against the closed form is below what `interpolation_error` says on the step, for each chosen mode."""
        exact, worst = self.closed(), []
        for rows in (5, 8, 13):
            file = self.traced(rows)
            with h5py.File(file) as loci:
                nodes, stated = loci["speed"][:], loci["interpolation_error"][:, :MODES]
            largest = 0.0
            for step in range(len(nodes) - 1):
                places = np.linspace(nodes[step], nodes[step + 1], 7)[1:-1]
                for one, other in zip(self.chosen(file, places), self.chosen(exact, places)):
                    errors = np.abs(one - other)
                    self.assertTrue((errors <= stated[step] + 2e-9 * np.abs(other)).all(), (rows, step, errors, stated[step]))
                    largest = max(largest, (errors / np.abs(other)).max())
            worst.append(largest)
        self.assertLess(worst[1], 0.3 * worst[0])
        self.assertLess(worst[2], 0.3 * worst[1])

    def test_an_exact_table_has_no_errors_between_its_rows(self):
        self.write("bearing.csv", table(8))
        stated, exact = (self.trace_text(with_table(more), output=output, tolerance=1e-9)
                         for more, output in (("", "stated.h5"), ("\nexact = true", "exact.h5")))
        with h5py.File(stated) as one, h5py.File(exact) as other:
            self.assertIn("interpolation_error", one)
            self.assertNotIn("interpolation_error", other)
            self.assertNotIn("event_interval", other)
        self.assert_within(self.chosen(exact, [700.0, 4000.0]), self.chosen(stated, [700.0, 4000.0]), 1e-12)

    def test_a_degree_may_be_given(self):
        self.write("bearing.csv", table(8))
        self.write("rotor.toml", with_table("\ndegree = 2"))
        self.assertIn("interpolant of degree 2;", self.run_well("explain", "rotor.toml"))
        file = self.trace_text(with_table("\ndegree = 2\nexact = true"), tolerance=1e-9)
        # Blended parabolas are off by more than what is chosen.
        worse = abs(self.chosen(file, [700.0]) - self.chosen(self.closed(), [700.0])).max()
        better = abs(self.chosen(self.traced(8), [700.0]) - self.chosen(self.closed(), [700.0])).max()
        self.assertGreater(worse, 3.0 * better)

    def test_critical_speeds_lie_in_their_intervals(self):
        exact = sorted(p for p, _ in self.special_points(self.closed(), "resonance"))
        file = self.traced(6)
        with h5py.File(file) as loci:
            kinds = [text.decode().split(",")[0] for text in loci["events"][:]]
            places, intervals = loci["event_parameter"][:], loci["event_interval"][:]
        found = sorted((p, *interval) for kind, p, interval in zip(kinds, places, intervals) if kind == "resonance")
        self.assertEqual(len(found), len(exact))
        self.assertGreater(len(found), 1)
        for p, (_, low, high) in zip(exact, found):
            self.assertLessEqual(low, p)
            self.assertLessEqual(p, high)

    def test_explain_and_trace_say_how_far_off_the_table_is(self):
        self.write("bearing.csv", table(8))
        self.write("scene.toml", with_table())
        self.assertRegex(self.run_well("explain", "scene.toml"),
                         r"bearing 1 +at node 1, node 7; table of 8 rows, speed = 0 to 9e\+03 rpm, .*left out is missed by")
        self.assertRegex(self.run_well("trace", "scene.toml"), r"data +relative error of eigenvalues between samples up to \S+ ")

    def test_errors_that_are_not_known_are_said(self):
        """Traced over a mass, the table is read at one speed; over the square of the speed, its rows are no places of the path."""
        self.write("bearing.csv", table(8))
        self.write("scene.toml", with_table('\nover = "speed * (1 - 1e-6 * speed)"'))
        self.assertIn("the error of that is not known: it is stated where what all", self.run_well("trace", "scene.toml"))
        self.assertNotIn("not known", self.run_well("trace", "scene.toml", "--force", "--without", "bearing"))
        self.write("scene.toml", with_table())
        self.assertNotIn("not known", self.run_well("trace", "scene.toml", "--force"))
        self.write("scene.toml", with_table('\nmxx = "m"', 'm = { value = 1, unit = "kg" }'))
        summary = self.run_well("trace", "scene.toml", "--force", "--parameter", "m", "--from", "0", "--to", "2")
        self.assertNotIn("between samples", summary)
        self.assertIn("the error of that is not known: it is stated where 'speed' is traced", summary)
        self.assertRegex(summary, r"1 +\S+ +\S+ % +\S+ +\S+ % +1st backward bending")

    def test_verify_finds_the_table_beside_the_scene(self):
        file = self.traced(8)
        self.assertIn("worst discrepancy", self.run_well("verify", file))

    def test_seal_between_shafts_is_a_bearing_with_mass(self):
        """Two equal shafts that a bearing joins: where both move alike it does nothing, and the modes of one alone are among
        those of both."""
        shaft = """
[[shaft]]
name = "{name}"
stations = {{ length = 1, outer = 0.08 }}
elements = 4
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"
[[bearing]]
node = ["{name} node 1", "{name} node 5"]
kxx = 3e7
kxy = 1e6
cxx = 500
"""
        head = "[parameters]\nspeed = 100\n[trace]\nparameter = \"speed\"\nfrom = 100\nto = 500\n"
        both = shaft.format(name="a") + shaft.format(name="b")
        joint = "[[bearing]]\nbetween = [\"a node 3\", \"b node 3\"]\nkxx = 1e7\nkxy = 1e5\ncxx = 300\nmxx = 4\n"
        one = self.spectra(self.trace_text(head + shaft.format(name="a"), output="one.h5", tolerance=1e-10), [300.0])[0]
        two = self.spectra(self.trace_text(head + both + joint, output="two.h5", tolerance=1e-10), [300.0])[0]
        self.assertEqual(len(two), 2 * len(one))
        for s in one:
            self.assertLess(np.abs(two - s).min(), 1e-8 * abs(s), s)


if __name__ == "__main__":
    unittest.main()
