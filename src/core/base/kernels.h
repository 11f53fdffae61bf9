// SPDX-License-Identifier: MIT
#pragma once

#include "vk/kernel.h"

#include <span>

namespace zvo
{

/// The shaders of all operations, embedded by the build.
std::span<const vk::EmbeddedKernel> zvoKernels();

} // namespace zvo
