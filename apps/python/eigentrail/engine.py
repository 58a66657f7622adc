"""The compiled engine, which computes, and reads files."""

from functools import cache
from importlib import import_module
from typing import Any


@cache
def engine() -> Any:
    """The compiled module; an ImportError that says how to get it where it is missing, or is for another version of Python."""
    try:
        return import_module("._engine", __package__)
    except ImportError as error:
        raise ImportError(
            "this installation of eigentrail has no compiled engine for this Python, which computes and reads files: install the "
            "Debian package, run `pip install .` in the sources, or put build/release/python on the PYTHONPATH") from error
