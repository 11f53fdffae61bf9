// SPDX-License-Identifier: MIT
#include "baseline/baseline_kernels.h"

#include "core/base/kernels.h"

#include <vector>

namespace zvo
{
std::span<const vk::EmbeddedKernel> zvoBaselineKernels();
} // namespace zvo

namespace zvo::baseline
{

std::span<const vk::EmbeddedKernel> allKernels()
{
    static const std::vector<vk::EmbeddedKernel> kernels = []
    {
        const auto own = zvoKernels();
        const auto baselines = zvoBaselineKernels();
        std::vector<vk::EmbeddedKernel> all(own.begin(), own.end());
        all.insert(all.end(), baselines.begin(), baselines.end());
        return all;
    }();
    return kernels;
}

} // namespace zvo::baseline
