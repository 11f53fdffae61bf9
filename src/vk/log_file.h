// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/log.h"

namespace zvo::vk
{

/// A log that appends every message to the file `path` as one line, "SEVERITY: MESSAGE"; a line stays whole if several
/// processes write. Messages that cannot be written are lost. path must live as long as the log is used; null or empty:
/// no log.
LogCallback logToFile(const char* path);

} // namespace zvo::vk
