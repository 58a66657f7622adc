"""`eigentrail import`: from files of other programs to a trace, for every format, and the same bits as from HDF5."""

import csv
import io
import pathlib
import unittest

import h5py
import numpy as np
import scipy.io
import scipy.sparse

import nastran_files
from program import ProgramTest

OPENFAST = pathlib.Path(__file__).parents[1] / "import" / "data"

SPEEDS = np.linspace(0.0, 2.0, 9)


def stiffness(p):
    """Without symmetry and with all digits: two modes that come close to each other, and one beside them."""
    return np.array([[2.0 + p / 3, 0.1 * np.cos(p), 0.0], [0.2 * np.sin(p), 3.0 - p / 7, 0.3], [0.0, 0.25, 7.0 + np.exp(p)]])


MASS = np.diag([1.0, 1.1, 1.3])
DAMPING = np.diag([0.01, 0.02, 0.03]) / 3.0
STIFFNESS = np.array([stiffness(p) for p in SPEEDS])


def state_matrix(p):
    inverse = np.linalg.inv(MASS)
    return np.block([[np.zeros((3, 3)), np.eye(3)], [-inverse @ stiffness(p), -inverse @ DAMPING]])


STATE = np.array([state_matrix(p) for p in SPEEDS])


class ImportTest(ProgramTest):
    def imported(self, form, *arguments):
        """Imports to the folder "new"; returns what was printed."""
        return self.run_well("import", form, *arguments, "-o", "new", "--name", "model", "--force")

    def write_samples(self, **matrices):
        """The samples as HDF5, in the folder of the imported scene."""
        with h5py.File(self.folder / "new" / "reference.h5", "w") as file:
            file["parameter"] = SPEEDS
            for name, samples in matrices.items():
                file[name] = np.broadcast_to(samples, (len(SPEEDS), *samples.shape[-2:]))

    def eigenvalues(self, scene):
        self.run_well("trace", scene, "-o", "loci.h5", "--quiet", "--force", "--tolerance", "1e-8")
        with h5py.File(self.folder / "loci.h5") as file:
            return {name: file[name][()] for name in ("eigenvalue", "dense_output")}

    def assert_same_bits(self):
        """The imported scene and the same scene with reference.h5 trace to the same bits."""
        scene = (self.folder / "new" / "model.toml").read_text()
        self.assertEqual(scene.count('"model.h5"'), 1)
        self.write("new/reference.toml", scene.replace('"model.h5"', '"reference.h5"'))
        own, reference = self.eigenvalues("new/model.toml"), self.eigenvalues("new/reference.toml")
        self.assertGreater(own["eigenvalue"].size, 3)
        for name, values in own.items():
            self.assertEqual(values.tobytes(), reference[name].tobytes(), name)

    def modes(self, scene, *options):
        rows = csv.DictReader(io.StringIO(self.run_well("spectrum", scene, "--csv", *options)))
        return np.array([complex(float(row["real"]), float(row["imag"])) for row in rows])

    def assert_modes(self, found, expected, tolerance=1e-9):
        """As matched sets; modes with a negative imaginary part are not listed."""
        expected = expected[expected.imag > 0]
        found = found[found.imag > 0]
        self.assertEqual(len(found), len(expected))
        for s in expected:
            self.assertLess(min(abs(found - s)), tolerance * abs(s))


