"""Bad input: exit code 2, one line on stderr with the place, the key and the way out, and no file left.

In a scene of the tables below "§" stands where the message must point; it is taken out before the run. Without
it the message must name the file only.
"""

import re
import unittest

import h5py

from program import BLADE, FAMILY, ProgramTest, each_case, edited

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


def blade(name, old, new, *fragments):
    return name, edited(BLADE, old, new), fragments


def blade_with(name, addition, *fragments):
    return name, f"{BLADE}\n{addition}\n", fragments


def family(name, old, new, *fragments):
    return name, edited(FAMILY, old, new), fragments


UNKNOWN_NAMES = [
    blade_with("unknown key of an element", '[[fixed]]\npoint = "blade"\ncoordinate = "y"\n§valu = 1',
               "[[fixed]] 1 valu: unknown key", "did you mean 'value'?"),
    blade("misspelt required key of an element", "coefficient =", "§coeficient =",
          "[[drag]] 1 coeficient: unknown key", "did you mean 'coefficient'?"),
    blade("unknown key of a point", 'mass = "mass"', 'mass = "mass"\n§colour = 1',
          "[[point]] 1 colour: unknown key", "known: name, mass, position"),
    blade("unknown key of trace", "to = 5.0", "to = 5.0\n§tolerence = 1e-6",
          "[trace] tolerence: unknown key", "did you mean 'tolerance'?"),
    blade("unknown key unlike any known one", "to = 5.0", "to = 5.0\n§colour = 1", "[trace] colour: unknown key; known: "
          "parameter, from, to, tolerance, modes, order, reference, first_step, max_step, max_nodes, branch, without, certify"),
    blade("unknown key of a parameter", 'unit = "rad/s"', '§units = "rad/s"',
          "[parameters] omega: unknown key 'units'", "did you mean 'unit'?"),
    blade("unknown key at top level", "title =", "§titel =", "titel: unknown key", "did you mean 'title'?"),
    family("unknown key of a matrix family", "M =", "§D = [[[1, 0], [0, 1]]]\nM =",
           "[matrix_family] D: unknown key"),
    blade("misspelt element table", "[[rod]]", "[[§rdo]]", "rdo: unknown key", "did you mean 'rod'?"),
    blade("misspelt trace table", "[trace]", "[§trac]", "trac: unknown key", "did you mean 'trace'?"),
    blade("misspelt parameters table", "[parameters]", "[§parametrs]",
          "parametrs: unknown key", "did you mean 'parameters'?"),
    family("element beside a matrix family", "[matrix_family]", '[[§rod]]\nto = "x"\n\n[matrix_family]',
           "rod: unknown key in a scene with [matrix_family]"),
    blade_with("force on a point that does not exist", '[[force]]\n§point = "blad"\ncomponents = [1, 0, 0]',
               "[[force]] 1 point: no point is called 'blad'", "did you mean 'blade'?"),
    blade("rod to a point that does not exist", 'to = "blade"', '§to = "bladde"',
          "[[rod]] 1 to: no point is called 'bladde'", "did you mean 'blade'?"),
    blade("drag on a point that does not exist", 'point = "blade"', '§point = "hub of the rotor"',
          "[[drag]] 1 point: no point is called 'hub of the rotor'", "known: blade"),
    blade("name with a line break in the message", 'to = "blade"', r'§to = "bla\nde"', "no point is called"),
    blade("parameter that nothing uses", "drag   = 2.0", "drag   = 2.0\n§spare = 1.0",
          "[parameters] spare: nothing in the scene uses this parameter"),
    blade("traced parameter that is unknown", 'parameter = "omega"', '§parameter = "omga"',
          "[trace] parameter: no parameter is called 'omga'", "did you mean 'omega'?"),
    blade("traced parameter that is derived", "drag   = 2.0", 'drag   = "2 * mass"',
          "[trace] parameter: 'drag' is defined by an expression") + (('parameter = "omega"', '§parameter = "drag"'),),
    ("traced parameter named like a dataset", BLADE.replace("omega", "mode").replace("parameter =", "§parameter ="),
     ("cannot be called 'mode'", "rename it")),
] + [(f"traced parameter named {name}", BLADE.replace("omega", name).replace("parameter =", "§parameter ="),
      (f"cannot be called '{name}'", "rename it"))
     for name in ("step", "function", "end", "event", "step_length", "step_parameter", "dense_output", "dense_block",
                  "dense_chart", "mode_block", "certified", "events", "event_parameter", "event_eigenvalue",
                  "event_half_width", "event_puiseux", "event_node", "range", "stable_from", "stable_mode")]

