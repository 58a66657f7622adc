"""Damaged HDF5 and MATLAB files through everything that reads them: an error or a result, never a crash, a hang or a gigabyte.

    EIGENTRAIL=build/release/apps/eigentrail EIGENTRAIL_DATA=data PYTHONPATH=tests/cli:build/release/python \\
        python3 tests/reliability/damaged_files.py --files 10000

Every file is opened by Python's `open`, if it is of a kind that this reads, and by one command of the program. Files that fail
are kept in the folder `--keep`.
"""

import argparse
import collections
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np
import scipy.io

from program import BLADE, CROSSING, PROGRAM, SCENES

MOST_MEMORY = 1 << 30  # bytes
RANDOM = np.random.default_rng(1)


def run(*command, folder, seconds):
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, errors="replace",
                          timeout=seconds)


def matrices(path, libver="earliest", **storage):
    with h5py.File(path, "w", libver=libver) as file:
        for name in ("M/0", "K/0", "K/1"):
            file.create_dataset(name, data=np.eye(6) + (name > "L") * 0.1, **storage)
        file["state_names"] = [f"state {i}" for i in range(6)]


def samples(path):
    with h5py.File(path, "w", libver="latest") as file:
        file["parameter"] = np.linspace(0.0, 1.0, 5)
        file["parameter"].attrs["units"] = "m/s"
        file["A"] = RANDOM.normal(size=(5, 4, 4))
        file.attrs["digits"] = 6


def mat_5(path, compressed):
    scipy.io.savemat(path, {"A": RANDOM.normal(size=(4, 4, 5)), "speed": np.arange(5.0), "frame": ["fixed"] * 4},
                     do_compression=compressed)


def mat_73(path):
    """As MATLAB writes it with -v7.3: HDF5 behind a header of 512 bytes."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, array in (("A", RANDOM.normal(size=(5, 4, 4))), ("speed", np.arange(5.0)[:, None])):
            file.create_dataset(name, data=array, chunks=array.shape, compression="gzip")
            file[name].attrs.create("MATLAB_class", b"double", dtype="S7")
    text = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Jan 01 00:00:00 2024 HDF5 schema 1.00 ."
    with open(path, "r+b") as file:
        file.write(text.ljust(116) + bytes(8) + b"\x00\x02IM")


FAMILY = '[trace]\nparameter = "p"\nfrom = 0\nto = 1\n[{0}]\nfile = "model.h5"\n'
OF_LOCI = (("info", "{}"), ("eval", "{}", "--at", "50"), ("events", "{}"), ("verify", "{}"), ("export", "{}", "-o", "t.csv", "--force"),
           ("report", "{}", "-o", "r.html", "--force"))
OF_OTHERS = (("info", "{}"), ("report", "{}", "-o", "r.html", "--force"))
DRAW = ("plot", "{}", "-o", "p.png", "--force")


def good_files(folder):
    """{name: (content, commands)}; "{}" stands for the file."""
    (folder / "blade.toml").write_text(BLADE)
    (folder / "crossing.toml").write_text(CROSSING)
    found = {}

    def add(name, commands, *command):
        if command:
            done = run(PROGRAM, *command, "-o", name, "--force", folder=folder, seconds=600.0)
            assert done.returncode == 0, done.stderr
        found[name] = ((folder / name).read_bytes(), commands)

    add("loci.h5", OF_LOCI, "trace", "blade.toml", "--quiet")
    add("crossing.h5", OF_LOCI, "trace", "crossing.toml", "--quiet")
    add("rotor.h5", OF_LOCI, "trace", SCENES / "jeffcott.toml", "--quiet")
    plane = ("blade.toml", "--second", "drag", "--second-from", "1", "--second-to", "3")
    add("boundary.h5", OF_OTHERS, "boundary", *plane)
    add("map.h5", OF_OTHERS, "map", *plane)
    add("accuracy.h5", OF_OTHERS, "accuracy", "crossing.toml", "--tolerances", "1e-4,1e-8", "--orders", "2,3", "--samples", "20",
        "--repeat", "1", "--grids", "25")
    for name, how in (("plain", {}), ("deflate", {"compression": "gzip", "shuffle": True, "fletcher32": True}),
                      ("latest", {"libver": "latest", "chunks": (1, 6)}), ("v110", {"libver": ("v108", "v110"), "chunks": (2, 2)})):
        matrices(folder / f"{name}.h5", **how)
        add(f"{name}.h5", (("explain", "family.toml"), ("spectrum", "family.toml", "--at", "0.5")))
    samples(folder / "samples.h5")
    add("samples.h5", (("explain", "samples.toml"), ("spectrum", "samples.toml", "--at", "0.5")))
    mat_5(folder / "v5.mat", False)
    mat_5(folder / "v7.mat", True)
    mat_73(folder / "v73.mat")
    for name in ("v5.mat", "v7.mat", "v73.mat"):
        add(name, (("import", "matlab", "{}", "-o", "imported", "--force"),))
    return found


SIGNATURES = re.compile(b"OHDR|OCHK|TREE|BTHD|BTLF|BTIN|HEAP|GCOL|FRHP|FHDB|FHIB|SNOD|FAHD|EAHD|\x89HDF|\x01\x00[\x01-\x20]\x00\x01\x00\x00\x00")


def damaged(content, chance):
    """The content with flipped bits, blocks of zeros or noise, blocks exchanged, or cut off; mostly where HDF5 describes the
    data, which are most of a file."""
    data = bytearray(content)
    if chance.random() < 0.1:
        return bytes(data[:chance.randrange(len(data))])
    begin, reach = 0, len(data)
    places = [found.start() for found in SIGNATURES.finditer(content)]
    if places and chance.random() < 0.8:
        begin = chance.choice(places)
        reach = min(600, len(data) - begin)
    if chance.random() < 0.6:
        for _ in range(chance.choice((1, 1, 1, 2, 5, 20))):
            data[begin + chance.randrange(reach)] ^= 1 << chance.randrange(8)
        return bytes(data)
    length = min(chance.choice((1, 2, 4, 8, 16, 64, 512)), reach)
    at, other = begin + chance.randrange(reach - length + 1), chance.randrange(len(data) - length + 1)
    data[at:at + length] = chance.choice((bytes(length), b"\xff" * length, chance.randbytes(length), data[other:other + length]))
    return bytes(data)


OPENER = """
import sys, warnings, eigentrail as et
warnings.simplefilter("ignore")
for path in sys.stdin:
    try:
        et.open(path.strip())
        print("opened", flush=True)
    except (ValueError, OSError) as error:
        print("refused" if path.strip() in str(error) else f"names no file: {error}".replace("\\n", " "), flush=True)
    except BaseException as error:
        print(f"raised {type(error).__name__}: {error}".replace("\\n", " "), flush=True)
