// SPDX-License-Identifier: MIT
#include "picture.h"

#include "common/environment_input.h"
#include "common/output.h"
#include "common/picture_file.h"
#include "common/tree_input.h"
#include "common/view.h"
#include "core/frame/frame_renderer.h"
#include "core/scene/camera.h"

#include <optional>

namespace zvo::python
{

namespace
{

ViewCamera cameraOf(const Tree& tree, const PictureOptions& options)
{
    if (!options.view.empty())
    {
        return cli::cameraOfNumbers(options.view);
    }
    const TreeData data = tree.download();
    const double aspect = static_cast<double>(options.width) / options.height;
    return cli::chooseCamera(options.camera, Scene(), cli::subjectOf(cli::boundsOf(data), data.grid), aspect);
}

// Those of `zvo render`.
FrameOptions frameOptions(const PictureOptions& options)
{
    FrameOptions frame;
    frame.integrator = options.integrator;
    frame.antialias = options.samples > 1;
    frame.denoise = options.denoise;
    frame.trace.occlusion_rays = 8;
    return frame;
}

std::vector<std::uint32_t> render(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera,
                                  const PictureOptions& options)
{
    const FrameOptions frame = frameOptions(options);
    std::optional<DeviceEnvironment> environment;
    if (frame.integrator != Integrator::Primary)
    {
        environment = cli::readEnvironment(device.device(), {}, std::nullopt);
    }
    const FrameSubject subject = {tree, camera, environment ? &*environment : nullptr};
    FrameRenderer renderer(device.device());
    renderer.resize(options.width, options.height);
    renderer.reserve(tree, frame);
    for (std::uint32_t sample = 0; sample < options.samples; ++sample)
    {
        device.run([&](vk::FrameGraph& graph) { renderer.addSample(graph, subject, frame); });
    }
    device.run(
        [&](vk::FrameGraph& graph)
        {
            renderer.denoise(graph, frame);
            renderer.develop(graph, frame);
        });
    return device.download(renderer.buffers().image);
}

} // namespace

std::vector<std::uint32_t> render(const Tree& tree, const PictureOptions& options)
{
    const TraceCamera camera = traceCamera(cameraOf(tree, options), tree.device().grid, options.height);
    return tree.session().use([&](vk::HeadlessDevice& device)
                              { return render(device, tree.device(), camera, options); });
}

void writePicture(const std::string& path, std::uint32_t width, std::uint32_t height,
                  std::span<const std::uint32_t> texels)
{
    constexpr std::array<std::string_view, 4> kKinds = {".png", ".jpg", ".jpeg", ".webp"};
    cli::checkPictureName("picture", path, kKinds);
    cli::Output output(path, true);
    const std::vector<std::uint8_t> encoded = cli::encodePicture(path, width, height, texels);
    output.write(std::as_bytes(std::span(encoded)));
    output.finish();
}

} // namespace zvo::python