WRONG_TYPES = [
    blade("text where a number belongs", "mass   = 50.0", "§mass   = true",
          "[parameters] mass: expected a number or an expression, found true or false"),
    blade("number where a text belongs", 'name = "blade"', "§name = 7",
          "[[point]] 1 name: expected a text, found a number"),
    blade("number where a point belongs", 'to = "blade"', "§to = 7",
          "[[rod]] 1 to: expected three numbers or expressions [x, y, z], found a number"),
    blade("array where a number belongs", 'coefficient = "drag"', '§coefficient = ["drag"]',
          "[[drag]] 1 coefficient: expected a number or an expression, found an array"),
    blade("two coordinates", 'position = ["1 + length", 0, 0]', '§position = ["1 + length", 0]',
          "[[point]] 1 position: expected three numbers or expressions [x, y, z], found 2"),
    blade("four components", '[0, 0, "omega"]', '[0, 0, "omega", 0]',
          "[frame] angular_velocity: expected three") + (("angular_velocity", "§angular_velocity"),),
    blade("number as title", 'title = "Blade"', "§title = 3", "title: expected a text, found a number"),
    blade("number as element table", 'title = "Blade"', "§drags = 3\ntitle = 'x'", "drags: unknown key", "'drag'"),
    blade("number as gravity", 'title = "Blade"', "§gravity = 9.81", "gravity: expected a table [gravity]"),
    blade("text as order", "to = 5.0", 'to = 5.0\n§order = "high"', "[trace] order", "unknown parameter 'high'"),
    blade("number as certify", "to = 5.0", "to = 5.0\n§certify = 1",
          "[trace] certify: expected true or false, found a number"),
    blade("date", "mass   = 50.0", "mass   = §1979-05-27", "dates and times have no meaning in a scene"),
    blade("unit that is no text", 'unit = "rad/s"', "§unit = 1", "[parameters] omega: unit: expected a text"),
    blade_with("coordinate that is no axis", '[[fixed]]\npoint = "blade"\n§coordinate = "w"',
               '[[fixed]] 1 coordinate: expected "x", "y" or "z", found "w"'),
]

MISSING_KEYS = [
    blade("missing key of an element", '[[drag]]\npoint = "blade"\ncoefficient = "drag"', '§[[drag]]\npoint = "blade"',
          "[[drag]] 1 coefficient: is missing", "expected a number or an expression"),
    blade("missing name of a point", '[[point]]\nname = "blade"', "§[[point]]", "[[point]] 1 name: is missing"),
    blade("missing value of a parameter", "{ value = 40.0, unit", "{ unit", "[parameters] omega: expected value =")
    + (("omega  =", "§omega  ="),),
    blade("missing from", "[trace]\nparameter = \"omega\"\nfrom = 100.0", '§[trace]\nparameter = "omega"',
          "[trace] from: is missing", "--from"),
    blade("missing to", "[trace]\nparameter = \"omega\"\nfrom = 100.0\nto = 5.0",
          '§[trace]\nparameter = "omega"\nfrom = 100.0', "[trace] to: is missing", "--to"),
    blade("missing traced parameter", '[trace]\nparameter = "omega"', "§[trace]",
          "[trace] parameter: is missing", "--parameter"),
    family("missing K", "K = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]", "", "[matrix_family] K: is missing")
    + (("[matrix_family]", "§[matrix_family]"),),
    ("empty file", "", ("[trace]",)),
    ("no point", BLADE[:BLADE.index("[frame]")], ("at least one [[point]]",)),
]

