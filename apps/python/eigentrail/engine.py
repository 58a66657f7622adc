"""The compiled engine, which computes, and reads files."""

import inspect
from collections.abc import Callable
from functools import wraps
from typing import Any, Optional, TypeVar

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


Function = TypeVar("Function", bound=Callable[..., Any])


def suggesting(function: Function) -> Function:
    """The function with a suggestion in the TypeError for a keyword that it does not have."""
    known = list(inspect.signature(function).parameters)

    @wraps(function)
    def call(*arguments: Any, **keywords: Any) -> Any:
        for name in keywords:
            if name not in known and _found is not None:
                raise TypeError(f"{function.__qualname__.removesuffix('.__init__')}: {name} is no keyword; "
                                + _found.suggestion(name, known[1:]))
        return function(*arguments, **keywords)

    return call  # type: ignore[return-value]
