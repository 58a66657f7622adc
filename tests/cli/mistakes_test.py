"""Mistakes that are made by hand on the first day. Each message names the place and says what to do.

Each row is the mistake, what is written in place of what, and what the message must contain. In a scene "§" stands where the
message must point; it is taken out before the run.
"""

import unittest

from command_test_case import CommandTest
from program import BLADE, EXIT_DONE, each_case, edited

BODIES = """
[[body]]
name = "a"
mass = 1
position = [0, 0, 0]

[[body]]
name = "b"
mass = 1
position = [1, 0, 0]
"""

BEAM = """
[[beam]]
name = "wing"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 2
span = [0, 1]
mass = 1
EA = 1e4
EI_flap = [2, 1]
EI_lag = 1
GJ = 1
"""


def beam(old, new):
    """The text of a beam with a mistake, in place of the drag of the scene."""
    return ("[[drag]]", edited(BEAM, old, new) + "\n[[drag]]")

ROTOR = """
[parameters]
speed = { value = 3000, unit = "rpm" }
stiff = { value = 1e7, unit = "N/m" }

[trace]
parameter = "speed"
from = 100
to = 9000

[[shaft]]
stations = { length = [0.3, 0.4], outer = [0.05, 0.06] }
elements = [1, 2]
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"

[[disc]]
node = 2
mass = 20
Id = 0.2
Ip = 0.3

[[bearing]]
node = [1, 4]
kxx = "stiff"
"""

ROTORS = [
    ("node that does not exist", ("node = 2", "§node = 5"), "[[disc]] 1 node: there is no node 5; the nodes are numbered from 1 to 4"),
    ("node zero", ("node = 2", "§node = 0"), "there is no node 0"),
    ("node that is no number", ("node = 2", '§node = "middle"'), "expected the number of a node, such as 3"),
    ("node of another shaft", ("node = 2", '§node = "inner node 2"'), "no shaft is called 'inner'"),
    ("negative diameter", ("outer = [0.05, 0.06]", "outer = [0.05, -0.06]", "stations", "§stations"),
     "segment 2: its outer diameter must be positive; found -0.06 m"),
    ("hole wider than the shaft", ("outer = [0.05, 0.06]", "outer = 0.05, inner = 0.06", "stations", "§stations"),
     "segment 1: its inner diameter must be less than the outer one, 0.05 m; found 0.06 m"),
    ("negative length", ("length = [0.3, 0.4]", "length = [0.3, -0.4]", "stations", "§stations"), "segment 2: its length must be positive"),
    ("positions that do not ascend", ("length = [0.3, 0.4]", "position = [0, 0.4, 0.3]", "stations", "§stations"),
     "segment 2: its length must be positive"),
    ("lists of different lengths", ("outer = [0.05, 0.06]", "§outer = [0.05, 0.06, 0.07]"), "outer: has 3 values, and there are 2 segments"),
    ("elements for other segments", ("elements = [1, 2]", "§elements = [1, 2, 3]"), "has 3 values, and there are 2 segments"),
    ("half an element", ("elements = [1, 2]", "§elements = 1.5"), "expected whole numbers from 1"),
    ("shear modulus twice", ("nu = 0.3", "§nu = 0.3\nG = 8e10"), "give one of G and nu"),
    ("steel without Poisson's ratio", ("nu = 0.3\n", ""), "give one of G and nu"),
    ("Poisson's ratio of more than a half", ("nu = 0.3", "§nu = 0.6"), "must lie between -1 and 0.5; found 0.6"),
    ("density that is missing", ("density = 7850\n", ""), "[[shaft]] 1 density: is missing"),
    ("misprint of a key of a shaft", ("density = 7850", "§densty = 7850"), "did you mean 'density'?"),
    ("stiffness in rad/s", ('kxx = "stiff"', '§kxx = "speed"'), '"speed" is in rpm, but N/m is expected'),
    ("speed in N/m", ('speed = "speed"', '§speed = "stiff"'), '"stiff" is in N/m, but rad/s is expected'),
    ("disc with too much polar inertia", ("Ip = 0.3", "§Ip = 0.5"), "no disc has more than 2 Id, here 0.4 kg m^2"),
    ("disc by numbers and shape", ("Ip = 0.3", "Ip = 0.3\n§outer = 0.2"), "the mass is given already"),
    ("bearing without coefficients", ('kxx = "stiff"\n', ""), "expected coefficients such as kxx = 1e6"),
    ("misprint of a coefficient", ('kxx = "stiff"', 'kxx = "stiff"\n§kxz = 1'), "unknown key"),
    ("table that does not exist", ('kxx = "stiff"', '§table = "absent.csv"'), "absent.csv: no such file"),
    ("table outside of the folder", ('kxx = "stiff"', '§table = "../bearing.csv"'), "expected a file in the scene's folder"),
    ("bearing between one node", ("node = [1, 4]", "§between = [1, 1]"), "names node 1 twice"),
    ("support of a freedom that is none", ("[[bearing]]", '[[support]]\nnode = 1\n§holds = "xx"\n[[bearing]]'),
     "'xx' is no freedom of a node; did you mean 'x'?"),
    ("points beside a shaft", ("[[disc]]", '[[§point]]\nname = "a"\nmass = 1\nposition = [0, 0, 0]\n[[disc]]'),
     "point: unknown key in a scene with [[shaft]]"),
    ("two shafts without names", ("[[shaft]]", "§[[shaft]]", "[[disc]]", "[[shaft]]\nstations = { length = 1, outer = 0.1 }\nE = 2e11\nnu = 0.3\n"
                                  "density = 7800\n[[disc]]"), "each needs a name"),
    ("effect switched off", ("to = 9000", 'to = 9000\n§without = "shaft"'), "cannot be left out: without its elastic forces"),
    ("support switched off", ("to = 9000", 'to = 9000\n§without = "support"'), "it holds freedoms; remove its table"),
    ("effect that a rotor has not", ("to = 9000", 'to = 9000\n§without = "seal"'), "is no effect of this rotor; known:"),
    ("misspelt effect", ("to = 9000", 'to = 9000\n§without = "bearings"'), "did you mean 'bearing'?"),
]