EXPRESSIONS = [
    blade("unknown parameter in an expression", 'coefficient = "drag"', '§coefficient = "2 * darg"',
          '[[drag]] 1 coefficient: in "2 * darg" at character 5: unknown parameter \'darg\'', "did you mean 'drag'?"),
    blade("malformed expression", 'coefficient = "drag"', '§coefficient = "2 * (drag + )"',
          "[[drag]] 1 coefficient:", "at character 13:", "unexpected ')'"),
    blade("parenthesis that is never closed", 'coefficient = "drag"', '§coefficient = "2 * (drag"',
          "at character 5:", "this '(' is never closed"),
    blade("unknown function", 'coefficient = "drag"', '§coefficient = "sqr(drag)"',
          "at character 1: unknown function 'sqr'", "did you mean 'sqrt'?"),
    blade("error in an expression over two lines", 'coefficient = "drag"', '§coefficient = """2 *\n darg"""',
          "[[drag]] 1 coefficient:", "unknown parameter 'darg'"),
    blade("empty expression", 'coefficient = "drag"', '§coefficient = ""', "at character 1: expression ends"),
    blade("malformed definition of a parameter", "drag   = 2.0", '§drag   = "2 +* mass"',
          "[parameters] drag:", "at character 4:"),
    blade("unknown unit", 'unit = "rad/s"', '§unit = "turns/s"', "[parameters] omega: unit 'turns/s' is not known"),
    blade("parameters defined through each other", "drag   = 2.0", 'drag   = "2 * mass"',
          "[parameters] mass: is defined through itself: mass -> drag -> mass") + (("mass   = 50.0", '§mass   = "drag"'),),
    blade("parameter's name with a dash", "drag   = 2.0", "drag   = 2.0\n§drag-2 = 1.0",
          "[parameters] drag-2:", "letters, digits and '_'"),
]

VALUES = [
    blade("from equal to to", "to = 5.0", "§to = 100.0", "[trace] to: equals from (100)"),
    blade("tolerance too large", "to = 5.0", "to = 5.0\n§tolerance = 0.5",
          "[trace] tolerance: must lie between 1e-13 and 0.1; found 0.5"),
    blade("tolerance of zero", "to = 5.0", "to = 5.0\n§tolerance = 0", "[trace] tolerance: must lie between"),
    blade("tolerance that is no number", "to = 5.0", "to = 5.0\n§tolerance = nan", "[trace] tolerance: expected"),
    blade("order too large", "to = 5.0", "to = 5.0\n§order = 5", "[trace] order: must lie between 1 and 4"),
    blade("order of a half", "to = 5.0", "to = 5.0\n§order = 2.5", "[trace] order: expected a whole number"),
    blade("no modes", "to = 5.0", "to = 5.0\n§modes = 0", "[trace] modes: must be at least 1", '"all"'),
    blade("infinite end", "to = 5.0", "§to = inf", "[trace] to: expected a finite number"),
    blade("end that divides by zero", "to = 5.0", '§to = "1 / (drag - 2)"', "[trace] to:", "finite"),
    family("end of a family that divides by zero", "to = 1", '§to = "1 / 0"', "[trace] to:", "finite"),
    blade("negative mass", 'mass = "mass"', '§mass = "-mass"', "[[point]] 1 mass: must not be negative; found -50"),
    blade("slightly negative mass", 'mass = "mass"', '§mass = "-1e-9*mass"',
          "[[point]] 1 mass: must not be negative; found -5.0000000000000004e-08 where the trace begins"),
    blade("mass negative at the start only", 'mass = "mass"', '§mass = "mass - omega"',
          "[[point]] 1 mass: must not be negative; found -50"),
    blade("mass negative at the end only", 'mass = "mass"', '§mass = "mass - 1000/omega"',
          "[[point]] 1 mass: must not be negative; found -150"),
    blade("rod without length", 'length = "length"', '§length = "length - 5"',
          "[[rod]] 1 length: must be positive; found 0"),
    blade("stiffness that is no number", 'coefficient = "drag"', '§coefficient = "sqrt(-drag)"',
          "[[drag]] 1 coefficient: is not a finite number"),
    blade("rod between two fixed places", '[[rod]]\nfrom = [1, 0, 0]\nto = "blade"',
          "[[rod]]\nfrom = [1, 0, 0]\n§to = [6, 0, 0]", "[[rod]] 1 to: joins no moving point"),
    blade_with("gravity across the axis of rotation", "[gravity]\n§acceleration = [9.81, 0, 0]",
               "[gravity] acceleration: must be parallel to [frame] angular_velocity"),
    blade_with("plane without a direction", '[[plane]]\npoint = "blade"\n§normal = [0, 0, 0]', "[[plane]] 1 normal:"),
    blade_with("two points of one name", '[[point]]\n§name = "blade"\nmass = 1\nposition = [0, 0, 0]',
               "[[point]] 2 name: another point is called 'blade' already"),
    ("two frames", BLADE.replace("[frame]", "[[frame]]") + "\n§[[frame]]\nangular_velocity = [0, 0, 1]\n",
     ("[frame]: a scene has one of these at most",)),
    blade_with("frame defined twice", "§[frame]\nangular_velocity = [0, 0, 1]", "not valid TOML", "frame"),
    blade("text that is never closed", 'title = "Blade"', 'title = "Blade§', "not valid TOML"),
]

