# SPDX-License-Identifier: MIT
from __future__ import annotations

from dataclasses import dataclass

from . import _native


@dataclass(frozen=True)
class Device:
    """A Vulkan device of this machine."""

    index: int
    name: str
    type: str
    """"discrete", "integrated", "virtual", "cpu" or "other"."""
    driver: str
    memory_bytes: int
    """Size of the device's memory."""
    reasons: tuple[str, ...]
    """Why zvo cannot use the device; empty: it can."""


def devices() -> list[Device]:
    """All Vulkan devices, in the order of their indices, whether or not zvo can use them."""
    return [Device(index, *report[:-1], tuple(report[-1])) for index, report in enumerate(_native.devices())]


def name_of(device: str | int | None) -> str:
    """A choice of a device, as the engine takes it."""
    return "" if device is None else str(device)
