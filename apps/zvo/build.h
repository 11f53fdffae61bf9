// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo build`: voxelizes scenes and writes the tree to a .zvo file. Throws Error.
void buildFile(const BuildFileOptions& options);

} // namespace zvo::cli
