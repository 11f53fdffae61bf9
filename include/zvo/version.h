// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/export.h"

// Semantic versioning (docs/embedding.md, "Versions").
#define ZVO_VERSION_MAJOR 0
#define ZVO_VERSION_MINOR 2
#define ZVO_VERSION_PATCH 0

/// A number that grows with the version, for comparisons in the preprocessor.
#define ZVO_VERSION (ZVO_VERSION_MAJOR * 10000 + ZVO_VERSION_MINOR * 100 + ZVO_VERSION_PATCH)

/// The same for people: "0.2.0".
#define ZVO_VERSION_TEXT ZVO_VERSION_JOIN(ZVO_VERSION_MAJOR, ZVO_VERSION_MINOR, ZVO_VERSION_PATCH)
#define ZVO_VERSION_JOIN(major, minor, patch) ZVO_VERSION_QUOTE(major.minor.patch)
#define ZVO_VERSION_QUOTE(text) #text

#ifdef __cplusplus

namespace zvo
{

/// ZVO_VERSION of the library that runs, which may be another one than that of the headers.
ZVO_API int version() noexcept;

} // namespace zvo

#endif
