"""Command lines that are wrong. They run in a folder with a good scene and its results, of every kind (files.MAKERS)."""

import os
import subprocess
import time
import unittest

from good import BLADE, FAMILY, TWO_SHORT_RODS
from program import edited

TRACE = ["trace", "scene.toml", "-o", "new.h5"]
EXPLAIN = ["explain", "scene.toml"]
EVAL = ["eval", "loci.h5"]
VERIFY = ["verify", "loci.h5"]
BOUNDARY = ["boundary", "column.toml", "-o", "new.h5"]
MAP = ["map", "column.toml", "-o", "new.h5"]
ACCURACY = ["accuracy", "scene.toml", "-o", "new.h5"]
REPORT = ["report", "loci.h5"]
SECOND = ["--second", "damping", "--second-from", "0.01", "--second-to", "1"]


def write(name, text):
    """Prepares the folder: one more file in it."""
    return lambda folder: (folder / name).write_text(text)


def link(name, to):
    return lambda folder: (folder / name).symlink_to(to)


def rewrite(path, text):
    """Replaces a file by a new one. The old one is a link that other tests share."""
    path.unlink()
    path.write_text(text)


def edit(name, old, new):
    return lambda folder: rewrite(folder / name, edited((folder / name).read_text(), old, new))


def as_anybody(prepare):
    """Skips the test for root, whom permissions do not restrict."""
    def unless_root(folder):
        if os.geteuid() == 0:
            raise unittest.SkipTest("permissions do not bind root")
        prepare(folder)
    return unless_root


def unreadable(name):
    def prepare(folder):
        rewrite(folder / name, "")
        (folder / name).chmod(0)
    return as_anybody(prepare)


read_only_folder = as_anybody(lambda folder: (folder / "folder").chmod(0o555))


def row(name, arguments, *fragments, prepare=None):
    return (name, arguments, fragments) if prepare is None else (name, arguments, fragments, prepare)


def option(command, name, flag, value, *fragments):
    """A command with one option more, by which the message names it."""
    place = f"eigentrail: {flag}: " if command in (TRACE, EXPLAIN, ACCURACY) else flag
    return row(f"{command[0]} with {name}", [*command, flag, value], place, *fragments)


def by_parser(command, name, flag, value, *fragments):
    """An option that the parser of the command line refuses."""
    return row(f"{command[0]} with {name}", [*command, flag, value], flag, *fragments)


def unfinished(folder):
    """A map that was killed behind its first lines."""
    command = [os.environ["EIGENTRAIL"], *MAP, *SECOND, "--grid", "400x20", "--quiet", "--jobs", "1"]
    with subprocess.Popen(command, cwd=folder) as run:
        while not (folder / "new.h5.unfinished").exists() or (folder / "new.h5.unfinished").stat().st_size < 20000:
            time.sleep(0.005)
        run.kill()


RESUMED = [
    row("map over an interrupted one", [*MAP, *SECOND], "new.h5.unfinished: holds what an interrupted run has computed for new.h5",
        "--resume goes on with it, --force begins anew", prepare=unfinished),
    row("resumed map with another grid", [*MAP, *SECOND, "--grid", "400x21", "--resume"], "new.h5: cannot be resumed: cells: was '20' and is '21'",
        "begin anew with --force", prepare=unfinished),
    row("resumed map of another scene", [*MAP, *SECOND, "--grid", "400x20", "--resume", "--set", "damping=0.3"], "new.h5: cannot be resumed: scene: line",
        prepare=unfinished),
    row("boundary over an interrupted map", [*BOUNDARY, *SECOND, "--resume"], "command: was 'map' and is 'boundary'", prepare=unfinished),
    row("resumption of a complete map of other input", ["map", "column.toml", *SECOND, "-o", "map.h5", "--resume"],
        "map.h5: cannot be resumed: it is of other input", "begin anew with --force"),
    *(row(f"{command[0]} resumed by force", [*command, "--resume", "--force"], "--force", "--resume")
      for command in ([*MAP, *SECOND], [*BOUNDARY, *SECOND], ACCURACY, ["sweep", "scene.toml", "--vary", "drag=1,2"])),
    row("resumption from a text", [*MAP, *SECOND, "--resume"], "new.h5.unfinished: is no file of an interrupted run; rename it",
        prepare=write("new.h5.unfinished", "my notes, which are longer than a line of the format\n")),
]


