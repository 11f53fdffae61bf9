// SPDX-License-Identifier: MIT
#pragma once

#include "support/engine_device.h"

#include <span>

namespace zvo
{

/// The kernels of tests/core/light.
std::span<const vk::EmbeddedKernel> lightTestKernels();

namespace test
{

/// A device with the engine's kernels and those of tests/core/light.
inline vk::HeadlessDevice& lightDevice()
{
    return deviceWith(lightTestKernels());
}

} // namespace test

} // namespace zvo
