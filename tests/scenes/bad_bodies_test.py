"""Bad input about bodies, joints and what acts on them: exit code 2, one line on stderr with file, line, column and key that
says what is wrong and what would be right, and no file left.

In the scenes below "§" stands where the message must point; it is taken out before the run.
"""

import unittest

from program import ProgramTest, each_case, edited

SCENE = """\
[parameters]
omega = 3.0
g = 9.81

[trace]
parameter = "omega"
from = 1
to = 5

[frame]
angular_velocity = [0, 0, "omega"]

[gravity]
acceleration = [0, 0, "-g"]

[[point]]
name = "ball"
mass = 1.0
position = [0, 0, -2]

[[body]]
name = "blade"
mass = 2.0
centre = [0.5, 0, 0]
inertia = [0.1, 0.2, 0.25]
position = [0, 0, 0]
x_axis = [0, 0, -1]
y_axis = [0, 1, 0]
markers = { tip = [1, 0, 0] }

[[body]]
name = "second"
mass = 1.0
inertia = [0.1, 0.1, 0.1]
position = [0, 0, -1.5]

[[revolute]]
name = "hinge"
from = [0, 0, 0]
to = "blade"
axis = [0, 1, 0]

[[universal]]
name = "cardan"
from = "blade.tip"
to = { body = "second", at = [0, 0, 0.5] }
axis = [1, 0, 0]
cross_axis = "second.y"

[[ball]]
name = "socket"
from = "second"
to = "ball"
"""


def scene(name, old, new, *fragments):
    return name, edited(SCENE, old, new), fragments


def scene_with(name, addition, *fragments):
    return name, f"{SCENE}\n{addition}\n", fragments


