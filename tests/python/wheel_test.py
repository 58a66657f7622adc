"""`pip install` makes a package that computes."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "apps" / "python"


class Wheel(unittest.TestCase):
    def test_pip_installs_it(self):
        with tempfile.TemporaryDirectory(prefix="eigentrail-") as folder:
            source = pathlib.Path(folder) / "source"
            source.mkdir()
            for name in ("eigentrail", "pyproject.toml", "setup.py"):  # setuptools writes beside the sources
                (source / name).symlink_to(PACKAGE / name)
            target = pathlib.Path(folder) / "installed"
            subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-build-isolation",
                            "--disable-pip-version-check", "--root-user-action=ignore", "--target", target, source],
                           check=True)
            text = ("import importlib.metadata, eigentrail as et, numpy as np; "
                    "loci = et.trace(et.Family(M=np.eye(1), K=[[[1.0]], [[3.0]]], parameter='p'), p=(0, 1)); "
                    "print(et.__file__, float(loci.natural_frequency[-1, 0]), et.__version__, loci.attrs['program_version'], "
                    "importlib.metadata.version('eigentrail'))")
            environment = {**os.environ, "PYTHONPATH": str(target)}
            printed = subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, text=True,
                                     env=environment).stdout.split()
            self.assertTrue(printed[0].startswith(str(target)))
            self.assertAlmostEqual(float(printed[1]), 2.0, places=6)
            self.assertEqual(len(set(printed[2:])), 1, printed)
            self.assertTrue((target / "eigentrail" / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
