"""Little memory ends commands with a message, and files that would unpack to more than they may are given up at once."""

import os
import resource
import struct
import subprocess
import unittest
import zipfile
import zlib

import h5py
import numpy as np
import scipy.io

from command_test_case import CommandTest
from program import BLADE, EXIT_BAD_INPUT, FAMILY, PROGRAM, TIME_LIMIT

MEGABYTE = 1_000_000


class LittleMemory(CommandTest):
    def test_commands_end(self):
        self.trace(FAMILY)
        self.write("blade.toml", BLADE)
        matrices = {"M": np.eye(3), "K": np.diag([1.0, 2.0, 3.0])}
        np.savez(self.folder / "model.npz", **matrices)
        scipy.io.savemat(self.folder / "model.mat", matrices)
        environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
        for megabytes in (100, 150, 200, 300):
            def limited(most=megabytes * MEGABYTE):
                resource.setrlimit(resource.RLIMIT_AS, (most, most))
            for command in (("trace", "blade.toml", "-o", "blade.h5", "--force"), ("info", "loci.h5"), ("plot", "loci.h5", "--force"),
                            ("import", "numpy", "model.npz", "-o", "numpy", "--force"),
                            ("import", "matlab", "model.mat", "-o", "matlab", "--force"),
                            ("map", "blade.toml", "--second", "drag", "--second-from", "1", "--second-to", "3", "--grid", "2x2", "-o", "map.h5", "--force")):
                with self.subTest(f"{command[0]} with {megabytes} MB"):
                    run = subprocess.run([PROGRAM, *command], cwd=self.folder, capture_output=True, text=True, check=False, env=environment,
                                         preexec_fn=limited, timeout=TIME_LIMIT)
                    self.assertIn(run.returncode, (0, 1, 2), run)
                    if run.returncode != 0:
                        self.assertRegex(run.stderr, r"^eigentrail: .*\n$")
                        self.assertIn("memory", run.stderr)


class Bombs(CommandTest):
    """Zeros in a few megabytes that would unpack to four gigabytes, and data without the end that is announced."""
    rows = 22_000  # 3.9 GB

    def refused(self, *command):
        run = subprocess.run([PROGRAM, *command], cwd=self.folder, capture_output=True, text=True, check=False, timeout=TIME_LIMIT,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (1_000 * MEGABYTE,) * 2))
        self.assertEqual(run.returncode, EXIT_BAD_INPUT, run)
        self.assertRegex(run.stderr, r"^eigentrail: .*(too large|more than|needs more memory)")

    def zeros(self):
        """The first bytes of the matrix."""
        return bytes(8 * self.rows * (self.rows // 1000))

    def test_numpy(self):
        with zipfile.ZipFile(self.folder / "bomb.npz", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            with archive.open("K.npy", "w", force_zip64=True) as entry:
                np.lib.format.write_array_header_1_0(entry, {"descr": "<f8", "fortran_order": False, "shape": (1, self.rows, self.rows)})
                entry.write(self.zeros())
        self.refused("import", "numpy", "bomb.npz", "-o", "new")

    def test_matlab(self):
        packed = zlib.compressobj(1)
        size = self.rows**2 * 8
        parts = struct.pack("<IIIIIIiiHHII", 6, 8, 6, 0, 5, 8, self.rows, self.rows, 1, 1, ord("K"), 0)[:44]
        body = struct.pack("<II", 14, len(parts) + 8 + size) + parts + struct.pack("<II", 9, size)
        data = packed.compress(body) + packed.compress(self.zeros()) + packed.flush()
        header = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x100) + b"IM"
        (self.folder / "bomb.mat").write_bytes(header + struct.pack("<II", 15, len(data)) + data)
        self.refused("import", "matlab", "bomb.mat", "-o", "new")

    def test_hdf5(self):
        chunk = zlib.compress(bytes(8 * self.rows * 100), 1)
        self.trace(FAMILY)
        for path, name in (("matrices.h5", "K/0"), ("loci.h5", "eigenvalue")):
            with h5py.File(self.folder / path, "a") as file:
                if name in file:
                    del file[name]
                dataset = file.create_dataset(name, (self.rows, self.rows), chunks=(100, self.rows), compression="gzip", dtype="f8")
                for row in range(0, self.rows, 100):
                    dataset.id.write_direct_chunk((row, 0), chunk)
                self.assertLess((self.folder / path).stat().st_size, dataset.nbytes / 50)
        self.write("scene.toml", '[trace]\nparameter = "p"\nfrom = 0\nto = 1\n[matrix_family]\nfile = "matrices.h5"\n')
        self.refused("explain", "scene.toml")
        self.refused("info", "loci.h5")


if __name__ == "__main__":
    unittest.main()
