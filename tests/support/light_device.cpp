// SPDX-License-Identifier: MIT
#include "support/light_device.h"

#include "core/base/kernels.h"
#include "support/device.h"

#include <span>
#include <vector>

namespace zvo
{

std::span<const vk::EmbeddedKernel> lightTestKernels();

namespace test
{

vk::HeadlessDevice& lightDevice()
{
    static const std::vector<vk::EmbeddedKernel> kernels = []
    {
        std::vector<vk::EmbeddedKernel> all(zvoKernels().begin(), zvoKernels().end());
        all.insert(all.end(), lightTestKernels().begin(), lightTestKernels().end());
        return all;
    }();
    return sharedDevice(kernels);
}

} // namespace test
} // namespace zvo
