"""Writes a scene for benchmarks: python3 tests/bench/three_blades.py > three_blades.toml

Forty rigid bodies: a hub held in the turning frame and three hinged blades of 13 links each, joined by universal joints with
springs about the flap and the lag axis: 78 freedoms, 480 coordinates. `mistuning` makes the second blade stiffer and
the third one softer by that share; without it every mode is there three times.
"""
import math
import sys

LINKS, BLADES = 13, 3

HEAD = """\
title = "Three blades of thirteen links"

[parameters]
omega     = {{ value = 1.0, unit = "rad/s" }}
span      = {{ value = 10.0, unit = "m" }}
hub       = {{ value = 0.5, unit = "m" }}
line      = {{ value = 20.0, unit = "kg/m" }}       # mass per length of a blade
flap      = {{ value = 5e5, unit = "N m^2" }}       # bending stiffness
lag       = {{ value = 5e6, unit = "N m^2" }}
mistuning = {mistuning}
h         = "span / {links}"
mass      = "line * h"

[trace]
parameter = "omega"
from = 1.0
to = 10.0
modes = 10
tolerance = 1e-6

[frame]
angular_velocity = [0, 0, "omega"]

[[body]]
name = "hub"
mass = "10 * mass"
inertia = ["mass * hub^2", "mass * hub^2", "2 * mass * hub^2"]
position = [0, 0, 0]

[[weld]]
from = [0, 0, 0]
to = "hub"
"""

LINK = """
[[body]]
name = "{name}"
mass = "mass"
centre = ["h/2", 0, 0]
inertia = ["mass*h^2/100", "mass*h^2/12", "mass*h^2/12"]
position = ["{c} * (hub + {i}*h)", "{s} * (hub + {i}*h)", 0]
x_axis = [{c}, {s}, 0]
y_axis = [{ms}, {c}, 0]
markers = {{ end = ["h", 0, 0] }}

[[universal]]
name = "{name} joint"
from = {before}
to = "{name}"
axis = "{name}.y"
cross_axis = "{name}.z"

[[torsional_spring]]
joint = "{name} joint"
about = "axis"
stiffness = "{root} * {tuned} * flap / h"

[[torsional_spring]]
joint = "{name} joint"
about = "cross_axis"
stiffness = "{root} * {tuned} * lag / h"
"""


def scene(mistuning=0.02, blades=BLADES):
    """The scene's text; fewer blades for comparison."""
    text = HEAD.format(mistuning=mistuning, links=LINKS)
    for blade in range(blades):
        angle = 2 * math.pi * blade / BLADES
        c, s = round(math.cos(angle), 15), round(math.sin(angle), 15)
        tuned = f"(1 + {(0, 1, -1)[blade]} * mistuning)"
        for i in range(LINKS):
            name = f"blade {blade + 1} link {i + 1}"
            at_hub = f'{{ body = "hub", at = ["{c} * hub", "{s} * hub", 0] }}'
            text += LINK.format(name=name, i=i, c=c, s=s, ms=-s, tuned=tuned, root=1 if i else 2,
                                before=f'"blade {blade + 1} link {i}.end"' if i else at_hub)
    return text


if __name__ == "__main__":
    print(scene(*map(float, sys.argv[1:])), end="")
