"""Lets calls of the system fail, one after the other, in a trace, a resumed trace, imports and an export.

    faults.py LIBRARY [--calls 1000] [--only trace,allocate]

LIBRARY is that of faults.cpp, EIGENTRAIL names the program. Of each kind of call at most `--calls` fail, once or from then on: the
first ones, the last ones, and some between them. Whatever fails, the command ends with exit code 0, 1 or 2 and a message, its files
are whole or not there, and a trace can be gone on with.
"""

import argparse
import collections
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import numpy as np
import scipy.io

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from loci_comparison import differences  # noqa: E402
from program import FAMILY, PROGRAM, TIME_LIMIT  # noqa: E402

CALLS = ("allocate", "open", "write", "sync", "rename", "truncate", "map", "lock")
TRACE = ["trace", "scene.toml", "-o", "out.h5", "--quiet", "--threads", "1", "--save-every", "0", "--tolerance", "1e-3"]


class Command:
    """A command, the files that it needs, and what it writes where nothing fails."""

    def __init__(self, name, folder, inputs, arguments):
        self.name, self.inputs, self.arguments = name, inputs, arguments
        self.folder = folder / name
        self.reset()
        run = self.run({})
        assert (run.returncode, run.stderr) == (0, ""), (name, run)
        self.whole = folder / f"{name}-whole"
        shutil.copytree(self.folder, self.whole)

    def reset(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()
        for path, content in self.inputs.items():
            (self.folder / path).write_bytes(content)

    def run(self, variables, *options):
        return subprocess.run([PROGRAM, *self.arguments, *options], cwd=self.folder, env={**os.environ, **variables},
                              capture_output=True, text=True, check=False, timeout=TIME_LIMIT)

    def check(self):
        """Files are whole, or not there, or still what they were."""
        for path in self.folder.rglob("*"):
            if path.is_file() and path.suffix not in (".partial", ".lock") and path.name not in self.inputs:
                wanted = self.whole / path.relative_to(self.folder)
                assert path.suffix == ".h5" and "trace" in self.arguments or path.read_bytes() == wanted.read_bytes(), path

    def go_on(self):
        """After the fault is gone, the command succeeds; a trace goes on."""
        options = ["--resume"] if "trace" in self.arguments and "--resume" not in self.arguments else []
        if "trace" not in self.arguments:
            options = ["--force"]
        run = self.run({}, *options)
        assert (run.returncode, run.stderr) == (0, ""), run
        self.check_done()

    def check_done(self):
        written = {path.relative_to(self.folder) for path in self.folder.rglob("*")}
        wanted = {path.relative_to(self.whole) for path in self.whole.rglob("*")}
        assert written == wanted, written ^ wanted
        if "trace" in self.arguments:
            assert not (found := differences(self.folder / "out.h5", self.whole / "out.h5")), found


def commands(folder, library):
    scene = {"scene.toml": FAMILY.encode()}
    trace = Command("trace", folder, scene, TRACE)
    yield trace
    # A trace that was cut off: its last save failed.
    trace.reset()
    trace.run({"LD_PRELOAD": library, "FAULT_CALL": "rename", "FAULT_AT": "2"})
    cut_off = (trace.folder / "out.h5").read_bytes()
    yield Command("resume", folder, scene | {"out.h5": cut_off}, [*TRACE, "--resume"])
    yield Command("export", folder, {"loci.h5": (trace.whole / "out.h5").read_bytes()}, ["export", "loci.h5", "-o", "tables", "--csv", "-q"])
    matrices = {"M": np.eye(3), "K": np.diag([1.0, 2.0, 3.0])}
    np.savez(folder / "model.npz", **matrices)
    scipy.io.savemat(folder / "model.mat", matrices)
    for form, name in (("numpy", "model.npz"), ("matlab", "model.mat")):
        yield Command(form, folder, {name: (folder / name).read_bytes()}, ["import", form, name, "-o", "new"])


def chosen(count, most, chance):
    """Numbers of calls, from 1."""
    if count <= most:
        return range(1, count + 1)
    ends = {*range(1, most // 4 + 1), *range(count - most // 4 + 1, count + 1)}
    return sorted(ends | set(chance.sample(range(1, count + 1), most - len(ends))))


def try_fault(command, variables, counts):
    command.reset()
    run = command.run(variables)
    counts[run.returncode] += 1
    assert run.returncode in (0, 1, 2), run
    command.check()
    if run.returncode == 0:
        assert run.stderr == "", run
        command.check_done()
        return
    assert run.stderr.startswith("eigentrail: ") and run.stderr.count("\n") == 1, run
    command.go_on()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("library")
    parser.add_argument("--calls", type=int, default=1000)
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    only = set(filter(None, arguments.only.split(",")))
    folder = pathlib.Path(tempfile.mkdtemp(prefix="eigentrail-faults-"))
    failed = 0
    try:
        for command in commands(folder, arguments.library):
            for call in CALLS:
                if only and not only >= {command.name, call} and not only <= {command.name, call}:
                    continue
                variables = {"LD_PRELOAD": arguments.library, "FAULT_CALL": call, "FAULT_AT": "0", "FAULT_COUNT": str(folder / "count")}
                command.reset()
                command.run(variables)
                count, counts = int((folder / "count").read_text()), collections.Counter()
                for at in chosen(count, arguments.calls, chance):
                    for later in ({}, {"FAULT_FROM": "1"}):
                        fault = {"LD_PRELOAD": arguments.library, "FAULT_CALL": call, "FAULT_AT": str(at), **later}
                        try:
                            try_fault(command, fault, counts)
                        except (AssertionError, subprocess.TimeoutExpired) as error:
                            failed += 1
                            print(f"{command.name}: {fault}: {error}", flush=True)
                ends = ", ".join(f"{number} with exit code {code}" for code, number in sorted(counts.items()))
                print(f"{command.name}: {call}: {count} calls; {ends or 'none failed'}", flush=True)
    finally:
        shutil.rmtree(folder)
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