BODIES = [
    scene("body without mass", '[[body]]\nname = "blade"\nmass = 2.0', '§[[body]]\nname = "blade"',
          "[[body]] 1 mass: is missing", "expected a number or an expression"),
    scene("body without name", '[[body]]\nname = "second"', "§[[body]]", "[[body]] 2 name: is missing", "expected a text"),
    scene("body without position", "position = [0, 0, -1.5]\n", "", "[[body]] 2 position: is missing",
          "expected three numbers") + (('[[body]]\nname = "second"', '§[[body]]\nname = "second"'),),
    scene("negative mass", "mass = 2.0", "§mass = -2.0", "[[body]] 1 mass: must not be negative", "found -2"),
    scene("two bodies of one name", 'name = "second"', '§name = "blade"',
          "[[body]] 2 name: another body or point is called 'blade' already"),
    scene("body named like a point", 'name = "second"', '§name = "ball"',
          "[[body]] 2 name: another body or point is called 'ball' already"),
    scene("misspelt key of a body", "centre = [0.5, 0, 0]", "§center = [0.5, 0, 0]",
          "[[body]] 1 center: unknown key", "did you mean 'centre'?"),
    scene("inertia that no body has", "[0.1, 0.2, 0.25]", "[0.1, 0.2, 0.35]",
          "[[body]] 1 inertia: no body has it: one principal moment exceeds the sum of the other two")
    + (("inertia = [0.1, 0.2", "§inertia = [0.1, 0.2"),),
    scene("negative inertia", "[0.1, 0.2, 0.25]", "[-0.1, 0.2, 0.2]", "[[body]] 1 inertia: no body has it")
    + (("inertia = [-0.1", "§inertia = [-0.1"),),
    scene("inertia that no body has, off the diagonal", "inertia = [0.1, 0.1, 0.1]",
          "§inertia = [[0.1, 0.09, 0], [0.09, 0.1, 0], [0, 0, 0.1]]", "[[body]] 2 inertia: no body has it"),
    scene("inertia that is not symmetric", "inertia = [0.1, 0.1, 0.1]",
          "§inertia = [[0.1, 0.01, 0], [0, 0.1, 0], [0, 0, 0.1]]", "[[body]] 2 inertia: must be symmetric"),
    scene("inertia of two numbers", "[0.1, 0.2, 0.25]", "[0.1, 0.2]",
          "[[body]] 1 inertia: expected [Ixx, Iyy, Izz] or a 3 x 3 matrix")
    + (("inertia = [0.1, 0.2]", "§inertia = [0.1, 0.2]"),),
    scene("inertia that stops being one within the range", "inertia = [0.1, 0.1, 0.1]",
          '§inertia = [0.1, 0.1, "0.05 * omega"]', "[[body]] 2 inertia: no body has it", "where the trace ends"),
    scene("parallel axes", "y_axis = [0, 1, 0]", "§y_axis = [0, 0, 2]", "[[body]] 1 y_axis: must not be parallel to x_axis"),
    scene("one axis", "y_axis = [0, 1, 0]\n", "", "[[body]] 1 x_axis: an orientation is given once",
          "two of x_axis, y_axis, z_axis") + (("x_axis = [0, 0, -1]", "§x_axis = [0, 0, -1]"),),
    scene("three axes", "y_axis = [0, 1, 0]\n", "y_axis = [0, 1, 0]\nz_axis = [1, 0, 0]\n",
          "[[body]] 1 x_axis: an orientation is given once") + (("x_axis = [0, 0, -1]", "§x_axis = [0, 0, -1]"),),
    scene("axes and an angle", "y_axis = [0, 1, 0]\n", "y_axis = [0, 1, 0]\naxis_angle = { axis = [0, 1, 0], angle = 1 }\n",
          "an orientation is given once") + (("x_axis = [0, 0, -1]", "§x_axis = [0, 0, -1]"),),
    scene("angle and Euler angles", "position = [0, 0, -1.5]",
          'position = [0, 0, -1.5]\naxis_angle = { axis = [0, 1, 0], angle = 1 }\n'
          '§euler = { sequence = "zyx", angles = [0, 0, 1] }',
          "[[body]] 2 euler: an orientation is given once"),
    scene("axis of zero length", "x_axis = [0, 0, -1]", "§x_axis = [0, 0, 0]",
          "[[body]] 1 x_axis: must not be the zero vector"),
    scene("turned about an axis of zero length", "position = [0, 0, -1.5]",
          "position = [0, 0, -1.5]\naxis_angle = { §axis = [0, 0, 0], angle = 1 }", "axis: must not be the zero vector"),
    scene("sequence of Euler angles with equal neighbours", "position = [0, 0, -1.5]",
          'position = [0, 0, -1.5]\neuler = { §sequence = "zzx", angles = [0, 0, 1] }', "sequence: expected three axes",
          'such as "zyx" or "zxz"', 'found "zzx"'),
    scene("marker called centre", "tip = [1, 0, 0]", "tip = [1, 0, 0], §centre = [0, 0, 0]",
          "centre: is the centre of mass already; choose another name"),
    scene("marker of two numbers", "tip = [1, 0, 0]", "§tip = [1, 0]", "tip: expected three numbers", "found 2"),
]

