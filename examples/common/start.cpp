// SPDX-License-Identifier: MIT
#include "common/start.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

namespace host
{

Start::Start(const Options& options, void* host_features, std::size_t number) : m_instance(options.validation)
{
    std::vector<zvo::DeviceReport> usable;
    for (VkPhysicalDevice candidate : m_instance.physicalDevices(options.device))
    {
        zvo::DeviceReport report =
            zvo::query(m_instance.getProcAddr(), m_instance.handle(), candidate, Instance::kApiVersion);
        if (report.usable())
        {
            usable.push_back(std::move(report));
        }
    }
    if (usable.empty())
    {
        throw std::runtime_error("there is no device that zvo can use");
    }
    const zvo::DeviceReport& report = usable[number % usable.size()];
    const auto has = [&](const char* feature)
    { return options.optional && std::ranges::find(report.present, feature) != report.present.end(); };
    zvo::OptionalFeatures optional;
    optional.pass_times = has("hostQueryReset");
    optional.subgroup_sizes = has("subgroupSizeControl");
    optional.int64_atomics = has("shaderBufferInt64Atomics");
    m_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    m_info.pNext = host_features;
    zvo::patchFeatures(m_info, m_features, optional);
    m_device = std::make_unique<Device>(m_instance, report.physical_device,
                                        m_instance.queueFamily(report.physical_device), m_info);
}

zvo::ContextInfo Start::contextInfo() const
{
    zvo::ContextInfo info;
    info.get_instance_proc_addr = m_instance.getProcAddr();
    info.instance = m_instance.handle();
    info.physical_device = m_device->physicalDevice();
    info.device = m_device->handle();
    info.queue_family = m_device->queueFamily();
    info.instance_api_version = Instance::kApiVersion;
    info.instance_extensions = m_instance.extensions();
    info.enabled_features = m_info.pNext;
    info.enabled_core_features = m_info.pEnabledFeatures;
    return info;
}

zvo::Tree buildTree(const Device& device, zvo::Context& context, const Mesh& mesh, std::uint32_t depth,
                    std::uint64_t& frame, bool keep_sums)
{
    const ZvoMesh arrays(mesh);
    const zvo::MeshInfo mesh_info = arrays.info();
    zvo::ModelInfo model_info;
    model_info.meshes = {&mesh_info, 1};
    return buildTree(device, context, model_info, depth, frame, keep_sums);
}

zvo::Tree buildTree(const Device& device, zvo::Context& context, const zvo::ModelInfo& model_info, std::uint32_t depth,
                    std::uint64_t& frame, bool keep_sums)
{
    VkCommandBuffer commands = device.makeCommands();
    std::optional<zvo::Model> model;
    std::optional<zvo::TreeBuild> build;
    for (bool has_more = true; has_more;)
    {
        device.begin(commands);
        {
            zvo::Recorder recorder(context, commands, ++frame);
            if (!build)
            {
                model.emplace(recorder, model_info);
                zvo::TreeBuildInfo info;
                info.grid = model->gridAround(depth);
                info.keep_sums = keep_sums;
                build.emplace(context, *model, info);
            }
            has_more = build->record(recorder);
        }
        device.submitAndWait(commands);
        context.frameDone(frame);
    }
    return build->take();
}

} // namespace host
