"""Kills commands at random times, resumes or repeats them, and compares the files bit for bit with uninterrupted ones.

    kills.py [--kills 1000] [--seed 1]        traces, by SIGKILL
    kills.py --commands 60                    each of the other commands that write
    kills.py --full-disk 100                  a file system that fills up, in place of kills (needs to mount, or a
                                              limit on the size of files stands for it)

EIGENTRAIL names the program. Every file of a trace that is left must open and hold a prefix of the whole one; other outputs
are absent or whole.
"""

import argparse
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from loci_comparison import differences  # noqa: E402
from program import BLADE, CURVES, PUSHED_PENDULUM, edited  # noqa: E402

PROGRAM = os.environ["EIGENTRAIL"]
SCENES = pathlib.Path(os.environ["EIGENTRAIL_DATA"]) / "scenes"


def scenes(quick):
    """Traces of several sizes: from a few points to thousands, from one mode to many, with branches and folds. `quick`: those
    of less than a second."""
    yield "short", BLADE, []
    for name, options in (("ground_resonance", []), ("watt_governor", ["--max-step", "0.5"])):
        yield name, (SCENES / f"{name}.toml").read_text(encoding="utf-8"), options
    if quick:
        return
    yield "long", edited(BLADE, "to = 5.0", "to = 5.0\norder = 1\ntolerance = 1e-9\nmax_step = 0.02"), []
    yield "fold", PUSHED_PENDULUM, ["--tolerance", "1e-8", "--max-step", "0.001"]
    for name, options in (("rotating_mass", ["--max-step", "0.05"]), ("princeton_blade", [])):
        yield name, (SCENES / f"{name}.toml").read_text(encoding="utf-8"), options


class Trace:
    """One scene, its whole trace, and how long that takes."""

    def __init__(self, folder, name, text, options):
        self.folder = folder / name
        self.folder.mkdir()
        (self.folder / "scene.toml").write_text(text, encoding="utf-8")
        self.options = options
        begin = time.monotonic()
        self.run("whole.h5", "--save-every", "0.02")
        self.seconds = time.monotonic() - begin
        self.size = (self.folder / "whole.h5").stat().st_size

    def command(self, output, *options):
        return [PROGRAM, "trace", "scene.toml", "-o", output, "--quiet", *self.options, *options]

    def run(self, output, *options):
        run = subprocess.run(self.command(output, *options), cwd=self.folder, capture_output=True, text=True, check=False)
        assert (run.returncode, run.stderr) == (0, ""), (run.args, run.stderr)

    def start(self, output, *options, **settings):
        return subprocess.Popen(self.command(output, *options), cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, **settings)

    def check_readable(self, output):
        """The file holds the first points of the whole one; how many, or none when there is no file yet."""
        path = self.folder / output
        if not path.exists():
            return None
        with h5py.File(path) as file, h5py.File(self.folder / "whole.h5") as whole:
            points = len(file["node"])
            columns = file["eigenvalue"].shape[1]
            found = file["eigenvalue"][()]
            assert found.tobytes() == whole["eigenvalue"][:points, :columns].tobytes(), "no prefix of the whole trace"
            assert len(file["step_length"]) == points - 1
        return points

    def finish(self, output):
        self.run(output, "--resume")
        found = differences(self.folder / output, self.folder / "whole.h5")
        assert not found, found
        (self.folder / output).unlink()


class Counts:
    def __init__(self):
        self.killed = self.too_late = self.before_first_save = self.resumed = 0


def kill_once(trace, chance, counts):
    run = trace.start("out.h5", "--save-every", chance.choice(["0", "0.005", "0.02", "0.1"]))
    time.sleep(chance.random() * 1.1 * trace.seconds)
    run.kill()
    run.communicate()
    counts.killed += run.returncode == -signal.SIGKILL
    counts.too_late += run.returncode == 0
    points = trace.check_readable("out.h5")
    counts.before_first_save += points is None
    # Sometimes the trace that goes on is killed, too.
    while chance.random() < 0.3:
        run = trace.start("out.h5", "--resume", "--save-every", "0.01")
        time.sleep(chance.random() * trace.seconds)
        run.kill()
        run.communicate()
        trace.check_readable("out.h5")
    trace.finish("out.h5")
    counts.resumed += 1


PLANE = ["scene.toml", "--second", "drag", "--second-from", "0.5", "--second-to", "20"]
RESUMED = {  # these go on with what they have computed
    "map": ["map", *PLANE, "--grid", "60x20", "--jobs", "1", "--quiet"],
    "boundary": ["boundary", "plane.toml", "--second", "q", "--second-from", "-1", "--second-to", "1", "--lines", "20", "--quiet"],
    "accuracy": ["accuracy", "scene.toml", "--tolerances", "1e-4,1e-6,1e-8", "--grids", "25,50", "--samples", "20", "--repeat", "1", "--quiet"],
    "sweep": ["sweep", "scene.toml", "--vary", "drag=1:1:12", "--jobs", "2", "--quiet"],
}
REPEATED = {  # these are short
    "import": ["import", "numpy", "matrices.npz"],
    "export": ["export", "loci.h5"],
    "report": ["report", "loci.h5"],
    "plot": ["plot", "loci.h5"],
    "merge": ["merge", "part_1.h5", "part_2.h5", "--quiet"],
}
ENDINGS = {"export": ".csv", "report": ".html", "plot": ".svg", "sweep": "", "import": ""}
MEASURED = {"wall_time"}  # datasets of measured times


