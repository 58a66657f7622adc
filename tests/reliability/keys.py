"""Rows made from the output of `eigentrail reference`: every table with each required key missing, with each key of a wrong
kind, and with an unknown key."""

import functools
import re
import subprocess

from program import PLACE, PROGRAM, edited
from good import MACHINE

# Without a frame, in which discs may not spin, and without what is generated here.
BASE = edited(edited(MACHINE, '[frame]\nangular_velocity = [0, 0, "omega"]\n\n', ""),
              '[gravity]\nacceleration = [0, 0, "-g"]\n\n', "")
BASE = edited(edited(BASE, "mass = 2.0", 'mass = "omega"'), "g = 9.81\n", "")

# Good values of keys whose kind alone does not tell, of all tables or of one.
SPECIAL = {"from": "[0, 0, -1.5]", "to": '"second"', "cross_axis": '"second.y"', "second": "[0, 1, 0]", "lift": "[0, 0, 1]",
           "leading": "[0, 1, 0]", "root": "[0, 0, 0]", "rod from": "[0, 0, -1]", "spring from": "[0, 0, -1]",
           "damper from": "[0, 0, -1]", "follower_force from": "[0, 0, -1]", "beam from": "[0, 3, 0]", "beam to": "[1, 3, 0]",
           "beam elements": "2", "beam_damping beam": '"wing"', "blade elements": "2",
           "strips on": '"wing"'}

# By what the reference says of a value: a good one, wrong ones, and what is expected in their place.
KINDS = [
    (r"text", '"new"', ("1", "true", "[]"), "a text"),
    (r"moving place", '"ball"', ("1", "[0, 0, 0]", "false"), "expected"),
    (r"place", "[0, 0, 3]", ("1", "[1, 2]", "true"), "expected three numbers or expressions [x, y, z]"),
    (r"direction", '"second.x"', ("1", "[1]", "true"), "expected three numbers or expressions [x, y, z]"),
    (r"name of a body", '"blade"', ("1", "[0, 0, 1]", "{}"), "a text"),
    (r"name of a beam, blade or body", '"wing"', ("1", "[0, 0, 1]", "{}"), "a text"),
    (r"name of an inflow", '"disc"', ("1", "[0, 0, 1]", "{}"), "a text"),
    (r"name of strips", '"air"', ("1", "[0, 0, 1]", "{}"), "a text"),
    (r"name of a beam", '"wing"', ("1", "[0, 0, 1]", "{}"), "a text"),
    (r"name of a joint", '"hinge"', ("1", "[0, 0, 1]", "{}"), "a text"),
    (r"axis", '"x"', ("1", "[1, 0, 0]"), "a text"),
    (r"\[x, y, z\].*", "[1, 0, 0]", ('"x"', "[1, 2]", "{}"), "three numbers or expressions [x, y, z]"),
    (r"2 x 2.*", "[[1, 0], [0, 1]]", ("1", "true", "[1, 2]", "[[1, 2]]"), "expected"),
    (r"(list of|two) joints", '["hinge", "pin"]', ("1", "true", "[1]"), "expected"),
    (r"list", "[1, 2]", ("true", "{}"), "expected"),
    (r"true or false", "true", ("1", "[]"), "true or false"),
    (r"{.*", None, ("1", "true", "[]"), "a table"),
    (r"", "0.5", ("true", "[1]", '"1 +"'), ""),  # a number, its unit being what the reference says
]

# What the wrong values are called in the names of rows.
WORDS = {"1": "one", "true": "true", "false": "false", "[]": "an empty list", "{}": "an empty table", '"x"': "a text",
         '"1 +"': "half an expression", "[1]": "a list of one", "[1, 2]": "a list of two", "[0, 0, 0]": "a fixed place",
         "[0, 0, 1]": "a direction", "[1, 0, 0]": "a vector", "[[1, 2]]": "one row"}

# Keys that cannot be given at will: they depend on others.
DEPENDENT = {"torsional_spring about", "torsional_damper about", "torsional_maxwell_damper about", "body inertia",
             "body x_axis", "body y_axis", "body z_axis", "strips root", "strips tip", "strips leading", "strips lift"}


