#!/usr/bin/env python3
"""Measures what a build from scratch costs: CPU time of all processes, and the costliest compilations.

    build_cost.py FOLDER [CMAKE OPTIONS]    builds the preset release into FOLDER, which must not exist

Wall time depends on what else the machine does; CPU time does so much less. The memory is the peak of one compiler.
"""
import pathlib
import resource
import subprocess
import sys


def cpu():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def launch(log, command):
    """Runs a compiler and adds its cost to the log; a line of that length is written as a whole."""
    status = subprocess.call(command)
    megabytes = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    with open(log, "a") as file:
        file.write(f"{cpu():.2f} {megabytes:.0f} {command[command.index('-o') + 1]}\n")
    return status


def build(folder, options):
    folder, source = pathlib.Path(folder).resolve(), pathlib.Path(__file__).resolve().parents[2]
    folder.mkdir(parents=True)
    log = folder / "costs.txt"
    launcher = f"{sys.executable};-IS;{pathlib.Path(__file__).resolve()};--launch;{log}"
    subprocess.run(["cmake", "--preset", "release", "-S", source, "-B", folder, f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}",
                    *options], check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", folder], check=True, stdout=sys.stderr)
    costs = sorted((line.split() for line in log.read_text().splitlines()), key=lambda words: -float(words[0]))
    print(f"{cpu():.0f} s in all, {sum(float(words[0]) for words in costs):.0f} s for {len(costs)} compilations, "
          f"at most {max(int(words[1]) for words in costs)} MB")
    for seconds, megabytes, name in costs[:10]:
        print(f"{float(seconds):7.2f} s {megabytes:>5} MB  {name}")


if sys.argv[1:2] == ["--launch"]:
    sys.exit(launch(sys.argv[2], sys.argv[3:]))
if len(sys.argv) < 2:
    sys.exit(__doc__)
build(sys.argv[1], sys.argv[2:])
