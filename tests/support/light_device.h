// SPDX-License-Identifier: MIT
#pragma once

#include "vk/headless.h"

namespace zvo::test
{

/// A device with the engine's kernels and those of tests/core/light.
vk::HeadlessDevice& lightDevice();

} // namespace zvo::test