# What is wrong in a CSV file of bearing coefficients or of stations.
ROTOR_FILES = [
    ("speeds that do not ascend", "table", "speed [rpm],kxx\n0,1e7\n9000,1e7\n5000,1e7\n",
     "table.csv:4: speed must ascend; found 5000 behind 9000"),
    ("speeds that end too early", "table", "speed [rpm],kxx\n0,1e7\n5000,1e7\n", "go from speed = 0 to 5000 rpm, and nothing is "
     "extrapolated; speed is 9000"),
    ("speed in a unit that is none", "table", "speed [rpn],kxx\n0,1e7\n9000,1e7\n", "unit 'rpn' is not known"),
    ("speed in newtons", "table", "speed [N],kxx\n0,1e7\n9000,1e7\n", "column speed is in N, but rad/s is expected"),
    ("coefficient in another unit", "table", "speed [rpm],kxx [N s/m]\n0,1e7\n9000,1e7\n", "column kxx is in N s/m, but N/m is expected"),
    ("column that is unknown", "table", "speed [rpm],kxxx\n0,1e7\n9000,1e7\n", "unknown column 'kxxx'; did you mean 'kxx'?"),
    ("column that stands twice", "table", "speed [rpm],kxx,kxx\n0,1,2\n", "table.csv:1: two columns are called 'kxx'"),
    ("row with too few cells", "table", "speed [rpm],kxx,kyy\n0,1e7,1e7\n9000,1e7\n", "table.csv:3: has 2 cells under 3 headings"),
    ("cell that is no number", "table", "speed [rpm],kxx\n0,1e7\n9000,stiff\n", "table.csv:3: kxx: expected a finite number, "
     "found 'stiff'"),
    ("no headings", "table", "0,1e7\n9000,1e7\n", "unknown column '1e7'"),
    ("no rows", "table", "speed [rpm],kxx\n", "has no rows"),
    ("one row", "table", "speed [rpm],kxx\n100,1e7\n", "has one row; expected two at least"),
    ("no coefficients", "table", "speed [rpm]\n0\n9000\n", "has no column of a coefficient"),
    ("stations without lengths", "stations", "outer\n0.05\n", "expected a column 'length' or a column 'position'"),
    ("stations without diameters", "stations", "length\n0.05\n", "expected a column 'outer'"),
    ("stations that do not ascend", "stations", "position,outer\n0,0.1\n0.5,0.1\n0.4,0.1\n", "table.csv:4: the positions must ascend"),
    ("stations in another unit", "stations", "length [kg],outer\n1,0.1\n", "column length is in kg, but m is expected"),
    ("stations with an unknown column", "stations", "length,outre\n1,0.1\n", "unknown column 'outre'; did you mean 'outer'?"),
    ("stations of negative diameter", "stations", "length,outer\n1,-0.1\n", "segment 1: its outer diameter must be positive"),
]

