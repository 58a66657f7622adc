"""Arguments that are of the kinds that the annotations of a function name."""

import inspect
import os
import reprlib
from collections.abc import Callable, Mapping, Sequence
from functools import cache, wraps
from numbers import Integral, Real
from typing import Any, TypeVar, Union, get_args, get_origin

import numpy as np

from .engine import engine

# Per kind: in words, one and several of it, and its types.
KINDS: dict[Any, tuple[str, str, Any]] = {
    bool: ("True or False", "True or False", (bool, np.bool_)), int: ("a whole number", "whole numbers", Integral),
    float: ("a number", "numbers", Real), str: ("a text", "texts", str), os.PathLike: ("a path", "paths", os.PathLike),
    Mapping: ("a dict", "dicts", Mapping), Sequence: ("a list", "lists", (list, tuple, range, np.ndarray)),
    tuple: ("a pair", "pairs", (list, tuple)), type(None): ("None", "None", type(None)), Any: ("anything", "anything", object),
}

Function = TypeVar("Function", bound=Callable[..., Any])


def checked(function: Function) -> Function:
    """The function with a TypeError for a keyword that it does not have, with a suggestion, and one that names an argument of
    another kind than its annotation. Arguments whose annotation has other kinds than KINDS, and Dataset, are left to the function."""
    signature = inspect.signature(function)
    known = [name for name, one in signature.parameters.items() if name != "self"]
    takes_all = any(one.kind is one.VAR_KEYWORD for one in signature.parameters.values())

    @cache
    def hints() -> dict[str, Any]:
        parameters = inspect.signature(function, eval_str=True).parameters
        return {name: one.annotation for name, one in parameters.items()
                if one.kind is not one.VAR_KEYWORD and _is_known(one.annotation)}

    @wraps(function)
    def call(*arguments: Any, **keywords: Any) -> Any:
        for name in keywords:
            if not takes_all and name not in known:
                raise TypeError(f"{function.__qualname__.removesuffix('.__init__')}: {name} is no keyword; "
                                + engine().suggestion(name, known))
        given = signature.bind(*arguments, **keywords).arguments
        for name, hint in hints().items():
            if name in given and not _fits(given[name], hint):
                raise TypeError(f"{name}: expected {_in_words(hint)}, found {reprlib.repr(given[name])}")
        return function(*arguments, **keywords)

    return call  # type: ignore[return-value]


def _kind(hint: Any) -> Any:
    return get_origin(hint) or hint


def _described(kind: Any) -> Any:
    if getattr(kind, "__name__", "") == "Dataset":  # of xarray, which is imported late
        return "a Dataset", "Datasets", kind
    return KINDS.get(kind)


def _is_known(hint: Any) -> bool:
    if _kind(hint) is Union:
        return all(map(_is_known, get_args(hint)))
    return _described(_kind(hint)) is not None


def _fits(value: Any, hint: Any) -> bool:
    kind, parts = _kind(hint), get_args(hint)
    if kind is Union:
        return any(_fits(value, part) for part in parts)
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if not isinstance(value, _described(kind)[2]):
        return False
    if kind is tuple:
        return len(value) == len(parts) and all(map(_fits, value, parts))
    if kind is Mapping:
        return all(_fits(one, parts[1]) for one in value.values())
    return kind is not Sequence or all(_fits(one, parts[0]) for one in value)


def _in_words(hint: Any, several: int = 0) -> str:
    kind, parts = _kind(hint), get_args(hint)
    if kind is Union:
        return " or ".join(_in_words(part, several) for part in parts if part is not type(None))
    inner = parts[-1] if kind in (Sequence, Mapping, tuple) else Any
    return _described(kind)[several] + (f" of {_in_words(inner, 1)}" if inner is not Any else "")
