// SPDX-License-Identifier: MIT
// Two devices in one process, each with a context of its own: nothing of zvo is global. On a machine with several
// devices that will do, they are different ones; the pictures are the same bytes all the same.
//
//     two_contexts a.ppm b.ppm
//
// Both are the bytes of
//
//     zvo render knot.ply -o picture.png --resolution 128 --size 320x200 --camera 1.5,2,3.5,0,0,0,26
#include "common/start.h"

#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

namespace
{

constexpr VkExtent2D kSize = {320, 200};
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr host::Edge kZvoWrites = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

// One device, and a tree that is being built on it. Members go in reverse: what a context made, then it, then the
// device.
class World
{
public:
    World(const host::Options& options, std::size_t number)
        : m_start(options, nullptr, number), m_context(m_start.contextInfo()), m_commands(device().makeCommands()),
          m_image(device(), kFormat, kSize, VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT),
          m_tracer(m_context, kSize.width, kSize.height, kFormat)
    {
        std::printf("%s\n", m_context.report().name.c_str());
    }

    // Takes one step: the model, then the tree's, then the picture. False when there is none left.
    bool step()
    {
        if (m_is_done)
        {
            return false;
        }
        device().begin(m_commands);
        {
            zvo::Recorder recorder(m_context, m_commands, ++m_frame);
            record(recorder);
        }
        device().submitAndWait(m_commands);
        m_context.frameDone(m_frame);
        return true;
    }

    void save(const std::filesystem::path& path) const { m_image.savePpm(path); }

private:
    [[nodiscard]] const host::Device& device() const { return m_start.device(); }

    void record(zvo::Recorder& recorder)
    {
        if (!m_build)
        {
            const host::ZvoMesh mesh(host::knot());
            const zvo::MeshInfo mesh_info = mesh.info();
            zvo::ModelInfo model_info;
            model_info.meshes = {&mesh_info, 1};
            const zvo::Model model(recorder, model_info); // the build keeps what it needs of it
            zvo::TreeBuildInfo build_info;
            build_info.grid = model.gridAround(7);
            m_build.emplace(m_context, model, build_info);
        }
        else if (!m_build->record(recorder))
        {
            m_tree.emplace(m_build->take());
            const auto camera = zvo::CameraInfo::lookAt({1.5, 2, 3.5}, {0, 0, 0}, 26 * (std::numbers::pi / 180));
            m_image.barrier(m_commands, {}, kZvoWrites);
            m_tracer.trace(recorder, *m_tree, camera, {}, {m_image.handle(), kFormat, kZvoWrites.layout});
            m_image.barrier(m_commands, kZvoWrites, host::Image::kRead);
            m_image.readBack(m_commands);
            m_is_done = true;
        }
    }

    host::Start m_start;
    zvo::Context m_context;
    VkCommandBuffer m_commands;
    host::Image m_image;
    zvo::Tracer m_tracer;
    std::optional<zvo::TreeBuild> m_build;
    std::optional<zvo::Tree> m_tree;
    std::uint64_t m_frame = 0;
    bool m_is_done = false;
};

void embed(const host::Options& options)
{
    World a(options, 0);
    World b(options, 1);
    // In turn. A context is used by one thread at a time; two contexts may be used by two threads.
    while (static_cast<int>(a.step()) + static_cast<int>(b.step()) > 0)
    {
    }
    a.save(options.arguments[0]);
    b.save(options.arguments[1]);
}

} // namespace

int main(int count, char** arguments)
{
    return host::run(count, arguments, "A B", 2, embed);
}
