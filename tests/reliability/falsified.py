"""Falsifies loci files in many ways; `verify` must refuse each one and pass those that are as they were traced.

    falsified.py [--falsified 200] [--correct 200] [--seed 1] [SCENE ...]

EIGENTRAIL names the program. Without scenes: those of data/scenes and of the command line's tests, at several
tolerances and in both directions.
"""

import argparse
import itertools
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from program import BIRTH, BLADE, CROSSING, CROSSING_WITHIN, FAMILY, PUSHED_PENDULUM  # noqa: E402

PROGRAM = os.environ["EIGENTRAIL"]
SCENES = pathlib.Path(os.environ["EIGENTRAIL_DATA"]) / "scenes"

TEXTS = {"birth": BIRTH, "blade": BLADE, "crossing": CROSSING, "crossing_within": CROSSING_WITHIN, "family": FAMILY,
         "fold": PUSHED_PENDULUM}


class NotApplicable(Exception):
    """The file has nothing of the kind."""


def some(chance, choices):
    choices = list(choices)
    if not choices:
        raise NotApplicable
    return chance.choice(choices)


def parameter(file):
    return file[file.attrs["parameter"]]


def existing(file):
    """Places (point, mode) with a finite eigenvalue that is not zero."""
    s = file["eigenvalue"][()]
    finite = np.isfinite(s)
    return [tuple(place) for place in np.argwhere(finite & (np.abs(s) > 1e-6 * np.abs(s[finite]).max(initial=0.0)))]


def change(file, name, place, new):
    data = file[name][()]
    old = data[place]
    data[place] = new(old)
    if np.array_equal(data[place], old, equal_nan=True):
        raise NotApplicable
    file[name][...] = data


def resize(dataset, count):
    if dataset.chunks is None:
        raise NotApplicable
    dataset.resize(count, axis=0)


def dimensions(dataset):
    """Names of the dimension scales of a dataset, "" where there is none."""
    return [next((scale.name for scale in dim.values()), "") for dim in getattr(dataset, "dims", [])]


def event_datasets(file):
    return [name for name in file if name == "event" or name == "events" or name.startswith("event_")]


def keep_events(file, kept):
    for name in event_datasets(file):
        data = file[name][()][kept]
        resize(file[name], len(kept))
        file[name][...] = data


def an_event(chance, file):
    return some(chance, range(len(file["events"])))


def write_event_line(file, event, place):
    kind, _, *others = file["events"][event].decode().split(",")
    file["events"][event] = ",".join([kind, repr(float(place)), *others])


def two_modes(chance, file):
    """Two modes with different eigenvalues at a point where both exist."""
    s = file["eigenvalue"][()]
    return some(chance, [(i, a, b) for i in range(len(s)) for a, b in itertools.combinations(range(s.shape[1]), 2)
                         if np.isfinite(s[i, [a, b]]).all() and abs(s[i, a] - s[i, b]) > 1e-3 * abs(s[i, a])])


# The kinds: functions of the random numbers and the open file.

def eigenvalues_too_large(chance, file):
    file["eigenvalue"][...] = 1.5 * file["eigenvalue"][()]


def one_eigenvalue_off(chance, file):
    change(file, "eigenvalue", some(chance, existing(file)), lambda s: s * (1 + 1e-4))


def eigenvalue_nan(chance, file):
    change(file, "eigenvalue", some(chance, existing(file)), lambda s: complex("nan"))


def parameter_nan(chance, file):
    change(file, file.attrs["parameter"], chance.randrange(len(parameter(file))), lambda p: float("nan"))


def parameter_reversed(chance, file):
    parameter(file)[...] = parameter(file)[()][::-1]


def parameter_constant(chance, file):
    parameter(file)[...] = parameter(file)[0]


def parameter_turned_back(chance, file):
    values = parameter(file)
    if len(values) < 3:
        raise NotApplicable
    values[1] = 1.5 * values[2] - 0.5 * values[0]


def all_constant(chance, file):
    """The parameter, also in the steps."""
    parameter(file)[...] = parameter(file)[0]
    series = file["step_parameter"][()]
    series[:, :, 0] = parameter(file)[0]
    file["step_parameter"][...] = series


