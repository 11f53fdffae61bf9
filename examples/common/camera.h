// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/tracer.h"

namespace host
{

/// From world to Vulkan's clip space, for a camera of a perspective view: reversed, depth is near / distance, 1 at the
/// near plane and 0 infinitely far away. What a maths library gives.
zvo::DMat4 reversedViewProjection(const zvo::CameraInfo& camera, double aspect, double near);

/// A matrix in single precision.
zvo::Mat4 narrowed(const zvo::DMat4& matrix);

} // namespace host
