"""Scenes whose numbers are wrong: expressions, units, parameters, the range of the trace, special points."""

from good import BLADE, blade, blade_with, family, machine, machine_with

EXPRESSIONS = [
    blade("unknown parameter in an expression", 'coefficient = "drag"', '§coefficient = "2 * darg"',
          '[[drag]] 1 coefficient: in "2 * darg" at character 5: unknown parameter \'darg\'', "did you mean 'drag'?"),
    blade("malformed expression", 'coefficient = "drag"', '§coefficient = "2 * (drag + )"',
          "[[drag]] 1 coefficient:", "at character 13:", "unexpected ')'"),
    blade("error in an expression over two lines", 'coefficient = "drag"', '§coefficient = """2 *\n darg"""',
          "[[drag]] 1 coefficient:", "unknown parameter 'darg'"),
    blade("malformed definition of a parameter", "drag   = 2.0", '§drag   = "2 +* mass"',
          "[parameters] drag:", "at character 4:"),
]

VALUES = [
    blade("tolerance too large", "to = 5.0", "to = 5.0\n§tolerance = 0.5",
          "[trace] tolerance: must lie between 1e-13 and 0.1; found 0.5"),
    blade("tolerance that is no number", "to = 5.0", "to = 5.0\n§tolerance = nan", "[trace] tolerance: expected"),
    blade("no modes", "to = 5.0", "to = 5.0\n§modes = 0", "[trace] modes: must be at least 1", '"all"'),
    blade("order too large", "to = 5.0", "to = 5.0\n§order = 5", "[trace] order: must lie between 1 and 4"),
    blade("infinite end", "to = 5.0", "§to = inf", "[trace] to: expected a finite number"),
    blade("end that divides by zero", "to = 5.0", '§to = "1 / (drag - 2)"', "[trace] to:", "finite"),
    blade("slightly negative mass", 'mass = "mass"', '§mass = "-1e-9*mass"',
          "[[point]] 1 mass: must not be negative; found -5.0000000000000004e-08 where the trace begins"),
    blade("mass negative at the start only", 'mass = "mass"', '§mass = "mass - drag*omega/2"',
          "[[point]] 1 mass: must not be negative; found -50"),
    blade("mass negative at the end only", 'mass = "mass"', '§mass = "mass - 500*drag/omega"',
          "[[point]] 1 mass: must not be negative; found -150"),
    blade("rod without length", 'length = "length"', '§length = "length - 5"',
          "[[rod]] 1 length: must be positive; found 0"),
    blade_with("plane without a direction", '[[plane]]\npoint = "blade"\n§normal = [0, 0, 0]', "[[plane]] 1 normal:"),
    blade_with("two points of one name", '[[point]]\n§name = "blade"\nmass = 1\nposition = [0, 0, 0]',
               "[[point]] 2 name: another point is called 'blade' already"),
]


def coefficient(name, expression, *fragments):
    """The expression in place of a coefficient, between double quotes."""
    return blade(name, 'coefficient = "drag"', f'§coefficient = "{expression}"', "[[drag]] 1 coefficient:", *fragments)


def not_finite(name, expression, found, where=" where the trace begins"):
    return coefficient(name, expression, "is not a finite number; found ", found + where)


def unit(name, text, suggestion="N m^-1"):
    return blade(name, 'unit = "rad/s"', f'§unit = "{text}"', f"[parameters] omega: unit '{text}' is not known", suggestion)


def parameter(name, line, *fragments):
    return blade(name, "drag   = 2.0", f"drag   = 2.0\n{line}", *fragments)


def option(name, line, *fragments):
    """A line more in [trace]."""
    return blade(name, "to = 5.0", f"to = 5.0\n§{line}", *fragments)


def events(name, lines, *fragments):
    return blade_with(name, f"[events]\n{lines}", *fragments)


