"""Scenes whose numbers are wrong: expressions, units, parameters, the range of the trace, special points."""

from good import BLADE, blade, blade_with, family, machine, machine_with

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
    blade("mass negative at the start only", 'mass = "mass"', '§mass = "mass - drag*omega/2"',
          "[[point]] 1 mass: must not be negative; found -50"),
    blade("mass negative at the end only", 'mass = "mass"', '§mass = "mass - 500*drag/omega"',
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
    coefficient("operator at the end", "2 * ", "at character", "expression ends where a number"),
    coefficient("comparison", "drag < 3", "at character 6:", "unexpected '<'"),
    coefficient("brackets", "[drag]", "at character 1:", "unexpected '['"),
    coefficient("percent sign", "5 %", "at character 3:", "unexpected '%'"),
    coefficient("letter that is not ASCII", "2 * ω", "at character 5:", "unexpected 'ω'"),
    coefficient("degree sign", "30°", "at character 3:", "unexpected '°'"),
    coefficient("infinity in an expression", "2 * inf", "at character 5: unknown parameter 'inf'"),
    coefficient("parentheses a hundred and fifty deep", "(" * 150 + "drag" + ")" * 150, "nested deeper than 100"),
    coefficient("powers a hundred and fifty deep", "2^" * 150 + "drag", "too many intermediate results"),
    coefficient("calls a hundred and fifty deep", "sin(" * 150 + "drag" + ")" * 150, "nested deeper than 100"),
    coefficient("parenthesis of very many that is never closed", "(" * 90 + "drag", "this '(' is never closed"),
    blade("expression of five thousand characters", 'coefficient = "drag"', 'coefficient = §"drag' + " + 1" * 1250 + '"',
          "4096 characters"),
    coefficient("intermediate results without end", "1 + (" * 80 + "drag" + ")" * 80, "too many intermediate results"),
    blade("unknown parameter in a position", '"1 + length", 0, 0', '"1 + lenght", 0, 0',
          '[[point]] 1 position: in "1 + lenght" at character 5: unknown parameter', "did you mean 'length'?")
    + (("position =", "§position ="),),
    blade("unknown parameter in the frame", '[0, 0, "omega"]', '[0, 0, "Omega"]', "[frame] angular_velocity:",
          "unknown parameter 'Omega'", "did you mean 'omega'?") + (("angular_velocity =", "§angular_velocity ="),),
    blade("unknown parameter in the range", "to = 5.0", '§to = "omega_0 / 20"', "[trace] to:", "unknown parameter 'omega_0'"),
]

NUMBERS = [
    not_finite("division by zero", "1 / 0", "inf"),
    not_finite("zero by zero", "0 / 0", "nan"),
    not_finite("division by a difference that vanishes", "1 / (drag - 2)", "inf"),
    not_finite("division by zero at the start", "drag / (omega - 100)", "inf"),
    not_finite("division by zero at the end", "drag / (omega - 5)", "inf", " where the trace ends"),
    not_finite("root that is not real within the range", "sqrt(drag*(omega - 30)*(omega - 60))", "nan",
               " within the range of the trace"),
    not_finite("logarithm of zero", "log(0)", "-inf"),
    not_finite("logarithm of a negative number", "log(-drag)", "nan"),
    not_finite("root of a negative number", "sqrt(-1)", "nan"),
    not_finite("power of a negative number", "(-drag)^0.5", "nan"),
    not_finite("arc sine of two", "asin(drag)", "nan"),
    not_finite("overflow of an exponential", "exp(1000)", "inf"),
    not_finite("overflow of a product", "1e200 * 1e200", "inf"),
    not_finite("overflow of a power", "drag*omega^200", "inf"),
    blade("nan as a coefficient", 'coefficient = "drag"', "§coefficient = nan",
          "[[drag]] 1 coefficient: expected a finite number"),
    blade("infinite mass", 'mass = "mass"', "§mass = inf", "[[point]] 1 mass: expected a finite number"),
    blade("infinite coordinate", '["1 + length", 0, 0]', '["1 + length", 0, -inf]',
          "[[point]] 1 position: expected a finite number") + (("position =", "§position ="),),
    blade("division by zero in a position", '"1 + length", 0, 0', '"length / 0", 0, 0', "[[point]] 1 position:", "finite")
    + (("position =", "§position ="),),
    machine("division by zero in the position of a body", "position = [0, 0, -1.5]", '§position = [0, "1/0", -1.5]',
            "[[body]] 2 position:", "finite"),
    blade("nan as a parameter", "drag   = 2.0", "§drag   = nan", "[parameters] drag: expected a finite number"),
    blade("infinite parameter in a table", "value = 40.0", "§value = -inf", "[parameters] omega: expected a finite number"),
    blade("division by zero in a parameter", "drag   = 2.0", 'drag   = "1 / 0"',
          "[[drag]] 1 coefficient: is not a finite number; found inf")
    + (("coefficient =", "§coefficient ="),),
    blade("parameter that overflows", "drag   = 2.0", 'drag   = "exp(mass * mass)"',
          "[[drag]] 1 coefficient: is not a finite number; found inf") + (("coefficient =", "§coefficient ="),),
    blade("nan as the beginning", "from = 100.0", "§from = nan", "[trace] from: expected a finite number"),
    blade("division by zero in the beginning", "from = 100.0", '§from = "mass / 0"', "[trace] from: is not a finite number"),
    events("nan as a damping ratio", "§damping_ratio = nan", "[events] damping_ratio: expected a finite number"),
    events("infinite harmonic", "§harmonics = [1, inf]", "[events] harmonics: expected a finite number"),
]