class RoundTrip(ImportTest):
    """Numbers survive the other formats without a changed bit."""

    def test_numpy(self):
        np.savez(self.folder / "a.npz", A=STATE, speed=SPEEDS)
        self.imported("numpy", "a.npz")
        self.write_samples(A=STATE)
        self.assert_same_bits()

    def test_numpy_compressed_and_in_the_order_of_fortran(self):
        np.savez_compressed(self.folder / "a.npz", K=np.asfortranarray(STIFFNESS), M=np.asfortranarray(MASS), C=DAMPING, p=SPEEDS)
        self.imported("numpy", "a.npz")
        self.write_samples(M=MASS, C=DAMPING, K=STIFFNESS)
        self.assert_same_bits()

    def test_matlab(self):
        for compression in (False, True):
            scipy.io.savemat(self.folder / "a.mat", {"A": np.moveaxis(STATE, 0, 2), "speed": SPEEDS}, do_compression=compression)
            self.imported("matlab", "a.mat")
            self.write_samples(A=STATE)
            self.assert_same_bits()

    def test_matlab_numbered_variables_and_a_sparse_mass(self):
        variables = {f"K{i:02d}": K for i, K in enumerate(STIFFNESS)} | {f"w{i:02d}": p for i, p in enumerate(SPEEDS)}
        scipy.io.savemat(self.folder / "a.mat", variables | {"M": scipy.sparse.csc_matrix(MASS), "C": DAMPING})
        self.imported("matlab", "a.mat")
        self.write_samples(M=MASS, C=DAMPING, K=STIFFNESS)
        self.assert_same_bits()

    def test_matlab_version_4(self):
        scipy.io.savemat(self.folder / "a.mat", {f"A{i:02d}": A for i, A in enumerate(STATE)} | {"speed": SPEEDS}, format="4")
        self.imported("matlab", "a.mat")
        self.write_samples(A=STATE)
        self.assert_same_bits()

    def test_matrix_market(self):
        scipy.io.mmwrite(self.folder / "M.mtx", scipy.sparse.coo_matrix(MASS), precision=17, symmetry="symmetric")
        scipy.io.mmwrite(self.folder / "C.mtx", DAMPING, precision=17)
        for i, K in enumerate(STIFFNESS):
            scipy.io.mmwrite(self.folder / f"K{i}.mtx", K, precision=17)
        rows = "".join(f"{p!r},M.mtx,C.mtx,K{i}.mtx\n" for i, p in enumerate(SPEEDS.tolist()))
        self.write("samples.csv", "speed [rad/s],M,C,K\n" + rows)
        self.imported("matrix-market", "samples.csv")
        self.write_samples(M=MASS, C=DAMPING, K=STIFFNESS)
        self.assert_same_bits()

    def test_matrix_market_powers(self):
        matrices = {"M0": MASS, "C0": DAMPING, "K0": STIFFNESS[0], "K2": np.array([[0.5, 0.1, 0], [0, -0.3, 0], [0.1, 0, 1 / 3]])}
        for name, matrix in matrices.items():
            scipy.io.mmwrite(self.folder / f"{name}.mtx", scipy.sparse.csr_matrix(matrix), precision=17)
        self.imported("matrix-market", *[f"{name}.mtx" for name in matrices], "--parameter", "speed", "--to", 1.5)
        with h5py.File(self.folder / "new" / "reference.h5", "w") as file:
            for name, matrix in matrices.items():
                file[f"{name[0]}/{name[1:]}"] = matrix
        self.assert_same_bits()

    def nastran(self, suffix, write):
        """One file per speed, and a table of them."""
        for i, K in enumerate(STIFFNESS):
            content = write({"MAA": MASS, "BAA": DAMPING, "KAA": K})
            (self.folder / f"{i}.{suffix}").write_bytes(content if isinstance(content, bytes) else content.encode())
        self.write("samples.csv", "speed,file\n" + "".join(f"{p!r},{i}.{suffix}\n" for i, p in enumerate(SPEEDS.tolist())))
        self.imported("nastran", "samples.csv")

    def test_nastran_text(self):
        self.nastran("op4", nastran_files.op4_text)
        self.write_samples(M=MASS, C=DAMPING, K=STIFFNESS)
        self.assert_same_bits()

    def test_nastran_binary(self):
        for order in "<>":
            self.nastran("op4", lambda matrices, order=order: nastran_files.op4_binary(matrices, order))
            self.write_samples(M=MASS, C=DAMPING, K=STIFFNESS)
            self.assert_same_bits()

    def test_nastran_bulk_data_have_ten_digits(self):
        self.nastran("pch", nastran_files.dmig)
        with h5py.File(self.folder / "new" / "model.h5") as file:
            self.assertEqual(file.attrs["digits"], 10)
            self.assertEqual(file["state_names"].asstr()[()].tolist(), ["grid 1, T3", "grid 2, T3", "grid 3, T3"])
            np.testing.assert_allclose(file["K"][()], STIFFNESS, rtol=1e-9)
        self.assert_modes(self.modes("new/model.toml", "--at", 0.5), np.linalg.eigvals(state_matrix(0.5)), 1e-6)


class OneOperatingPoint(ImportTest):
    """Files without a parameter give a spectrum."""

    exact = np.linalg.eigvals(state_matrix(0.0))

    def test_numpy(self):
        np.savez(self.folder / "a.npz", A=STATE[0])
        self.assertIn("eigentrail spectrum new/model.toml", self.imported("numpy", "a.npz"))
        self.assert_modes(self.modes("new/model.toml"), self.exact)

    def test_matrix_market(self):
        for name, matrix in {"M": MASS, "C": DAMPING, "K": STIFFNESS[0]}.items():
            scipy.io.mmwrite(self.folder / f"{name}.mtx", matrix, precision=17)
        self.imported("matrix-market", "M.mtx", "C.mtx", "K.mtx")
        self.assert_modes(self.modes("new/model.toml"), self.exact)

    def test_nastran(self):
        self.write("a.op4", nastran_files.op4_text({"MGG": MASS, "BGG": DAMPING, "KGG": STIFFNESS[0]}))
        self.imported("nastran", "a.op4")
        self.assert_modes(self.modes("new/model.toml"), self.exact)


