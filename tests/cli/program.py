"""Runs eigentrail as a user does: as a process, in a folder of its own."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["EIGENTRAIL"]
SCENES = pathlib.Path(os.environ["EIGENTRAIL_DATA"]) / "scenes"

# No test asserts a time; this ends a run that hangs. Builds with sanitizers are slower.
TIME_LIMIT = 30.0 * float(os.environ.get("EIGENTRAIL_SLOWDOWN", "1"))

# A kernel of OpenBLAS that it chooses on no processor of today; on those it does not know it takes Prescott.
OTHER_KERNEL = "Nehalem"

EXIT_DONE = 0
EXIT_NUMBERS_FAILED = 1
EXIT_BAD_INPUT = 2

BLADE = """\
title = "Blade"

[parameters]
omega  = { value = 40.0, unit = "rad/s" }
mass   = 50.0
length = 5.0
drag   = 2.0

[trace]
parameter = "omega"
from = 100.0
to = 5.0

[frame]
angular_velocity = [0, 0, "omega"]

[[point]]
name = "blade"
mass = "mass"
position = ["1 + length", 0, 0]

[[rod]]
from = [1, 0, 0]
to = "blade"
length = "length"

[[drag]]
point = "blade"
coefficient = "drag"
"""

FAMILY = """\
[trace]
parameter = "p"
from = 0
to = 1

[matrix_family]
M = [[[1, 0], [0, 1]]]
K = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]
"""

# s^2 + 0.1 s + 1 - p = 0: a pair, s = -0.05 +- sqrt(p - 0.9975), that becomes two real modes; one is zero at p = 1.
BIRTH = """\
[trace]
parameter = "p"
from = 0
to = 1.5

[matrix_family]
M = [[[1]]]
C = [[[0.1]]]
K = [[[1]], [[-1]]]
"""

# Two oscillators without coupling, s^2 = -(1 + p) and s^2 = -(2 - p): they cross at p = 1/2.
CROSSING = """\
[trace]
parameter = "p"
from = 0
to = 1

[matrix_family]
M = [[[1, 0], [0, 1]]]
K = [[[1, 0], [0, 2]], [[1, 0], [0, -1]]]
"""

# -s^2 = 1.5 +- d sqrt(1 + d^2), d = p - 1/2: two modes that cross at p = 1/2, where the coupling d^2 between them vanishes.
# They are no independent parts.
CROSSING_WITHIN = """\
[trace]
parameter = "p"
from = 0
to = 1

[matrix_family]
M = [[[1, 0], [0, 1]]]
K = [[[1, 0.25], [0.25, 2]], [[1, -1], [-1, -1]], [[0, 1], [1, 0]]]
"""

# Two circles of flutter that intersect, of two freedoms, and a line of divergence.
CURVES = """\
[parameters]
p = 0.0
q = 0.0

[trace]
parameter = "p"
from = -1
to = 1

[matrix_family]
M = [[["1", "0"], ["0", "1"]]]
C = [[["(p - 0.13)^2 + (q + 0.21)^2 - 0.16", "0"], ["0", "(p - 0.3)^2 + q^2 - 0.3"]]]
K = [[["1.3 - p - q", "0"], ["0", "4"]]]
"""

# A pendulum pushed sideways by p times its weight, sin(angle) = p: hanging up to p = 1, standing on the way back.
PUSHED_PENDULUM = """
[parameters]
g = 9.81
p = 0.0
[trace]
parameter = "p"
from = 0
to = 1.2
tolerance = 1e-2
[gravity]
acceleration = [0, 0, "-g"]
[[point]]
name = "bob"
mass = 1.0
position = [0, 0, -1]
[[rod]]
from = [0, 0, 0]
to = "bob"
length = 1.0
[[fixed]]
point = "bob"
coordinate = "y"
[[follower_force]]
point = "bob"
from = [0, 0, 0]
to = "bob"
magnitude = "p*g"
angle = "-pi/2"
axis = [0, 1, 0]
"""


# What shows that a message comes from a library.
LIBRARIES = r"HDF5-DIAG|terminate called|std::|toml::|CLI::|Eigen::|Traceback"

PLACE = "§"  # in a scene: where the message must point; it is taken out before the run


def edited(scene, old, new):
    """The scene with its one occurrence of `old` replaced."""
    assert scene.count(old) == 1, f"{old!r} occurs {scene.count(old)} times"
    return scene.replace(old, new)


def each_case(cases):
    """Adds one test per case to a class, so that each is reported by its name."""
    def add(test_class):
        for name, *details in cases:
            method = "test_" + re.sub(r"\W+", "_", name)
            assert not hasattr(test_class, method), method
            setattr(test_class, method, lambda self, details=details: self.check(*details))
        return test_class
    return add


def datasets(file):
    """The datasets of an open HDF5 file by name; beside them is the type of its complex numbers."""
    return {name: file[name] for name in file if name != "complex128"}


class ProgramTest(unittest.TestCase):
    """Each test runs in an empty folder, so that names in messages are short and remaining files are detected."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="eigentrail-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *arguments):
        try:
            return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
        except subprocess.TimeoutExpired:
            self.fail(f"{' '.join(map(str, arguments))}: hangs")

    def run_well(self, *arguments):
        """Standard output of a run that must succeed and print nothing on stderr."""
        run = self.run_program(*arguments)
        self.assertEqual((run.returncode, run.stderr), (EXIT_DONE, ""), run.args)
        return run.stdout

    def wait_for(self, name):
        """Waits until a run has begun to write the file."""
        end = time.monotonic() + 20
        while not (self.folder / name).exists():
            self.assertLess(time.monotonic(), end, "nothing is written")
            time.sleep(0.002)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8", errors="surrogateescape")
        return path

    def write_marked(self, scene, edits):
        """Writes scene.toml after some edits (old, new) and without its mark; returns "line:column:" of the mark, or ""."""
        for old, new in edits:
            scene = edited(scene, old, new)
        self.write("scene.toml", scene.replace(PLACE, ""))
        if PLACE not in scene:
            return ""
        before = scene[:scene.index(PLACE)]
        return f"{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}:"

    def contents(self):
        """Every path below the folder with its bytes (None for a folder)."""
        return {path.relative_to(self.folder): path.read_bytes() if path.is_file() else None
                for path in self.folder.rglob("*")}

    def assert_refused(self, run, fragments, beginning="eigentrail: "):
        """Bad input: exit code 2 and one line on stderr that says what is wrong."""
        self.assertEqual(run.returncode, EXIT_BAD_INPUT, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertTrue(run.stderr.startswith(beginning), f"{run.stderr!r} does not begin {beginning!r}")
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertTrue(run.stderr.endswith("\n"), run.stderr)
        self.assertNotRegex(run.stderr, LIBRARIES)
        for fragment in fragments:
            self.assertIn(fragment, run.stderr)