def event_deleted(chance, file):
    event = an_event(chance, file)
    keep_events(file, [i for i in range(len(file["events"])) if i != event])


def event_invented(chance, file):
    """A copy of one, elsewhere on its step."""
    event = an_event(chance, file)
    count = len(file["events"])
    for name in event_datasets(file):
        data = file[name][()]
        resize(file[name], count + 1)
        file[name][...] = np.concatenate([data, data[event:event + 1]])
    node = max(file["event_node"][event], 1)
    p = parameter(file)[()]
    place = 0.5 * (p[node] + p[node - 1])
    if abs(place - file["event_parameter"][event]) < 1e-3 * np.ptp(p):
        place += 0.2 * (p[node] - p[node - 1])
    file["event_parameter"][count] = place
    write_event_line(file, count, place)


def event_moved(chance, file):
    event = an_event(chance, file)
    p = parameter(file)[()]
    node = max(file["event_node"][event], 1)
    place = file["event_parameter"][event]
    other = p[node] if abs(p[node] - place) > abs(p[node - 1] - place) else p[node - 1]
    place += 0.1 * (other - place)
    file["event_parameter"][event] = place
    write_event_line(file, event, place)


def event_of_another_mode(chance, file):
    event = an_event(chance, file)
    line = file["events"][event].decode()
    modes = line.rpartition(",")[2].split(";")
    others = [str(i + 1) for i in range(len(file["mode"])) if str(i + 1) not in modes]
    if modes == [""]:
        raise NotApplicable
    file["events"][event] = line.rpartition(",")[0] + "," + ";".join([some(chance, others), *modes[1:]])


def event_turned(chance, file):
    change(file, "event_direction", some(chance, np.flatnonzero(file["event_direction"][()])), lambda d: -d)


def event_eigenvalue_off(chance, file):
    change(file, "event_eigenvalue", some(chance, np.flatnonzero(file["event_eigenvalue"][()])), lambda s: 1.01 * s)


def event_of_another_kind(chance, file):
    event = an_event(chance, file)
    kind, rest = file["events"][event].decode().split(",", 1)
    file["events"][event] = ("divergence" if kind != "divergence" else "crossing") + "," + rest


def labels_exchanged_at_a_point(chance, file):
    i, a, b = two_modes(chance, file)
    for name in ("eigenvalue", "eigenvalue_derivative", "mode_shape", "frequency", "damped_frequency", "damping_ratio"):
        data = file[name][()]
        data[i, [a, b]] = data[i, [b, a]]
        file[name][...] = data


def labels_exchanged_between_two_points(chance, file):
    """In all that has modes, dense output too."""
    i, a, b = two_modes(chance, file)
    last = chance.randint(i, len(file["eigenvalue"]) - 1)
    rows_of = {"/node": slice(i, last + 1), "/step": slice(i, last)}
    for dataset in file.values():
        along = dimensions(dataset)
        if along[1:2] != ["/mode"] or along[0] not in rows_of:
            continue
        rows = rows_of[along[0]]
        data = dataset[()]
        part = data[rows]
        part[:, [a, b]] = part[:, [b, a]]
        dataset[...] = data
    if i == 0 and last == len(file["eigenvalue"]) - 1:
        raise NotApplicable


def shape_altered(chance, file):
    i, mode = some(chance, existing(file))
    shape = file["mode_shape"][i, mode]
    change(file, "mode_shape", (i, mode, int(np.argmax(np.abs(shape)))), lambda v: 1.1 * v)


def shapes_exchanged(chance, file):
    i, a, b = two_modes(chance, file)
    data = file["mode_shape"][()]
    if abs(np.vdot(data[i, a], data[i, b])) > 0.999 * np.linalg.norm(data[i, a]) * np.linalg.norm(data[i, b]):
        raise NotApplicable
    data[i, [a, b]] = data[i, [b, a]]
    file["mode_shape"][...] = data