class Others(ImportTest):
    """What is no part of the model is named."""

    G = np.array([[0.0, 0.2, 0.0], [-0.2, 0.0, 0.1], [0.0, -0.1, 0.0]])

    def test_gyroscopic_matrices_belong_to_a_speed(self):
        for form, write in (("numpy", lambda **arrays: np.savez(self.folder / "a.npz", **arrays)),
                            ("matlab", lambda **arrays: scipy.io.savemat(self.folder / "a.mat", arrays))):
            for damping in ({}, {"C": DAMPING}):
                write(M=MASS, K=STIFFNESS[0], G=self.G, **damping)
                said = self.imported(form, "a.npz" if form == "numpy" else "a.mat")
                self.assertIn("G is the gyroscopic matrix: the damping is C + speed G", said)
                self.assertNotIn("not read", said)
                C = damping.get("C", 0.0) + 1.7 * self.G
                inverse = np.linalg.inv(MASS)
                A = np.block([[np.zeros((3, 3)), np.eye(3)], [-inverse @ STIFFNESS[0], -inverse @ C]])
                self.assert_modes(self.modes("new/model.toml", "--at", 1.7), np.linalg.eigvals(A), 1e-9)

    def test_gyroscopic_matrices_of_samples_are_refused(self):
        np.savez(self.folder / "a.npz", M=MASS, K=STIFFNESS, G=self.G, speed=SPEEDS)
        self.assert_refused(self.run_program("import", "numpy", "a.npz", "-o", "new"), ["G, the gyroscopic matrix", "C + speed G"])

    def test_arrays_that_nobody_reads_are_listed_and_small_letters_asked_about(self):
        np.savez(self.folder / "a.npz", M=MASS, K=STIFFNESS[0], c=DAMPING, notes=np.ones(3), H=MASS)
        said = self.imported("numpy", "a.npz")
        self.assertIn("not read: c, notes, H", said)
        self.assertIn("array c is not read; did you mean C?", said)
        self.write("a.op4", nastran_files.op4_text({"MGG": MASS, "KGG": STIFFNESS[0], "GGG": self.G}))
        self.assertIn("not read: GGG", self.imported("nastran", "a.op4"))

    def test_all_arrays_of_a_model_are_read(self):
        np.savez(self.folder / "a.npz", **{f"K{i:02d}": K for i, K in enumerate(STIFFNESS)}, M=MASS, state_names=["a", "b", "c"],
                 **{f"w{i:02d}": p for i, p in enumerate(SPEEDS)})
        self.assertNotIn("not read", self.imported("numpy", "a.npz"))


class OpenFast(ImportTest):
    def test_modes_of_a_turbine(self):
        """To the digits that are printed in the test of OpenFAST's toolbox (tests/import/data/README.md)."""
        text = self.run_well("import", "openfast", *[OPENFAST / f"ws03.0.{i}.lin" for i in (1, 13, 34)], "-o", "new")
        self.assertIn("3 motions of 3 blades in multiblade coordinates", text)
        self.assertIn("wrote new/ws03.0.toml", text)
        modes = self.modes("new/ws03.0.toml")
        modes = sorted(modes[modes.imag > 1e-3], key=abs)[:3]
        self.assertEqual([f"{abs(s) / (2 * np.pi):.5f}" for s in modes], ["0.31403", "0.33141", "0.62634"])
        self.assertEqual([f"{-100 * s.real / abs(s):.3f}" for s in modes], ["0.439", "6.034", "2.481"])


class Command(ImportTest):
    def test_help_lists_all_formats_and_what_they_read(self):
        text = self.run_well("import", "--help")
        places = [text.index(f"\n  {form} ") for form in ("openfast", "matrix-market", "matlab", "nastran", "numpy")]
        self.assertEqual(places, sorted(places))
        self.assertIn("OUTPUT4 (.op4)", self.run_well("import", "nastran", "--help"))
        self.assertIn("--state-names", self.run_well("import", "matrix-market", "--help"))

    def test_the_name_is_that_of_the_files(self):
        for name in ("M0", "K0", "K1"):
            scipy.io.mmwrite(self.folder / f"rotor_{name}.mtx", MASS)
        files = [f"rotor_{name}.mtx" for name in ("M0", "K0", "K1")]
        self.assertIn("wrote new/rotor.toml", self.run_well("import", "matrix-market", *files, "-o", "new"))

    def test_files_that_have_nothing_in_common_take_the_name_of_their_folder(self):
        (self.folder / "my shaft").mkdir()
        files = [f"my shaft/{name}.mtx" for name in ("M0", "K0", "K1")]
        for file in files:
            scipy.io.mmwrite(self.folder / file, MASS)
        self.assertIn("wrote new/my_shaft.toml", self.run_well("import", "matrix-market", *files, "-o", "new"))

    def test_nothing_is_replaced_without_force(self):
        np.savez(self.folder / "a.npz", A=STATE[0])
        self.run_well("import", "numpy", "a.npz", "-o", "new")
        before = self.contents()
        self.assert_refused(self.run_program("import", "numpy", "a.npz", "-o", "new"), ["new/a.toml: exists already", "--force"])
        self.assertEqual(self.contents(), before)

    def test_a_format_that_is_not_known(self):
        self.assert_refused(self.run_program("import", "abaqus", "a.inp", "-o", "new"), [""])


if __name__ == "__main__":
    unittest.main()
