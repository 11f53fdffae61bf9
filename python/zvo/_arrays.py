# SPDX-License-Identifier: MIT
"""What comes in: any array becomes one of NumPy's with the shape, the type of elements and the order that the engine
reads. One that is so already is not copied."""

from __future__ import annotations

from typing import Any, Protocol, Union

import numpy as np
import numpy.typing as npt


class SupportsDLPack(Protocol):
    """A tensor of another library."""

    def __dlpack__(self, *, stream: None = None) -> Any: ...

    def __dlpack_device__(self) -> tuple[int, int]: ...


Input = Union[npt.ArrayLike, SupportsDLPack]
AnyArray = npt.NDArray[Any]

_KINDS = {"f": "numbers", "u": "whole numbers"}


def as_array(name: str, value: Input) -> AnyArray:
    """A NumPy array of a value. Memory is shared where there is any: by the buffer protocol, __array__ or DLPack."""
    if isinstance(value, np.ndarray):
        return value
    if hasattr(value, "__dlpack__") and not hasattr(value, "__array_interface__"):
        try:
            return np.from_dlpack(value)  # type: ignore[arg-type]
        except (BufferError, RuntimeError) as error:
            raise ValueError(f"{name}: cannot be read through DLPack ({error}); it must be on the CPU") from error
    return np.asarray(value)


def rows(name: str, value: Input, columns: int, dtype: npt.DTypeLike = np.float32, count: int | None = None,
         of: str = "") -> AnyArray:
    """The array of a value of shape (count, columns), or (any number, columns). of: what `count` is the number of."""
    array = as_array(name, value)
    if array.shape == (0,):  # of an empty list
        array = array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name}: expected an array of shape (N, {columns}), got {array.shape}")
    if count is not None and len(array) != count:
        raise ValueError(f"{name}: expected {count} rows, one for each of {of}, got {len(array)}")
    return elements(name, array, dtype)


def elements(name: str, array: AnyArray, dtype: npt.DTypeLike) -> AnyArray:
    """The array with elements of another type, one behind the other. Fractions do not become whole numbers."""
    wanted: np.dtype[Any] = np.dtype(dtype)
    if array.dtype.kind not in ("fiu" if wanted.kind == "f" else "iu") and array.size != 0:
        raise ValueError(f"{name}: expected {_KINDS[wanted.kind]}, got an array of {array.dtype}")
    with np.errstate(over="ignore"):  # the engine warns of what is not finite
        return np.ascontiguousarray(array, dtype=wanted)


def indices(name: str, value: Input, count: int) -> AnyArray:
    """Rows of three indices, each of which is below count."""
    array = as_array(name, value)
    checked = rows(name, array, 3, np.uint32)
    if checked.size != 0 and (array.min() < 0 or array.max() >= count):
        raise ValueError(f"{name}: expected indices of {count} vertices, got some from {array.min()} to {array.max()}")
    return checked


def linear_colors(name: str, value: Input, count: int, of: str) -> AnyArray:
    """Linear colours with alpha, (count, 4): of bytes, which are sRGB, or of fractions, which are linear already."""
    array = as_array(name, value)
    is_srgb = array.dtype == np.uint8
    if not is_srgb and array.dtype.kind != "f":
        raise ValueError(f"{name}: expected uint8 or fractions, got an array of {array.dtype}")
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise ValueError(f"{name}: expected an array of shape (N, 3) or (N, 4), got {array.shape}")
    colors = rows(name, array, array.shape[1], np.uint8 if is_srgb else np.float32, count, of)[:, :3]
    linear = np.ones((count, 4), np.float32)
    linear[:, :3] = _LINEAR_OF_SRGB[colors] if is_srgb else colors
    return linear


def picture(name: str, value: Input) -> AnyArray:
    """A picture of bytes, (height, width, 4), of one with or without alpha."""
    array = as_array(name, value)
    if array.ndim != 3 or array.shape[2] not in (3, 4) or array.dtype != np.uint8 or array.size == 0:
        raise ValueError(f"{name}: expected an array of uint8 of shape (height, width, 3) or (height, width, 4), got "
                         f"one of {array.dtype} of shape {array.shape}")
    if array.shape[2] == 3:
        array = np.concatenate([array, np.full(array.shape[:2] + (1,), 255, np.uint8)], axis=2)
    return np.ascontiguousarray(array)


def _linear_of_srgb() -> AnyArray:
    encoded = np.arange(256) / 255.0  # IEC 61966-2-1
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4).astype(np.float32)


_LINEAR_OF_SRGB = _linear_of_srgb()
