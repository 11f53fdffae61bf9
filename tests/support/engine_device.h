// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/kernels.h"
#include "support/device.h"

#include <span>
#include <vector>

namespace zvo::test
{

/// The device that the tests of a binary share, with the engine's kernels.
inline vk::HeadlessDevice& device()
{
    return sharedDevice(zvoKernels());
}

/// The same with more kernels, of which a binary has one set.
inline vk::HeadlessDevice& deviceWith(std::span<const vk::EmbeddedKernel> more)
{
    static const std::vector<vk::EmbeddedKernel> kernels = [&]
    {
        std::vector<vk::EmbeddedKernel> all(zvoKernels().begin(), zvoKernels().end());
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }();
    return sharedDevice(kernels);
}

} // namespace zvo::test
