"""Relations between joints: gears, a rack, a screw, a differential, against closed forms."""

import math
import unittest

import numpy as np
import scipy.linalg

from program import EXIT_BAD_INPUT
from scene_test_case import SceneTest

PLACES = (9.81, 10.5, 12.0)
HEAD = """\
parameters = { g = 9.81, n = 2.0 }
trace = { parameter = "g", from = 9.81, to = 12 }
gravity = { acceleration = [0, 0, "-g + 0 * n"] }
"""


def pendulum(name, hinge, mass, centre, at=(0, 0, 0), on="[0, 0, 0]"):
    """Hangs from a hinge about y; 0.06 about its centre."""
    x, _, z = at
    return (f'[[body]]\nname = "{name}"\nmass = {mass}\ncentre = [{centre}, 0, 0]\ninertia = [0.05, 0.06, 0.07]\n'
            f'position = [{x}, 0, {z}]\nx_axis = [0, 0, -1]\ny_axis = [0, 1, 0]\nmarkers = {{ end = [0.5, 0, 0] }}\n'
            f'[[revolute]]\nname = "{hinge}"\nfrom = {on}\nto = "{name}"\naxis = [0, 1, 0]\n')


A = pendulum("a", "first", 2.0, 0.3)
B = pendulum("b", "second", 1.0, 0.2, (1, 0, 0), "[1, 0, 0]")
I_A, I_B = 0.06 + 2.0 * 0.3**2, 0.06 + 0.2**2


