// SPDX-License-Identifier: MIT
#pragma once

#include "vk/kernel.h"

#include <span>

namespace zvo::baseline
{

/// The shaders of zvo and those of the baselines, for a device that runs both.
std::span<const vk::EmbeddedKernel> allKernels();

} // namespace zvo::baseline