def make_inputs(folder):
    (folder / "scene.toml").write_text(BLADE)
    (folder / "plane.toml").write_text(CURVES)
    np.savez(folder / "matrices.npz", M=np.eye(40), K=np.arange(1600.0).reshape(40, 40))
    subprocess.run([PROGRAM, "trace", "scene.toml", "-o", "loci.h5", "--quiet"], cwd=folder, check=True)
    for part in (1, 2):
        subprocess.run([PROGRAM, *RESUMED["map"], "--part", f"{part}/2", "-o", f"part_{part}.h5"], cwd=folder, check=True)


def is_whole(path, whole):
    """Whether an output, a file or a folder, is the whole one but for measured times."""
    if whole.is_dir():
        return sorted(one.name for one in path.iterdir()) == sorted(one.name for one in whole.iterdir()) \
            and all(is_whole(path / one.name, one) for one in whole.iterdir())
    if whole.suffix != ".h5":
        return path.read_bytes() == whole.read_bytes()
    return not set(differences(path, whole)) - MEASURED


def kill_command(folder, name, kills, chance, counts):
    """Kills one command again and again; each time what is left is completed, and compared."""
    begin = time.monotonic()
    command = {**RESUMED, **REPEATED}[name]
    whole, output = (folder / f"{word}_{name}{ENDINGS.get(name, '.h5')}" for word in ("whole", "out"))
    subprocess.run([PROGRAM, *command, "-o", whole.name], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    seconds = time.monotonic() - begin
    present = set(folder.iterdir())
    for _ in range(kills):
        resumed = False
        while True:
            more = ["--resume"] if name in RESUMED and resumed else []
            run = subprocess.Popen([PROGRAM, *command, "-o", output.name, *more], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(chance.random() * 1.1 * seconds)
            run.kill()
            said = run.communicate()[1].decode()
            counts.killed += run.returncode == -signal.SIGKILL
            counts.too_late += run.returncode == 0
            assert run.returncode in (0, -signal.SIGKILL), (run.args, said)
            if ENDINGS.get(name) and output.exists():
                assert is_whole(output, whole), output
            resumed = True
            if name in REPEATED or chance.random() < 0.5:
                break
        done = subprocess.run([PROGRAM, *command, "-o", output.name, *(["--resume"] if name in RESUMED else [])],
                              cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0 or (name in REPEATED and "exists already" in done.stderr), done.stderr
        assert is_whole(output, whole), output
        shutil.rmtree(output) if output.is_dir() else output.unlink()
        for other in set(folder.iterdir()) - present:
            assert other.stem.startswith(output.stem), other
            other.unlink()
        counts.resumed += 1
    print(f"{name}: {seconds:.2f} s", flush=True)


class SmallDisk:
    """A file system of a given size if one can be mounted; otherwise a limit on the size of files."""

    def __init__(self, trace, size):
        self.trace, self.limit = trace, size
        self.place = trace.folder / "disk"
        self.place.mkdir(exist_ok=True)
        self.is_mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", self.place],
                                         capture_output=True, check=False).returncode == 0
        self.output = "disk/out.h5"

    def limit_files(self):
        if not self.is_mounted:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (self.limit, self.limit))

    def make_room(self):
        if self.is_mounted:
            subprocess.run(["mount", "-o", "remount,size=1G", self.place], check=True)

    def close(self):
        if self.is_mounted:
            subprocess.run(["umount", self.place], check=True)


def fill_once(trace, chance, counts):
    """Room for a part of the file and its copy."""
    disk = SmallDisk(trace, int(trace.size * chance.uniform(0.3, 1.7)) // 4096 * 4096 + 65536)
    try:
        run = trace.start(disk.output, "--save-every", "0", preexec_fn=disk.limit_files)
        said = run.communicate(timeout=600)[1]
        if run.returncode == 0:
            counts.too_late += 1
        else:
            assert run.returncode == 1, (run.returncode, said)
            assert re.fullmatch(r"eigentrail: \S+: cannot be written on: .*(No space left on device|File too large); "
                                r"(\d+ points are in \S+; make room, then the same command with --resume goes on"
                                r"|nothing was saved)\n", said), said
            counts.killed += 1
            points = trace.check_readable(disk.output)
            assert points is None or f" {points} points are in " in said, (points, said)
            counts.before_first_save += points is None
        assert {path.name for path in disk.place.iterdir()} <= {"out.h5"}, list(disk.place.iterdir())
        disk.make_room()
        trace.finish(disk.output)
        counts.resumed += 1
    finally:
        disk.close()
    return disk.is_mounted


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--commands", type=int, default=0)
    parser.add_argument("--full-disk", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    counts = Counts()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="eigentrail-kills-"))
    try:
        if arguments.commands:
            make_inputs(folder)
            for name in {**RESUMED, **REPEATED}:
                kill_command(folder, name, arguments.commands, chance, counts)
            print(f"{counts.killed} killed, {counts.too_late} had ended before; {counts.resumed} resumed or repeated and equal bit for bit")
            return
        runs = arguments.full_disk or arguments.kills
        traces = [Trace(folder, *scene) for scene in scenes(quick=runs < 100)]
        for trace in traces:
            print(f"{trace.folder.name}: {trace.seconds:.2f} s, {trace.size} bytes", flush=True)
        how = "killed"
        for i in range(runs):
            trace = traces[i % len(traces)]
            if arguments.full_disk:
                mounted = fill_once(trace, chance, counts)
                how = "on a file system that filled up" if mounted else "at a limit on the size of files"
            else:
                kill_once(trace, chance, counts)
    finally:
        shutil.rmtree(folder)
    print(f"{counts.killed} {how}, {counts.too_late} had ended before, {counts.before_first_save} before the first save; "
          f"all files readable, {counts.resumed} resumed and equal bit for bit")


if __name__ == "__main__":
    main()
