// SPDX-License-Identifier: MIT
#pragma once

#include "kernels/test/params.h"
#include "support/device.h"

namespace zvo
{

/// The kernels below tests/kernels.
std::span<const vk::EmbeddedKernel> testKernels();

} // namespace zvo

namespace zvo::test
{

inline vk::HeadlessDevice& device()
{
    return sharedDevice(testKernels());
}

} // namespace zvo::test