SYNTAX = [
    coefficient("letter that is not ASCII", "2 * ω", "at character 5:", "unexpected 'ω'"),
    coefficient("parentheses a hundred and fifty deep", "(" * 150 + "drag" + ")" * 150, "nested deeper than 100"),
    blade("expression of five thousand characters", 'coefficient = "drag"', 'coefficient = §"drag' + " + 1" * 1250 + '"',
          "4096 characters"),
    coefficient("intermediate results without end", "1 + (" * 80 + "drag" + ")" * 80, "too many intermediate results"),
    blade("unknown parameter in a position", '"1 + length", 0, 0', '"1 + lenght", 0, 0',
          '[[point]] 1 position: in "1 + lenght" at character 5: unknown parameter', "did you mean 'length'?")
    + (("position =", "§position ="),),
]

NUMBERS = [
    not_finite("division by zero", "1 / 0", "inf"),
    not_finite("division by zero at the end", "drag / (omega - 5)", "inf", " where the trace ends"),
    not_finite("root that is not real within the range", "sqrt(drag*(omega - 30)*(omega - 60))", "nan",
               " within the range of the trace"),
    not_finite("logarithm of zero", "log(0)", "-inf"),
    blade("infinite mass", 'mass = "mass"', "§mass = inf", "[[point]] 1 mass: expected a finite number"),
    blade("infinite coordinate", '["1 + length", 0, 0]', '["1 + length", 0, -inf]',
          "[[point]] 1 position: expected a finite number") + (("position =", "§position ="),),
    machine("division by zero in the position of a body", "position = [0, 0, -1.5]", '§position = [0, "1/0", -1.5]',
            "[[body]] 2 position:", "finite"),
    blade("nan as a parameter", "drag   = 2.0", "§drag   = nan", "[parameters] drag: expected a finite number"),
    blade("infinite parameter in a table", "value = 40.0", "§value = -inf", "[parameters] omega: expected a finite number"),
    blade("division by zero in a parameter", "drag   = 2.0", 'drag   = "1 / 0"',
          "[[drag]] 1 coefficient: is not a finite number; found inf")
    + (("coefficient =", "§coefficient ="),),
    blade("division by zero in the beginning", "from = 100.0", '§from = "mass / 0"', "[trace] from: is not a finite number"),
    events("infinite harmonic", "§harmonics = [1, inf]", "[events] harmonics: expected a finite number"),
]

CONSTANTS = [
    events("damping ratio that depends on a parameter", '§damping_ratio = "drag / 100"',
           "[events] damping_ratio: expected numbers without parameters"),
    machine_with("strips that depend on a parameter", '[[blade_element]]\nbody = "blade"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\n'
                 'leading = [0, 1, 0]\nlift = [0, 0, 1]\nchord = 0.1\n§strips = "omega"',
                 "[[blade_element]] 1 strips: expected a whole number from 1 to 64"),
    option("modes that depend on a parameter that is no whole number", 'modes = "length / 2"',
           "[trace] modes: expected a whole number, found 2.5"),
]

UNITS = [
    unit("unit of two strokes", "rad//s"),
    unit("unit with parentheses", "1/(s)", "did you mean '1/s'?"),
    unit("unit written out", "radians/second", "did you mean 'rad/s'?"),
    unit("power without a sign", "s-1", "did you mean 's^-1'?"),
]

PARAMETERS = [
    blade("parameters defined in a circle of three", "drag   = 2.0", 'drag   = "a"\na = "b"\nb = "drag"',
          "is defined through itself: drag -> a -> b -> drag") + (("drag   =", "§drag   ="),),
    parameter("name that begins with a digit", "§2mass = 1.0", "[parameters] 2mass:", "letters, digits and '_'"),
    parameter("empty name", '§"" = 1.0', "[parameters] :", "letters, digits and '_'"),
    parameter("name with a letter that is not ASCII", '§"ω" = 1.0', "[parameters] ω:", "letters, digits and '_'"),
    parameter("name that is split by a point", "§a.b = 1.0", "[parameters] a: expected value ="),
    parameter("definition with an unknown parameter", '§spare = "2 * masss"', "[parameters] spare:", "at character 5:",
              "did you mean 'mass'?"),
    parameter("definition in a table with a fault", 'spare = { §value = "mass +", unit = "kg" }', "[parameters] spare:",
              "expression ends"),
    blade("traced parameter that nothing depends on", '[0, 0, "omega"]', "[0, 0, 40]",
          "[parameters] omega: nothing in the scene uses this parameter") + (("omega  =", "§omega  ="),),
    blade("parameter used in the range only", "to = 5.0", '§to = "spare"', "[trace] to:", "unknown parameter 'spare'"),
]

