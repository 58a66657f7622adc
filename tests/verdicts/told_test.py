"""What the program says where eigenvalues are zero, infinite or at the end of a range, and of critical speeds, on shafts and
families whose answer is known."""

import csv
import math
import re
import unittest

import numpy as np

from verdicts_test import VerdictTest

SHAFT = """
[parameters]
speed = { value = 3000, unit = "rpm" }
[trace]
parameter = "speed"
from = 0
to = 6000
modes = 2
[events]
harmonics = 1
[[shaft]]
stations = { length = 1.0, outer = 0.05 }
elements = 4
E = 2.11e11
nu = 0.3
density = 7810
speed = "speed"
[[disc]]
node = 3
mass = 27
Id = 0.15
Ip = 0.3
"""
PINNED = SHAFT + "[[support]]\nnode = [1, 5]\n"
# A pin at one end, a disc at the other: at rest four eigenvalues are zero, at speed two, beside the slow precession.
OVERHUNG = SHAFT.replace("node = 3", "node = 5").replace("modes = 2", "modes = 6").replace(
    "[events]\nharmonics = 1\n", "") + "[[bearing]]\nnode = 1\nkxx = 1e6\n"
TABLE = ("speed [rpm], kxx [N/m], kxy [N/m], kyx [N/m], kyy [N/m], cxx [N s/m], cyy [N s/m]\n"
         "500, 2.1e7, 0.9e6, -1.3e6, 3.4e7, 2.4e4, 3.1e4\n1000, 2.2e7, 1.1e6, -1.6e6, 3.3e7, 2.2e4, 2.8e4\n"
         "2000, 2.3e7, 1.5e6, -2.0e6, 3.1e7, 1.8e4, 2.3e4\n4000, 2.5e7, 2.5e6, -3.5e6, 3.0e7, 1.3e4, 1.6e4\n"
         "6000, 2.6e7, 4.0e6, -5.0e6, 2.9e7, 1.0e4, 1.2e4\n9000, 2.7e7, 6.0e6, -8.0e6, 2.8e7, 0.7e4, 0.8e4\n")

FAMILY = '[trace]\nparameter = "p"\nfrom = {}\nto = {}\n[parameters]\n{}\n[matrix_family]\n{}\n'
# Two bars with a load that follows the second one by the share 1 - a.
ZIEGLER = FAMILY.format(0, 4, "a = 0.55\nc = 0", 'M = [[[3, 1], [1, 1]]]\nC = [[["2*c", "-c"], ["-c", "c"]]]\n'
                        'K = [[[2, -1], [-1, 1]], [[-1, "a"], [0, "a-1"]]]')
THROUGH_INFINITY = FAMILY.format(0, 2, "a = 1", 'E = [[[1, 0], [0, 1]], [["-a", 0], [0, 0]]]\nA = [[[-1, 0.2], [0.3, -2]]]')


def plane(M, C, K, extra="", first="a", low=-1, high=1):
    """A family over two parameters, a and b or x and y."""
    names = "ab" if first == "a" else "xy"
    values = "\n".join(f"{name} = 0.1" for name in names)
    return (f'[trace]\nparameter = "{first}"\nfrom = {low}\nto = {high}\n{extra}\n[parameters]\n{values}\n'
            f"[matrix_family]\nM = [{M}]\nC = [{C}]\nK = [{K}]\n")


# The vector of the mode on the boundary becomes real along it.
REAL_SHAPES = plane("[[0.8, 0], [0, 1]]", '[["-0.03*b", "-0.07 + 0.16*b"], ["0.14 + 0.33*a", "0.07 + 0.1*b"]]',
                    '[["1.51 + 0.42*a - 0.28*b", "0.8*a - 0.2*b"], ["a + 0.37*b", "1.69 - 0.92*b"]]')
ROUND = plane("[[0.99, 0.14], [0.14, 0.97]]",
              '[["0.06+0.36*a^2+0.11*b", "-0.12-0.16*a^2+0.16*b"], ["-0.18-0.27*a^2+0.48*b", "0.1-0.11*a^2-0.11*b"]]',
              '[["1.01-0.37*a^2+0.36*b", "0.79*a^2-0.43*b"], ["-0.03*a^2+0.31*b", "0.58-0.17*a^2+0.4*b"]]', "tolerance = 1e-8")
# Without damping: the stiffness of the first freedom is lost at y = 0.7 + (x - 0.5)^2 / 2, and with a second one a little above.
LOST_STIFFNESS = ('[["y - 0.7 - 0.5*(x - 0.5)^2"]]', '[["y - 0.7 - 0.5*(x - 0.5)^2", 0.1], [0.1, 2]]')


