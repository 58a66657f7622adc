"""Builds the compiled engine of the package with CMake. The rest is in pyproject.toml.

EIGENTRAIL_BUILD names a build tree to take it from; without it one is made, which takes minutes.
"""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCES = pathlib.Path(__file__).resolve().parents[2]


class Engine(build_ext):
    def build_extension(self, ext):
        given = os.environ.get("EIGENTRAIL_BUILD")
        tree = pathlib.Path(given) if given else pathlib.Path(self.build_temp).resolve() / "cmake"
        if not given:
            subprocess.run(["cmake", "-S", SOURCES, "-B", tree, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                            "-DEIGENTRAIL_BUILD_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", tree, "--target", "eigentrail_engine", "--parallel"], check=True)
        package = tree / "python" / "eigentrail"
        (engine,) = package.glob("_engine.*")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        self.copy_file(str(engine), str(target))
        self.copy_file(str(package / "version.py"), str(target.parent))


VERSION = re.search(r"project\(eigentrail VERSION (\S+)", (SOURCES / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
setup(version=VERSION, ext_modules=[Extension("eigentrail._engine", sources=[])], cmdclass={"build_ext": Engine})
