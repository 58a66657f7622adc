"""The compiled engine, which computes, and reads files."""

from typing import Any, Optional

_found: Any = None
_why: Optional[ImportError] = None
try:
    from . import _engine as _found  # type: ignore[attr-defined, no-redef]
except ImportError as error:  # not compiled, or for another version of Python
    _why = error


def engine() -> Any:
    """The compiled module; an ImportError that says how to get it where it is missing."""
    if _found is None:
        raise ImportError(
            "this installation of eigentrail has no compiled engine for this Python, which computes and reads files: install the "
            "Debian package, run `pip install .` in the sources, or put build/release/python on the PYTHONPATH") from _why
    return _found