class Boundaries(VerdictTest):
    def curves(self, scene, second, low, high):
        self.write("scene.toml", scene)
        text = self.run_well("boundary", "scene.toml", "--second", second, "--second-from", str(low), "--second-to", str(high),
                             "-o", "b.h5", "--force")
        return re.findall(r"^  \d+ +(\w+) .*  (\w+(?:, \w+)?)  (?:yes|no|in part)$", text, re.MULTILINE), text

    def test_a_curve_on_which_shapes_become_real_is_followed_from_edge_to_edge(self):
        curves, _ = self.curves(REAL_SHAPES, "b", -1, 1)
        self.assertEqual(curves, [("divergence", "edge, edge"), ("flutter", "edge, edge"), ("flutter", "edge, edge")])

    def test_a_closed_curve_goes_round_once_and_has_no_corners(self):
        for tolerance in "1e-8", "1e-6":
            curves, text = self.curves(ROUND.replace("1e-8", tolerance), "b", -1, 1)
            self.assertEqual(curves, [("flutter", "closed")])
            self.assertNotIn("corner", text)

    def test_without_damping_a_lost_stiffness_is_no_flutter(self):
        for stiffness in LOST_STIFFNESS:
            size = 2 if "0.1" in stiffness else 1
            curves, text = self.curves(plane(np.eye(size).tolist(), np.zeros((size, size)).tolist(), stiffness, "tolerance = 1e-8", "x",
                                             0), "y", 0, 1)
            self.assertEqual(curves, [("divergence", "edge, edge")])
            self.assertNotIn("could not be followed", text)
            self.assertRegex(text, r"edge, edge +yes\n")


class Rotors(VerdictTest):
    def critical_speeds(self, scene, *options):
        file = self.trace(scene, "--force", *options)
        return self.places(file, "resonance")

    def refused(self, scene, *options):
        self.write("scene.toml", scene)
        result = self.run_program("trace", "scene.toml", "-o", "loci.h5", "--force", *options)
        self.assertEqual(result.returncode, 2)
        return result.stderr

    def test_what_rounding_hides_is_zero(self):
        text = self.trace_and_read(OVERHUNG)
        for row in re.findall(r"^  \d+ +\S+ .*rigid-body.*$", text, re.M):
            self.assertEqual(row.split()[1:3], ["0", "-"], "at rest")
        table = self.run_well("eval", "loci.h5", "--at", "1", "3000")
        self.assertNotIn("e-", table)
        # The spin's moment of inertia over that about the pin, times the speed, of rigid bodies.
        shaft = 7810 * math.pi * 0.025**2
        rigid = (0.3 + shaft * 0.025**2 / 2) / (0.15 + 27 + shaft / 3) * 100 * math.pi
        slowest = min(float(s) for s in re.findall(r"\n  3000 +mode \d +0 \+ (\S+)j .* 0 %", table))
        self.assertAlmostEqual(slowest / rigid, 1.0, delta=5e-3)
        self.run_well("verify", "loci.h5")

    def test_a_free_shaft_that_outer_damping_brakes_is_stable(self):
        # Four zeros throughout; M, D and K are symmetric, D and K hold nothing but them.
        free = OVERHUNG.split("[[bearing]]")[0].replace("density = 7810", "density = 7810\nalpha = 0.5")
        file = self.trace(free.replace("modes = 6", "modes = 8"))
        (kind, begin, end), = self.ranges(file)
        self.assertEqual((kind, begin, end), ("stable", 0.0, 6000.0))
        with self.open(file) as loci:
            self.assertLess(loci["speed"].size, 100)
            self.assertEqual(loci["growing_unfollowed"][()].max(), 0)

    def test_a_rotor_is_excited_by_its_own_speed_in_either_sense(self):
        speeds = self.critical_speeds(PINNED)
        self.assertEqual(len(speeds), 2)
        self.assertAlmostEqual(speeds[0], 2858.3085, delta=1e-3)
        self.assertEqual([round(-speed, 6) for speed in reversed(speeds)],
                         [round(speed, 6) for speed in self.critical_speeds(PINNED, "--from", "-6000", "--to", "0")])
        bare = PINNED.replace('{ value = 3000, unit = "rpm" }', "3000").replace('speed = "speed"', 'speed = "2*pi*speed/60"')
        self.assert_within(np.array(self.critical_speeds(bare)), np.array(speeds), 1e-9)
    def test_no_frequency_is_invented(self):
        bare = PINNED.replace('speed = { value = 3000, unit = "rpm" }', "speed = 1\ntwice = 1").replace('unit = "rpm"', "")
        other = bare.replace("mass = 27", 'mass = "27*twice"').replace('parameter = "speed"', 'parameter = "twice"').replace(
            "from = 0", "from = 1").replace("to = 6000", "to = 2").replace('speed = "speed"', "speed = 300")
        self.assertIn("of what frequency? 'twice' has no unit; give `excitation`", self.refused(other))

    def test_a_range_that_is_not_reached_is_not_said_to_be_kept(self):
        operating = PINNED.replace("harmonics = 1", "harmonics = 1\noperating_range = [2900, 3500]")
        self.write("scene.toml", operating)
        text = self.run_well("trace", "scene.toml", "-o", "loci.h5", "--to", "2600")
        self.assertIn("not known as a whole: critical speeds from 2436 to 4410 matter to the operating range 2900 to 3500", text)
        for ends in (("0", "6000"), ("-6000", "0")):
            text = self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force", "--from", ends[0], "--to", ends[1])
            self.assertIn("1.44 % from the operating range", text)
            self.assertNotIn("not known", text)

    def test_a_table_over_a_multiple_of_the_speed_has_its_errors(self):
        self.write("bearing.csv", TABLE)
        scene = SHAFT.replace("from = 0", "from = 500").replace("to = 6000", "to = 4500").replace(
            "mass = 27\nId = 0.15\nIp = 0.3", "outer = 0.3\ninner = 0.05\nwidth = 0.05\ndensity = 7810")
        scene += '[[bearing]]\nnode = [1, 5]\ntable = "bearing.csv"\n'
        plain, once = (self.trace_and_read_again(scene + over) for over in ("", 'over = "1*speed"\n'))
        self.assertIn("relative error of eigenvalues between samples", plain)
        self.assertEqual(once, plain)
        twice = self.trace_and_read_again(scene + 'over = "2*speed"\n')
        self.assertRegex(twice, r"flutter +speed = 2633\.35\d* .*between 1649\.\d+ and 3384\.")

    def trace_and_read_again(self, scene):
        self.write("scene.toml", scene)
        text = self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force")
        return re.sub(r"  work .*", "", text)

    def test_how_a_shaft_can_still_move(self):
        for bearing, words in (("", "move along x, to tilt along x, to move along y and to tilt along y"),
                               ("[[support]]\nnode = 1\n", "tilt along x and to tilt along y")):
            self.write("scene.toml", SHAFT + bearing)
            text = self.run_well("explain", "scene.toml")
            self.assertIn(f"The shaft is free to {words}: eigenvalues zero.", text)
            node, holds = re.search(r"add \[\[support\]\] (node = .*), (holds = .*)\.", text).groups()
            self.write("scene.toml", f"{SHAFT}{bearing}[[support]]\n{node}\n{holds}\n")
            self.assertNotIn("free to", self.run_well("explain", "scene.toml"))

    def test_nothing_begins_where_a_bearing_without_stiffness_stops_to_hold(self):
        scene = SHAFT.split("[[disc]]")[0].replace('speed = { value = 3000, unit = "rpm" }', 'k = { value = 1, unit = "N/m" }')
        scene = scene.replace('"speed"', "314").replace("parameter = 314", 'parameter = "k"').replace("to = 6000", "to = 2e7")
        scene = scene.replace("[events]\nharmonics = 1\n", "").replace("modes = 2", "modes = 6")
        text = self.trace_and_read(scene + '[[bearing]]\nnode = [1, 5]\nkxx = "k"\ncxx = 1e4\n')
        self.assertNotIn("onset", text)
        self.assertNotIn("unstable", text)


