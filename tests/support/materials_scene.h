// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstddef>
#include <cstdint>

namespace zvo::test
{

/// Small, long and huge triangles of every material class in [0, extent]^3: plain, textured, alpha tested and blended,
/// with vertex colours, some of them emissive with and without a texture. count: of each of the five materials.
Scene materialsScene(float extent, std::size_t count = 120, std::uint32_t seed = 17);

} // namespace zvo::test
