// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/edit/brush.h"
#include "demo/world/tool.h"

#include <glm/glm.hpp>
#include <vector>

namespace zvo::demo
{

/// A voxel and its images.
std::vector<glm::ivec3> imagesOf(const glm::ivec3& voxel, const Mirror& mirror, const Grid& grid);

/// A brush without part, and its images.
std::vector<Brush> imagesOf(const Brush& brush, const Mirror& mirror, const Grid& grid);

} // namespace zvo::demo