SCENES = [
    # Beams.
    ("beam without length", beam("to = [1, 0, 0]", "§to = [0, 0, 0]"), "to: must be apart from `from`"),
    ("beam along the y axis of its sections", beam("elements = 2", '§y_axis = [2, 0, 0]'), "y_axis: must not be parallel to the beam"),
    ("beam without a stiffness", beam("GJ = 1", ""), "GJ: is missing"),
    ("negative stiffness of a beam", beam("GJ = 1", "§GJ = -1"), "GJ: must be positive; found -1"),
    ("beam with a station too many", beam("EI_flap = [2, 1]", "§EI_flap = [2, 1, 1]"), "one for each of the 2 stations of span; found 3"),
    ("beam with a list and no stations", beam("span = [0, 1]", ""), "EI_flap: a list needs the places of its stations; give span as well"),
    ("stations of a beam in disorder", beam("span = [0, 1]", "§span = [1, 0]"), "span: expected numbers that increase"),
    ("half an element", beam("elements = 2", "§elements = 2.5"), "elements: expected a whole number from 1 to 200"),
    ("cubic element", beam("elements = 2", "§degree = 3"), "degree: expected a whole number from 1 to 2"),
    ("pinned end of a beam", beam("elements = 2", '§ends = ["pinned", "free"]'), 'expected "clamped" or "free", found "pinned"'),
    ("beam at a point", beam("to = [1, 0, 0]", '§to = "blade"'), "to: a point has no orientation"),
    ("beam with the name of a point", beam('name = "wing"', '§name = "blade"'), "name: another beam, body or point is called 'blade' already"),
    ("small section matrix", beam("GJ = 1", "§stiffness = [[1, 0], [0, 1]]"), "stiffness: expected a 6 x 6 matrix"),
    ("stations in a file that is not there", beam("span = [0, 1]", '§file = "stations.csv"'), "file: cannot open"),
    ("damping of no beam", ("[[drag]]", BEAM + '[[beam_damping]]\n§beam = "wind"\ntime = 0.1\n[[drag]]'),
     "beam: no beam is called 'wind'; did you mean 'wing'?"),
    # Expressions and texts.
    ("expression without quotes", ('mass = "mass"', "mass = 2§*mass"), 'put expressions and names in quotes: mass = "2*mass"'),
    ("name without quotes", ('mass = "mass"', "mass = §mass"), 'put expressions and names in quotes: mass = "mass"'),
    ("expression in a list without quotes", ('["1 + length", 0, 0]', "[§length, 0, 0]"), "put expressions and names in quotes, each"),
    ("negative expression without quotes", ("drag   = 2.0", "drag   = §-mass"), 'put expressions and names in quotes: drag = "-mass"'),
    ("quote that is not closed", ('name = "blade"', 'name = "blade§'), "a quote is opened here and never closed"),
    # Numbers.
    ("decimal comma", ("drag   = 2.0", "drag   = 2§,5"), "decimals have a point: drag = 2.5"),
    ("number without its zero", ("drag   = 2.0", "drag   = §.5"), "write the zero before the point: 0.5"),
    ("number that ends in a point", ("drag   = 2.0", "drag   = 2.§"), "write a digit behind the point: 2.0"),
    ("number with its unit", ("mass   = 50.0", "mass   = 50 §kg"), 'written { value = 50, unit = "kg" }'),
    ("numbers without commas", ("from = [1, 0, 0]", "from = [1 §0 0]"), "separated by commas"),
    ("list in parentheses", ("from = [1, 0, 0]", "from = §(1, 0, 0)"), "lists stand in brackets"),
    ("flag in capitals", ("to = 5.0", "to = 5.0\ncertify = §True"), "write true or false"),
    # Tables and keys.
    ("one bracket for two bodies", ("[[drag]]", BODIES.replace("[[body]]", "[body]").replace("[body]\nname = \"b\"",
                                                                                         "§[body]\nname = \"b\"") + "[[drag]]"),
     "two brackets each: [[body]]"),
    ("brackets that are not closed", ("[[rod]]", "[[rod]§"), "close it with two brackets"),
    ("colon for an equals sign", ('name = "blade"', 'name§: "blade"'), "write key = value"),
    ("comment of another language", ("[[rod]]", "§// the rod\n[[rod]]"), "comments begin with #"),
    ("key given twice", ("drag   = 2.0", "drag   = 2.0\ndrag   = §3.0"), "stands twice"),
    ("table in braces over two lines", ('{ value = 40.0, unit = "rad/s" }', '{ value = 40.0,§\n unit = "rad/s" }'),
     "stands on one line"),
    # Units.
    ("unit in capitals", ('unit = "rad/s"', '§unit = "RPM"'), "unit 'RPM' is not known; did you mean 'rpm'?"),
    ("mass in newtons", ("mass   = 50.0", 'mass   = { value = 50, unit = "kN" }', 'mass = "mass"', '§mass = "mass"'),
     '[[point]] 1 mass: "mass" is in kN, but kg is expected'),
    ("damping in metres", ("drag   = 2.0", 'drag   = { value = 2, unit = "m" }', 'coefficient = "drag"', '§coefficient = "drag"'),
     '[[drag]] 1 coefficient: "drag" is in m, but N s/m is expected'),
    ("sum of different things", ("mass   = 50.0", 'mass   = { value = 50, unit = "kg" }', 'mass = "mass"',
                                 '§mass = "mass + omega"'), "adds kg and 1/s"),
    ("hertz times two pi", ('unit = "rad/s"', 'unit = "Hz"', '[0, 0, "omega"]', '[0, 0, "2*pi*omega"]',
                            "angular_velocity", "§angular_velocity"), "converts omega to radians twice", "leave out the factor"),
    ("revolutions without their name", ('unit = "rad/s"', 'unit = "1/min"', "angular_velocity", "§angular_velocity"),
     'write "rpm", "rev/s" or "rad/s"'),
    # Values.
]

