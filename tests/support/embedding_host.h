// SPDX-License-Identifier: MIT
// A host that embeds zvo through its public API: a Context, frames, and an image of its own.
#pragma once

#include "support/host_device.h"
#include "zvo/zvo.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace zvo::test
{

/// A host's declaration for zvo::Context. host must outlive it; handles keeps the arrays it points to.
struct Declaration
{
    explicit Declaration(const HostDevice& host);
    Declaration(const Declaration&) = delete;
    Declaration& operator=(const Declaration&) = delete;

    vk::DeviceHandles handles;
    std::vector<const char*> instance_extensions;
    std::vector<const char*> device_extensions;
    ContextInfo info;
};

/// A host's image in device memory, into which pictures are copied and which can be read back.
class TargetImage
{
public:
    TargetImage(HostDevice& host, VkFormat format, std::uint32_t width, std::uint32_t height);
    ~TargetImage();
    TargetImage(const TargetImage&) = delete;
    TargetImage& operator=(const TargetImage&) = delete;

    /// Records the barrier before zvo's copies, and behind earlier ones, which discards the image's contents.
    void beginCopies(VkCommandBuffer commands);

    /// Records the barrier after zvo's copies, and a copy to the host's memory. without_barrier: leaves the barrier
    /// out, which hosts must not do.
    void read(VkCommandBuffer commands, bool without_barrier = false);

    [[nodiscard]] ImageTarget target() const;

    /// The words that read() copied, once the device is done.
    [[nodiscard]] std::vector<std::uint32_t> words() const;

private:
    VkDeviceMemory allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags properties);
    void change(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to, VkAccessFlags2 before,
                VkAccessFlags2 after);

    HostDevice& m_host;
    VkFormat m_format;
    std::uint32_t m_width;
    std::uint32_t m_height;
    VkImage m_image = VK_NULL_HANDLE;
    VkBuffer m_buffer = VK_NULL_HANDLE;
    VkDeviceMemory m_image_memory = VK_NULL_HANDLE;
    VkDeviceMemory m_buffer_memory = VK_NULL_HANDLE;
    const void* m_mapped = nullptr;
};

/// A host with one frame under way at a time.
class EmbeddingHost
{
public:
    /// change() edits the declaration before the Context is made from it.
    explicit EmbeddingHost(const HostOptions& options = {}, const std::function<void(ContextInfo&)>& change = {});

    /// Records a frame, submits it, waits, and reports it as done. If record throws, the exception is passed on; the
    /// frame is then lost or, with submits_failed, submitted all the same.
    void frame(const std::function<void(Recorder&, VkCommandBuffer)>& record);
    void frame(const std::function<void(Recorder&)>& record);

    /// Records a frame that never reaches the device.
    void lostFrame(const std::function<void(Recorder&, VkCommandBuffer)>& record);
    void lostFrame(const std::function<void(Recorder&)>& record);

    /// A Model, Tree, DynamicTree or Environment, which is made in a frame of its own.
    template <typename Object, typename... Arguments> Object make(Arguments&&... arguments)
    {
        std::optional<Object> object;
        frame([&](Recorder& recorder) { object.emplace(recorder, std::forward<Arguments>(arguments)...); });
        return std::move(*object);
    }

    /// Records frames until the job is done. Returns their number.
    std::uint32_t finish(TreeJob& job);

    Model upload(const ModelInfo& info) { return make<Model>(info); }
    Tree build(const Model& model, const TreeBuildInfo& info);
    Tree compress(Tree&& octree);

    DynamicObjectId add(DynamicTree& tree, const Model& model, const Mat4& to_world);

    /// Records updates, one a frame, until the current state is shown.
    void update(DynamicTree& tree);

    /// Records a dab, in as many frames as there has to be for it.
    void edit(DynamicTree& tree, const BrushInfo& brush);

    /// Records a picture in a frame of its own. Returns its words. trace: takes a Recorder and a target.
    template <typename Trace> std::vector<std::uint32_t> picture(TargetImage& image, const Trace& trace)
    {
        frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                image.beginCopies(commands);
                trace(recorder, image.target());
                image.read(commands);
            });
        return image.words();
    }

    /// Traces a picture of a tree: kWidth * kHeight words.
    template <typename AnyTree>
    std::vector<std::uint32_t> picture(AnyTree& tree, const CameraInfo& camera, const TraceInfo& info = {})
    {
        Tracer tracer(context, kWidth, kHeight, VK_FORMAT_R8G8B8A8_UNORM);
        TargetImage image(device, VK_FORMAT_R8G8B8A8_UNORM, kWidth, kHeight);
        return picture(image, [&](Recorder& recorder, const ImageTarget& target)
                       { tracer.trace(recorder, tree, camera, info, target); });
    }

    static constexpr std::uint32_t kWidth = 101; // picture size, no multiple of a tile
    static constexpr std::uint32_t kHeight = 67;

    HostDevice device;
    Declaration declaration;
    Context context;
    std::uint64_t last_frame = 0;
    bool submits_failed = false;

private:
    void submit(VkCommandBuffer commands);
};

} // namespace zvo::test
