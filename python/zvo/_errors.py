# SPDX-License-Identifier: MIT


class ZvoError(RuntimeError):
    """A failure. Its text is one line: what went wrong, where, and what to do about it."""

    code: str
    """The kind of failure: "device", "input", "output", "memory" or "other"."""


class ZvoWarning(UserWarning):
    """What was left out, or may not be as it was meant. Options are called as those of the command line."""
