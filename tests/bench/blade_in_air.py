"""Writes the scene of a hingeless blade in hover, of which docs/developers/performance.md reports: 20 beam elements with strips
and the three-state inflow of Pitt and Peters.

    python3 tests/bench/blade_in_air.py > blade.toml               elements of three nodes
    python3 tests/bench/blade_in_air.py --nodes 2 > blade.toml     of two
    python3 tests/bench/blade_in_air.py --lag > blade.toml         with two states of lag for each of 40 strips
"""

import argparse

SCENE = """title = "Hingeless blade in hover"

[parameters]
omega = {{ value = 40, unit = "rad/s" }}

[trace]
parameter = "omega"
from = 10
to = 40
tolerance = 1e-6
modes = {{ band = ["1 rad/s", "1500 rad/s"], count = 12 }}

[frame]
angular_velocity = [0, 0, "omega"]

[[inflow]]
name = "disc"
radius = 5.5

[[blade]]
name = "blade"
hub_radius = 0.5
length = 5
elements = 20
degree = {degree}
pitch = 0.1
mass = 5.5
EI_flap = 8e3
EI_lag = 6e4
GJ = 4e3
EA = 5e7
inertia_flap = 0.0005
inertia_lag = 0.025

[[strips]]
on = "blade"
chord = 0.3
drag = 0.01
inflow = "disc"
"""

if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--nodes", type=int, choices=(2, 3), default=3)
    parser.add_argument("--lag", action="store_true")
    options = parser.parse_args()
    print(SCENE.format(degree=options.nodes - 1) + ("\n[[lift_lag]]" if options.lag else ""))