CONSTANTS = [
    events("damping ratio that depends on a parameter", '§damping_ratio = "drag / 100"',
           "[events] damping_ratio: expected numbers without parameters"),
    events("harmonic that depends on a parameter", '§harmonics = [1, "drag"]',
           "[events] harmonics: expected numbers without parameters"),
    machine_with("strips that depend on a parameter", '[[blade_element]]\nbody = "blade"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\n'
                 'leading = [0, 1, 0]\nlift = [0, 0, 1]\nchord = 0.1\n§strips = "omega"',
                 "[[blade_element]] 1 strips: expected a whole number from 1 to 64"),
    option("modes that depend on a parameter that is no whole number", 'modes = "length / 2"',
           "[trace] modes: expected a whole number, found 2.5"),
]

UNITS = [
    unit("unit of two strokes", "rad//s"),
    unit("unit that ends in a stroke", "rad/"),
    unit("unit that ends in a point", "rad·"),
    unit("unit with a power that is a letter", "rad s^x"),
    unit("unit with a power that is missing", "s^"),
    unit("unit with a power of a half", "s^0.5"),
    unit("unit with a power too large", "s^13"),
    unit("unit with parentheses", "1/(s)", "did you mean '1/s'?"),
    unit("unit written out", "radians/second", "did you mean 'rad/s'?"),
    unit("power without a sign", "s-1", "did you mean 's^-1'?"),
    unit("number as a factor of a unit", "2 rad/s"),
    unit("unit without a letter before its power", "^2"),
]

PARAMETERS = [
    blade("parameter defined by itself", "drag   = 2.0", '§drag   = "drag + 1"',
          "[parameters] drag: is defined through itself: drag -> drag"),
    blade("parameters defined in a circle of three", "drag   = 2.0", 'drag   = "a"\na = "b"\nb = "drag"',
          "is defined through itself: drag -> a -> b -> drag") + (("drag   =", "§drag   ="),),
    parameter("name that begins with a digit", "§2mass = 1.0", "[parameters] 2mass:", "letters, digits and '_'"),
    parameter("name with a point", '§"a.b" = 1.0', "[parameters] a.b:", "letters, digits and '_'"),
    parameter("empty name", '§"" = 1.0', "[parameters] :", "letters, digits and '_'"),
    parameter("name with a space", '§"blade mass" = 1.0', "[parameters] blade mass:", "letters, digits and '_'"),
    parameter("name with a letter that is not ASCII", '§"ω" = 1.0', "[parameters] ω:", "letters, digits and '_'"),
    parameter("name that is split by a point", "§a.b = 1.0", "[parameters] a: expected value ="),
    parameter("definition with an unknown parameter", '§spare = "2 * masss"', "[parameters] spare:", "at character 5:",
              "did you mean 'mass'?"),
    parameter("definition that is empty", '§spare = ""', "[parameters] spare:", "expression ends"),
    parameter("definition in a table with a fault", 'spare = { §value = "mass +", unit = "kg" }', "[parameters] spare:",
              "expression ends"),
    blade("traced parameter that nothing depends on", '[0, 0, "omega"]', "[0, 0, 40]",
          "[parameters] omega: nothing in the scene uses this parameter") + (("omega  =", "§omega  ="),),
    blade("parameter used in the range only", "to = 5.0", '§to = "spare"', "[trace] to:", "unknown parameter 'spare'"),
    blade("parameter in another case", 'mass = "mass"', '§mass = "Mass"', "unknown parameter 'Mass'", "did you mean 'mass'?"),
]

