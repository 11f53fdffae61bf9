// SPDX-License-Identifier: MIT
#include "support/device.h"

#include "vk/log_file.h"

#include <cassert>
#include <cstdlib>
#include <memory>
#include <string_view>

namespace zvo::test
{

namespace
{

std::unique_ptr<vk::HeadlessDevice> g_device;
std::span<const vk::EmbeddedKernel> g_kernels;
std::atomic<std::uint32_t> g_message_count = 0;

} // namespace

vk::HeadlessOptions deviceOptions()
{
    const char* variable = std::getenv("ZVO_TEST_VALIDATION");
    const std::string_view validation = variable != nullptr ? variable : "";
    const char* name = std::getenv("ZVO_TEST_DEVICE");
    vk::HeadlessOptions options;
    options.device = name != nullptr ? name : "cpu";
    options.validation = validation == "1" || validation == "2";
    options.gpu_assisted_validation = validation == "2";
    options.message_counter = &g_message_count;
    options.log = vk::logToFile(std::getenv("ZVO_LOG"));
    const char* type = std::getenv("ZVO_TEST_TYPE");
    options.overrides.type = type != nullptr ? type : "";
    if (options.gpu_assisted_validation)
    {
        // The instrumentation takes a vec3, and each column of a matrix, for as long as a vec4, also at a buffer's end.
        options.overrides.buffer_slack = 64;
        // It checks accesses through addresses, and changes what kernels read through descriptors beside its own.
        options.tuning[vk::kLoadsName] = static_cast<std::uint32_t>(vk::LoadForm::Addresses);
    }
    return options;
}

vk::HeadlessDevice& sharedDevice(std::span<const vk::EmbeddedKernel> kernels)
{
    if (!g_device)
    {
        g_device = std::make_unique<vk::HeadlessDevice>(deviceOptions(), kernels);
        g_kernels = kernels;
    }
    assert(g_kernels.data() == kernels.data());
    return *g_device;
}

std::uint32_t validationMessageCount()
{
    return g_message_count;
}

void destroySharedDevice()
{
    g_device.reset();
}

} // namespace zvo::test