def equilibrium_altered(chance, file):
    x = file["equilibrium"][()]
    change(file, "equilibrium", some(chance, [tuple(at) for at in np.argwhere(x != 0)]), lambda value: 1.02 * value)


def multiplier_altered(chance, file):
    if "multiplier" not in file:
        raise NotApplicable
    force = file["multiplier"][()]
    change(file, "multiplier", some(chance, [tuple(at) for at in np.argwhere(force != 0)]), lambda value: 1.02 * value)


def range_moved(chance, file):
    place = some(chance, range(len(file["stable_from"])))
    shift = 0.01 * np.ptp(parameter(file)[()])
    change(file, chance.choice(["stable_from", "stable_to"]), place, lambda p: p + shift)


def range_of_another_kind(chance, file):
    place = some(chance, range(len(file["stable_kind"])))
    file["stable_kind"][place] = "marginal" if file["stable_kind"][place] == b"stable" else "stable"


def range_invented(chance, file):
    p = parameter(file)[()]
    if len(file["stable_kind"]) == 1 and file["stable_from"][0] == p[0] and file["stable_to"][0] == p[-1]:
        raise NotApplicable
    for name in file:
        if name == "range" or name.startswith("stable_"):
            resize(file[name], 1)
    file["stable_from"][0], file["stable_to"][0] = p[0], p[-1]
    file["stable_kind"][0] = "stable"


def derived_column_altered(chance, file):
    change(file, chance.choice(["frequency", "damped_frequency", "damping_ratio"]), some(chance, existing(file)),
           lambda value: value * 1.001)


def derivative_altered(chance, file):
    change(file, "eigenvalue_derivative", some(chance, existing(file)), lambda slope: slope * 1.01)


def condition_altered(chance, file):
    change(file, chance.choice(["condition", "residual"]), some(chance, existing(file)), lambda value: 2 * value)


def certified_invented(chance, file):
    change(file, "certified", some(chance, [tuple(at) for at in np.argwhere(file["certified"][()] >= 0)]), lambda c: 1 - c)


def dense_output_altered(chance, file):
    series = file["dense_output"][()]
    largest = np.nanmax(np.abs(series))
    change(file, "dense_output", some(chance, [tuple(at) for at in np.argwhere(np.abs(series) > 1e-3 * largest)]),
           lambda value: 1.01 * value)


def dataset_missing(chance, file):
    del file[some(chance, [name for name in file if name not in ("complex128", file.attrs["parameter"])])]


def last_point_missing(chance, file):
    if len(file["node"]) < 3:
        raise NotApplicable
    for dataset in file.values():
        if dimensions(dataset)[:1] in (["/node"], ["/step"]):
            resize(dataset, len(dataset) - 1)
    for name in ("node", "step"):
        resize(file[name], len(file[name]) - 1)


def mode_deleted(chance, file):
    """All of it is as of a mode that does not exist."""
    mode = chance.randrange(len(file["mode"]))
    for dataset in file.values():
        if dimensions(dataset)[:2] in (["/node", "/mode"], ["/step", "/mode"]):
            dataset[:, mode] = -1 if dataset.dtype.kind == "i" else np.nan


def scaled_in_all_datasets(chance, file):
    for name in ("eigenvalue", "dense_output", "frequency", "damped_frequency", "eigenvalue_derivative"):
        file[name][...] = file[name][()] * (1 + 1e-3)


def tolerance_altered(chance, file):
    file.attrs["tolerance"] = 0.1 * file.attrs["tolerance"]


def names_exchanged(chance, file):
    if "mode_name" not in file:
        raise NotApplicable
    names = file["mode_name"][()]
    a, b = some(chance, [pair for pair in itertools.combinations(range(len(names)), 2) if names[pair[0]] != names[pair[1]]])
    names[[a, b]] = names[[b, a]]
    file["mode_name"][...] = names


