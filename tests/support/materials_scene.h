// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene.h"

namespace zvo::test
{

/// Small, long and huge triangles of every material class in [0, extent]^3: plain, textured, alpha tested and blended,
/// with vertex colours, some of them emissive with and without a texture.
Scene materialsScene(float extent);

} // namespace zvo::test
