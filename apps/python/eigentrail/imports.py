"""Models that other programs made."""

import glob
import os
import pathlib
import tempfile
from collections.abc import Sequence
from typing import Any, Union

from .checked import checked
from .engine import engine
from .errors import SceneError, tell
from .files import write

Files = Union[str, os.PathLike[str], Sequence[Union[str, os.PathLike[str]]]]


class Imported:
    """A scene and its matrices in memory, as an importer has read them: give it to `trace`, `spectrum` and the others.

    `understood` are sentences on what was found and what was done with it. `save(folder, name)` writes both files, for the
    program.
    """

    def __init__(self, found: Any, text: str, image: bytes):
        self.title, self.parameter = found["title"], found["parameter"]
        self.understood: list[str] = list(found["understood"])
        self.text, self.image = text, image

    def __repr__(self) -> str:
        return "\n".join([f"Imported: {self.title}", *("  " + line for line in self.understood)])

    def save(self, folder: Union[str, os.PathLike[str]], name: str = "model", overwrite: bool = False) -> str:
        """Writes `name`.toml and `name`.h5 to the folder; returns the path of the scene. Files that exist are kept
        (FileExistsError), unless `overwrite`."""
        os.makedirs(folder, exist_ok=True)
        scene = os.path.join(folder, f"{name}.toml")
        write({os.path.join(folder, f"{name}.h5"): self.image,
               scene: self.text.replace('"model.h5"', f'"{name}.h5"').encode()}, overwrite)
        return scene


def from_openfast(files: Files, **options: Any) -> Imported:
    """Linearizations of OpenFAST, `.lin` files of one or several operating points: paths, or a pattern.

        turbine = from_openfast("lin/*.lin")
        loci = trace(turbine, modes=dict(band=["0.1 Hz", "2 Hz"]))

    Options are those of `eigentrail import openfast`. Raises SceneError for files that cannot be used.
    """
    return from_files("openfast", files, **options)


@checked
def from_files(format: str, files: Files, **options: Any) -> Imported:
    """Files of any format that `eigentrail import` reads: openfast, matrix-market, matlab, nastran, numpy."""
    paths = _paths(files)
    known = engine().import_formats()
    if format not in known:
        raise SceneError(f"format: {format!r} is not read; {engine().suggestion(format, list(known))}")
    texts = {}
    for name, value in options.items():
        key = name if name in known[format] else name.replace("_", "-")
        if key not in known[format]:
            raise SceneError(f"{name}: is no option of {format}; {engine().suggestion(name, list(known[format]))}")
        texts[key] = ",".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)
    with tempfile.TemporaryDirectory(prefix="eigentrail-") as folder:
        found = engine().import_files(format, paths, texts, folder)
        text = pathlib.Path(folder, "model.toml").read_text(encoding="utf-8")
        matrices = pathlib.Path(folder, "model.h5")
        if not matrices.exists():
            raise SceneError(f"{format}: gives a scene with a table of stations, no matrices; use the program, "
                             f"eigentrail import {format} FILES -o FOLDER, and give the scene to et.trace")
        image = matrices.read_bytes()
    tell(found["warnings"])
    return Imported(found, text, image)


def _paths(files: Files) -> list[str]:
    if isinstance(files, (str, os.PathLike)):
        pattern = os.fspath(files)
        paths = sorted(glob.glob(pattern)) if any(c in pattern for c in "*?[") else [pattern]
        if not paths:
            raise SceneError(f"{pattern}: no file has such a name")
        return paths
    return [os.fspath(path) for path in files]