JOINTS = [
    scene("joint of a body with itself", 'to = { body = "second", at = [0, 0, 0.5] }', '§to = "blade.centre"',
          "[[universal]] 1 to: joins a body with itself; 'from' and 'to' must differ"),
    scene("joint of a point with itself", 'from = "second"\nto = "ball"', 'from = "ball"\n§to = "ball"',
          "[[ball]] 1 to: joins a body with itself; 'from' and 'to' must differ"),
    scene("joint of two fixed places", 'to = "blade"\n', "§to = [0, 0, 0]\n",
          "[[revolute]] 1 to: joins no moving point or body; name one in 'from' or 'to'"),
    scene("hinge on a point", 'to = "blade"\n', '§to = "ball"\n',
          "[[revolute]] 1 to: a point has no orientation; this joint needs a body or a fixed place"),
    scene_with("line carried by a point", '[[point_on_line]]\n§from = "ball"\nto = "blade"\naxis = [0, 0, 1]',
               "[[point_on_line]] 1 from: a point has no orientation; the line needs a body or a fixed place"),
    scene_with("plane carried by a point", '[[point_on_plane]]\n§from = "ball"\nto = "blade"\nnormal = [0, 0, 1]',
               "[[point_on_plane]] 1 from: a point has no orientation; the plane needs a body or a fixed place"),
    scene("unknown marker", 'from = "blade.tip"', '§from = "blade.tipp"',
          "[[universal]] 1 from: no point, body or marker is called 'blade.tipp'", "did you mean 'blade.tip'?"),
    scene("unknown body", 'to = "blade"\n', '§to = "bladee"\n',
          "[[revolute]] 1 to: no point, body or marker is called 'bladee'", "did you mean 'blade'?"),
    scene("unknown body under a place", 'to = { body = "second", at', 'to = { §body = "sekond", at',
          "body: no body is called 'sekond'", "did you mean 'second'?"),
    scene("place without at", 'to = { body = "second", at = [0, 0, 0.5] }', 'to = §{ body = "second" }', "at: is missing"),
    scene("unknown axis of a body", 'cross_axis = "second.y"', '§cross_axis = "second.w"',
          '[[universal]] 1 cross_axis: expected [x, y, z], or an axis of a body such as "blade.x", found "second.w"',
          "did you mean 'second."),
    scene("marker in place of an axis", 'cross_axis = "second.y"', '§cross_axis = "blade.tip"',
          "[[universal]] 1 cross_axis: expected [x, y, z], or an axis of a body"),
    scene("axis of a third body", 'cross_axis = "second.y"', '§cross_axis = "third.y"', "expected [x, y, z], or an axis"),
    scene("hinge with the axis of another body", '"blade"\naxis = [0, 1, 0]', '"blade"\n§axis = "second.y"',
          "[[revolute]] 1 axis: must be a direction of one of the joined bodies, or [x, y, z] in the frame"),
    scene("hinge without axis", '[[revolute]]\nname = "hinge"\nfrom = [0, 0, 0]\nto = "blade"\naxis = [0, 1, 0]',
          '§[[revolute]]\nname = "hinge"\nfrom = [0, 0, 0]\nto = "blade"', "[[revolute]] 1 axis: is missing"),
    scene("hinge with an axis of zero length", '"blade"\naxis = [0, 1, 0]', '"blade"\n§axis = [0, 0, 0]',
          "[[revolute]] 1 axis: must not be the zero vector"),
    scene("ball joint with an axis", 'from = "second"\nto = "ball"', 'from = "second"\nto = "ball"\n§axis = [0, 0, 1]',
          "[[ball]] 1 axis: unknown key"),
    scene("universal joint whose axes are not at right angles", 'cross_axis = "second.y"', "§cross_axis = [1, 1, 0]",
          "[[universal]] 1 cross_axis: must be at a right angle to axis at the starting guess; the cosine is 0.707"),
    scene("two joints of one name", 'name = "cardan"', '§name = "hinge"',
          "[[universal]] 1 name: another constraint is called 'hinge' already"),
    scene_with("rod of no length", '[[rod]]\nfrom = "blade.tip"\nto = "ball"\n§length = 0',
               "[[rod]] 1 length: must be positive", "found 0"),
    scene("misspelt joint", "[[universal]]", "[[§univresal]]", "univresal: unknown key", "did you mean 'universal'?"),
]

