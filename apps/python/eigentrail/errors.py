"""What the package raises."""


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
