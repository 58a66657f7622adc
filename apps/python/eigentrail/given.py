"""What users give as a scene, and keywords of the commands, as the engine wants them."""

import inspect
import math
import os
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from numbers import Real
from typing import Any, NamedTuple, Optional, Union

import numpy as np

from . import toml
from .engine import engine
from .errors import SceneError
from .families import Family, Samples
from .imports import Imported
from .later import xarray

Source = Union[str, os.PathLike[str], Mapping[str, Any], Family, Samples, Imported]


class Given(NamedTuple):
    """A scene with the values of its parameters set, and the range of each parameter that has one."""

    scene: Any
    function: Any
    ranges: dict[str, tuple[Any, Any]]
    warnings: list[str]
    attached: "Attached"
    values: dict[str, float]  # those that were given, per parameter, in its unit


class Attached(NamedTuple):
    """Matrices in memory, by the names of the files by which the scene calls them. Errors in a text that was generated name no
    lines of it."""

    files: dict[str, bytes] = {}
    matrices: dict[str, Any] = {}
    generated: bool = True

    def scene(self, text: str, name: str) -> Any:
        return engine().parse_scene(text, name, self.files, self.matrices, self.generated)


def give(command: Callable[..., Any], source: Source, values: Mapping[str, Any], tolerance: Optional[float] = None,
         functions: bool = False, events: Optional[Mapping[str, Any]] = None) -> Given:
    """`values`: per parameter a number, a text such as "300 rpm" or an expression, or a pair: a range. `functions`: whether
    a family may be given by a function. `command`: the function that was called with `values`, among other keywords."""
    if isinstance(source, xarray.Dataset):
        raise TypeError("expected a scene, found a result; the scene of a result is its .attrs['scene']")
    if not functions and getattr(source, "function", None) is not None:
        raise SceneError("a family that a function gives can be traced only: the function knows one parameter, and is called "
                         "for one range; give its matrices as a Family of powers and names, or as Samples")
    ranges = {name: _range(name, value) for name, value in values.items() if _is_range(value)}
    settings = [f"{name}={_setting(value, name)}" for name, value in values.items() if name not in ranges]
    function, attached = None, Attached()
    if isinstance(source, Imported):
        attached = Attached({"model.h5": source.image})
        scene = attached.scene(source.text, "Imported")
    elif isinstance(source, (Family, Samples)):
        traced = source.parameter or _only(ranges)
        attached = _attached(source)
        scene = attached.scene(source.scene(traced, ranges.get(traced)), type(source).__name__)
        if isinstance(source, Family) and source.function is not None:
            function = engine().FunctionSource(
                partial(source.at, parameter=traced), _function_tolerance(source, tolerance), source.max_calls, source.resolution,
                source.breaks, source.names or [])
    else:
        scene, attached = _read(source)
    _require_known(command, values, [name for name, _, _ in scene.parameters])
    if events:
        scene = _with_events(scene, events, attached)
    scene, warnings = scene.with_settings(settings, "")
    given = {name: value for name, _, value in scene.parameters if name in values and name not in ranges}
    return Given(scene, function, ranges, warnings, attached, given)


def option_text(value: Any) -> str:
    """The value of an option as on the command line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return ", ".join(f"{name} = {toml.value_text(item)}" for name, item in value.items())
    if isinstance(value, (list, tuple)):
        return ", ".join(str(item) for item in value)
    return _setting(value)


def number(name: str, value: Any) -> float:
    """A value of a parameter that must be a number, in its unit."""
    if not isinstance(value, Real) or not math.isfinite(value):
        raise SceneError(f"{name}: expected finite numbers in the unit of the parameter, found {value!r}")
    return float(value)


def within(name: str, value: int, most: int) -> None:
    if not 0 <= value <= most:
        raise SceneError(f"{name}: expected 0 to {most}, found {value}")


def _require_known(command: Callable[..., Any], names: Iterable[str], parameters: Sequence[str]) -> None:
    """SceneError for a keyword that is no parameter of the scene, with a suggestion."""
    keywords = [name for name, one in inspect.signature(command).parameters.items() if one.kind is one.KEYWORD_ONLY]
    for name in names:
        if name not in parameters:
            raise SceneError(f"{name}: is no parameter of the scene, and no keyword of {command.__name__}; "
                             + engine().suggestion(name, [*parameters, *keywords]))


def _read(source: Any) -> tuple[Any, Attached]:
    """The scene of a dict, a text or a file."""
    if isinstance(source, Mapping):
        return Attached().scene(toml.dumps(source), "scene"), Attached()
    if not isinstance(source, (str, os.PathLike)):
        raise TypeError("expected a scene: a path, a text, a dict, a Family, Samples, a StateSpace, or what an importer returns; found "
                        + type(source).__name__)
    text = os.fspath(source)
    as_given = Attached(generated=False)
    if isinstance(source, str) and ("\n" in text or "=" in text):
        return as_given.scene(text, "scene"), as_given
    return engine().read_scene(text), as_given


def _attached(family: Any) -> Attached:
    if family.function is not None:
        return Attached()
    if isinstance(family, Family) and family.is_dense_polynomial():
        return Attached(matrices={"family.h5": family.matrices})
    return Attached({"family.h5": family.image()})


def _with_events(scene: Any, events: Mapping[str, Any], attached: Attached) -> Any:
    """The scene with other entries in [events]."""
    tables = tomllib.loads(scene.text)
    tables["events"] = {**tables.get("events", {}), **events}
    return attached._replace(generated=True).scene(toml.dumps(tables), scene.path)


def _only(ranges: Mapping[str, Any]) -> str:
    if len(ranges) != 1:
        raise TypeError("expected the range of one parameter, such as omega=(0, 400), or the name of the family's parameter: "
                        "Family(..., parameter=...)")
    return next(iter(ranges))


def _function_tolerance(family: Any, tolerance: Optional[float]) -> float:
    if family.function_tolerance is not None:
        return float(family.function_tolerance)
    return min(max(1e-3 * (tolerance or 1e-6), 1e-13), 1e-6)


def _is_range(value: Any) -> bool:
    return isinstance(value, (tuple, list, np.ndarray))


def _range(name: str, value: Any) -> tuple[Any, Any]:
    if len(value) != 2:
        raise SceneError(f"{name}: expected a range of two values, such as {name}=(0, 400), found {len(value)} values")
    return value[0], value[1]


def _setting(value: Any, name: str = "option") -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    try:
        return repr(float(value))
    except (TypeError, ValueError):
        raise TypeError(f"{name}: expected a number, a text with a unit, an expression, or a pair: a range; found "
                        f"{value!r}") from None
