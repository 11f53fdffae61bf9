// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/kernels.h"
#include "glsl/host_kernels.h"
#include "support/device.h"

#include <span>
#include <vector>

namespace zvo::test
{

/// The device that the tests of a binary share, with the engine's kernels and a host's.
inline vk::HeadlessDevice& deviceOfHosts()
{
    static const std::vector<vk::EmbeddedKernel> kernels = []
    {
        std::vector<vk::EmbeddedKernel> all(zvoKernels().begin(), zvoKernels().end());
        all.insert(all.end(), hostKernels().begin(), hostKernels().end());
        return all;
    }();
    return sharedDevice(kernels);
}

} // namespace zvo::test
