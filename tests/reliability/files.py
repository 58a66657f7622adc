"""Result files that are damaged, or of another kind than a command reads."""

import functools
import os
import pathlib
import shutil
import subprocess
import tempfile

import h5py
import numpy as np

from program import PROGRAM, SCENES, datasets

ZIEGLER = SCENES / "ziegler_column.toml"
BLADE = SCENES / "rotating_mass.toml"

# What makes a good file of each kind.
MAKERS = {
    "loci.h5": ("trace", "scene.toml", "--tolerance", "1e-4", "--quiet"),
    "boundary.h5": ("boundary", "column.toml", "--second", "damping", "--second-from", 0.01, "--second-to", 1, "--lines", 1, "--quiet"),
    "map.h5": ("map", "column.toml", "--second", "damping", "--second-from", 0.01, "--second-to", 1, "--grid", "3x4", "--quiet"),
    "study.h5": ("accuracy", "column.toml", "--tolerances", "1e-4", "--orders", 2, "--grids", 5, "--samples", 5, "--repeat",
                 1,
                 "--quiet"),
    "page.html": ("report", "map.h5", "--quiet"),
}


def make_files(names=tuple(MAKERS)):
    """A folder with good files of every kind, and the scenes that they are made from."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="eigentrail-"))
    shutil.copy(ZIEGLER, folder / "column.toml")
    shutil.copy(BLADE, folder / "scene.toml")
    for name in names:
        subprocess.run([PROGRAM, *map(str, MAKERS[name]), "-o", name], cwd=folder, check=True)
    (folder / "folder").mkdir()
    return folder


# Commands with the file that they are given.
def evaluate(name):
    return ["eval", name, "--at", "50"]


def events(name):
    return ["events", name, "--csv"]


def info(name):
    return ["info", name]


def verify(name):
    return ["verify", name, "--samples", "3"]


def report(name):
    return ["report", name, "-o", "new.html"]


def resume(name):
    return ["trace", "scene.toml", "--tolerance", "1e-4", "-o", name, "--resume"]


READERS = [evaluate, events, info, verify]  # of loci only
ALL = [*READERS, report]


# Damage: functions of the path.

def cut(size):
    """Truncates the file to its first `size` bytes, or to this fraction of it if `size` is below one."""
    def damage(path):
        whole = path.read_bytes()
        path.write_bytes(whole[:int(size * len(whole)) if 0 < size < 1 else size])
    return damage


def bytes_at(offset, new):
    def damage(path):
        whole = bytearray(path.read_bytes())
        whole[offset:offset + len(new)] = new
        path.write_bytes(whole)
    return damage


def content(data):
    return lambda path: path.write_bytes(data)


def inside(change):
    """What changes the open HDF5 file."""
    def damage(path):
        with h5py.File(path, "r+") as file:
            change(file)
    return damage


def replace(file, name, data):
    """Another dataset by the same name, with the attributes of the first."""
    attributes = {key: value for key, value in file[name].attrs.items() if key in ("units", "long_name")}
    del file[name]
    file[name] = data
    file[name].attrs.update(attributes)


def without(name):
    return inside(lambda file: file.pop(name))


def attribute(name, value):
    """Another value of an attribute of the file; None takes it away."""
    def change(file):
        del file.attrs[name]
        if value is not None:
            file.attrs[name] = value
    return inside(change)


def dataset(name, of):
    """Another dataset: a function of the numbers that are there."""
    return inside(lambda file: replace(file, name, of(file[name][()])))


def entry(name, at, value):
    def change(file):
        file[name][at] = value
    return inside(change)


def as_group(name):
    def change(file):
        del file[name]
        file.create_group(name)
    return inside(change)


def as_folder(path):
    path.unlink()
    path.mkdir()


def gone(path):
    path.unlink()


def pipe(path):
    path.unlink()
    os.mkfifo(path)


def copied(name):
    return lambda path: shutil.copy(path.parent / name, path)


def other_hdf5(path):
    with h5py.File(path, "w") as file:
        file["numbers"] = [1.0, 2.0]


def loci(name, damage, *fragments, commands=tuple(ALL)):
    return name, "loci.h5", damage, commands, fragments


def inside_loci(name, damage, *fragments):
    """A fault in data that all commands read in the same way; only two of them are tested."""
    return loci(name, damage, *fragments, commands=[evaluate, report])


def reported(name, file, damage, *fragments):
    """A fault in data that only the report reads."""
    return name, file, damage, [report], fragments


FORM = [
    loci("file that is gone", gone, "no such file"),
    loci("file that is a folder", as_folder, "is a folder"),
    loci("file that is a pipe", pipe, "not a plain file"),
    loci("file of no bytes", content(b""), "cannot be read"),
    loci("file of a signature", cut(8), "cannot be read"),
    loci("half a file", cut(0.5), "cannot be read"),
    loci("file without its last byte", lambda path: path.write_bytes(path.read_bytes()[:-1]), "cannot be read"),
    loci("text in place of a file", content(b"omega,mode\n1,2\n"), "cannot be read"),
    loci("page in place of a file", copied("page.html"), "cannot be read"),
    loci("file with another signature", bytes_at(0, b"\x89PNG"), "cannot be read"),
    loci("file whose root lies beyond its end", bytes_at(64, b"\xff" * 7), "cannot be read"),
    loci("HDF5 file of somebody else", other_hdf5, "is an HDF5 file, but no", "eigentrail", commands=READERS),
    reported("HDF5 file of somebody else on a page", "loci.h5", other_hdf5, "is an HDF5 file, but none of eigentrail"),
    loci("boundary in place of loci", copied("boundary.h5"), "holds 'eigentrail-boundary', not loci", commands=READERS),
    loci("map in place of loci", copied("map.h5"), "holds 'eigentrail-map', not loci", commands=READERS),
    loci("study in place of loci", copied("study.h5"), "holds 'eigentrail-accuracy', not loci", commands=READERS),
    reported("half a map", "map.h5", cut(0.5), "cannot be read"),
    reported("map that is gone", "map.h5", gone, "no such file"),
    reported("page on a page", "page.html", lambda path: None, "cannot be read"),
]

ATTRIBUTES = [
    loci("schema of the future", attribute("schema_version", np.int64(2)), "has schema 2, this program reads schema 1"),
    loci("schema of the past", attribute("schema_version", np.int64(0)), "has schema 0, this program reads schema 1"),
    loci("schema as a text", attribute("schema_version", "1"), "schema_version"),
    loci("schema as a list", attribute("schema_version", np.array([1, 1])), "schema_version"),
    loci("no schema", attribute("schema_version", None), "schema_version"),
    loci("format of another program", attribute("format", "loci"), "eigentrail"),
    loci("format as a number", attribute("format", 1), "format"),
    loci("no format", attribute("format", None), "eigentrail"),
    loci("no parameter", attribute("parameter", None), "parameter"),
    loci("parameter as a number", attribute("parameter", 1), "parameter"),
    loci("parameter that is no dataset", attribute("parameter", "torque"), "torque"),
    loci("parameter without a name", attribute("parameter", "")),
    loci("parameter that is the eigenvalues", attribute("parameter", "eigenvalue"), "eigenvalue"),
    loci("unit as a number", inside(lambda file: file["omega"].attrs.create("units", 1.0)), "units"),
    loci("no scene", attribute("scene", None), "scene", commands=[verify]),
    loci("scene that is no scene", attribute("scene", "mass = ["), "not valid TOML", commands=[verify]),
    loci("scene of another parameter", attribute("scene", ZIEGLER.read_text()), "omega", commands=[verify]),
    loci("reference as a text", attribute("reference", "small"), "reference", commands=[verify]),
    loci("option that no trace takes", attribute("option_order", "9"), "order: must lie between 1 and 4", commands=[verify]),
    loci("option of another program", inside(lambda file: file.attrs.create("option_colour", "red")), "colour",
         commands=[verify]),
    loci("branch in words", attribute("option_branch", "left"), "branch", commands=[verify]),
    reported("boundary of the future", "boundary.h5", attribute("schema_version", np.int64(9)), "has schema 9"),
    reported("map of the future", "map.h5", attribute("schema_version", np.int64(9)), "has schema 9"),
    reported("study of the future", "study.h5", attribute("schema_version", np.int64(9)), "has schema 9"),
    reported("map without its second parameter", "map.h5", attribute("second_parameter", None), "second_parameter"),
    reported("boundary without its window", "boundary.h5", attribute("second_from", None), "second_from"),
    reported("boundary whose window is a text", "boundary.h5", attribute("second_to", "one"), "second_to"),
    reported("map of a format of the future", "map.h5", attribute("format", "eigentrail-chart"), "eigentrail-chart"),
]

SHAPES = [
    inside_loci("one point less", dataset("omega", lambda p: p[:-1])),
    inside_loci("one eigenvalue less", dataset("eigenvalue", lambda s: s[:-1]), "eigenvalue"),
    inside_loci("one mode less", dataset("eigenvalue", lambda s: s[:, :1]), "eigenvalue"),
    inside_loci("eigenvalues in a row", dataset("eigenvalue", lambda s: s.ravel()), "eigenvalue"),
    inside_loci("parameters in a table", dataset("omega", lambda p: p.reshape(-1, 1)), "omega"),
    inside_loci("one step less", dataset("dense_output", lambda d: d[:-1]), "dense_output"),
    inside_loci("dense output of one end", dataset("dense_output", lambda d: d[:, :, :1]), "dense_output"),
    inside_loci("dense output of order zero", dataset("dense_output", lambda d: d[..., :1]), "dense_output"),
    inside_loci("dense output of three dimensions", dataset("dense_output", lambda d: d[..., 0]), "dense_output"),
    inside_loci("dense output of order twenty", dataset("dense_output", lambda d: np.resize(d, (*d.shape[:3], 21))),
                "dense_output"),
    inside_loci("one length less", dataset("step_length", lambda h: h[:-1]), "step_length"),
    inside_loci("one length more", dataset("step_length", lambda h: np.append(h, 1.0)), "step_length"),
    inside_loci("parameter of a step in one number", dataset("step_parameter", lambda p: p[:, 0, 0]), "step_parameter"),
    inside_loci("one block less", dataset("dense_block", lambda b: b[:-1]), "dense_block"),
    inside_loci("charts of one function", dataset("dense_chart", lambda c: c[:, :1]), "dense_chart"),
    inside_loci("blocks of one mode", dataset("mode_block", lambda b: b[:, :1]), "mode_block"),
    inside_loci("certificate of one step", dataset("certified", lambda c: c[:1]), "certified"),
    inside_loci("one event less", dataset("event_parameter", lambda p: p[:-1]), "events"),
    inside_loci("one direction less", dataset("event_direction", lambda d: d[:-1]), "events"),
    inside_loci("shapes of events of one coordinate", dataset("event_shape", lambda x: x[:, :1]), "event_shape"),
    inside_loci("shifts of events by one parameter", dataset("event_shift", lambda x: x[:, :1]), "event_shift"),
    inside_loci("sensitivities of events to one parameter", dataset("event_sensitivity", lambda x: x[:, :1]),
                "event_sensitivity"),
    inside_loci("equilibria of one coordinate", dataset("equilibrium", lambda x: x[:, :1]), "equilibrium"),
    inside_loci("multipliers of one point", dataset("multiplier", lambda x: x[:1]), "multiplier"),
    inside_loci("residuals of one point", dataset("residual", lambda r: r[:1]), "residual"),
    inside_loci("conditions of one mode", dataset("condition", lambda c: c[:, :1]), "condition"),
    inside_loci("one name of a mode less", dataset("mode_name", lambda n: n[:-1]), "mode_name"),
    inside_loci("ends of ranges in a row", dataset("stable_margin", lambda m: m.ravel()), "stable_margin"),
    inside_loci("one range more", dataset("stable_from", lambda p: np.append(p, 1.0)), "stable_from"),
    inside_loci("ranges without dimensions", dataset("range", lambda _: 1), "stable_"),
    reported("shapes of one mode", "loci.h5", dataset("mode_shape", lambda x: x[:, :1]), "mode_shape"),
    reported("shapes of one point", "loci.h5", dataset("mode_shape", lambda x: x[:1]), "mode_shape"),
    reported("margins of a map in another shape", "map.h5", dataset("margin", lambda m: m[:, :1]), "margin"),
    reported("counts of a map for one line", "map.h5", dataset("unstable", lambda n: n[:1]), "unstable"),
    reported("damping ratios of a map for one line", "map.h5", dataset("damping_ratio", lambda z: z[:1]), "damping_ratio"),
    reported("places of a map without their lines", "map.h5", dataset("axis_line", lambda n: n[:-1]), "axis_"),
    reported("dense output of a boundary for one function", "boundary.h5", dataset("dense_output", lambda d: d[:, :1]),
             "dense_output"),
    reported("lengths of a boundary for one step", "boundary.h5", dataset("step_length", lambda h: h[:1]), "dense_output"),
    reported("extents of a boundary in a row too short", "boundary.h5", dataset("curve_extent", lambda e: e.ravel()[:3]),
             "curve"),
    reported("names of curves missing", "boundary.h5", dataset("curve_kind", lambda k: k[:0]), "curve"),
    reported("errors of a study for one run", "study.h5", dataset("error", lambda e: e[:1]), "error"),
    reported("methods of a study for one run", "study.h5", dataset("method", lambda m: m[:1]),
             "does not fit the other datasets"),
]

NUMBERS = [
    inside_loci("parameters as texts", dataset("omega", lambda p: p.astype("S")), "omega"),
    inside_loci("eigenvalues as real numbers", dataset("eigenvalue", np.real), "eigenvalue"),
    inside_loci("eigenvalues as texts", dataset("eigenvalue", lambda s: s.astype("S")), "eigenvalue"),
    inside_loci("lengths as complex numbers", dataset("step_length", lambda h: h.astype(complex)), "step_length"),
    inside_loci("names of modes as numbers", dataset("mode", lambda m: np.arange(len(m))), "mode"),
    inside_loci("coordinates as numbers", dataset("coordinate", lambda c: np.arange(len(c))), "coordinate"),
    inside_loci("events as numbers", dataset("events", lambda e: np.arange(len(e))), "events"),
    inside_loci("blocks as texts", dataset("dense_block", lambda b: b.astype("S")), "dense_block"),
    inside_loci("group in place of eigenvalues", as_group("eigenvalue"), "eigenvalue"),
    inside_loci("group in place of the parameter", as_group("omega"), "omega"),
    inside_loci("nan in the dense output", entry("dense_output", (0, 0, 0, 0), np.nan), "dense_output"),
    inside_loci("infinity in the dense output", entry("dense_output", (1, 1, 1, 1), np.inf), "dense_output"),
    inside_loci("nan among the parameters", entry("omega", 3, np.nan), "omega"),
    inside_loci("nan among the lengths", entry("step_length", 3, np.nan), "step_length"),
    inside_loci("nan in the parameter of a step", entry("step_parameter", (3, 0, 0), np.nan), "step_parameter"),
    inside_loci("mode in a block that does not exist", entry("mode_block", (0, 0), 99), "mode_block"),
    inside_loci("mode in a negative block", entry("mode_block", (0, 0), -7), "mode_block"),
    inside_loci("mode in a block without functions", entry("mode_block", (0, slice(None)), 0), "dense_"),
    inside_loci("direction of an event that is none", entry("event_direction", 0, 5), "event_direction"),
    inside_loci("event without its commas", dataset("events", lambda e: np.array([b"flutter"] * len(e), dtype=object)),
                "events"),
    inside_loci("range of a mode that does not exist", entry("stable_mode", (0, 0), 99), "stable_mode"),
]

STATES = [
    ("resumption of a text", "loci.h5", content(b"x"), [resume], ["is no readable loci file"]),
    ("resumption of half a file", "loci.h5", cut(0.5), [resume], ["is no readable loci file"]),
    ("resumption of a folder", "loci.h5", as_folder, [resume], ["is a folder"]),
    ("resumption of a map", "map.h5", lambda path: None, [resume], ["is no readable loci file"]),
    ("resumption of a file of no bytes", "loci.h5", content(b""), [resume], ["is no readable loci file"]),
    ("resumption of a state that is not there", "loci.h5", attribute("status", "interrupted"), [resume],
     ["cannot be resumed", "holds no state", "--force"]),
    ("resumption without a version", "loci.h5", attribute("program_version", None), [resume], ["program_version"]),
    ("resumption without a status", "loci.h5", attribute("status", None), [resume], ["status"]),
    ("resumption without an option", "loci.h5", attribute("option_order", None), [resume], ["option_order"]),
    ("resumption of a schema of the future", "loci.h5", attribute("schema_version", np.int64(2)), [resume], ["has schema 2"]),
    ("resumption of a damaged file", "loci.h5", dataset("dense_output", lambda d: d[:-1]), [resume], ["dense_output"]),
]

ROWS = FORM + ATTRIBUTES + SHAPES + NUMBERS + STATES

# Datasets that no command but the report, or none at all, needs.
NOT_READ = {"frequency", "damped_frequency", "damping_ratio", "eigenvalue_derivative", "coordinate_unit", "kinetic_energy_share", "motion",
            "scene_parameter_unit", "node", "step", "function", "end", "order", "event", "mode_name", "constraint",
            "stable_from"}
# Datasets that files of earlier versions do not have.
NOT_READ |= {"rounding", "growing_unfollowed", "stable_whole"}
FOR_PAGES = {"event_node", "mode_shape"}


@functools.cache
def names_of_datasets():
    folder = make_files(["loci.h5"])
    with h5py.File(folder / "loci.h5") as file:
        names = sorted(datasets(file))
    shutil.rmtree(folder)
    return names


EACH_DATASET = [loci(f"file without {name}", without(name), name, commands=[report] if name in FOR_PAGES else [info, report])
                for name in names_of_datasets() if name not in NOT_READ]