def outputs(command, kind):
    """Faults of an output file, for a command line without its output option."""
    others = {"loci.h5", "map.h5", "boundary.h5", "study.h5", "page.html", "scene.toml"}
    own = {"trace": "loci.h5", "map": "map.h5", "boundary": "boundary.h5", "accuracy": "study.h5",
           "report": "page.html"}[command[0]]
    given = f"{command[0]} to "
    yield row(given + "an absent folder", [*command, "-o", "none/new"], "none/new: the folder none does not exist")
    yield row(given + "a folder", [*command, "-o", "folder"], "folder: is a folder; give the name of a file")
    yield row(given + "a folder by force", [*command, "-o", "folder", "--force"], "folder: is a folder")
    yield row(given + "the folder itself", [*command, "-o", "."], ".: is a folder")
    yield row(given + "a name below a file", [*command, "-o", "scene.toml/new"],
              "scene.toml/new: the folder scene.toml does not exist")
    yield row(given + "a name too long", [*command, "-o", "x" * 300], "x" * 300, "cannot be created")
    yield row(given + "no name", [*command, "-o", ""], "--output")
    yield row(given + "nothing", [*command, "-o"], "--output")
    yield row(given + "a device by force", [*command, "-o", "/dev/null", "--force"], "/dev/null: is no readable " + kind)
    yield row(given + "a result that exists", [*command, "-o", own], f"{own}: exists already", "--force")
    yield row(given + "a link to a result that exists", [*command, "-o", "link"], "link: exists already",
              prepare=link("link", own))
    for other in sorted(others - {own}):
        yield row(given + f"{other} by force", [*command, "-o", other, "--force"],
                  f"{other}: is no readable {kind}; --force replaces nothing else")
    yield row(given + "a folder that may not be written", [*command, "-o", "folder/new"], "folder/new: cannot be created",
              prepare=read_only_folder)


GENERAL = [
    row("no command", [], "command"),
    row("unknown command", ["trac"], "unknown command 'trac'", "did you mean 'trace'?"),
    row("command in capitals", ["TRACE", "scene.toml"], "unknown command 'TRACE'"),
    row("empty command", [""], "unknown command ''"),
    row("command of two lines", ["tr\nace"], "unknown command 'tr ace'"),
    row("option in place of a command", ["--tolerance", "1e-6"], "it is an option of suggest, trace"),
    row("scene in place of a command", ["scene.toml"], "unknown command 'scene.toml'"),
    row("option of two lines", [*TRACE, "--tole\nrance"], "--tole"),
    row("two commands", ["info", "events", "loci.h5"], "loci.h5"),
]