# Tables that are tried elsewhere: options, families, rotors, which stand in scenes without points and bodies
# (tests/cli/mistakes_test.py, mode_names_test.py), rotors of several blades (hammond_ground_resonance_test.py), and conditions,
# which need a parameter of their own (tests/steady/trim_test.cpp).
APART = {"[trace]", "[events]", "[modes]", "[matrix_family]", "[sampled_family]", "[[shaft]]", "[[disc]]", "[[support]]", "[rotor]",
         "[[trim]]"}

# What a table needs beside it.
WING = """
[[beam]]
name = "wing"
from = [0, 3, 0]
to = [1, 3, 0]
elements = 1
mass = 1
EA = 1e4
EI_flap = 1
EI_lag = 1
GJ = 1
"""
AIR = f"""{WING}
[[strips]]
name = "air"
on = "wing"
chord = 0.2
wind = [0, -5, 0]
"""
WHEEL = """
[[body]]
name = "wheel"
mass = 1
inertia = [1, 1, 1]
position = [3, 0, 0]
[[revolute]]
name = "pin"
from = [3, 0, 0]
to = "wheel"
axis = [0, 1, 0]
"""
BESIDE = {"[[gear]]": WHEEL, "[[coupler]]": WHEEL, "[[beam_damping]]": WING, "[[strips]]": WING, "[[lift_lag]]": AIR, "[[apparent_mass]]": AIR}


def kind_of(unit):
    return next(kind for kind in KINDS if re.fullmatch(kind[0], unit) or kind[0] == "")


@functools.cache
def reference():
    """Tables by their heading, such as [[spring]]: (key, unit, whether it is required)."""
    text = subprocess.run([PROGRAM, "reference", "--markdown"], capture_output=True, text=True, check=True).stdout
    tables = {}
    for line in text.splitlines():
        if heading := re.match(r"`(\[+\w+\]+)`: ", line):
            tables[heading[1]] = keys = []  # of two tables [[bearing]], the first one belongs to rotors
        elif row := re.match(r"\| `(\w+)` \| (.*?) \| .* \| (.*?) \|$", line):
            keys.append((row[1], row[2], row[3] == "required"))
    return {heading: keys for heading, keys in tables.items() if heading not in APART}


def good_lines(heading):
    """A line for every required key of a table."""
    name = heading.strip("[]")
    return {key: f"{key} = {SPECIAL.get(f'{name} {key}') or SPECIAL.get(key) or kind_of(unit)[1]}"
            for key, unit, required in reference()[heading] if required}


def scene(heading, lines, mark_heading=False):
    return f"{BASE}\n{BESIDE.get(heading, '')}{PLACE if mark_heading else ''}{heading}\n" + "\n".join(lines.values()) + "\n"


def label(heading):
    """The name of the table in messages: tables of a list are numbered."""
    return f"{heading} {BASE.count(heading) + 1}" if heading.startswith("[[") else heading


def rows_of(heading):
    good = good_lines(heading)
    where = label(heading)
    name = heading.strip("[]")
    for key in good:
        rest = {other: line for other, line in good.items() if other != key}
        yield f"{name} without {key}", scene(heading, rest, True), (f"{where} {key}: is missing; expected ",)
    for key, unit, _ in reference()[heading]:
        if f"{name} {key}" in DEPENDENT:
            continue
        _, _, wrong, expected = kind_of(unit)
        for value in wrong:
            if value == "[1]" and (heading in ("[[beam]]", "[[blade]]", "[[strips]]") or f"{name} {key}" == "beam_damping time"):
                continue  # lists are values at stations, or of the strains
            bad = {**good, key: f"{PLACE}{key} = {value}"}
            yield f"{name} with {key} being {WORDS[value]}", scene(heading, bad), (f"{where} {key}: ", expected)
    unknown = {**good, "": f"{PLACE}nonsense_of_mine = 1"}
    yield f"{name} with a key of its own", scene(heading, unknown), (f"{where} nonsense_of_mine: unknown key; known: ",)


SCENES = [row for heading in reference() for row in rows_of(heading)]

# In still air a blade at rest has no direction of flow, and a rotor without thrust no inflow.
GOOD = [scene(heading, good_lines(heading)) for heading in reference() if heading not in ("[[blade_element]]", "[[inflow]]")]
