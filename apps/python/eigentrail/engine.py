"""The compiled engine, which computes. Reading files works without it."""

try:
    from . import _engine as _found
    _why = None
except ImportError as error:  # an installation that only reads files, or another version of Python
    _found, _why = None, error


def engine():
    """The compiled module; an ImportError that says how to get it where it is missing."""
    if _found is None:
        raise ImportError(
            "this installation of eigentrail reads files, but has no compiled engine to compute with: install the Debian "
            "package, run `pip install .` in the sources, or put build/release/python on the PYTHONPATH") from _why
    return _found


class SceneError(ValueError):
    """Bad input: a scene, a family or an option that cannot be used. The message says where, what was expected, and what
    to do."""


class TraceError(RuntimeError):
    """A computation that could not begin; the message says why."""


if _found is not None:
    SceneError = _found.SceneError  # noqa: F811  the engine raises its own
