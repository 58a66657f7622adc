"""Good scenes, and rows that make bad ones of them: (name of the fault, scene, what the message must contain, more edits)."""

from program import BLADE, FAMILY, edited

TWO_SHORT_RODS = """\
[parameters]
length = 1.0

[trace]
parameter = "length"
from = 1
to = 2

[[point]]
name = "ball"
mass = 1
position = [5, 1, 0]

[[rod]]
from = [0, 0, 0]
to = "ball"
length = "length"

[[rod]]
name = "far rod"
from = [100, 0, 0]
to = "ball"
length = "length"
"""

HELD = "".join(f'[[fixed]]\npoint = "blade"\ncoordinate = "{axis}"\nvalue = {value}\n\n'
               for axis, value in {"x": 6, "y": 0, "z": 0}.items())

MATRICES = FAMILY[FAMILY.index("M ="):]

MACHINE = """\
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


def blade(name, old, new, *fragments):
    return name, edited(BLADE, old, new), fragments


def blade_with(name, addition, *fragments):
    return name, f"{BLADE}\n{addition}\n", fragments


def family(name, old, new, *fragments):
    return name, edited(FAMILY, old, new), fragments


def machine(name, old, new, *fragments):
    return name, edited(MACHINE, old, new), fragments


def machine_with(name, addition, *fragments):
    return name, f"{MACHINE}\n{addition}\n", fragments
