// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo convert`: reads a tree or voxels and writes them as another kind of file. Throws Error.
void convert(const ConvertOptions& options);

} // namespace zvo::cli
