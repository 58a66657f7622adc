"""What the package raises, and how it warns."""

import os
import sys
import warnings
from collections.abc import Iterable

PACKAGE = os.path.join(os.path.dirname(__file__), "")


class Error(Exception):
    """Base of all errors of eigentrail."""


class SceneError(Error, ValueError):
    """Bad input: a scene, a family, a file or an option that cannot be used. The message says where, what was expected, and
    what to do."""


class TraceError(Error, RuntimeError):
    """A computation that could not begin; the message says why."""


class NotResolved(TraceError):
    """A function of matrices that changes too quickly for `max_calls` of it."""


class NotProjected(TraceError):
    """A large model whose modes could not be computed to the tolerance on a small space."""


def tell(remarks: Iterable[str]) -> None:
    """Warns where the user has called the package."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and frame.f_code.co_filename.startswith(PACKAGE):
        frame, level = frame.f_back, level + 1
    for remark in remarks:
        warnings.warn(remark, stacklevel=level)