MODELS = [
    ("two rods too short to meet", TWO_SHORT_RODS,
     ("no equilibrium found: KINSOL stopped after", "largest residual", "of its scale, in the constraint ")),
    blade_with("constraints that leave no freedom", HELD, "the constraints leave no freedom"),
    family("rows of different length", "[[1, 0], [0, 1]]]", "[[1, 0], [0]]]",
           "[matrix_family] M: power 0: row 2 has 1 entries, row 1 has 2") + (("M =", "§M ="),),
    family("matrices of different size", "[[0, 1], [1, 0]]", "[[1]]",
           "[matrix_family] K: is 1 x 1, M is 2 x 2") + (("K =", "§K ="),),
    family("matrix without rows", "M = [[[1, 0], [0, 1]]]", "§M = [[]]", "[matrix_family] M: has 0 rows"),
    family("list of rows where a list of matrices belongs", "M = [[[1, 0], [0, 1]]]", "§M = [[1, 0], [0, 1]]",
           "[matrix_family] M: expected a list of matrices"),
    family("pencil of zeros", "M = [[[1, 0], [0, 1]]]\nK = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]",
           "M = [[[0]]]\nK = [[[0]], [[0]]]", "the pencil is singular at p = 0", "constrain it"),
    family("freedom without mass and stiffness", "M = [[[1, 0], [0, 1]]]\nK = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]",
           "M = [[[1, 0], [0, 0]]]\nK = [[[1, 0], [0, 0]], [[1, 0], [0, 0]]]", "the pencil is singular at p = 0"),
]

MATRIX_FILES = [
    family("matrix file that does not exist", MATRICES, '§file = "none.h5"',
           "[matrix_family] file:", "none.h5"),
    family("matrix file above the scene", MATRICES, '§file = "../x.h5"',
           "[matrix_family] file: expected a file in the scene's folder or below it", "../x.h5"),
    family("matrix file with an absolute path", MATRICES, '§file = "/x.h5"',
           "[matrix_family] file: expected a file in the scene's folder or below it", "/x.h5"),
    family("matrix file that is no HDF5 file", MATRICES, '§file = "scene.toml"',
           "[matrix_family] file:", "scene.toml", "/M/0"),
    family("matrix file without K", MATRICES, '§file = "mass.h5"', "[matrix_family] file:", "mass.h5", "/K/0"),
    family("matrix file with a vector", MATRICES, '§file = "vector.h5"', "dataset /M/0: expected a matrix"),
    family("matrix file and matrices", "M =", 'file = "good.h5"\n§M =', "[matrix_family] M:", "not both"),
]

