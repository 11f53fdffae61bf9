// SPDX-License-Identifier: MIT
// The least that a program does to see voxels: its own Vulkan device, command buffer and image, and zvo in between.
//
//     embed_minimal picture.ppm              a mesh of the program's own
//     embed_minimal picture.ppm scene.zvo    what `zvo build` made
//
// The picture is the bytes of
//
//     zvo render knot.ply -o picture.png --resolution 128 --size 320x200 --camera 1.5,2,3.5,0,0,0,26
#include "common/host.h"
#include "common/mesh.h"
#include "common/program.h"
#include "zvo/zvo.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace
{

constexpr VkExtent2D kSize = {320, 200};
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

// What zvo does to the images that it gets, as zvo/tracer.h states it. The host's barriers lead there and away.
constexpr host::Edge kZvoWrites = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

void embed(const host::Options& options)
{
    // 1. Of the devices that there are, zvo says which will do, and why others will not.
    const host::Instance instance(options.validation);
    std::optional<zvo::DeviceReport> report;
    for (VkPhysicalDevice candidate : instance.physicalDevices(options.device))
    {
        report = zvo::query(instance.getProcAddr(), instance.handle(), candidate, host::Instance::kApiVersion);
        if (report->usable())
        {
            break;
        }
        std::fprintf(stderr, "%s: %s\n", report->name.c_str(), report->reasons.front().c_str());
    }
    if (!report || !report->usable())
    {
        throw std::runtime_error("there is no device that zvo can use");
    }

    // 2. The host creates the device, with the features of its own, and those that zvo adds. What zvo can do without
    // changes no picture: here, that it can tell how long its passes take.
    VkDeviceCreateInfo device_info{};
    device_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    zvo::FeatureStorage features;
    zvo::OptionalFeatures optional;
    optional.pass_times = options.optional && std::ranges::count(report->present, "hostQueryReset") != 0;
    zvo::patchFeatures(device_info, features, optional);
    const std::uint32_t family = instance.queueFamily(report->physical_device);
    const host::Device device(instance, report->physical_device, family, device_info);

    // 3. The context: zvo on that device. What was enabled is declared, as Vulkan does not tell.
    zvo::ContextInfo info;
    info.get_instance_proc_addr = instance.getProcAddr();
    info.instance = instance.handle();
    info.physical_device = device.physicalDevice();
    info.device = device.handle();
    info.queue_family = family;
    info.instance_api_version = host::Instance::kApiVersion;
    info.instance_extensions = instance.extensions();
    info.enabled_features = device_info.pNext;
    info.enabled_core_features = device_info.pEnabledFeatures;
    info.timed_passes_per_frame = optional.pass_times ? 512 : 0;
    zvo::Context context(info);

    // 4. Everything that the device does is recorded into command buffers of the host's, frame by frame. The host
    // submits them, and says when the device is done. This host waits for each: frames_in_flight does not.
    VkCommandBuffer commands = device.makeCommands();
    std::uint64_t frame = 0;
    const auto run = [&](const auto& record)
    {
        device.begin(commands);
        {
            zvo::Recorder recorder(context, commands, ++frame);
            record(recorder);
        } // the Recorder goes before the command buffer ends
        device.submitAndWait(commands);
        context.frameDone(frame);
    };

    // 5. A tree: of a file, or of triangles in steps, as the device finds out what sizes it takes.
    std::optional<zvo::Tree> tree;
    if (options.arguments.size() > 1)
    {
        run([&](zvo::Recorder& recorder) { tree.emplace(recorder, std::filesystem::path(options.arguments[1])); });
    }
    else
    {
        const host::ZvoMesh mesh(host::knot());
        const zvo::MeshInfo mesh_info = mesh.info();
        zvo::ModelInfo model_info;
        model_info.meshes = {&mesh_info, 1};
        std::optional<zvo::Model> model;
        run([&](zvo::Recorder& recorder) { model.emplace(recorder, model_info); });
        zvo::TreeBuildInfo build_info;
        build_info.grid = model->gridAround(7); // 2^7 voxels an edge
        zvo::TreeBuild build(context, *model, build_info);
        for (bool has_more = true; has_more;)
        {
            run([&](zvo::Recorder& recorder) { has_more = build.record(recorder); });
        }
        tree.emplace(build.take());
    }

    // 6. A picture in the host's image, between the host's barriers.
    const host::Image image(device, kFormat, kSize, VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    zvo::Tracer tracer(context, kSize.width, kSize.height, kFormat);
    const auto camera = zvo::CameraInfo::lookAt({1.5, 2, 3.5}, {0, 0, 0}, 26 * (std::numbers::pi / 180));
    run(
        [&](zvo::Recorder& recorder)
        {
            image.barrier(commands, {}, kZvoWrites);
            tracer.trace(recorder, *tree, camera, {}, {image.handle(), kFormat, kZvoWrites.layout});
            image.barrier(commands, kZvoWrites, host::Image::kRead);
            image.readBack(commands);
        });
    image.savePpm(options.arguments[0]);

    std::printf("%s: %llu voxels in %llu bytes\n", report->name.c_str(),
                static_cast<unsigned long long>(tree->info().voxel_count),
                static_cast<unsigned long long>(tree->info().bytes));
    for (const zvo::PassTime& pass : context.passTimes())
    {
        std::printf("%8.3f ms  %s\n", pass.ms, pass.name.c_str());
    }
} // The tracer and the tree go before the context, and that before the device.

} // namespace

int main(int count, char** arguments)
{
    return host::run(count, arguments, "PICTURE [SCENE.zvo]", 1, embed);
}