TRACES = [
    row("unknown option", [*TRACE, "--tolerence", "1e-6"], "--tolerence"),
    row("option with one dash", [*TRACE, "-tolerance", "1e-6"], "-t"),
    row("no scene", ["trace", "-o", "new.h5"], "SCENE"),
    row("two scenes", ["trace", "scene.toml", "column.toml", "-o", "new.h5"], "column.toml"),
    row("two outputs", [*TRACE, "-o", "newer.h5"], "--output"),
    row("scene that does not exist", ["trace", "none.toml", "-o", "new.h5"], "none.toml: ", "no such file"),
    row("scene without a name", ["trace", "", "-o", "new.h5"], "no such file"),
    row("scene that is a folder", ["trace", "folder", "-o", "new.h5"], "folder: "),
    row("scene that is a loci file", ["trace", "loci.h5", "-o", "new.h5"], "loci.h5: is an HDF5 file, no scene"),
    row("scene that is a page", ["trace", "page.html", "-o", "new.h5"], "page.html:1:1: not valid TOML"),
    row("scene that is a device", ["trace", "/dev/null", "-o", "new.h5"], "/dev/null: "),
    row("scene that is a link to itself", ["trace", "circle.toml", "-o", "new.h5"], "circle.toml: ",
        prepare=link("circle.toml", "circle.toml")),
    row("scene that may not be read", TRACE, "scene.toml: cannot be read", prepare=unreadable("scene.toml")),
    row("output that is the scene", ["trace", "scene.toml", "-o", "scene.toml"], "scene.toml: exists already"),
    row("output that is the scene by a way round", ["trace", "scene.toml", "-o", "./folder/../scene.toml", "--force"],
        "scene.toml: is no readable loci file"),
    row("failed trace over an old output", ["trace", "short.toml", "-o", "loci.h5", "--force"], "no equilibrium",
        prepare=write("short.toml", TWO_SHORT_RODS)),
    row("force and resume", [*TRACE, "--force", "--resume"], "--force", "--resume"),
    row("resumption to a page", ["trace", "scene.toml", "-o", "page.html", "--resume"],
        "page.html: is no readable loci file"),
    row("resumption to an absent folder", ["trace", "scene.toml", "-o", "none/new.h5", "--resume"],
        "the folder none does not exist"),
    option(TRACE, "an order in words", "--order", "cubic", 'expected a whole number or "auto", found "cubic"'),
    option(TRACE, "equal ends", "--to", "100", "equals from (100)"),
    option(TRACE, "an empty beginning", "--from", "", "expression ends"),
    option(TRACE, "an end with a unit of another kind", "--to", "5 m", "5 m does not fit omega, which is in rad/s"),
    option(TRACE, "an end with an unknown unit", "--to", "5 RPM", "unit 'RPM' is not known", "did you mean 'rpm'?"),
    option(TRACE, "an end with a decimal comma", "--to", "5,5", "unexpected ','"),
    option(TRACE, "an end that is true", "--to", "true", "expected a number or an expression"),
    option(TRACE, "a tolerance in words", "--tolerance", "tight", "unknown parameter 'tight'"),
    option(TRACE, "branches in words", "--branch", "left", "expected whole numbers separated by commas"),
    option(TRACE, "an effect to leave out that is none", "--without", "magic", "'magic' is no effect", "known: "),
    option(TRACE, "an unknown parameter", "--parameter", "omga", "did you mean 'omega'?"),
    option(TRACE, "a parameter without a name", "--parameter", "", "is missing"),
    by_parser(TRACE, "negative threads", "--threads", "-1", "1024"),
    by_parser(TRACE, "very many threads", "--threads", "5000", "1024"),
    by_parser(TRACE, "threads in words", "--threads", "all", "all"),
    by_parser(TRACE, "a negative time to lose", "--save-every", "-1", "-1"),
    by_parser(TRACE, "a time to lose in words", "--save-every", "soon", "soon"),
    by_parser(TRACE, "a time to lose that is no number", "--save-every", "nan", "nan"),
    row("trace with an option without its value", [*TRACE, "--order"], "--order"),
    row("trace with a value for a flag", [*TRACE, "--no-certify=perhaps"], "--no-certify"),
    *outputs(["trace", "scene.toml"], "loci file"),
]

EXPLANATIONS = [
    row("explain without a scene", ["explain"], "SCENE"),
    row("explain of loci", ["explain", "loci.h5"], "loci.h5: is an HDF5 file, no scene"),
    row("explain of a parameter named like a dataset", ["explain", "mode.toml"], "mode.toml:", "cannot be called 'mode'",
        prepare=write("mode.toml", BLADE.replace("omega", "mode"))),
    row("explain with a tolerance", [*EXPLAIN, "--tolerance", "1e-6"], "--tolerance"),
    row("explain with an output", [*EXPLAIN, "-o", "new.h5"], "-o"),
    row("sensitivity of a family", ["explain", "column.toml", "--sensitivity"], "column.toml: --sensitivity ranks effects"),
]

