"""Every joint, and what acts on its angle, in the smallest scene that has a closed form."""

import math
import unittest

import numpy as np

from scene_test_case import SceneTest

PLACES = (9.81, 10.5, 12.0)

HEAD = """\
parameters = { g = 9.81, p = 0.0 }
trace = { parameter = "g", from = 9.81, to = 12 }
gravity = { acceleration = [0, 0, "-g + 0 * p"] }
"""

# m = 2, centre 0.3 below the hinge, 0.06 + 2 * 0.3^2 about it
PENDULUM = """\
[[body]]
name = "arm"
mass = 2.0
centre = [0.3, 0, 0]
inertia = [0.05, 0.06, 0.07]
position = [0, 0, 0]
x_axis = [0, 0, -1]
y_axis = [0, 1, 0]
markers = { end = [0.5, 0, 0] }
"""
HINGE = '[[revolute]]\nname = "hinge"\nfrom = [0, 0, 0]\nto = "arm"\naxis = [0, 1, 0]\n'
MASS, CENTRE, INERTIA = 2.0, 0.3, 0.06 + 2.0 * 0.3**2

SECOND = """\
[[body]]
name = "second"
mass = 1.0
centre = [0.2, 0, 0]
inertia = [0.01, 0.02, 0.02]
position = [0, 0, -0.5]
x_axis = [0, 0, -1]
y_axis = [0, 1, 0]
"""


def composite(g, angle):
    """Arm and second body as one, the latter turned by `angle` at the arm's end."""
    along, across = 0.5 + 0.2 * math.cos(angle), 0.2 * math.sin(angle)
    inertia = INERTIA + 0.02 + along**2 + across**2
    return math.sqrt(g * math.hypot(MASS * CENTRE + along, across) / inertia)


def pairs(M, K):
    return np.sqrt(np.linalg.eigvals(np.linalg.solve(np.array(M), np.array(K))).real)


