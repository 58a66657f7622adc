"""Draws files into a picture: what `eigentrail plot` runs.

    python3 -m eigentrail.plot FILES... -o campbell.svg [--kind campbell ...]

The picture is written as a whole, or not at all; the same files give the same bytes. Errors of the input end with the exit
code 2.
"""

import argparse
import os
import sys

from . import files
from .engine import engine
from .figures import planes, shapes, studies, trace_figures, with_matplotlib
from .version import __version__

KINDS = {"campbell": "loci", "root-locus": "loci", "damping": "loci", "shape": "loci", "plane": "map or boundary",
         "accuracy": "accuracy"}
DEFAULTS = {"eigentrail-loci": "campbell", "eigentrail-boundary": "plane", "eigentrail-map": "plane",
            "eigentrail-accuracy": "accuracy"}


class BadInput(ValueError):
    """Options or files that do not fit."""


def main(arguments=None):
    """Draws and returns the exit code."""
    try:
        options = _parser().parse_args(arguments)
        kind = _suffix(options.output)
        picture = picture_of([files.open(path) for path in options.files], options)
        image = with_matplotlib.image(picture, kind, __version__)
    except (ValueError, OSError) as error:
        return _failed(error, 2)
    try:
        files.write({options.output: image}, options.force)
    except (ValueError, OSError, RuntimeError) as error:
        return _failed(error, 1)
    return 0


def _failed(error, exit_code):
    known = isinstance(error, OSError) and error.filename and error.strerror
    print(f"eigentrail: {f'{error.filename}: {error.strerror}' if known else error}", file=sys.stderr)
    return exit_code


def picture_of(data, options):
    """The picture of Datasets; `options` as of the command."""
    formats = [one.attrs["format"] for one in data]
    kind = options.kind or DEFAULTS[formats[0]]
    fitting = [format_ for format_, default in DEFAULTS.items() if format_.removeprefix("eigentrail-") in KINDS[kind].split()]
    for path, format_ in zip(options.files, formats):
        if format_ not in fitting:
            raise BadInput(f"{path}: a picture of the kind {kind} needs a file of the kind {KINDS[kind]}, found {format_}")
    _refuse_useless(options, kind)
    if kind == "plane":
        return _plane(data, formats, options)
    if len(data) > 1:
        raise BadInput(f"a picture of the kind {kind} shows one file, found {len(data)}; several go on the page of "
                       "eigentrail report")
    loci, size = data[0], options.size
    if kind == "campbell":
        return trace_figures.campbell_picture(loci, options.harmonics, options.unit, options.log, size)
    if kind == "root-locus":
        return trace_figures.root_locus_picture(loci, options.unit, size)
    if kind == "damping":
        return trace_figures.damping_picture(loci, size)
    if kind == "accuracy":
        return studies.work_precision_picture(loci, size=size)
    return shapes.shape_picture(loci, _place(loci, options.at), 1 if options.mode is None else options.mode, options.view, size)


def _plane(data, formats, options):
    """A map with a boundary, or one of them."""
    maps = [one for one, format_ in zip(data, formats) if format_ == "eigentrail-map"]
    boundaries = [one for one, format_ in zip(data, formats) if format_ == "eigentrail-boundary"]
    if len(maps) > 1 or len(boundaries) > 1:
        raise BadInput("a picture of the kind plane shows one map, one boundary, or one of each")
    if maps:
        return planes.plane_picture(maps[0], boundaries[0] if boundaries else None, options.size)
    return planes.plane_picture(boundaries[0], size=options.size)


def _refuse_useless(options, kind):
    """An option that the kind of picture does not use is a mistake."""
    used = {"campbell": {"harmonics", "unit", "log"}, "root-locus": {"unit"}, "shape": {"mode", "at", "view"}}.get(kind, set())
    for name, unset in (("harmonics", None), ("unit", None), ("log", False), ("mode", None), ("at", None), ("view", "3D")):
        if getattr(options, name) != unset and name not in used:
            raise BadInput(f"--{name}: a picture of the kind {kind} has no use for it")


def _place(loci, at):
    """The value of the parameter at which a shape is drawn: by default where the trace begins."""
    name = loci.attrs["parameter"]
    values = loci[name].values
    if at is None:
        return float(values[0])
    value = engine().option_value("--at", at, name, loci[name].attrs.get("units", "1"))
    if not values.min() <= value <= values.max():
        raise BadInput(f"--at {at}: {name} was traced from {values.min():.15g} to {values.max():.15g}")
    return value


def _suffix(path):
    """The kind of a picture file by its name."""
    kind = os.path.splitext(path)[1].lower().removeprefix(".")
    if kind not in with_matplotlib.KINDS:
        known = ", ".join(f".{name}" for name in with_matplotlib.KINDS)
        raise BadInput(f"{path}: expected a name that ends in one of {known}")
    return kind


def _numbers(text):
    try:
        return [float(part) for part in text.replace(",", " ").split()]
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected numbers such as 1,2, found {text!r}") from None


def _size(text):
    parts = _numbers(text.lower().replace("x", " "))
    if len(parts) != 2 or not all(1 <= part <= 60 for part in parts):
        raise argparse.ArgumentTypeError(f"expected width and height in inches from 1 to 60, such as 9x6, found {text!r}")
    return tuple(parts)


def _mode(text):
    return int(text) if text.isdigit() else text


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise BadInput(message.removeprefix("argument "))


def _parser():
    parser = _Parser(prog="eigentrail plot", description="Draws files of eigentrail into a picture.")
    parser.add_argument("files", nargs="+", metavar="FILE")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--kind", choices=KINDS)
    parser.add_argument("--harmonics", type=_numbers)
    parser.add_argument("--unit")
    parser.add_argument("--mode", type=_mode)
    parser.add_argument("--at")
    parser.add_argument("--view", default="3D")
    for flag in ("--log", "--force"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("--size", type=_size)
    return parser


if __name__ == "__main__":
    sys.exit(main())