EVALUATIONS = [
    row("eval without a file", ["eval", "--at", "50"], "FILE"),
    row("eval of two files", ["eval", "loci.h5", "map.h5", "--at", "50"], "map.h5"),
    row("eval above the range", [*EVAL, "--at", "101"], "loci.h5: omega = 101 lies outside", "5 ... 100"),
    row("eval below the range", [*EVAL, "--at", "50", "4.9", "--csv"], "omega = 4.9 lies outside"),
    row("eval at infinity", [*EVAL, "--at", "inf"], "inf"),
    row("eval at no number", [*EVAL, "--at", "fast"], "--at", "fast"),
    row("eval at a number beyond all", [*EVAL, "--at", "1e999"], "--at 1e999", "finite"),
    row("eval at a list with a gap", [*EVAL, "--at", "50,,60"], "--at 50,,60: expected a number, found an empty text"),
    row("eval at a range of two numbers", [*EVAL, "--at", "10:60"], "--at 10:60: expected begin:step:end"),
    row("eval at a range that leads away", [*EVAL, "--at", "10:-5:60"], "the step -5 does not lead from 10 to 60"),
    row("eval at a number with a unit of another kind", [*EVAL, "--at", "50mm"], "--at 50mm: 50 mm does not fit omega"),
    row("eval at a number with an unknown unit", [*EVAL, "--at", "50 turns"], "unit 'turns' is not known",
        "did you mean 'rev'?"),
    row("eval at an empty text", [*EVAL, "--at", ""], "--at", "empty"),
    row("eval without a place", EVAL, "--at"),
    row("eval with a place without a value", [*EVAL, "--at"], "--at"),
    row("eval as csv and json", [*EVAL, "--at", "50", "--csv", "--json"], "--csv", "--json"),
    row("eval to a file", [*EVAL, "--at", "50", "-o", "new.csv"], "-o"),
    row("events of no file", ["events"], "FILE"),
    row("events at a place", ["events", "loci.h5", "--at", "50"], "--at"),
    row("events as csv and json", ["events", "loci.h5", "--csv", "--json"], "--csv", "--json"),
    row("events as sensitivities in json", ["events", "loci.h5", "--sensitivity", "--json"], "--sensitivity", "--json"),
    row("events of a scene", ["events", "scene.toml"], "scene.toml: is a scene, no result; trace it first"),
    row("info of no file", ["info"], "FILE"),
    row("info as json and scene", ["info", "loci.h5", "--json", "--scene"], "--json", "--scene"),
    row("info as csv", ["info", "loci.h5", "--csv"], "--csv"),
    row("info of a file that may not be read", ["info", "loci.h5"], "loci.h5: cannot be read", prepare=unreadable("loci.h5")),
    row("verify of no file", ["verify"], "FILE"),
    by_parser(VERIFY, "no samples", "--samples", "0", "1 to 1000000"),
    by_parser(VERIFY, "samples without end", "--samples", "1000001", "1 to 1000000"),
    by_parser(VERIFY, "samples in words", "--samples", "many", "many"),
    by_parser(VERIFY, "a seed in words", "--seed", "luck", "luck"),
    by_parser(VERIFY, "a negative seed", "--seed", "-1", "-1"),
    by_parser(VERIFY, "a seed beyond whole numbers", "--seed", "99999999999999999999999", "99999999999999999999999"),
]

BOUNDARIES = [
    row("boundary without a scene", ["boundary", "-o", "new.h5", *SECOND], "SCENE"),
    row("boundary of a map", ["boundary", "map.h5", "-o", "new.h5", *SECOND], "map.h5: is an HDF5 file, no scene"),
    row("boundary without a second parameter", [*BOUNDARY, "--from", "0", "--to", "1"], "--second"),
    row("boundary without a beginning", [*BOUNDARY, "--second", "damping", "--second-to", "1"], "--second-from: is missing"),
    row("boundary without an end", [*BOUNDARY, "--second", "damping", "--second-from", "0"], "--second-to: is missing"),
    row("boundary with an unknown second parameter", [*BOUNDARY, "--second", "dampin", "--second-from", "0", "--second-to", "1"],
        "--second: no parameter is called 'dampin'", "did you mean 'damping'?"),
    row("boundary with one parameter twice", [*BOUNDARY, "--second", "load", "--second-from", "0", "--second-to", "1"],
        "--second: 'load' is the first parameter already"),
    row("boundary with a derived parameter", [*BOUNDARY, "--second", "damping", "--second-from", "0", "--second-to", "1"],
        "--second: 'damping' is defined by an expression",
        prepare=edit("column.toml", "damping = 0.1", 'damping = "load + 0.1"')),
    row("family that does not name its parameter", ["trace", "family.toml", "-o", "new.h5", "--parameter", "p"],
        "family.toml: [trace] parameter: a scene with [matrix_family] names here the parameter",
        prepare=write("family.toml", "[parameters]\np = 1\n" + edited(FAMILY, 'parameter = "p"\n', ""))),
    row("boundary of a scene without its range", [*BOUNDARY, *SECOND], "[trace] from: is missing", "--from",
        prepare=edit("column.toml", "from =", "# from =")),
    row("boundary of an empty window", [*BOUNDARY, "--second", "damping", "--second-from", "1", "--second-to", "1"],
        "--second-to: equals --second-from (1): the window is empty"),
    row("boundary from nan", [*BOUNDARY, "--second", "damping", "--second-from", "nan", "--second-to", "1"],
        "--second-from: is not a finite number"),
    row("boundary from a word", [*BOUNDARY, "--second", "damping", "--second-from", "none", "--second-to", "1"],
        "--second-from", "none"),
    row("boundary of an unknown first parameter",
        [*BOUNDARY, *SECOND, "--parameter", "lod", "--from", "0", "--to", "1"],
        "--parameter: no parameter is called 'lod'", "did you mean 'load'?"),
    row("boundary of another parameter without its range", [*BOUNDARY, "--second", "load", "--second-from", "0", "--second-to", "1",
                                                            "--parameter", "damping"],
        "--from: is missing; the range in the scene is not that of 'damping'"),
    row("boundary of another parameter without its end",
        [*BOUNDARY, "--second", "load", "--second-from", "0", "--second-to", "1", "--parameter",
                                                          "damping", "--from", "0"], "--to: is missing"),
    row("boundary of an empty first range", [*BOUNDARY, *SECOND, "--to", "0"],
        "--to: equals from (0)"),
    row("boundary of a first range in words", [*BOUNDARY, *SECOND, "--to", "high"], "--to", "high"),
    row("boundary with a tolerance of zero", [*BOUNDARY, *SECOND, "--tolerance", "0"],
        "tolerance: must lie between 1e-13 and 0.1"),
    row("boundary with negative lines", [*BOUNDARY, *SECOND, "--lines", "-1"],
        "--lines: must lie between 0 and 1000; found -1"),
    row("boundary with lines without end", [*BOUNDARY, *SECOND, "--lines", "1001"],
        "--lines: must lie between 0 and 1000; found 1001"),
    row("boundary with half a line", [*BOUNDARY, *SECOND, "--lines", "2.5"], "--lines", "2.5"),
    row("boundary of a damping ratio of one", [*BOUNDARY, *SECOND, "--damping-ratio", "1"],
        "--damping-ratio: must lie between -1 and 1; found 1"),
    row("boundary of a damping ratio in words", [*BOUNDARY, *SECOND, "--damping-ratio", "low"], "--damping-ratio", "low"),
    row("boundary of two damping ratios", [*BOUNDARY, *SECOND], "--damping-ratio: the scene's [events] has 2 damping ratios",
        prepare=edit("column.toml", "[matrix_family]", "[events]\ndamping_ratio = [0.01, 0.02]\n\n[matrix_family]")),
    row("boundary to an empty text", [*BOUNDARY, "--second", "damping", "--second-from", "-1", "--second-to", ""], "--second-to", "empty"),
    row("boundary with an empty number of lines", [*BOUNDARY, *SECOND, "--lines", ""], "--lines", "empty"),
    row("boundary with a grid", [*BOUNDARY, *SECOND, "--grid", "5"], "--grid"),
    *outputs(["boundary", "column.toml", *SECOND], "boundary file"),
]