class Joints(SceneTest):
    def check(self, text, closed_form, places=PLACES, *options):
        path = self.trace_text(text, *options)
        self.check_frequencies(path, closed_form, places)
        return path

    def test_weld(self):
        joint = '[[weld]]\nfrom = "arm.end"\nto = "second"\n'
        self.check(HEAD + PENDULUM + HINGE + SECOND + joint, lambda g: [composite(g, 0.0)])

    def test_weld_of_bodies_that_stand_crosswise(self):
        second = SECOND.replace("x_axis = [0, 0, -1]", "x_axis = [-1, 0, 0]")
        joint = '[[weld]]\nfrom = "second"\nto = "arm.end"\n'
        self.check(HEAD + PENDULUM + HINGE + second + joint, lambda g: [composite(g, math.pi / 2)])

    def test_revolute_held_at_an_angle(self):
        joint = '[[revolute]]\nfrom = "arm.end"\nto = "second"\naxis = "arm.y"\nangle = "p"\n'
        text = HEAD + PENDULUM + HINGE + SECOND + joint
        path = self.check(text, lambda p: [composite(9.81, p)], (0.0, 0.5, 1.5, 2.5), "--parameter", "p", "--to", "2.5",
                          "--from", "0")
        p, _ = self.nodes(path)
        # Right-handed about y: hanging parts turn towards -x by a positive angle, and the arm swings back.
        relative = np.arctan2(-self.coordinate(path, "second.x_axis.x"), -self.coordinate(path, "second.x_axis.z")) - np.arctan2(
            -self.coordinate(path, "arm.x_axis.x"), -self.coordinate(path, "arm.x_axis.z"))
        np.testing.assert_allclose(relative, p, atol=1e-11)

    def test_cardan_joint_with_springs(self):
        """Centre of mass at the joint: each axis has its own spring and inertia."""
        body = '[[body]]\nname = "arm"\nmass = 2.0\ninertia = [0.05, 0.06, 0.07]\nposition = [0, 0, 0]\n'
        joint = ('[[universal]]\nname = "j"\nfrom = [0, 0, 0]\nto = "arm"\naxis = [1, 0, 0]\ncross_axis = "arm.y"\n'
                 '[[torsional_spring]]\njoint = "j"\nabout = "axis"\nstiffness = 3\n'
                 '[[torsional_spring]]\njoint = "j"\nabout = "cross_axis"\nstiffness = "5 + p"\n')
        path = self.trace_text(HEAD + body + joint, "--parameter", "p", "--from", "0", "--to", "4")
        self.check_frequencies(path, lambda p: [math.sqrt(3 / 0.05), math.sqrt((5 + p) / 0.06)], (0.0, 1.0, 4.0))

    def test_ball(self):
        """Two pendulums and a turn about the vertical that nothing resists."""
        path = self.trace_text(HEAD + PENDULUM + '[[ball]]\nfrom = [0, 0, 0]\nto = "arm"\n', tolerance=1e-8)
        for g in PLACES:
            s = self.eval_at(path, [g])[0]
            s = np.sort(s[~np.isnan(s.real)].imag)
            expected = [math.sqrt(g * 0.6 / (moment + 0.18)) for moment in (0.07, 0.06)]
            np.testing.assert_allclose(s[-2:], expected, rtol=1e-7)
            np.testing.assert_allclose(s[:-2], 0.0, atol=1e-5)

    def test_cylindrical(self):
        joint = ('[[cylindrical]]\nname = "j"\nfrom = [0, 0, 0]\nto = "slug"\naxis = [0, 0, 1]\n'
                 '[[torsional_spring]]\njoint = "j"\nstiffness = 0.4\n'
                 '[[spring]]\nfrom = [0, 0, 2]\nto = "slug"\nstiffness = 90\nfree_length = 2\n')
        body = '[[body]]\nname = "slug"\nmass = 2.0\ninertia = [0.05, 0.06, 0.07]\nposition = [0, 0, -0.2]\n'
        path = self.check(HEAD + body + joint, lambda g: [math.sqrt(0.4 / 0.07), math.sqrt(45)])
        np.testing.assert_allclose(self.coordinate(path, "slug.z"), -2.0 * self.nodes(path)[0] / 90.0, rtol=1e-11)

    def test_prismatic_in_a_turning_frame(self):
        """k - m W^2: the slider moves out, and slows down."""
        text = (HEAD + '[frame]\nangular_velocity = [0, 0, "p"]\n'
                '[[body]]\nname = "slider"\nmass = 2.0\ninertia = [0.05, 0.06, 0.07]\nposition = [1, 0, 0]\n'
                '[[prismatic]]\nfrom = [0, 0, 0]\nto = "slider"\naxis = [1, 0, 0]\n'
                '[[spring]]\nfrom = [0, 0, 0]\nto = "slider"\nstiffness = 90\nfree_length = 1\n')
        path = self.check(text, lambda p: [math.sqrt(45 - p * p)], (0.0, 3.0, 6.0), "--parameter", "p", "--from", "0",
                          "--to", "6")
        p, _ = self.nodes(path)
        np.testing.assert_allclose(self.coordinate(path, "slider.x"), 90.0 / (90.0 - 2.0 * p**2), rtol=1e-11)

    def test_prismatic_held_at_a_length(self):
        second = SECOND.replace("centre = [0.2, 0, 0]\n", "")
        joint = '[[prismatic]]\nfrom = "arm"\nto = "second"\naxis = "arm.x"\nlength = "0.5 + p"\n'
        closed_form = lambda p: [math.sqrt(9.81 * (0.6 + 0.5 + p) / (INERTIA + 0.02 + (0.5 + p) ** 2))]
        self.check(HEAD + PENDULUM + HINGE + second + joint, closed_form, (0.0, 0.7, 2.0), "--parameter", "p", "--from", "0",
                   "--to", "2")

    # A bead slides on a swinging arm, on a spring from the hinge: angle and distance do not couple.
    BEAD = ('[[point]]\nname = "bead"\nmass = 0.7\nposition = [0, 0, -0.5]\n'
            '[[spring]]\nfrom = [0, 0, 0]\nto = "bead"\nstiffness = 80\nfree_length = 0.4\n')

    @staticmethod
    def bead_on_arm(g):
        r = 0.4 + 0.7 * g / 80
        return [math.sqrt(g * (0.6 + 0.7 * r) / (INERTIA + 0.7 * r * r)), math.sqrt(80 / 0.7)]

    def test_point_on_the_line_of_a_body(self):
        joint = '[[point_on_line]]\nfrom = "arm"\nto = "bead"\naxis = "arm.x"\n'
        self.check(HEAD + PENDULUM + HINGE + self.BEAD + joint, self.bead_on_arm)

    def test_point_on_the_plane_of_a_body(self):
        joint = ('[[point_on_plane]]\nfrom = "arm"\nto = "bead"\nnormal = "arm.z"\n'
                 '[[fixed]]\npoint = "bead"\ncoordinate = "y"\n')
        self.check(HEAD + PENDULUM + HINGE + self.BEAD + joint, self.bead_on_arm)

    def test_hinge_made_of_coordinates(self):
        """The arm's origin held, and two of its markers in the plane of swing."""
        held = "".join(f'[[fixed]]\npoint = "arm"\ncoordinate = "{c}"\n' for c in "xyz")
        held += '[[plane]]\npoint = "arm.end"\nnormal = [0, 3, 0]\n'
        held += '[[fixed]]\npoint = { body = "arm", at = [0.1, 0, 0.2] }\ncoordinate = "y"\n'
        self.check(HEAD + PENDULUM + held, lambda g: [math.sqrt(g * 0.6 / INERTIA)])

    def test_bifilar_pendulum(self):
        """A bar on two parallel threads h = 0.8, b = 0.25 either side and c = 0.1 above its centre."""
        h, b, c = 0.8, 0.25, 0.1
        text = HEAD + f"""
[[body]]
name = "bar"
mass = 2.0
inertia = [0.05, 0.06, 0.07]
position = [0, 0, {-h - c}]
markers = {{ left = [{-b}, 0, {c}], right = [{b}, 0, {c}] }}
[[rod]]
from = [{-b}, 0, 0]
to = "bar.left"
length = {h}
[[rod]]
from = [{b}, 0, 0]
to = "bar.right"
length = {h}
"""
        def closed_form(g):
            swing = pairs([[2 * h * h, 2 * h * c], [2 * h * c, 2 * c * c + 0.05]], [[2 * g * h, 0], [0, 2 * g * c]])
            return [math.sqrt(g / h), math.sqrt(2 * g * b * b / (h * 0.07)), *swing]

        self.check(text, closed_form)


