// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/kernels.h"
#include "support/device.h"

namespace zvo::test
{

/// The device that the tests of a binary share, with the engine's kernels.
inline vk::HeadlessDevice& device()
{
    return sharedDevice(zvoKernels());
}

} // namespace zvo::test
