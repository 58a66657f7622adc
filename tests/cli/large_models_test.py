"""Large models from the command line: what verify knows of them, names of their modes, scenes with many beams."""

import unittest

import h5py
import numpy as np
import scipy.sparse as sp

from program import ProgramTest

CHAIN = ('[parameters]\nomega = 0\n[trace]\nparameter = "omega"\nfrom = 0\nto = 1\nmodes = 3\n'
         '[matrix_family]\nfile = "chain.h5"\n')

# 7 bays of two rails and a rung, 4 elements each: more than 1000 coordinates.
BEAM = ('[[beam]]\nname = "{}"\nfrom = {}\nto = {}\nelements = 4\ndegree = 1\ny_axis = {}\nmass = 1\nEA = 1e4\n'
        'EI_flap = 1\nEI_lag = 2\nGJ = 1\n')


def ladder(bays):
    text = ('[parameters]\nomega = 0\n[trace]\nparameter = "omega"\nfrom = 0\nto = 2\n'
            '[frame]\nangular_velocity = [0, 0, "omega"]\n')
    for bay in range(1, bays + 1):
        for rail in (0, 1):
            text += (f'[[body]]\nname = "corner {rail}{bay}"\nmass = 0.01\ninertia = [1e-4, 1e-4, 1e-4]\n'
                     f'position = [{bay}, {rail - 0.5}, 0]\n')
            before = f'[0, {rail - 0.5}, 0]' if bay == 1 else f'"corner {rail}{bay - 1}"'
            text += BEAM.format(f'rail {rail}{bay}', before, f'"corner {rail}{bay}"', '[0, 1, 0]')
        text += BEAM.format(f'rung {bay}', f'"corner 0{bay}"', f'"corner 1{bay}"', '[1, 0, 0]')
    return text


class LargeModels(ProgramTest):
    def write_chain(self, names=()):
        n = 300
        step = sp.diags([-1, 2, -1], [-1, 0, 1], (n, n)) * (n / 10) ** 2
        turn = sp.diags([-1, 1], [-1, 1], (n, n))
        with h5py.File(self.folder / "chain.h5", "w") as file:
            for name, matrix in {"M/0": sp.eye(n), "C/1": turn, "K/0": step, "K/1": sp.diags(np.linspace(0, 3, n))}.items():
                rows = sp.csr_matrix(matrix)
                for part in ("data", "indices", "indptr"):
                    file[f"{name}/{part}"] = getattr(rows, part)
            for key, values in names:
                file[key] = values
        self.write("scene.toml", CHAIN)

    def trace(self, *options):
        run = self.run_program("trace", "scene.toml", "-o", "loci.h5", "--force", *options)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout

    def verify(self):
        return self.run_program("verify", "loci.h5")

    def test_families_are_verified_with_the_whole_model(self):
        self.write_chain()
        self.assertIn("projected from 300 freedoms", self.trace())
        run = self.verify()
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("stored points, each solved afresh by shift-invert of the whole model", run.stdout)

    def test_modes_have_the_names_of_the_large_model(self):
        self.write_chain([("state_names", [f"place {i}" for i in range(300)])])
        self.trace()
        with h5py.File(self.folder / "loci.h5") as file:
            for name in file["mode_name"][...]:
                self.assertIn("place", name.decode())

    def test_a_changed_large_matrix_fails(self):
        self.write_chain()
        self.trace()
        with h5py.File(self.folder / "chain.h5", "r+") as file:
            file["K/0/data"][...] = file["K/0/data"][...] * (1 + 1e-5)
        run = self.verify()
        self.assertEqual(run.returncode, 1)
        self.assertIn("has this file changed since the trace?", run.stderr)

    def test_all_modes_of_a_very_large_scene_are_refused(self):
        self.write("scene.toml", ladder(26))
        run = self.run_program("trace", "scene.toml", "-o", "loci.h5")
        self.assertEqual(run.returncode, 2)
        self.assertIn("follow some of them", run.stderr)


if __name__ == "__main__":
    unittest.main()