class Families(VerdictTest):
    def test_growth_that_ended_is_no_divergence_later(self):
        # A pair is real from 4/3 to 5/3 (det K = 0), and meets the other one at 2.0624.
        file = self.trace(ZIEGLER)
        self.assertEqual([row["kind"] for row in self.events(file)], ["collision"] * 3)
        self.assertEqual([round(p, 6) for p in self.places(file, "collision")], [1.333333, 1.666667, 2.062378])

    def test_growth_from_the_start_is_not_marginal(self):
        # Re s = 0.0109 p^2: the tolerance would hide it up to p = 0.0135.
        scene = FAMILY.format(0, 1, "c = 0.2", 'M = [[[1, 0], [0, 1]]]\nC = [[["c", 0], [0, 0]]]\n'
                              "K = [[[1, 0], [0, 4]], [[0, 1], [-1, 0]]]")
        for kind, begin, end in self.ranges(self.trace(scene)):
            self.assertEqual((kind, begin), ("marginal", 0.0))
            self.assertLess(end, 1e-5)

    def test_carts_that_end_without_a_spring_are_stable_up_to_there(self):
        # s (6 s^3 + 1.5 s^2 + 5 p s + p/2): a rigid motion throughout, and three zeros at p = 0.
        scene = FAMILY.format(10, 0, "", "M = [[[2, 0], [0, 3]]]\nC = [[[0.5, 0], [0, 0]]]\n"
                              "K = [[[0, 0], [0, 0]], [[1, -1], [-1, 1]]]")
        text = self.trace_and_read(scene)
        (kind, begin, end), = self.ranges("loci.h5")
        self.assertEqual((kind, begin), ("stable", 10.0))
        self.assertAlmostEqual(end, 0.0, delta=1e-12)
        self.assertRegex(text, r"zero throughout  modes 1:[^;]*;")
        self.assertRegex(text, r"stable +p = 10 -> .* margin 0 to")

    def test_growth_through_infinity(self):
        text = self.trace_and_read(THROUGH_INFINITY)
        self.assertRegex(text, r"onset of instability\n +infinity +near p = 1 +mode 2 +unstable above")
        self.assertIn("inf + 0j", self.run_well("eval", "loci.h5", "--at", "1"))
        self.run_well("sweep", "scene.toml", "--vary", "a=0.8,1,1.25", "-o", "runs")
        rows = list(csv.DictReader((self.folder / "runs" / "index.csv").read_text().splitlines()))
        self.assert_within(np.array([float(row["divergence"]) for row in rows]), np.array([1.25, 1.0, 0.8]), 1e-9)
        text = self.run_well("boundary", "scene.toml", "--second", "a", "--second-from", "0.6", "--second-to", "1.4", "-o", "b.h5")
        self.assertIn("no boundary was followed in the window", text)
        self.assertIn("growth that begins or ends at infinity", text)

    def test_a_range_that_ends_where_the_mass_is_singular(self):
        file = self.trace(FAMILY.format(0, 1, "", "M = [[[1, 0], [0, 1]], [[-1, 0], [0, 0]]]\nC = [[[1, 0], [0, 0.1]]]\n"
                                        "K = [[[0.1, 0.03], [0.03, 4]]]"))
        with self.open(file) as loci:
            self.assertEqual(np.isinf(loci["eigenvalue"][-1]).sum(), 1)
        self.run_well("verify", file)

    def test_where_damping_vanishes_the_onset_is_at_its_place(self):
        self.write("scene.toml", ZIEGLER.replace("a = 0.55", "a = 1"))
        text = self.run_well("boundary", "scene.toml", "--second", "c", "--second-from", "0", "--second-to", "0.5", "-o", "b.h5")
        place, = re.findall(r"may have another limit: p = (\S+), c = 0", text)
        self.assertAlmostEqual(float(place), 3.5 - math.sqrt(2.0), delta=1e-7)

    def test_a_line_of_equilibria(self):
        scene = """
[parameters]
k = { value = 1, unit = "N/m" }
[trace]
parameter = "k"
from = 1
to = -0.5
[[point]]
name = "m"
mass = 1
position = [1, 0, 0]
[[fixed]]
point = "m"
coordinate = "y"
[[fixed]]
point = "m"
coordinate = "z"
[[spring]]
from = [0, 0, 0]
to = "m"
stiffness = "k"
free_length = 1
[[drag]]
point = "m"
coefficient = 0.1
"""
        self.assertIn("another equilibrium path crosses at k = 0 (a line of equilibria); branch 1 is straight on, branch 2 leaves "
                      "it (k stays, m.x rises)", self.trace_and_read(scene))