"""


class Opener:
    """A process of Python that opens one file after the other."""

    def __init__(self):
        self.process = subprocess.Popen([sys.executable, "-c", OPENER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def open(self, path):
        self.process.stdin.write(f"{path}\n")
        self.process.stdin.flush()
        said = self.process.stdout.readline().strip()
        if said:
            return said
        ended = self.process.wait()
        self.__init__()
        return f"ended with code {ended}"

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def judged(command, folder, seconds):
    """Runs a command of the program; what is wrong with how it ended, or what it said."""
    try:
        done = run(PROGRAM, *command, folder=folder, seconds=seconds)
    except subprocess.TimeoutExpired:
        return "hangs"
    if done.returncode not in (0, 1, 2):
        return f"ended with code {done.returncode}: {done.stderr[-200:]}"
    if "Traceback" in done.stderr:
        return f"traceback: {done.stderr[-200:]}"
    if done.returncode == 2 and not done.stderr:
        return "refused without a word"
    return ("done", "numbers failed", "refused")[done.returncode]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, default=300)
    parser.add_argument("--seed", type=int, default=9)
    parser.add_argument("--plots", type=float, default=0.02, help="share of files that are drawn")
    parser.add_argument("--seconds", type=float, default=60.0, help="a command that takes longer hangs")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    counts, bad, slowest, opener = collections.Counter(), [], 0.0, Opener()
    with tempfile.TemporaryDirectory(prefix="eigentrail-") as name:
        folder = pathlib.Path(name)
        (folder / "family.toml").write_text(FAMILY.format("matrix_family"))
        (folder / "samples.toml").write_text(FAMILY.format("sampled_family"))
        good = good_files(folder)
        for i in range(options.files):
            kind = list(good)[i % len(good)]
            content, commands = good[kind]
            path = folder / ("model.h5" if "toml" in str(commands) or kind == "samples.h5" else "damaged" + pathlib.Path(kind).suffix)
            path.write_bytes(damaged(content, chance))
            of_eigentrail = commands in (OF_LOCI, OF_OTHERS)
            words = DRAW if of_eigentrail and chance.random() < options.plots else chance.choice(commands)
            said, begin = {}, time.monotonic()
            if of_eigentrail:
                said["open"] = opener.open(path)
            opened = time.monotonic()
            said[words[0]] = judged([path.name if word == "{}" else word for word in words], folder, options.seconds)
            slowest = max(slowest, opened - begin, time.monotonic() - opened)
            for what, how in said.items():
                counts[what, how if how in ("opened", "done", "refused", "numbers failed") else "BAD"] += 1
                if how not in ("opened", "done", "refused", "numbers failed"):
                    bad.append(f"{i} {kind} {what}: {how}")
                    print(bad[-1], flush=True)
                    if options.keep:
                        options.keep.mkdir(exist_ok=True)
                        shutil.copy(path, options.keep / f"{i}_{what}_{kind}")
    opener.close()
    memory = 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    for (what, how), count in sorted(counts.items()):
        print(f"{what:9} {how:15} {count}")
    print(f"{options.files} files, slowest {slowest:.1f} s, most memory of a process {memory >> 20} MB")
    if memory > MOST_MEMORY:
        bad.append("a process took more than 1 GB")
    return f"{len(bad)} faults" if bad else 0


if __name__ == "__main__":
    sys.exit(main())