MAPS = [
    row("map without a scene", ["map", "-o", "new.h5", *SECOND], "SCENE"),
    row("map without a second parameter", [*MAP, "--from", "0", "--to", "1"], "--second"),
    row("map with an unknown second parameter", [*MAP, "--second", "drag", "--second-from", "0", "--second-to", "1"],
        "--second: no parameter is called 'drag'", "known: load, damping"),
    row("map of a mass that becomes negative",
        ["map", "scene.toml", "-o", "new.h5", "--second", "mass", "--second-from", "-1", "--second-to", "2"],
        "[[point]] 1 mass: must not be negative; found -1"),
    row("map of a parameter named like a dataset",
        ["map", "margin.toml", "-o", "new.h5", "--second", "margin", "--second-from", "1", "--second-to", "2"],
        "margin.toml:7:", "[parameters] margin: a parameter of the map cannot be called 'margin'",
        prepare=write("margin.toml", BLADE.replace("drag ", "margin ").replace('"drag"', '"margin"'))),
    row("map of one line", [*MAP, *SECOND, "--grid", "1x5"],
        "--grid: expected at least 2 values of each parameter, found 1x5"),
    row("map of half a line", [*MAP, *SECOND, "--grid", "2.5x4"], "--grid: expected N, or NxM", "found '2.5x4'"),
    row("map of three sizes", [*MAP, *SECOND, "--grid", "3x4x5"], "--grid: expected N, or NxM", "found '3x4x5'"),
    row("map of no size", [*MAP, *SECOND, "--grid", ""], "--grid"),
    row("map of very many cells", [*MAP, *SECOND, "--grid", "1000000x1000000"], "--grid: expected at most"),
    row("map of sizes beyond whole numbers", [*MAP, *SECOND, "--grid", "99999999999x2"], "--grid: expected N, or NxM"),
    row("map with negative jobs", [*MAP, *SECOND, "--jobs", "-1"], "--jobs: expected 0 to", "found -1"),
    row("map with very many jobs", [*MAP, *SECOND, "--jobs", "100000"], "--jobs: expected 0 to", "found 100000"),
    row("map with jobs in words", [*MAP, *SECOND, "--jobs", "all"], "--jobs", "all"),
    row("map with an empty number of jobs", [*MAP, *SECOND, "--jobs", ""], "--jobs", "empty"),
    row("map with lines", [*MAP, *SECOND, "--lines", "5"], "--lines"),
    *outputs(["map", "column.toml", *SECOND], "stability map"),
]