KINDS = [eigenvalues_too_large, one_eigenvalue_off, eigenvalue_nan, parameter_nan, parameter_reversed, parameter_constant,
         parameter_turned_back, all_constant, event_deleted, event_invented, event_moved, event_of_another_mode, event_turned,
         event_eigenvalue_off, event_of_another_kind, labels_exchanged_at_a_point, labels_exchanged_between_two_points,
         shape_altered, shapes_exchanged, equilibrium_altered, multiplier_altered, range_moved, range_of_another_kind,
         range_invented, derived_column_altered, derivative_altered, condition_altered, certified_invented,
         dense_output_altered, dataset_missing, last_point_missing, mode_deleted, scaled_in_all_datasets, tolerance_altered,
         names_exchanged]


def traces(scenes):
    """Names, scenes and options of traces, the plain ones first."""
    ways = [[], ["--tolerance", "1e-4"], ["--order", "2"], ["--tolerance", "1e-10"], ["--no-certify"], ["--max-nodes", "6"]]
    for options in ways:
        for scene in scenes:
            yield scene, options


class Files:
    """Traced files in a folder of their own."""

    def __init__(self, folder):
        self.folder = folder
        self.count = 0

    def run(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False)

    def trace(self, scene, options):
        """The file of a trace; None if the trace has no first point."""
        path = self.folder / f"{self.count}.h5"
        self.count += 1
        name = pathlib.Path(scene).stem
        if scene in TEXTS:
            scene = self.folder / f"{scene}.toml"
            scene.write_text(TEXTS[name], encoding="utf-8")
        self.run("trace", scene, "-o", path, "--quiet", *options)
        return path if path.exists() else None

    def falsified(self, path, kind, chance):
        """A copy that is falsified; None if the file has nothing of the kind."""
        copy = self.folder / "falsified.h5"
        shutil.copy(path, copy)
        try:
            with h5py.File(copy, "r+") as file:
                kind(chance, file)
        except NotApplicable:
            return None
        return copy


def check_correct(files, path):
    """The complaint about a correct file; empty if it passes."""
    run = files.run("verify", path)
    return "" if run.returncode == 0 else run.stderr or "no message"


def check_falsified(files, path):
    """What is wrong with how a falsified file is refused; empty if nothing is, and the message."""
    run = files.run("verify", path)
    lines = run.stderr.splitlines()
    if run.returncode not in (1, 2):
        return f"exit code {run.returncode}", run.stdout
    says = run.returncode == 2 and len(lines) == 1 or run.returncode == 1 and len(lines) > 1
    return ("" if says and "Error" not in run.stderr else "does not say what is wrong"), run.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--falsified", type=int, default=200)
    parser.add_argument("--correct", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args()
    given = [pathlib.Path(scene).resolve() for scene in arguments.scenes]
    scenes = given or [*sorted(TEXTS), *sorted(SCENES.glob("*.toml"))]
    chance = random.Random(arguments.seed)
    files = Files(pathlib.Path(tempfile.mkdtemp(prefix="eigentrail-falsified-")))
    wrong = correct = falsified = 0
    try:
        kinds = itertools.cycle(KINDS)
        for scene, options in traces(scenes):
            path = files.trace(scene, options)
            if path is None:
                continue
            if correct < arguments.correct:
                correct += 1
                complaint = check_correct(files, path)
                if complaint:
                    wrong += 1
                    print(f"correct file refused: {scene} {' '.join(options)}\n{complaint}", flush=True)
            per_file = -(-arguments.falsified // max(arguments.correct, 1)) if arguments.correct else len(KINDS)
            for _ in range(len(KINDS)):
                if falsified >= arguments.falsified or per_file == 0:
                    break
                kind = next(kinds)
                copy = files.falsified(path, kind, chance)
                if copy is None:
                    continue
                falsified += 1
                per_file -= 1
                complaint, message = check_falsified(files, copy)
                if complaint or arguments.verbose:
                    print(f"{kind.__name__}: {complaint or 'refused'}: {scene} {' '.join(options)}\n{message}", flush=True)
                wrong += bool(complaint)
            if correct >= arguments.correct and falsified >= arguments.falsified:
                break
    finally:
        shutil.rmtree(files.folder)
    print(f"{falsified} falsified files of {len(KINDS)} kinds and {correct} correct ones: {wrong} judged wrongly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