COMMANDS = [
    ("value in another unit", ["spectrum", "scene.toml", "--at", "5 mm"], "--at 5 mm: 5 mm does not fit omega, which is in rad/s"),
    ("setting without its value", ["trace", "scene.toml", "--set", "drag"], "--set drag: expected NAME=VALUE"),
]


@each_case([(name, edits, fragments) for name, edits, *fragments in SCENES])
class MistakeInAScene(CommandTest):
    def check(self, edits, fragments):
        where = self.write_marked(BLADE, list(zip(edits[::2], edits[1::2])))
        before = self.contents()
        run = self.run_program("trace", "scene.toml")
        self.assert_refused(run, fragments, f"eigentrail: scene.toml:{where}")
        self.assertEqual(self.contents(), before)


@each_case([(name, edits, fragments) for name, edits, *fragments in ROTORS])
class MistakeInARotor(CommandTest):
    def check(self, edits, fragments):
        where = self.write_marked(ROTOR, list(zip(edits[::2], edits[1::2])))
        run = self.run_program("trace", "scene.toml")
        self.assert_refused(run, fragments, f"eigentrail: scene.toml:{where}")


@each_case([(name, key, text, fragments) for name, key, text, *fragments in ROTOR_FILES])
class MistakeInAFileOfARotor(CommandTest):
    def check(self, key, text, fragments):
        self.write("table.csv", text)
        old = 'kxx = "stiff"' if key == "table" else "stations = { length = [0.3, 0.4], outer = [0.05, 0.06] }"
        self.write("scene.toml", edited(ROTOR.replace("elements = [1, 2]", "elements = 2"), old, f'{key} = "table.csv"'))
        self.assert_refused(self.run_program("trace", "scene.toml"), ["eigentrail: scene.toml:", *fragments])


@each_case([(name, command, fragments) for name, command, *fragments in COMMANDS])
class MistakeOnTheCommandLine(CommandTest):
    def check(self, command, fragments):
        self.write("scene.toml", BLADE)
        self.assert_refused(self.run_program(*command), fragments)


class Harmless(CommandTest):
    """What looks like a mistake and is none."""

    def test_one_body_may_have_one_bracket(self):
        self.write("scene.toml", edited(BLADE, "[[rod]]", "[rod]"))
        self.run_well("trace", "scene.toml", "-q")

    def test_output_has_the_name_of_the_scene(self):
        self.write("scene.toml", BLADE)
        self.assertIn("wrote scene.h5", self.run_well("trace", "scene.toml"))
        self.assertIn("wrote scene.html", self.run_well("report", "scene.h5"))

    def test_parameter_that_nothing_uses_is_a_warning(self):
        self.write("scene.toml", edited(BLADE, "drag   = 2.0", "drag   = 2.0\nspare  = 1.0"))
        run = self.run_program("trace", "scene.toml", "-q")
        self.assertEqual(run.returncode, EXIT_DONE)
        self.assertEqual(run.stderr, "eigentrail: warning: scene.toml:8:1: [parameters] spare: nothing in the scene uses this "
                                     "parameter; remove it or use it\n")


if __name__ == "__main__":
    unittest.main()
