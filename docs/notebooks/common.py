"""What the notebooks share: the files they read, made by the program, and colours that all people tell apart."""

import os
import pathlib
import shutil
import subprocess
import tempfile

import matplotlib.pyplot as plt
from cycler import cycler

SCENES = pathlib.Path(__file__).resolve().parents[2] / "data" / "scenes"
_folder = tempfile.TemporaryDirectory(prefix="eigentrail-")

BLUE, ORANGE, GREEN, PINK, SKY, YELLOW, BLACK = (
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000")  # Okabe & Ito, 2008
plt.rcParams.update({
    "axes.prop_cycle": cycler(color=[BLUE, ORANGE, GREEN, PINK, SKY, YELLOW, BLACK],
                              linestyle=["-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (3, 1)), (0, (1, 1))]),
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "0.9",
    "figure.figsize": (7.5, 4.2), "figure.constrained_layout.use": True, "legend.frameon": False})


def made(command, scene, *options, change=("", "")):
    """Runs `eigentrail COMMAND SCENE -o FILE options` on a scene of data/scenes; returns the path of the file.

    `change` (old, new) edits the text of the scene before.
    """
    text = (SCENES / scene).read_text(encoding="utf-8")
    if change[0] not in text:
        raise ValueError(f"{scene} does not hold {change[0]!r}")
    folder = pathlib.Path(tempfile.mkdtemp(dir=_folder.name))
    (folder / scene).write_text(text.replace(*change) if change[0] else text, encoding="utf-8")
    file = folder / "out.h5"
    subprocess.run([_program(), command, folder / scene, "-o", file, "--quiet", *map(str, options)], check=True)
    return file


def _program():
    program = os.environ.get("EIGENTRAIL") or shutil.which("eigentrail")
    if not program:
        raise RuntimeError("the program eigentrail was not found: put it on the PATH, or its path into the environment "
                           "variable EIGENTRAIL; ./bootstrap demo builds it as build/release/apps/eigentrail")
    return program