# Arguments of runs in the folder that BadUsage.setUp fills.
USAGE = [
    ("no command", [], ["command"]),
    ("unknown command", ["trac"], ["trac"]),
    ("unknown option", ["trace", "scene.toml", "-o", "new.h5", "--tolerence", "1e-6"], ["--tolerence"]),
    ("no scene", ["trace", "-o", "new.h5"], ["SCENE"]),
    ("no output", ["trace", "scene.toml"], ["--output"]),
    ("scene that does not exist", ["trace", "none.toml", "-o", "new.h5"], ["none.toml: "]),
    ("scene that is a folder", ["trace", "folder", "-o", "new.h5"], ["folder: "]),
    ("scene that is a loci file", ["trace", "blade.h5", "-o", "new.h5"], ["blade.h5:1:1: "]),
    ("output that exists", ["trace", "scene.toml", "-o", "blade.h5"], ["blade.h5: exists already", "--force"]),
    ("output that is the scene", ["trace", "scene.toml", "-o", "scene.toml", "--force"], ["scene.toml: "]),
    ("output in a missing folder", ["trace", "scene.toml", "-o", "none/new.h5"],
     ["none/new.h5: the folder none does not exist"]),
    ("output that is a folder", ["trace", "scene.toml", "-o", "folder"], ["folder: is a folder"]),
    ("output with a name too long", ["trace", "scene.toml", "-o", "x" * 300], ["x" * 300]),
    ("output without a name", ["trace", "scene.toml", "-o", ""], ["--output"]),
    ("failed trace over an old output", ["trace", "short.toml", "-o", "blade.h5", "--force"], ["no equilibrium"]),
    ("order out of range", ["trace", "scene.toml", "-o", "new.h5", "--order", "9"], ["scene.toml: [trace] order:"]),
    ("equal ends", ["trace", "scene.toml", "-o", "new.h5", "--to", "100"], ["[trace] to: equals from (100)"]),
    ("text as tolerance", ["trace", "scene.toml", "-o", "new.h5", "--tolerance", "tight"],
     ["[trace] tolerance", "tight"]),
    ("unknown parameter", ["trace", "scene.toml", "-o", "new.h5", "--parameter", "omga"],
     ["[trace] parameter", "did you mean 'omega'?"]),
    ("explain of a bad scene", ["explain", "bad.toml"], ["bad.toml:24:1: [[rod]] 1 to: no point"]),
    ("eval above the range", ["eval", "blade.h5", "--at", "101"], ["omega = 101 lies outside", "5 ... 100"]),
    ("eval below the range", ["eval", "blade.h5", "--at", "50", "4.9", "--csv"], ["omega = 4.9 lies outside"]),
    ("eval at no number", ["eval", "blade.h5", "--at", "fast"], ["--at", "fast"]),
    ("eval at nan", ["eval", "blade.h5", "--at", "nan"], ["nan"]),
    ("eval without a place", ["eval", "blade.h5"], ["--at"]),
    ("eval --at without a value", ["eval", "blade.h5", "--at"], ["--at"]),
    ("eval as csv and json", ["eval", "blade.h5", "--at", "50", "--csv", "--json"], ["--csv", "--json"]),
    ("events as csv and json", ["events", "blade.h5", "--csv", "--json"], ["--csv", "--json"]),
    ("events of no file", ["events"], ["FILE"]),
    ("events at a place", ["events", "blade.h5", "--at", "50"], ["--at"]),
    ("info as json and scene", ["info", "blade.h5", "--json", "--scene"], ["--json", "--scene"]),
] + [(f"{command[0]} of {name}", [command[0], file, *command[1:]], [f"{file}: ", *fragments])
     for command in (["eval", "--at", "50"], ["events"], ["info"])
     for name, file, fragments in [
         ("a missing file", "none.h5", ["no such file"]),
         ("a folder", "folder", ["folder"]),
         ("a text", "scene.toml", ["cannot be read as a loci file"]),
         ("half a loci file", "half.h5", ["cannot be read as a loci file"]),
         ("an HDF5 file without loci", "other.h5", ["no loci file of eigentrail"])]]


@each_case(UNKNOWN_NAMES + WRONG_TYPES + MISSING_KEYS + EXPRESSIONS + VALUES + MODELS + MATRIX_FILES)
class BadScene(ProgramTest):
    def setUp(self):
        super().setUp()
        one = [[1.0, 0.0], [0.0, 1.0]]
        for name, datasets in [("good", {"M/0": one, "K/0": one, "K/1": one}), ("mass", {"M/0": one}),
                               ("vector", {"M/0": one[0], "K/0": one})]:
            with h5py.File(self.folder / f"{name}.h5", "w") as file:
                for path, matrix in datasets.items():
                    file[path] = matrix

    def check(self, scene, fragments, *more_edits):
        where = self.write_marked(scene, more_edits)
        before = self.contents()
        run = self.run_program("trace", "scene.toml", "-o", "loci.h5")
        self.assert_refused(run, fragments, f"eigentrail: scene.toml:{where} ")
        self.assertEqual(self.contents(), before)

    def test_residual_of_a_failed_equilibrium_is_not_above_that_of_the_guess(self):
        """At the guess the far rod is worst: c = 9025 of 2 |d| |x|_max = 950."""
        self.write("scene.toml", TWO_SHORT_RODS)
        message = self.run_program("trace", "scene.toml", "-o", "loci.h5").stderr
        self.assertLess(float(re.search("largest residual ([^ ]+) of its scale", message)[1]), 9.51)


@each_case(USAGE)
class BadUsage(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.toml", BLADE)
        self.write("short.toml", TWO_SHORT_RODS)
        self.write("bad.toml", edited(BLADE, 'to = "blade"', 'to = "blad"'))
        (self.folder / "folder").mkdir()
        self.run_well("trace", "scene.toml", "-o", "blade.h5", "--quiet")
        loci = (self.folder / "blade.h5").read_bytes()
        (self.folder / "half.h5").write_bytes(loci[:len(loci) // 2])
        with h5py.File(self.folder / "other.h5", "w") as file:
            file["numbers"] = [1.0, 2.0]

    def check(self, arguments, fragments):
        before = self.contents()
        self.assert_refused(self.run_program(*arguments), fragments)
        self.assertEqual(self.contents(), before)


if __name__ == "__main__":
    unittest.main()