EFFECTS = [
    scene("gravity that turns in the frame", 'acceleration = [0, 0, "-g"]', '§acceleration = ["-g", 0, 0]',
          "[gravity] acceleration: must be parallel to [frame] angular_velocity", "there is no steady state"),
    scene_with("spinning disc in a turning frame",
               '§[[spinning_disc]]\naxis = "blade.x"\npolar_inertia = 0.1\nspeed = 3',
               "[[spinning_disc]]: not together with [frame]", "inertia of the body itself"),
    scene_with("spring on an unknown joint", '[[torsional_spring]]\n§joint = "hinges"\nstiffness = 1',
               "[[torsional_spring]] 1 joint: no joint with an angle (revolute, universal, cylindrical) is called 'hinges'",
               "did you mean 'hinge'?"),
    scene_with("spring on a ball joint", '[[torsional_spring]]\n§joint = "socket"\nstiffness = 1',
               "joint: no joint with an angle (revolute, universal, cylindrical) is called 'socket'", "known: cardan, hinge"),
    scene_with("damper on an unknown joint", '[[torsional_damper]]\n§joint = "hnge"\ncoefficient = 1',
               "[[torsional_damper]] 1 joint: no joint with an angle", "did you mean 'hinge'?"),
    scene_with("spring on a universal joint without saying which angle",
               '§[[torsional_spring]]\njoint = "cardan"\nstiffness = 1', "[[torsional_spring]] 1 about: is missing"),
    scene_with("spring on a universal joint about another angle",
               '[[torsional_spring]]\njoint = "cardan"\n§about = "cross"\nstiffness = 1',
               'about: expected "axis" or "cross_axis", found "cross"'),
    scene_with("spring on a hinge about an angle", '[[torsional_spring]]\njoint = "hinge"\n§about = "axis"\nstiffness = 1',
               "[[torsional_spring]] 1 about: unknown key"),
    scene_with("moment on a point", '[[moment]]\n§body = "ball"\nalong = [0, 0, 1]\nmagnitude = 1',
               "[[moment]] 1 body: no body is called 'ball'", "known: blade, second"),
    scene_with("moment along nothing", '[[moment]]\nbody = "blade"\n§along = [0, 0, 0]\nmagnitude = 1',
               "[[moment]] 1 along: must not be the zero vector"),
    scene_with("force on a fixed place", '[[force]]\n§point = [0, 0, 0]\ncomponents = [1, 0, 0]',
               "[[force]] 1 point: expected a text"),
    scene_with("spring of two fixed places", "§[[spring]]\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nstiffness = 1\nfree_length = 1",
               "[[spring]] 1: joins no moving point"),
    scene_with("blade of no strips", '[[blade_element]]\nbody = "blade"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\n'
               "leading = [0, 1, 0]\nlift = [0, 0, 1]\nchord = 0.1\n§strips = 0",
               "[[blade_element]] 1 strips: expected a whole number from 1 to 64"),
    scene_with("blade of many strips", '[[blade_element]]\nbody = "blade"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\n'
               "leading = [0, 1, 0]\nlift = [0, 0, 1]\nchord = 0.1\n§strips = 65",
               "strips: expected a whole number from 1 to 64"),
    scene_with("blade of half a strip", '[[blade_element]]\nbody = "blade"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\n'
               "leading = [0, 1, 0]\nlift = [0, 0, 1]\nchord = 0.1\n§strips = 2.5",
               "strips: expected a whole number from 1 to 64"),
    scene_with("blade of no span", '[[blade_element]]\nbody = "blade"\nroot = [1, 0, 0]\n§tip = [1, 0, 0]\n'
               "leading = [0, 1, 0]\nlift = [0, 0, 1]\nchord = 0.1", "[[blade_element]] 1 tip: must not be the zero vector"),
    scene_with("lift along the chord", '[[blade_element]]\nbody = "blade"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\n'
               "leading = [0, 1, 0]\n§lift = [0, -2, 0]\nchord = 0.1", "lift: must not be parallel to leading"),
    scene_with("blade of an unknown body", '[[blade_element]]\n§body = "blades"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\n'
               "leading = [0, 1, 0]\nlift = [0, 0, 1]\nchord = 0.1",
               "body: no body is called 'blades'", "did you mean 'blade'?"),
    scene_with("bearing with three stiffnesses", '[[bearing]]\npoint = "blade.tip"\nseat = [0, 0, -1]\nfirst = [1, 0, 0]\n'
               "second = [0, 1, 0]\n§stiffness = [1, 2, 3]\ndamping = [[0, 0], [0, 0]]",
               "[[bearing]] 1 stiffness: expected a 2 x 2 matrix"),
]


@each_case(BODIES + JOINTS + EFFECTS)
class BadBodies(ProgramTest):
    def check(self, text, fragments, *more_edits):
        where = self.write_marked(text, more_edits)
        self.assertTrue(where, "the scene says nowhere where the message must point")
        contents = self.contents()
        run = self.run_program("trace", "scene.toml", "-o", "loci.h5")
        self.assert_refused(run, fragments, f"eigentrail: scene.toml:{where} ")
        self.assertEqual(self.contents(), contents)
        explained = self.run_program("explain", "scene.toml")
        self.assertEqual((explained.returncode, explained.stderr), (run.returncode, run.stderr))

    def test_the_scene_itself_is_good(self):
        self.write("scene.toml", SCENE)
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")


if __name__ == "__main__":
    unittest.main()
