// SPDX-License-Identifier: MIT
#pragma once

#include "vk/kernel.h"

#include <span>

namespace zvo
{

/// The kernels below tests/glsl, which include nothing of zvo but zvo/trace.glsl.
std::span<const vk::EmbeddedKernel> hostKernels();

} // namespace zvo
