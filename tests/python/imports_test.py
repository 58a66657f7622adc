"""Models of other programs, read into memory: the same bits as after `eigentrail import`."""

import pathlib
import unittest

import eigentrail as et
import numpy as np

from loci_comparison import differences
from program import SCENES, ProgramTest

LINEARIZATIONS = SCENES.parent / "linearizations"
DATA = pathlib.Path(__file__).resolve().parents[1] / "import" / "data"


class Imports(ProgramTest):
    def test_an_imported_model_is_that_of_the_program(self):
        source = LINEARIZATIONS / "iea15.npz"
        modes = "band = ['0.005 Hz', '0.06 Hz'], damping_below = 0.2"
        self.run_well("import", "numpy", source, "-o", "folder", "--name", "model", "--unit", "m/s", "--digits", "4")
        self.run_well("trace", "folder/model.toml", "--modes", modes, "-o", "program.h5", "--quiet", "--to", "12")
        model = et.from_files("numpy", source, unit="m/s", digits=4)
        self.assertIn("20", " ".join(model.understood))
        loci = et.trace(model, modes=dict(band=["0.005 Hz", "0.06 Hz"], damping_below=0.2), options={"to": 12})
        loci.eigentrail.save(self.folder / "python.h5")
        found = differences(self.folder / "program.h5", self.folder / "python.h5")
        self.assertEqual([name for name in found if name not in ("scene_path", "option_modes")], [])

    def test_it_can_be_saved_for_the_program(self):
        np.savez(self.folder / "model.npz", A=np.array([[[0, 1], [-1 - p, -0.1]] for p in (0.0, 0.5, 1.0)]), p=[0.0, 0.5, 1.0])
        model = et.from_files("numpy", self.folder / "model.npz")
        scene = model.save(self.folder / "saved", "oscillator")
        self.run_well("trace", scene, "-o", "program.h5", "--quiet")
        loci = et.trace(model)
        np.testing.assert_array_equal(et.open(self.folder / "program.h5").eigenvalue, loci.eigenvalue)

    def test_files_of_octave(self):
        """Against the matrices that its script had (tests/import/data/README.md)."""
        M, K, G = np.diag([2.0, 1.0]), np.array([[3.0, -1.0], [-1.0, 2.0]]), np.array([[0.0, 1.0], [-1.0, 0.0]])
        for name in ("octave_v6.mat", "octave_v7.mat"):
            with self.subTest(name):
                loci = et.trace(et.from_files("matlab", DATA / name))
                self.assertEqual(list(loci.coordinate.values), ["x", "y", "vx", "vy"])
                for speed in (1.0, 6.3):
                    A = np.block([[np.zeros((2, 2)), np.eye(2)],
                                  [-np.linalg.solve(M, K), -np.linalg.solve(M, 0.01 * K + speed * G)]])
                    s = np.linalg.eigvals(A)
                    found = np.sort_complex(loci.eigentrail.sel(speed=speed).eigenvalue.values)
                    np.testing.assert_allclose(found, np.sort_complex(s[s.imag > 0]), rtol=2e-6)

    def test_mistakes(self):
        for call, text in ((lambda: et.from_openfast("nowhere/*.lin"), "no file has such a name"),
                           (lambda: et.from_files("fast", "a.lin"), "is not read; known: .*openfast"),
                           (lambda: et.from_files("numpy", "a.npz", digts=4), "is no option of numpy"),
                           (lambda: et.from_files("numpy", "missing.npz"), "missing.npz"),
                           (lambda: et.from_files("elastodyn", DATA / "NRELOffshrBsline5MW_Blade.dat", length=61.5, hub_radius=1.5),
                            "eigentrail import elastodyn")):
            with self.subTest(text), self.assertRaisesRegex(et.SceneError, text):
                call()


if __name__ == "__main__":
    unittest.main()