TRACE = [
    option("negative tolerance", "tolerance = -1e-6", "[trace] tolerance: must lie between 1e-13 and 0.1; found -1e-06"),
    option("tolerance that no number reaches", "tolerance = 1e-14", "must lie between 1e-13 and 0.1; found 1e-14"),
    option("word as tolerance", 'tolerance = "tight"', "[trace] tolerance", "unknown parameter 'tight'"),
    option("infinite tolerance", "tolerance = inf", "[trace] tolerance: expected a finite number"),
    option("negative number of modes", "modes = -2", "[trace] modes: must be at least 1", '"all"'),
    option("two and a half modes", "modes = 2.5", "[trace] modes: expected a whole number, found 2.5"),
    option("number of modes beyond whole numbers", "modes = 1e10", "[trace] modes: expected a whole number"),
    option("order of zero", "order = 0", "[trace] order: must lie between 1 and 4"),
    option("negative order", "order = -1", "[trace] order: must lie between 1 and 4"),
    option("order that is infinite", "order = inf", "[trace] order: expected a finite number"),
    option("reference of zero", "reference = 0", "[trace] reference: must be positive"),
    option("negative reference", "reference = -1", "[trace] reference: must be positive"),
    option("reference that is no number", "reference = nan", "[trace] reference: expected a finite number"),
    option("first step of zero", "first_step = 0", "[trace] first_step: must be positive"),
    option("first step backwards", "first_step = -1", "[trace] first_step: must be positive"),
    option("longest step of zero", "max_step = 0.0", "[trace] max_step: must be positive"),
    option("longest step that is infinite", "max_step = inf", "[trace] max_step: expected a finite number"),
    option("one point", "max_nodes = 1", "[trace] max_nodes: must be at least 2"),
    option("no points", "max_nodes = 0", "[trace] max_nodes: must be at least 2"),
    option("half a point", "max_nodes = 10.5", "[trace] max_nodes: expected a whole number, found 10.5"),
    option("word as the number of points", 'max_nodes = "many"', "[trace] max_nodes", "unknown parameter 'many'"),
    option("branch of zero", "branch = 0", "[trace] branch: must be 1, 2 or 3; found 0"),
    option("branch of four", "branch = 4", "[trace] branch: must be 1, 2 or 3; found 4"),
    option("branch of a half", "branch = 1.5", "[trace] branch: expected a whole number, found 1.5"),
    option("branches that are no numbers", 'branch = "1, x"', "[trace] branch: expected whole numbers separated by commas"),
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
    blade("traced parameter that is a point", 'parameter = "omega"', '§parameter = "blade"',
          "[trace] parameter: no parameter is called 'blade'", "known: omega, mass, length, drag"),
    blade("scene without a trace", '[trace]\nparameter = "omega"\nfrom = 100.0\nto = 5.0', "", "[trace] from: is missing",
          "here or as --from"),
]

EVENTS = [
    events("damping ratio of one", "§damping_ratio = 1", "[events] damping_ratio: must lie between -1 and 1; found 1"),
    events("damping ratio of minus one", "§damping_ratio = -1", "must lie between -1 and 1; found -1"),
    events("damping ratio in percent", "§damping_ratio = [0.01, 5]", "must lie between -1 and 1; found 5"),
    events("damping ratio that divides by zero", '§damping_ratio = "1/0"', "must lie between -1 and 1; found inf"),
    events("empty text as a damping ratio", '§damping_ratio = ""', "[events] damping_ratio:", "expression ends"),
    events("harmonic of zero", "§harmonics = 0", "[events] harmonics: must be positive; found 0"),
    events("negative harmonic", "§harmonics = [1, -2]", "[events] harmonics: must be positive; found -2"),
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