TRACE = [
    option("tolerance that no number reaches", "tolerance = 1e-14", "must lie between 1e-13 and 0.1; found 1e-14"),
    option("number of modes beyond whole numbers", "modes = 1e10", "[trace] modes: expected a whole number"),
    option("order of zero", "order = 0", "[trace] order: must lie between 1 and 4"),
    option("reference of zero", "reference = 0", "[trace] reference: must be positive"),
    option("first step backwards", "first_step = -1", "[trace] first_step: must be positive"),
    option("longest step of zero", "max_step = 0.0", "[trace] max_step: must be positive"),
    option("one point", "max_nodes = 1", "[trace] max_nodes: must be at least 2"),
    option("half a point", "max_nodes = 10.5", "[trace] max_nodes: expected a whole number, found 10.5"),
    option("branch of zero", "branch = 0", "[trace] branch: must be 1, 2 or 3; found 0"),
    option("branch of four", "branch = 4", "[trace] branch: must be 1, 2 or 3; found 4"),
    option("branch of a half", "branch = 1.5", "[trace] branch: expected a whole number, found 1.5"),
    option("branches with a gap", 'branch = "1,,2"', "[trace] branch: expected whole numbers separated by commas"),
    option("empty list of branches", 'branch = ""', "[trace] branch:", "expression ends"),
    option("branch out of range in a list", 'branch = "1, 2, 7"', "[trace] branch: must be 1, 2 or 3; found 7"),
    option("two faults at a time", "order = 7\nmax_nodes = 0", "[trace] order: must lie between 1 and 4",
           "max_nodes: must be"),
    option("effects to leave out with a gap", 'without = "drag,,rod"', "[trace] without: expected names separated by commas"),
    option("effect to leave out that is none", 'without = "drg"', "[trace] without: 'drg' is no effect",
           "did you mean 'drag'?"),
    option("effect to leave out that the scene has not", 'without = "gravity"', "[trace] without: 'gravity' is no effect"),
    option("constraint to leave out", 'without = "rod"', "[trace] without: 'rod' is no effect", "constraints cannot"),
    option("inertia to leave out", 'without = "point"', "[trace] without: 'point' is no effect", "inertia"),
    blade("beginning equal to the end by an expression", "to = 5.0", '§to = "2 * mass"', "[trace] to: equals from (100)"),
    blade("scene without a trace", '[trace]\nparameter = "omega"\nfrom = 100.0\nto = 5.0', "", "[trace] from: is missing",
          "here or as --from"),
]

EVENTS = [
    events("damping ratio of one", "§damping_ratio = 1", "[events] damping_ratio: must lie between -1 and 1; found 1"),
    events("damping ratio of minus one", "§damping_ratio = -1", "must lie between -1 and 1; found -1"),
    events("damping ratio in percent", "§damping_ratio = [0.01, 5]", "must lie between -1 and 1; found 5"),
    events("harmonic of zero", "§harmonics = 0", "[events] harmonics: must be positive; found 0"),
    events("excitation without harmonics", '§excitation = "omega"', "[events] excitation: is of no use without `harmonics`"),
    events("excitation with no harmonics", 'harmonics = []\n§excitation = "omega"', "excitation: is of no use without"),
    events("excitation of an unknown parameter", 'harmonics = 1\n§excitation = "2 * omga"',
           "[events] excitation:", "unknown parameter 'omga'", "did you mean 'omega'?"),
    events("excitation that divides by zero", 'harmonics = 1\n§excitation = "omega / 0"', "[events] excitation:", "finite"),
    blade("harmonics of a length", 'unit = "rad/s"', 'unit = "mm"', "[events] harmonics: of what frequency?",
          "'omega' is in mm",
          "`excitation`") + (('[frame]', '[events]\n§harmonics = 1\n[frame]'),),
]

SCENES = (EXPRESSIONS + VALUES + SYNTAX + NUMBERS + CONSTANTS + UNITS + PARAMETERS + TRACE + EVENTS)
