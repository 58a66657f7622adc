"""Every kind of file can be opened with xarray, h5py, and ncdump of netCDF."""

import re
import shutil
import subprocess
import unittest

import h5py
import xarray

from program import BIRTH, CROSSING, FAMILY, PUSHED_PENDULUM, SCENES, TIME_LIMIT, ProgramTest, datasets, each_case

MULTIBODY = SCENES / "ground_resonance.toml"
ZIEGLER = SCENES / "ziegler_column.toml"
WINDOW = ["--second", "damping", "--second-from", "0.01", "--second-to", "1"]

FILES = [
    ("loci of a multibody scene", "trace", MULTIBODY),
    ("loci of a matrix family", "trace", FAMILY),
    ("loci with events", "trace", CROSSING),
    ("loci with births", "trace", BIRTH),
    ("loci of a path that turns back", "trace", PUSHED_PENDULUM),
    ("boundary", "boundary", ZIEGLER, *WINDOW),
    ("boundary without curves", "boundary", ZIEGLER, *WINDOW, "--from", "0", "--to", "0.1"),
    ("map", "map", ZIEGLER, *WINDOW, "--grid", "5x7"),
    ("accuracy", "accuracy", SCENES / "pendulum.toml", "--tolerances", "1e-4", "--orders", "2", "--samples", "10",
     "--repeat", "1", "--grids", "25"),
]


def is_dimension(dataset):
    return dataset.attrs.get("CLASS") == b"DIMENSION_SCALE"


@each_case(FILES)
class Contract(ProgramTest):
    def check(self, command, scene, *options):
        if isinstance(scene, str):
            scene = self.write("scene.toml", scene)
        self.run_well(command, scene, "-o", "out.h5", "--quiet", *options)
        self.path = self.folder / "out.h5"
        with h5py.File(self.path) as file:
            contents = datasets(file)
            self.read_by_h5py(contents)
            self.described(contents)
            self.dimensioned(contents)
            self.read_by_xarray(set(contents))
            self.read_by_ncdump(contents)

    def read_by_h5py(self, contents):
        for name, dataset in contents.items():
            with self.subTest(f"h5py reads {name}"):
                self.assertEqual(dataset[()].shape, dataset.shape)

    def described(self, contents):
        for name, dataset in contents.items():
            for attribute in ("units", "long_name"):
                with self.subTest(f"{attribute} of {name}"):
                    self.assertTrue(dataset.attrs[attribute])

    def dimensioned(self, contents):
        for name, dataset in contents.items():
            with self.subTest(f"dimensions of {name}"):
                if is_dimension(dataset):
                    self.assertEqual(dataset.ndim, 1)
                    continue
                for axis, dimension in enumerate(dataset.dims):
                    scale, = dimension.values()
                    self.assertEqual(scale.shape, dataset.shape[axis:axis + 1])

    def read_by_xarray(self, names):
        with xarray.open_dataset(self.path, engine="h5netcdf") as data:
            self.assertEqual(set(data.variables), names)
            for name, variable in data.variables.items():
                with self.subTest(f"xarray reads {name}"):
                    self.assertEqual(variable.values.shape, variable.shape)

    def read_by_ncdump(self, contents):
        header = self.dumped("-h")
        for name, dataset in contents.items():
            dimensions = ", ".join(scale.name[1:] for dim in dataset.dims for scale in dim.values())
            with self.subTest(f"ncdump names {name}"):
                self.assertRegex(header, rf"(?m)^\t\w+ {name}\({re.escape(dimensions or name)}\) ;$")
                self.assertIn(f'\tstring {name}:units = "{dataset.attrs["units"]}" ;', header)
                self.assertIn(f"\tstring {name}:long_name = ", header)
        self.assertIn("\ndata:\n", self.dumped())

    def dumped(self, *options):
        self.assertTrue(shutil.which("ncdump"), "ncdump is missing: install netcdf-bin")
        run = subprocess.run(["ncdump", *options, self.path], capture_output=True, text=True, timeout=TIME_LIMIT,
                             check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout


if __name__ == "__main__":
    unittest.main()
