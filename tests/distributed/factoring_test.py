"""Large models whose matrices several processes factor together, by PETSc and MUMPS: results against SuiteSparse."""

import csv
import io
import os
import pathlib
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np
import scipy.sparse as sp

from program import EXIT_BAD_INPUT, PROGRAM, TIME_LIMIT, ProgramTest
from together import ENVIRONMENT, MPIRUN, run_together

TOLERANCE = 1e-6
PLACES = [str(p) for p in np.linspace(0.0, 1.0, 21)]


def plate(cells, damping, turning, follower):
    """Matrices of a plate in its own plane, cells x cells places with two displacements each; see docs/large-models.md."""
    step = sp.diags([-1, 2, -1], [-1, 0, 1], (cells, cells)) * (cells + 1) ** 2
    stiffness = lambda a: sp.kron(step, sp.eye(cells)) + a * sp.kron(sp.eye(cells), step)
    mass = sp.diags(np.linspace(1, 1.8, cells * cells))
    turn = sp.bmat([[None, -mass], [mass, None]])
    both = sp.block_diag([mass, mass])
    matrices = {"M/0": both, "K/0": sp.block_diag([stiffness(1.1), stiffness(1.6)]), "K/2": -both}
    if damping > 0:
        matrices["C/0"] = damping * both
    if turning:
        matrices["C/1"] = 2 * turn
    if follower:
        matrices["K/follower"] = -turn
    return matrices


def write_family(path, matrices):
    with h5py.File(path, "w") as file:
        for name, matrix in matrices.items():
            rows = sp.csr_matrix(matrix)
            for part in ("data", "indices", "indptr"):
                file[f"{name}/{part}"] = getattr(rows, part)


def scene(modes, follower=False):
    return f"""\
[parameters]
omega = 0
{"force = 0.5" if follower else ""}
[trace]
parameter = "omega"
from = 0
to = 1
tolerance = {TOLERANCE}
modes = {modes}
[matrix_family]
file = "plate.h5"
{'factors = { follower = "force" }' if follower else ""}
"""


# name, matrices, modes, factors by SuiteSparse and by MUMPS
CASES = [
    ("symmetric", {"damping": 0, "turning": False, "follower": False}, "4", "Cholesky (CHOLMOD)", "LDL^T"),
    ("symmetric, shift among the modes", {"damping": 0, "turning": False, "follower": False},
     "{ near = 7.0, count = 4 }", "LU (UMFPACK)", "LDL^T"),
    ("gyroscopic", {"damping": 0, "turning": True, "follower": False}, "4", "Cholesky (CHOLMOD)", "LDL^T"),
    ("circulatory, left vectors, flutter", {"damping": 0.02, "turning": True, "follower": True}, "4", "LU (UMFPACK)", "LU"),
    ("complex shift, left vectors", {"damping": 0.02, "turning": True, "follower": True},
     "{ near = 7.0, count = 4 }", "LU (UMFPACK)", "LU"),
]


