// SPDX-License-Identifier: MIT
// A host that embeds zvo through its public API: a Context, frames, and an image of its own.
#pragma once

#include "support/host_device.h"
#include "zvo/zvo.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace zvo::test
{

/// What a host declares, as zvo::Context takes it. host must outlive it; handles keeps what it points to.
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

/// An image of a host's in device memory, that pictures are copied to and that copies back.
class TargetImage
{
public:
    TargetImage(HostDevice& host, VkFormat format, std::uint32_t width, std::uint32_t height);
    ~TargetImage();
    TargetImage(const TargetImage&) = delete;
    TargetImage& operator=(const TargetImage&) = delete;

    /// The edge barrier before: what it held is lost.
    void beginCopies(VkCommandBuffer commands);

    /// The edge barrier after it, and a copy to the host's memory. without_barrier: what a host must not do.
    void read(VkCommandBuffer commands, bool without_barrier = false);

    [[nodiscard]] ImageTarget target() const;

    /// Words of what read() copied, once the device is done.
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
    /// change: of what it declares.
    explicit EmbeddingHost(const HostOptions& options = {}, const std::function<void(ContextInfo&)>& change = {});

    /// Records a frame, submits it, waits and says that it is done. Throws what record throws; the frame is lost then,
    /// or with submits_failed, submitted all the same.
    void frame(const std::function<void(Recorder&, VkCommandBuffer)>& record);

    /// Records a frame that never reaches the device.
    void lostFrame(const std::function<void(Recorder&, VkCommandBuffer)>& record);

    /// Frames until the job, a TreeBuild or a TreeCompression, is done. Returns how many.
    template <typename Job> std::uint32_t finish(Job& job)
    {
        std::uint32_t count = 0;
        for (; !job.isDone(); ++count)
        {
            frame([&](Recorder& recorder, VkCommandBuffer) { job.record(recorder); });
        }
        return count;
    }

    Model upload(const ModelInfo& info);
    Tree build(const Model& model, const TreeBuildInfo& info);

    /// A picture of a tree: width * height words, for formats of 4 bytes.
    template <typename AnyTree>
    std::vector<std::uint32_t> picture(AnyTree& tree, const CameraInfo& camera, const TraceInfo& info = {})
    {
        Tracer tracer(context, kWidth, kHeight, VK_FORMAT_R8G8B8A8_UNORM);
        TargetImage image(device, VK_FORMAT_R8G8B8A8_UNORM, kWidth, kHeight);
        frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                image.beginCopies(commands);
                tracer.trace(recorder, tree, camera, info, image.target());
                image.read(commands);
            });
        return image.words();
    }

    static constexpr std::uint32_t kWidth = 101; // of pictures: no multiple of a tile
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
