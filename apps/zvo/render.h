// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo render`: voxelizes scenes and writes a picture of them, or a series. Throws Error.
void render(const RenderOptions& options);

} // namespace zvo::cli
