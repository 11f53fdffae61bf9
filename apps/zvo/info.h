// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo info`: tells on standard output what devices there are and which would be used. Throws Error{Device}, after
/// having told that, when none would.
void info(const InfoOptions& options);

} // namespace zvo::cli