class AnglesOfJoints(SceneTest):
    """What acts on the angle of a hinge: right-handed about the axis, of the second side against the first."""

    def balance(self, moment, slope, guess=0.0):
        """Angle and frequency where moment(a) - 0.6 g sin a = 0."""
        def at(g):
            a = guess
            for _ in range(100):
                a -= (moment(a) - 0.6 * g * math.sin(a)) / (slope(a) - 0.6 * g * math.cos(a))
            return a, math.sqrt((0.6 * g * math.cos(a) - slope(a)) / INERTIA)
        return at

    def check(self, addition, at, hinge=HINGE):
        path = self.trace_text(HEAD + PENDULUM + hinge + addition)
        self.check_frequencies(path, lambda g: [at(g)[1]], PLACES)
        found = np.arctan2(-self.coordinate(path, "arm.x_axis.x"), -self.coordinate(path, "arm.x_axis.z"))
        np.testing.assert_allclose(found, [at(g)[0] for g in self.nodes(path)[0]], rtol=1e-10)

    SPRING = '[[torsional_spring]]\njoint = "hinge"\nstiffness = 4\n'

    def test_free_angle_of_a_spring(self):
        self.check(self.SPRING + "free_angle = 0.8\n", self.balance(lambda a: -4 * (a - 0.8), lambda a: -4))

    def test_preload_of_a_spring(self):
        self.check(self.SPRING + "preload = 2\n", self.balance(lambda a: -4 * a - 2, lambda a: -4))

    def test_hinge_seen_from_the_other_side(self):
        hinge = HINGE.replace('from = [0, 0, 0]\nto = "arm"', 'from = "arm"\nto = [0, 0, 0]')
        self.check(self.SPRING + "free_angle = 0.8\n", self.balance(lambda a: -4 * (a + 0.8), lambda a: -4), hinge)

    def test_axis_of_the_other_sense(self):
        hinge = HINGE.replace("axis = [0, 1, 0]", "axis = [0, -2, 0]")
        self.check(self.SPRING + "free_angle = 0.8\n", self.balance(lambda a: -4 * (a + 0.8), lambda a: -4), hinge)

    def test_dead_moment_and_follower_moment(self):
        for along in ("[0, 2, 0]", '"arm.y"'):
            self.check(f'[[moment]]\nbody = "arm"\nalong = {along}\nmagnitude = 3\n', self.balance(lambda a: 3, lambda a: 0))

    def test_moments_along_the_axis_of_a_cardan_joint(self):
        """Angles a about x, then b about the body's y. A dead moment P along z works on b with P sin a, a follower along the
        body's z on a with P sin b: each fills one corner of K, so both are seen together only."""
        body = '[[body]]\nname = "arm"\nmass = 2.0\ninertia = [0.05, 0.05, 0.07]\nposition = [0, 0, 0]\n'
        joint = ('[[universal]]\nname = "j"\nfrom = [0, 0, 0]\nto = "arm"\naxis = [1, 0, 0]\ncross_axis = "arm.y"\n'
                 '[[torsional_spring]]\njoint = "j"\nabout = "axis"\nstiffness = 3\n'
                 '[[torsional_spring]]\njoint = "j"\nabout = "cross_axis"\nstiffness = 5\n')
        for dead, follower in ((1, 0), (0, 1), (1, 1), (-1, -1), (1, -0.5)):
            moments = "".join(f'[[moment]]\nbody = "arm"\nalong = {along}\nmagnitude = "{share} * p"\n'
                              for along, share in (("[0, 0, 1]", dead), ('"arm.z"', follower)))
            path = self.trace_text(HEAD + body + joint + moments, "--parameter", "p", "--from", "0", "--to", "1.2")
            for p in (0.0, 0.7, 1.2):
                K = np.array([[3.0, -follower * p], [-dead * p, 5.0]])
                np.testing.assert_allclose(np.sort(self.eval_at(path, [p])[0].imag), np.sort(pairs(0.05 * np.eye(2), K)),
                                           rtol=1e-10)

    def test_damper(self):
        path = self.trace_text(HEAD + PENDULUM + HINGE + '[[torsional_damper]]\njoint = "hinge"\ncoefficient = 0.9\n')
        for g in PLACES:
            expected = (-0.9 + np.sqrt(complex(0.81 - 4 * INERTIA * 0.6 * g))) / (2 * INERTIA)
            self.assert_within(self.eval_at(path, [g])[0, 0], expected, 1e-10)

    def test_linear_spring_and_damper_between_markers(self):
        """From a place beside the hinge's height to the arm's end, level: stiffness and damping times 0.5^2."""
        effects = ('[[spring]]\nfrom = [1, 0, -0.5]\nto = "arm.end"\nstiffness = 7\nfree_length = 1\n'
                   '[[damper]]\nfrom = "arm.end"\nto = [1, 0, -0.5]\ncoefficient = 2\n')
        path = self.trace_text(HEAD + PENDULUM + HINGE + effects)
        for g in PLACES:
            b, c = 2 * 0.25, 0.6 * g + 7 * 0.25
            expected = (-b + np.sqrt(complex(b * b - 4 * INERTIA * c))) / (2 * INERTIA)
            self.assert_within(self.eval_at(path, [g])[0, 0], expected, 1e-10)


class Redundant(SceneTest):
    def test_a_ball_joint_that_is_given_twice_is_one(self):
        """Two free bodies in a ball joint, one spring: its constraints are linear, so that those of the second one say the same everywhere."""
        joint = '[[ball]]\nfrom = { body = "a", at = [0.5, 0, 0] }\nto = { body = "b", at = [-0.5, 0, 0] }\n'
        bodies = "".join(f'[[body]]\nname = "{name}"\nmass = 1\ninertia = [0.1, 0.15, 0.2]\nposition = {at}\n'
                         for name, at in (("a", [0, 0, 0]), ("b", [1, 0, 0])))
        spring = '[[guided_spring]]\npoint = { body = "b", at = [0.3, 0.2, 0] }\ndirection = [0, 0, 1]\nstiffness = "k"\n'
        head = '[parameters]\nk = 40\n[trace]\nparameter = "k"\nfrom = 10\nto = 60\n'
        spectra = [self.eval_at(self.trace_text(head + bodies + spring + joint * times), [10.0, 35.0]) for times in (1, 2)]
        np.testing.assert_allclose(*spectra, rtol=1e-9, atol=1e-9)


if __name__ == "__main__":
    unittest.main()
