// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/edit/brush.h"
#include "io/scene/edit_script.h"

#include <filesystem>
#include <optional>

namespace zvo
{

/// The brush of a sphere or a box on the voxels of a grid; nothing for a box between the centres of voxels. Throws
/// Error{Input} for a sphere that is larger than a brush may be.
std::optional<Brush> brushOf(const ScriptedEdit& edit, const Grid& grid, const std::filesystem::path& path);

} // namespace zvo
