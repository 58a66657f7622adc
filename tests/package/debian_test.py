"""The Debian package: what is in it, and that it works from where it is unpacked."""

import gzip
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

BUILD = Path(os.environ["EIGENTRAIL_BUILD"])
SCENE = Path(os.environ["EIGENTRAIL_DATA"]) / "scenes" / "rotating_mass.toml"


def run(*command, **settings):
    return subprocess.run(command, check=True, capture_output=True, text=True, **settings).stdout


class DebianPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        folder = Path(cls.folder.name)
        run(os.environ["CPACK"], "--config", BUILD / "CPackConfig.cmake", "-B", folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=zstd")
        (cls.package,) = folder.glob("eigentrail_*.deb")
        cls.root = folder / "root"
        run("dpkg-deb", "-x", cls.package, cls.root)

    def field(self, name):
        return run("dpkg-deb", "-f", self.package, name).strip()

    def test_holds_program_library_python_package_and_manual(self):
        for name in (
            "bin/eigentrail",
            "lib/libeigentrail.a",
            "include/eigentrail/continuation/trace.hpp",
            "lib/cmake/eigentrail/eigentrail-config.cmake",
            "lib/python3/dist-packages/eigentrail/__init__.py",
            "share/man/man1/eigentrail.1.gz",
            "lib/python3/dist-packages/eigentrail/version.py",
            "share/doc/eigentrail/LICENSE",
            "share/doc/eigentrail/CHANGELOG.md",
            "share/doc/eigentrail/copyright",
            "share/doc/eigentrail/changelog.gz",
        ):
            self.assertTrue((self.root / "usr" / name).is_file(), name)
        self.assertTrue(list((self.root / "usr/lib/python3/dist-packages/eigentrail").glob("_engine.*.so")))
        self.assertFalse((self.root / "usr/share/eigentrail").exists(), "the Python package is there twice")
        self.assertEqual([path.name for path in self.root.iterdir()], ["usr"])

    def test_depends_on_the_libraries_of_the_program(self):
        depends = self.field("Depends")
        for library in ("libc6", "libhdf5", "liblapacke", "libsundials-kinsol"):
            self.assertIn(library, depends)
        for package in ("python3-xarray", "python3-matplotlib", "python3-plotly"):
            self.assertIn(package, self.field("Recommends"))

    def test_program_and_python_package_work_together(self):
        program = self.root / "usr/bin/eigentrail"
        self.assertEqual(run(program, "--version").split(), ["eigentrail", self.field("Version")])
        loci = Path(self.folder.name) / "out.h5"
        run(program, "trace", SCENE, "-o", loci, "--to", "90", "--quiet")
        reader = self.root / "usr/lib/python3/dist-packages"
        script = ("import sys, eigentrail as et; print(et.open(sys.argv[1]).sizes['node'], "
                  "et.trace(sys.argv[2], options={'to': 90}).sizes['node'])")
        nodes = run("/usr/bin/python3", "-c", script, loci, SCENE, env={**os.environ, "PYTHONPATH": str(reader)}).split()
        self.assertGreater(int(nodes[0]), 1)
        self.assertEqual(nodes[0], nodes[1])
        picture = Path(self.folder.name) / "out.svg"
        run(program, "plot", loci, "-o", picture)
        self.assertTrue(picture.read_bytes().startswith(b"<?xml"))

    def test_licences_are_named(self):
        copyright_file = (self.root / "usr/share/doc/eigentrail/copyright").read_text(encoding="utf-8")
        for name in ("License: BSD-3-clause", "License: Expat", "UMFPACK", "GPL"):
            self.assertIn(name, copyright_file)

    def test_manual_names_every_command(self):
        manual = gzip.decompress((self.root / "usr/share/man/man1/eigentrail.1.gz").read_bytes()).decode()
        help_text = run(self.root / "usr/bin/eigentrail", "--help")
        names = re.findall(r"^  (\S+)", help_text.split("Subcommands:\n")[1].split("\n\n")[0], re.MULTILINE)
        self.assertGreater(len(names), 5)
        for name in names:
            self.assertIn(f".SS {name}\n", manual)


if __name__ == "__main__":
    unittest.main()
