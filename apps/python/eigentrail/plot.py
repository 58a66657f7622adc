"""Draws files into a picture: what `eigentrail plot` runs.

    python3 -m eigentrail.plot FILES... -o campbell.svg [--kind campbell ...]

The picture is written as a whole, or not at all; the same files give the same bytes. Errors of the input end with the exit
code 2.
"""

import argparse
import inspect
import os
import sys

from . import files
from .engine import engine
from .figures import planes, shapes, studies, trace_figures, with_matplotlib
from .version import __version__


def main(arguments=None):
    """Draws and returns the exit code."""
    try:
        options = vars(_parser().parse_args(arguments))
        output, force = options.pop("output"), options.pop("force", False)
        kind = _suffix(output)
        picture = picture_of([files.open(path) for path in options["files"]], options)
        image = with_matplotlib.image(picture, kind, __version__)
    except (ValueError, OSError) as error:
        return _failed(error, 2)
    try:
        files.write({output: image}, force)
    except (ValueError, OSError, RuntimeError) as error:
        return _failed(error, 1)
    return 0


def _failed(error, exit_code):
    known = isinstance(error, OSError) and error.filename and error.strerror
    print(f"eigentrail: {f'{error.filename}: {error.strerror}' if known else error}", file=sys.stderr)
    return exit_code


def picture_of(data, options):
    """The picture of Datasets; `options` of the command, those that were given, by their names."""
    formats = [one.attrs["format"].removeprefix("eigentrail-") for one in data]
    kind = options.pop("kind", None) or next(kind for kind, (of, _) in KINDS.items() if formats[0] in of.split(" or "))
    of, draw = KINDS[kind]
    for path, format_ in zip(options.pop("files"), formats):
        if format_ not in of.split(" or "):
            raise ValueError(f"{path}: a picture of the kind {kind} needs a file of the kind {of}, found eigentrail-{format_}")
    useless = [name for name in options if name not in inspect.signature(draw).parameters]
    if useless:
        raise ValueError(f"--{useless[0]}: a picture of the kind {kind} has no use for it")
    if kind != "plane" and len(data) > 1:
        raise ValueError(f"a picture of the kind {kind} shows one file, found {len(data)}; several go on the page of "
                       "eigentrail report")
    return draw(*data, **options)


def _plane(*data, size=None):
    """A map with a boundary, or one of them."""
    data = sorted(data, key=lambda one: one.attrs["format"], reverse=True)  # a map first
    if len({one.attrs["format"] for one in data}) < len(data):
        raise ValueError("a picture of the kind plane shows one map, one boundary, or one of each")
    return planes.plane_picture(*data, size=size)


def _shape(loci, at=None, mode=1, view="3D", size=None):
    return shapes.shape_picture(loci, _place(loci, at), mode, view, size)


# Per kind of picture, the usual one of its files first: the files that it shows, and what draws it, with its options as keywords.
KINDS = {"campbell": ("loci", trace_figures.campbell_picture), "root-locus": ("loci", trace_figures.root_locus_picture),
         "damping": ("loci", trace_figures.damping_picture), "shape": ("loci", _shape), "plane": ("map or boundary", _plane),
         "accuracy": ("accuracy", studies.work_precision_picture)}


def _place(loci, at):
    """The value of the parameter at which a shape is drawn: by default where the trace begins."""
    name = loci.attrs["parameter"]
    values = loci[name].values
    if at is None:
        return float(values[0])
    value = engine().option_value("--at", at, name, loci[name].attrs.get("units", "1"))
    if not values.min() <= value <= values.max():
        raise ValueError(f"--at {at}: {name} was traced from {values.min():.15g} to {values.max():.15g}")
    return value


def _suffix(path):
    """The kind of a picture file by its name."""
    kind = os.path.splitext(path)[1].lower().removeprefix(".")
    if kind not in with_matplotlib.KINDS:
        known = ", ".join(f".{name}" for name in with_matplotlib.KINDS)
        raise ValueError(f"{path}: expected a name that ends in one of {known}")
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
        raise ValueError(message.removeprefix("argument "))


def _parser():
    parser = _Parser(prog="eigentrail plot", description="Draws files of eigentrail into a picture.",
                     argument_default=argparse.SUPPRESS)
    parser.add_argument("files", nargs="+", metavar="FILE")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--kind", choices=KINDS)
    for option, of_text in (("harmonics", _numbers), ("unit", str), ("mode", _mode), ("at", str), ("view", str), ("size", _size)):
        parser.add_argument(f"--{option}", type=of_text)
    for flag in ("--log", "--force"):
        parser.add_argument(flag, action="store_true")
    return parser


if __name__ == "__main__":
    sys.exit(main())