# One mass changes its sign at m = 0.01, and a real eigenvalue goes through infinity there; another one grows on both sides.
MASS_SIGN = FAMILY.format(1, -1, "k = -1", "M = [[[1, 0.1], [0.1, 0]], [[0, 0], [0, 1]]]\nC = [[[0.2, 0], [0, 0.3]]]\n"
                          'K = [[[1, 0.2], [0.2, "k"]]]')


class FewModes(VerdictTest):
    def test_a_mode_that_comes_from_infinity_does_not_take_the_place_of_one_that_grows(self):
        for choice in "--modes=1", "--modes=2":
            for tolerance in "1e-5", "1e-6", "1e-7":
                text = self.trace_and_read(MASS_SIGN, "--set", "k=-1", choice, "--tolerance", tolerance)
                self.assertIn("stable ranges  none", text)
                self.assertNotIn("no special point was located", text)

    def test_one_eigenvalue_is_one_mode_also_as_its_reciprocal(self):
        self.trace_and_read(MASS_SIGN, "--set", "k=0", "--modes=1")
        rows = list(csv.DictReader(self.run_well("eval", "loci.h5", "--at", "-0.1", "--csv").splitlines()))
        companion = np.linalg.solve(np.block([[np.eye(2), np.zeros((2, 2))], [np.zeros((2, 2)), np.array([[1, 0.1], [0.1, -0.1]])]]),
                                    np.block([[np.zeros((2, 2)), np.eye(2)],
                                              [-np.array([[1, 0.2], [0.2, 0]]), -np.diag([0.2, 0.3])]]))
        grows = sorted(s.real for s in np.linalg.eigvals(companion) if s.real > 0 and s.imag >= 0)
        np.testing.assert_allclose(sorted(float(row["real"]) for row in rows if float(row["real"]) > 0), grows, rtol=1e-5)


if __name__ == "__main__":
    unittest.main()
