// SPDX-License-Identifier: MIT
#pragma once

#include "glsl/host_kernels.h"
#include "support/engine_device.h"

namespace zvo::test
{

/// The device that the tests of a binary share, with the engine's kernels and a host's.
inline vk::HeadlessDevice& deviceOfHosts()
{
    return deviceWith(hostKernels());
}

} // namespace zvo::test
