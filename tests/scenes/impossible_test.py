"""Mechanisms that cannot be assembled or solved: the message names the constraint or the freedom, and no file is left."""
import unittest

from program import ProgramTest

HEAD = """
parameters = { g = 9.81 }
trace = { parameter = "g", from = 5, to = 10 }
gravity = { acceleration = [0, "-g", 0] }
"""

BODY = """
[[body]]
name = "{name}"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = {position}
markers = {{ end = [{length}, 0, 0] }}
"""

HINGE = """
[[revolute]]
name = "{name}"
from = {start}
to = {end}
axis = [0, 0, 1]
"""


def four_bar(rocker):
    """Crank 0.3, coupler 0.5, ground 2: closes for rockers from 1.2 to 2.8 only."""
    return (HEAD + BODY.format(name="crank", position="[0, 0, 0]", length=0.3)
            + BODY.format(name="coupler", position="[0.3, 0, 0]", length=0.5)
            + BODY.format(name="rocker", position="[2, 0, 0]", length=f"-{rocker}")
            + HINGE.format(name="first", start="[0, 0, 0]", end='"crank"')
            + HINGE.format(name="second", start='"crank.end"', end='"coupler"')
            + HINGE.format(name="closing", start='"coupler.end"', end='"rocker.end"')
            + HINGE.format(name="fourth", start="[2, 0, 0]", end='"rocker"'))


class ImpossibleTest(ProgramTest):
    def refused(self, text, *expected):
        self.write("scene.toml", text)
        self.assert_refused(self.run_program("trace", "scene.toml", "-o", "x.h5"), expected)
        self.assertEqual(set(map(str, self.contents())), {"scene.toml"})

    def test_loop_that_cannot_close(self):
        self.refused(four_bar(0.5), "no configuration near the starting guess meets all constraints", "'closing[0]'",
                     "is missed by")

    def test_the_same_loop_closes_with_a_longer_rocker(self):
        explained = self.run_well("explain", self.write("scene.toml", four_bar(1.5)))
        self.assertIn("(3 more say what others do)", explained)

    def test_joints_that_contradict_each_other(self):
        scene = (HEAD + BODY.format(name="bar", position="[0, 0, 0]", length=0.3)
                 + HINGE.format(name="hinge", start="[0, 0, 0]", end='"bar"')
                 + '[[fixed]]\nname = "stop"\npoint = "bar.end"\ncoordinate = "z"\nvalue = 0.1\n')
        self.refused(scene, "meets all constraints", "'stop'", "contradict")

    def test_rotation_without_inertia(self):
        scene = HEAD + """
[[body]]
name = "rod"
mass = 1
centre = [0.5, 0, 0]
inertia = [0, 0.1, 0.1]
position = [0, 0, 0]
axis_angle = { axis = [0, 0, 1], angle = -1.57 }
[[ball]]
from = [0, 0, 0]
to = "rod"
"""
        self.refused(scene, "the pencil is singular", "'rod.", "no mass or inertia", "give it inertia")

    def test_massless_body_that_nothing_holds(self):
        scene = HEAD + """
[[point]]
name = "bob"
mass = 1
position = [0, -1, 0]
[[rod]]
from = [0, 0, 0]
to = "bob"
length = 1
[[body]]
name = "ghost"
mass = 0
position = [0, 0, 0]
[[ball]]
from = [0, 0, 0]
to = "ghost"
"""
        self.refused(scene, "the pencil is singular", "'ghost.")

    def test_nothing_to_follow_where_no_force_acts(self):
        scene = HEAD + """
[[point]]
name = "bob"
mass = 1
position = [1, 0, 0]
"""
        self.write("scene.toml", scene)
        self.assert_refused(self.run_program("trace", "scene.toml", "-o", "x.h5", "--without", "gravity"),
                            ["no force acts"])


if __name__ == "__main__":
    unittest.main()
