"""Compilation of numeric kernels, with a cache that notices edits in imported kernels.

numba's own cache compares only the file that a kernel stands in, so an edit in a kernel that it calls would be
missed. The cache folder is therefore named after a hash of all sources of the mechanics.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import cache
from importlib.resources import as_file, files
from importlib.resources.abc import Traversable
from typing import Any, ParamSpec, TypeVar, cast

import numba.extending  # type: ignore[import-untyped,unused-ignore]

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def compiled(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """The function as a numba kernel: cached on disk, without the interpreter lock, IEEE division by zero.

    It cannot make arrays: reference counts, of which every call would pay one for each array in its arguments, are off.
    """
    return _kernel(function, _nrt=False)


def inlined(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """As ``compiled``, always inlined: a call copies every array's seven words of its arguments, tuples' included."""
    return _kernel(function, _nrt=False, forceinline=True)


def compiled_to_allocate(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """As ``compiled``, for the few kernels that make arrays."""
    return _kernel(function)


@cache
def over_arrays(function: Callable[..., float], called: tuple[Callable[..., float], ...]) -> Callable[..., Any]:
    """A plain function of numbers, and what it calls, as a numpy function of arrays; both stay what they are."""
    for each in called:
        numba.extending.register_jitable(each)
    vectorize: Any = numba.vectorize
    return cast(Callable[..., Any], vectorize(cache=True)(function))


CONTRACT = {"contract"}
"""The one liberty taken with arithmetic: a product and a sum may be rounded once, which processors do in one instruction."""


def _kernel(function: Callable[Arguments, Result], **options: bool) -> Callable[Arguments, Result]:
    njit: Any = numba.njit
    return cast(
        Callable[Arguments, Result],
        njit(cache=True, nogil=True, error_model="numpy", no_cfunc_wrapper=True, fastmath=CONTRACT, **options)(
            function
        ),
    )


def _sources(folder: Traversable) -> list[bytes]:
    found: list[bytes] = []
    for each in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if each.name.endswith(".py"):
            found.append(each.name.encode() + b"\n" + each.read_bytes())
        elif each.is_dir() and each.name != "__pycache__":
            found.extend(_sources(each))
    return found


def _pin_cache() -> None:
    mechanics = files("palmar.mechanics")
    digest = hashlib.sha256(b"\n".join(_sources(mechanics))).hexdigest()[:16]
    settings: Any = numba.config
    if settings.CACHE_DIR:
        settings.CACHE_DIR = f"{settings.CACHE_DIR}/palmar-{digest}"
    else:
        with as_file(mechanics) as folder:
            settings.CACHE_DIR = f"{folder}/__pycache__/kernels-{digest}"


_pin_cache()