class Coupled(SceneTest):
    def check(self, text, closed_form, places=PLACES, *options):
        path = self.trace_text(text, *options)
        self.check_frequencies(path, closed_form, places)
        return path

    def test_two_pendulums_with_gears(self):
        for wheels in ("", "internal = true\n"):
            gear = f'[[gear]]\njoints = ["first", "second"]\nteeth = ["n", 1]\n{wheels}'
            self.check(HEAD + A + B + gear, lambda g: [math.sqrt(g * (0.6 + 0.2 * 4) / (I_A + I_B * 4))])
        self.check(HEAD + A + B + gear, lambda n: [math.sqrt(9.81 * (0.6 + 0.2 * n * n) / (I_A + I_B * n * n))], (1, 2, 5),
                   "--parameter", "n", "--from", "1", "--to", "5")

    def test_wheels_turn_in_opposite_directions_however_their_joints_are_declared(self):
        """Weights off the vertical on both arms tell the sense."""
        A = pendulum("a", "first", 2.0, 0.3).replace("centre = [0.3, 0, 0]", "centre = [0.3, 0, 0.2]")
        turned = B.replace("centre = [0.2, 0, 0]", "centre = [0.2, 0, 0.1]")
        gear = '[[gear]]\njoints = ["first", "second"]\nteeth = ["n", 1]\n'
        expected = self.nodes(self.trace_text(HEAD + A + turned + gear))[1][0]
        for before, behind in (("\naxis = [0, 1, 0]", "\naxis = [0, -3, 0]"), ('from = [1, 0, 0]\nto = "b"', 'from = "b"\nto = [1, 0, 0]')):
            found = self.nodes(self.trace_text(HEAD + A + turned.replace(before, behind) + gear))[1][0]
            np.testing.assert_allclose(found, expected, rtol=1e-12)
        internal = self.nodes(self.trace_text(HEAD + A + turned + gear + "internal = true\n"))[1][0]
        self.assertGreater(np.abs(internal - expected).max(), 0.01)

    def test_a_wheel_on_the_arm_that_it_meshes_with(self):
        """The second pendulum hangs from the end of the first; it rolls on a wheel that is at rest, outside or inside."""
        B_on_a = pendulum("b", "second", 1.0, 0.2, (0, 0, -0.5), '"a.end"')
        for internal, sign in (("false", 1.0), ("true", -1.0)):
            gear = f'[[gear]]\njoints = ["first", "second"]\nteeth = ["n", 1]\ninternal = {internal}\n'
            turn = 1.0 + 2.0 * sign  # of the second, where the first turns by 1
            inertia = I_A + (0.5 + 0.2 * turn) ** 2 + 0.06 * turn**2
            self.check(HEAD + A + B_on_a + gear, lambda g: [math.sqrt(g * (0.6 + 0.5 + 0.2 * turn**2) / inertia)])

    def test_rack_and_pinion(self):
        """The weight of the rack lifts the pendulum: 0.6 sin(angle) = 1.2 r / 2 at every g."""
        rack = ('[[body]]\nname = "rack"\nmass = 1.2\ninertia = [1, 1, 1]\nposition = [0.25, 0, 0.4]\n'
                '[[prismatic]]\nname = "slide"\nfrom = [0.25, 0, 0]\nto = "rack"\naxis = [0, 0, 1]\n'
                '[[coupler]]\njoints = ["first", "slide"]\nratios = [0.25, 1]\n')
        sine = 1.2 * 0.25 / 0.6
        path = self.check(HEAD + A + rack, lambda g: [math.sqrt(g * 0.6 * math.sqrt(1 - sine**2) / (I_A + 1.2 * 0.25**2))])
        np.testing.assert_allclose(self.coordinate(path, "rack.z"), 0.4 - 0.25 * math.asin(sine), rtol=1e-10)

    def test_screw(self):
        """Its weight turns the nut against a spring: k angle = m g h, and m h^2 adds to the inertia."""
        screw = ('[[body]]\nname = "nut"\nmass = 3.0\ninertia = [0.05, 0.06, 0.07]\nposition = [0, 0, 0.5]\n'
                 '[[cylindrical]]\nname = "screw"\nfrom = [0, 0, 0]\nto = "nut"\naxis = [0, 0, 1]\n'
                 '[[torsional_spring]]\njoint = "screw"\nstiffness = 40\n'
                 '[[coupler]]\njoints = ["screw", "screw.slide"]\nratios = ["0.05 * n", 1]\n')
        path = self.check(HEAD + screw, lambda g: [math.sqrt(40 / (0.07 + 3 * 0.01))])
        np.testing.assert_allclose(self.coordinate(path, "nut.z"), 0.5 - 3 * self.nodes(path)[0] * 0.01 / 40, rtol=1e-11)

    def test_differential(self):
        """The third turns by the mean of the others."""
        C = pendulum("c", "third", 1.5, 0.1, (2, 0, 0), "[2, 0, 0]")
        relation = '[[coupler]]\njoints = ["first", "second", "third"]\nratios = [1, 1, -2]\n'

        def closed_form(g):
            share = np.array([[0.25, 0.25], [0.25, 0.25]])
            M = np.diag([I_A, I_B]) + (0.06 + 1.5 * 0.01) * share
            return np.sqrt(scipy.linalg.eigvalsh(g * (np.diag([0.6, 0.2]) + 0.15 * share), M))

        self.check(HEAD + A + B + C + relation, closed_form)

    def train(self, ends=""):
        """Motor, pinion, wheel and load, two elastic shafts; `ends` holds what else there is."""
        places = {"motor": ([0, 0, 0], 2.0), "pinion": ([0, 0, 1], 0.1), "wheel": ([1, 0, 1], 0.9), "load": ([1, 0, 2], 7.0)}
        text = '[parameters]\nk = 4e4\nn = 3\n[trace]\nparameter = "k"\nfrom = 1e4\nto = 8e4\n'
        for name, (at, inertia) in places.items():
            text += (f'[[body]]\nname = "{name}"\nmass = 1\ninertia = [4, 4, {inertia}]\nposition = {at}\n'
                     f'[[revolute]]\nname = "{name} bearing"\nfrom = {at}\nto = "{name}"\naxis = [0, 0, 1]\n')
        for first, second, stiffness in (("motor", "pinion", '"k"'), ("wheel", "load", "9e4")):
            text += (f'[[cylindrical]]\nname = "{first} shaft"\nfrom = "{first}"\nto = "{second}"\naxis = [0, 0, 1]\n'
                     f'[[torsional_spring]]\njoint = "{first} shaft"\nstiffness = {stiffness}\n')
        return text + '[[gear]]\njoints = ["pinion bearing", "wheel bearing"]\nteeth = [1, "n"]\n' + ends

    @staticmethod
    def frequencies(k, n, ground=0.0):
        M = np.diag([2.0, 0.1 + 0.9 / n**2, 7.0])
        K = np.array([[k + ground, -k, 0], [-k, k + 9e4 / n**2, 9e4 / n], [0, 9e4 / n, 9e4]])
        return np.sqrt(np.abs(scipy.linalg.eigvalsh(K, M)))

    def test_geared_train_that_turns_freely(self):
        path = self.trace_text(self.train(), tolerance=1e-9)
        for k in (1e4, 4e4, 8e4):
            s = self.eval_at(path, [k])[0]
            np.testing.assert_array_equal(s[:2], 0.0)
            np.testing.assert_allclose(s[2:].imag, self.frequencies(k, 3)[1:], rtol=1e-9)
        self.run_well("verify", path)

    def test_ratio_of_a_free_train_is_traced(self):
        """The free motion turns with the ratio: that it is zero is rounding, and so is whether its two eigenvalues are a pair."""
        path = self.trace_text(self.train(), "--parameter", "n", "--from", "1", "--to", "5", tolerance=1e-9)
        _, at_nodes = self.nodes(path)
        self.assertFalse(np.isnan(at_nodes[:, ~np.isnan(at_nodes[0].real)]).any())
        for n in (1, 2.5, 5):
            s = self.eval_at(path, [n])[0]
            s = s[np.isfinite(s.real)]
            np.testing.assert_allclose(s[:-2], 0.0, atol=1e-4)
            np.testing.assert_allclose(s[-2:].imag, self.frequencies(4e4, n)[1:], rtol=1e-9)
        self.run_well("verify", path)

    def test_ratio_of_a_train_is_traced(self):
        spring = '[[torsional_spring]]\njoint = "motor bearing"\nstiffness = 500\n'
        path = self.check(self.train(spring), lambda n: self.frequencies(4e4, n, 500.0), (1, 2.5, 5),
                          "--parameter", "n", "--from", "1", "--to", "5")
        self.run_well("verify", path)

    def test_mistakes(self):
        for table, message in [
                ('[[gear]]\njoints = ["first", "secnd"]\nteeth = [1, 2]\n', "secnd"),
                ('[[gear]]\njoints = ["first", "second"]\nteeth = [1, 2, 3]\n', "expected the numbers of two wheels, found 3"),
                ('[[gear]]\njoints = ["first", "second"]\nteeth = [1, 0]\n', "teeth"),
                ('[[gear]]\njoints = ["first", "across"]\nteeth = [1, 2]\n', "axes of two wheels must be parallel"),
                ('[[coupler]]\njoints = ["first", "first"]\nratios = [1, 2]\n', "has 'first' twice"),
                ('[[coupler]]\njoints = ["first"]\nratios = [1]\n', "expected two joints or more"),
                ('[[coupler]]\njoints = ["first", "second"]\nratios = [1]\n', "found 2 joints and 1 ratios")]:
            with self.subTest(table):
                across = pendulum("c", "across", 1.0, 0.2, (2, 0, 0), "[2, 0, 0]").replace("\naxis = [0, 1, 0]", "\naxis = [1, 0, 0]")
                self.write("scene.toml", HEAD + A + B + across + table)
                run = self.run_program("explain", "scene.toml")
                self.assertEqual(run.returncode, EXIT_BAD_INPUT)
                self.assertIn(message, run.stderr)


if __name__ == "__main__":
    unittest.main()