class Factoring(ProgramTest):
    def together(self, count, *arguments):
        run = run_together(self.folder, count, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""), run.args)
        return run.stdout

    def prepare(self, cells, modes="4", **family):
        write_family(self.folder / "plate.h5", plate(cells, **family))
        self.write("scene.toml", scene(modes, family["follower"]))

    def eigenvalues(self, file):
        rows = csv.DictReader(io.StringIO(self.run_well("eval", file, "--csv", "--at", *PLACES)))
        return np.array([complex(float(row["real"]), float(row["imag"])) for row in rows])

    def events(self, file):
        return list(csv.DictReader(io.StringIO(self.run_well("events", file, "--csv"))))

    def test_traces_are_those_of_suitesparse(self):
        for name, family, modes, suitesparse, mumps in CASES:
            self.prepare(20, modes, **family)
            said = self.run_well("trace", "scene.toml", "-o", "one.h5", "--force")
            self.assertIn(f"factorizations by {suitesparse},", said, name)
            expected, expected_events = self.eigenvalues("one.h5"), self.events("one.h5")
            if "flutter" in name:
                self.assertIn("flutter", [event["kind"] for event in expected_events])
            for count in (1, 2):
                with self.subTest(name, processes=count):
                    said = self.together(count, "trace", "scene.toml", "-o", "together.h5", "--force")
                    processes = "1 process" if count == 1 else f"{count} processes"
                    self.assertIn(f"factorizations by {mumps} (MUMPS through PETSc, {processes}),", said)
                    self.assertEqual(said.count("wrote together.h5"), 1)
                    found = self.eigenvalues("together.h5")
                    self.assertLess(np.max(abs(found - expected) / abs(expected)), TOLERANCE)
                    events = self.events("together.h5")
                    self.assertEqual([event["kind"] for event in events], [event["kind"] for event in expected_events])
                    for event, other in zip(events, expected_events):
                        self.assertAlmostEqual(float(event["parameter"]), float(other["parameter"]), delta=10 * TOLERANCE)

    def test_spectrum_and_route(self):
        self.prepare(20, damping=0.02, turning=True, follower=True)
        expected = [line.split()[:2] for line in self.run_well("spectrum", "scene.toml", "--at", "0.5").splitlines()]
        found = [line.split()[:2] for line in self.together(2, "spectrum", "scene.toml", "--at", "0.5").splitlines()]
        self.assertEqual(found, expected)
        said = self.together(2, "explain", "scene.toml")
        self.assertIn("factorization  LU (MUMPS through PETSc, 2 processes) at each", said)
        self.assertEqual(said.count("route"), 1)

    def test_small_models_are_traced_by_one_process(self):
        self.prepare(5, damping=0, turning=True, follower=False)
        self.run_well("trace", "scene.toml", "-o", "one.h5", "--quiet")
        self.assertEqual(self.together(3, "trace", "scene.toml", "-o", "three.h5").count("wrote"), 1)
        np.testing.assert_array_equal(self.eigenvalues("three.h5"), self.eigenvalues("one.h5"))

    def test_errors_are_told_once_and_end_all(self):
        self.prepare(20, damping=0, turning=True, follower=False)
        self.write("none.toml", scene("4").replace("plate.h5", "none.h5"))
        massless = plate(20, damping=0, turning=False, follower=False)
        # A freedom without mass and stiffness: MUMPS finds no pivot.
        keep = sp.diags([1.0] * 799 + [0.0])
        write_family(self.folder / "singular.h5", {name: keep @ matrix @ keep for name, matrix in massless.items()})
        self.write("singular.toml", scene("4").replace("plate.h5", "singular.h5"))
        for arguments, code in [
            (["trace", "none.toml", "-o", "new.h5"], EXIT_BAD_INPUT),
            (["trace", "scene.toml", "-o", "none/new.h5"], EXIT_BAD_INPUT),
            (["trace", "singular.toml", "-o", "new.h5"], None),
        ]:
            with self.subTest(arguments):
                run = run_together(self.folder, 3, *arguments)
                alone = self.run_program(*arguments)
                self.assertEqual(run.returncode, alone.returncode if code is None else code)
                self.assertNotEqual(run.returncode, 0)
                said = [line for line in run.stderr.splitlines() if line.startswith("eigentrail: ")]
                self.assertEqual(said, alone.stderr.splitlines())

    def start_of_a_long_trace(self):
        """A trace by two processes, when both are there; the numbers of the processes."""
        self.prepare(120, damping=0.02, turning=True, follower=True)
        launcher = subprocess.Popen([MPIRUN, "-n", "2", PROGRAM, "trace", "scene.toml", "-o", "loci.h5"], cwd=self.folder,
                                    env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL)
        self.addCleanup(launcher.wait)
        self.addCleanup(launcher.kill)
        until = time.monotonic() + TIME_LIMIT
        while time.monotonic() < until:
            started = processes_in(self.folder)
            if len(started) == 2:
                time.sleep(1.0)  # into the factorizations
                return launcher, started
            time.sleep(0.05)
        self.fail("the processes have not started")

    def assert_all_end(self, launcher, started):
        self.assertNotEqual(launcher.wait(timeout=TIME_LIMIT), 0)
        self.assertEqual([number for number in started if number in processes_in(self.folder)], [])

    def test_signals_end_all(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                launcher, started = self.start_of_a_long_trace()
                launcher.send_signal(number)
                self.assert_all_end(launcher, started)

    def test_the_end_of_one_process_ends_all(self):
        for which in (0, 1):
            with self.subTest(which):
                launcher, started = self.start_of_a_long_trace()
                os.kill(sorted(started)[which], signal.SIGKILL)
                self.assert_all_end(launcher, started)


def processes_in(folder):
    """Numbers of the processes of the program that were started in a folder."""
    numbers = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            program = os.path.realpath(entry / "exe")
            if program == os.path.realpath(PROGRAM) and os.path.realpath(entry / "cwd") == os.path.realpath(folder):
                numbers.append(int(entry.name))
        except OSError:
            continue  # it has ended, or belongs to another user
    return numbers


if __name__ == "__main__":
    unittest.main()
