// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo info`: lists the devices on standard output, and the one that would be used. Throws Error{Device} afterwards if
/// none would be.
void info(const InfoOptions& options);

} // namespace zvo::cli
