// SPDX-License-Identifier: MIT
#pragma once

/// Marks what the shared library exports, and what of that is the library's own; everything else is hidden.
#if defined(_WIN32)
#error "zvo is built for systems with ELF or Mach-O libraries"
#else
#define ZVO_API __attribute__((visibility("default")))
#define ZVO_LOCAL __attribute__((visibility("hidden")))
#endif
