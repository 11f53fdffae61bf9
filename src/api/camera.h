// SPDX-License-Identifier: MIT
// Cameras of hosts. All functions throw Error{Usage} for values that are not valid.
#pragma once

#include "core/present/present.h"
#include "core/scene/camera.h"
#include "zvo/tracer.h"

#include <cstdint>

namespace zvo
{

/// An edge of a picture, in pixels.
std::uint32_t checkedEdge(std::uint32_t edge);

/// The view in a picture of that size.
ViewCamera viewOf(const CameraInfo& info, PictureSize size);

} // namespace zvo
