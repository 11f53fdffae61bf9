// SPDX-License-Identifier: MIT
// zvo_gpu_code SIZE... < variants: makes the pipelines of kernels on the device that ZVO_TEST_DEVICE names, in
// subgroups of each size, and prints what the driver says of their machine code, a line of JSON each, behind one on the
// device. Nothing runs: a driver that only compiles is enough, such as that of RADV_FORCE_FAMILY. A variant is a line,
// the name of the kernel and the values of its specialization constants. scripts/check-gpu-code runs it.
//
// zvo_gpu_code --tuning: prints what zvo chooses on GPUs, as the option --tuning takes it.
#include "core/base/kernels.h"
#include "core/base/tuning.h"
#include "support/host_device.h"
#include "vk/check.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

namespace
{

std::string tuningOfGpus()
{
    vk::TuningValues values;
    for (const TuningRow& row : tuningTable())
    {
        values.emplace(row.name, row.on_gpus);
    }
    return tuningText(values);
}

struct Variant
{
    std::string kernel;
    vk::Specialization constants;
};

std::vector<Variant> readVariants(std::istream& in)
{
    std::vector<Variant> variants;
    for (std::string line; std::getline(in, line);)
    {
        std::istringstream words(line);
        Variant& variant = variants.emplace_back();
        words >> variant.kernel;
        for (std::uint32_t value = 0; words >> value;)
        {
            variant.constants.push_back(value);
        }
    }
    return variants;
}

// `"kernel": ..., "constants": ...: the constants by id as spirv-opt takes them; "variant": ...`: the kernel's name,
// and by name the constants that do not have their default values.
std::string nameText(const Variant& variant, const vk::KernelInterface& interface)
{
    std::vector<std::string> by_id;
    std::vector<std::string> changed;
    for (const vk::ModuleConstant& constant : interface.constants)
    {
        const std::uint32_t value =
            constant.id < variant.constants.size() ? variant.constants[constant.id] : constant.value;
        const std::string text = constant.type == vk::ConstantType::Bool ? (value != 0 ? "true" : "false")
                                 : constant.type == vk::ConstantType::Int
                                     ? std::to_string(static_cast<std::int32_t>(value))
                                     : std::to_string(value);
        by_id.push_back(fmt::format("{}:{}", constant.id, text));
        if (value != constant.value)
        {
            changed.push_back(fmt::format("{}={}", constant.name, text));
        }
    }
    return fmt::format(R"("kernel": "{0}", "constants": "{1}", "variant": "{0}{2}")", variant.kernel,
                       fmt::join(by_id, " "), changed.empty() ? "" : fmt::format("({})", fmt::join(changed, ",")));
}

PFN_vkCreateComputePipelines g_create_pipelines = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL createWithStatistics(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                                    const VkComputePipelineCreateInfo* infos,
                                                    const VkAllocationCallbacks* callbacks, VkPipeline* pipelines)
{
    std::vector<VkComputePipelineCreateInfo> changed(infos, infos + count);
    for (VkComputePipelineCreateInfo& info : changed)
    {
        info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    }
    return g_create_pipelines(device, cache, count, changed.data(), callbacks, pipelines);
}

std::string valueText(const VkPipelineExecutableStatisticKHR& statistic)
{
    switch (statistic.format)
    {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
        return statistic.value.b32 != VK_FALSE ? "true" : "false";
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
        return std::to_string(statistic.value.i64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
        return std::to_string(statistic.value.u64);
    default:
        return fmt::format("{}", statistic.value.f64);
    }
}

// A device whose pipelines come with statistics.
class StatisticsDevice
{
public:
    StatisticsDevice() : m_host(options(m_features))
    {
        m_functions = vk::Functions::ofDevice(m_host.fn().vkGetInstanceProcAddr, m_host.instance(), m_host.device());
        g_create_pipelines = m_functions.vkCreateComputePipelines;
        m_functions.vkCreateComputePipelines = createWithStatistics;
        load(m_get_statistics, "vkGetPipelineExecutableStatisticsKHR");
    }

    /// zvo on this device, with subgroups of this size.
    [[nodiscard]] std::unique_ptr<vk::Device> make(std::uint32_t subgroup_size) const
    {
        vk::DeviceHandles handles = m_host.handles();
        handles.functions = &m_functions;
        handles.tuning = {{vk::kSubgroupSizeName, subgroup_size}};
        return std::make_unique<vk::Device>(handles, zvoKernels());
    }

    /// `"NAME": VALUE` for each statistic.
    [[nodiscard]] std::string statistics(VkPipeline pipeline) const
    {
        VkPipelineExecutableInfoKHR executable{}; // the first, and with compute pipelines the only one
        executable.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
        executable.pipeline = pipeline;
        std::uint32_t count = 0;
        VK_CHECK(m_get_statistics(m_host.device(), &executable, &count, nullptr));
        VkPipelineExecutableStatisticKHR empty{};
        empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
        std::vector<VkPipelineExecutableStatisticKHR> all(count, empty);
        VK_CHECK(m_get_statistics(m_host.device(), &executable, &count, all.data()));
        std::vector<std::string> texts;
        texts.reserve(count);
        for (const VkPipelineExecutableStatisticKHR& statistic : all)
        {
            texts.push_back(fmt::format("\"{}\": {}", statistic.name, valueText(statistic)));
        }
        return fmt::format("{}", fmt::join(texts, ", "));
    }

private:
    using Features = VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR;

    static test::HostOptions options(Features& features)
    {
        test::HostOptions options;
        options.device_extensions = {VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME};
        options.optional.subgroup_sizes = true;
        options.optional.int64_atomics = true;
        options.prepare = [&features](VkDeviceCreateInfo& info)
        {
            features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
            features.pipelineExecutableInfo = VK_TRUE;
            info.pNext = &features;
        };
        return options;
    }

    template <typename Function> void load(Function& function, const char* name)
    {
        function = reinterpret_cast<Function>(m_functions.vkGetDeviceProcAddr(m_host.device(), name));
    }

    Features m_features{};
    test::HostDevice m_host;
    vk::Functions m_functions;
    PFN_vkGetPipelineExecutableStatisticsKHR m_get_statistics = nullptr;
};

void run(const std::vector<std::uint32_t>& sizes)
{
    const std::vector<Variant> variants = readVariants(std::cin);
    // Lives until the process ends: on a device that only compiles, RADV does not survive that somebody waits.
    static const auto& statistics_device = *new StatisticsDevice;
    for (const std::uint32_t size : sizes)
    {
        const std::unique_ptr<vk::Device> device = statistics_device.make(size);
        if (size == sizes.front())
        {
            fmt::print("{{\"device\": \"{}\", \"driver\": \"{}\"}}\n", device->report().name, device->report().driver);
        }
        for (const Variant& variant : variants)
        {
            const vk::Kernel& kernel = device->kernels().get(variant.kernel, variant.constants);
            fmt::print("{{{}, \"subgroup\": {}, {}}}\n", nameText(variant, kernel.interface), size,
                       statistics_device.statistics(kernel.pipeline));
        }
    }
}

} // namespace

} // namespace zvo

int main(int argc, char** argv)
{
    try
    {
        if (argc == 2 && std::string_view(argv[1]) == "--tuning")
        {
            fmt::print("{}\n", zvo::tuningOfGpus());
            return 0;
        }
        std::vector<std::uint32_t> sizes;
        for (int i = 1; i < argc; ++i)
        {
            sizes.push_back(static_cast<std::uint32_t>(std::stoul(argv[i])));
        }
        zvo::run(sizes);
        return 0;
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
