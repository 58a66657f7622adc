"""One version: that of CMakeLists.txt is shown by everything."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import eigentrail as et

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["EIGENTRAIL"]
VERSION = re.search(r"project\(eigentrail VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
SCENE = {"trace": {"parameter": "p", "from": 0, "to": 1}, "matrix_family": {"M": [[[1]]], "K": [[[1]], [[3]]]}}


class Version(unittest.TestCase):
    def assert_in(self, file, pattern):
        self.assertEqual(re.search(pattern, (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE)[1], VERSION, file)

    def test_program_and_files(self):
        printed = subprocess.run([PROGRAM, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(printed, f"eigentrail {VERSION}\n")
        with tempfile.TemporaryDirectory() as folder:
            scene, loci = ROOT / "data/scenes/rotating_mass.toml", os.path.join(folder, "out.h5")
            subprocess.run([PROGRAM, "trace", scene, "-o", loci, "--quiet"], check=True)
            self.assertEqual(et.open(loci).attrs["program_version"], VERSION)

    def test_python_package(self):
        self.assertEqual(et.__version__, VERSION)
        if os.environ["EIGENTRAIL_COMPUTES"] == "1":
            self.assertEqual(et.trace(SCENE).attrs["program_version"], VERSION)

    def test_documents(self):
        self.assert_in("CITATION.cff", r"^version: (\S+)")
        self.assert_in("CHANGELOG.md", r"^## (\S+)")
        self.assert_in("docs/install.md", r"build/eigentrail_([\d.]+)_amd64\.deb")


if __name__ == "__main__":
    unittest.main()