STUDIES = [
    row("accuracy without a scene", ["accuracy"], "SCENE"),
    row("accuracy of loci", ["accuracy", "loci.h5"], "loci.h5: is an HDF5 file, no scene"),
    by_parser(ACCURACY, "tolerances in words", "--tolerances", "tight",
              "expected numbers separated by commas; found 'tight'"),
    by_parser(ACCURACY, "no tolerances", "--tolerances", ""),
    by_parser(ACCURACY, "a tolerance called none", "--tolerances", "none", "expected numbers from 1e-13 to 0.1"),
    by_parser(ACCURACY, "a gap in the tolerances", "--tolerances", "1e-4,,1e-6", "found '1e-4,,1e-6'"),
    by_parser(ACCURACY, "a tolerance of one", "--tolerances", "1e-4,1", "expected numbers from 1e-13 to 0.1"),
    by_parser(ACCURACY, "an order of zero", "--orders", "0,1", "expected numbers from 1 to 4"),
    by_parser(ACCURACY, "half an order", "--orders", "1.5", "found '1.5'"),
    by_parser(ACCURACY, "a grid of four points", "--grids", "4", "expected numbers from 5 to 1000000"),
    by_parser(ACCURACY, "a grid and none", "--grids", "none,50", "found 'none,50'"),
    by_parser(ACCURACY, "no samples", "--samples", "0", "expected a number from 1 to 1000000"),
    by_parser(ACCURACY, "samples in words", "--samples", "many", "many"),
    by_parser(ACCURACY, "no repetitions", "--repeat", "0", "expected a number from 1 to 1000"),
    by_parser(ACCURACY, "repetitions without end", "--repeat", "1001", "expected a number from 1 to 1000"),
    row("accuracy with two faults", [*ACCURACY, "--orders", "7", "--repeat", "0"], "--orders: ", "--repeat: "),
    *outputs(["accuracy", "scene.toml", "--tolerances", "1e-4", "--orders", "2", "--grids", "none", "--samples", "1",
              "--repeat", "1"], "work-precision study"),
]

REPORTS = [
    row("report of nothing", ["report", "-o", "new.html"], "FILE"),
    row("report to a picture", [*REPORT, "-o", "new.png"], "new.png: a report is a page in HTML", "ends in .html"),
    row("report of a file that is missing among good ones", [*REPORT, "none.h5", "-o", "new.html"], "none.h5: no such file"),
    row("report of a scene among good files", [*REPORT, "scene.toml", "-o", "new.html"], "scene.toml: is a scene, no result"),
    row("report to its own input", [*REPORT, "-o", "loci.h5"], "loci.h5: exists already"),
    row("report as csv", [*REPORT, "-o", "new.html", "--csv"], "--csv"),
    *outputs(REPORT, "report of eigentrail"),
]

OTHERS = [
    row("new scene without a name", ["new"], "SCENE"),
    row("new scene of an empty name", ["new", ""], "--output"),
    row("new scene over an old one", ["new", "scene.toml"], "scene.toml: exists already, and a scene is never replaced"),
    row("new scene in an absent folder", ["new", "none/new.toml"], "none/new.toml: the folder none does not exist"),
    row("new scene over a folder", ["new", "folder"], "folder: exists already"),
    row("new scene from an unknown starter", ["new", "new.toml", "--starter", "blades"],
        "--starter: there is none called 'blades'",
        "did you mean 'blade'?"),
    row("new scene by force", ["new", "scene.toml", "--force"], "--force"),
    row("new scene of a name too long", ["new", "x" * 300], "x" * 300, "cannot be created"),
    row("reference of an unknown table", ["reference", "sprin"], "no table of a scene is called 'sprin'",
        "did you mean 'spring'?"),
    row("reference of an unknown table among known ones", ["reference", "spring", "glue"],
        "no table of a scene is called 'glue'"),
    row("reference in another format", ["reference", "--html"], "--html"),
]

ROWS = GENERAL + RESUMED + TRACES + EXPLANATIONS + EVALUATIONS + BOUNDARIES + MAPS + STUDIES + REPORTS + OTHERS
