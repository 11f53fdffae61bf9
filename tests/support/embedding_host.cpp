// SPDX-License-Identifier: MIT
#include "support/embedding_host.h"

#include "vk/check.h"

#include <algorithm>

namespace zvo::test
{

namespace
{

ContextInfo changed(ContextInfo info, const std::function<void(ContextInfo&)>& change)
{
    if (change)
    {
        change(info);
    }
    return info;
}

std::uint32_t texelBytes(VkFormat format)
{
    return format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8 : 4;
}

VkImageAspectFlags aspectOf(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

} // namespace

Declaration::Declaration(const HostDevice& host) : handles(host.handles())
{
    const auto pointers = [](const std::vector<std::string>& names)
    {
        std::vector<const char*> result;
        for (const std::string& name : names)
        {
            result.push_back(name.c_str());
        }
        return result;
    };
    instance_extensions = pointers(handles.instance_extensions);
    device_extensions = pointers(handles.device_extensions);
    info.get_instance_proc_addr = handles.get_instance_proc_addr;
    info.instance = handles.instance;
    info.physical_device = handles.physical_device;
    info.device = handles.device;
    info.queue_family = handles.queue_family;
    info.instance_api_version = handles.instance_api_version;
    info.instance_extensions = instance_extensions;
    info.device_extensions = device_extensions;
    info.enabled_features = handles.enabled_features;
    info.enabled_core_features = handles.enabled_core_features;
    info.allocation_callbacks = handles.allocation_callbacks;
    info.pipeline_cache = handles.pipeline_cache;
    info.memory = handles.memory;
    info.memory_budget_bytes = handles.memory_budget_bytes;
    info.log = handles.log;
}

TargetImage::TargetImage(HostDevice& host, VkFormat format, std::uint32_t width, std::uint32_t height)
    : m_host(host), m_format(format), m_width(width), m_height(height)
{
    const vk::Functions& fn = host.fn();
    VkImageCreateInfo image{};
    image.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    image.imageType = VK_IMAGE_TYPE_2D;
    image.format = format;
    image.extent = {width, height, 1};
    image.mipLevels = 1;
    image.arrayLayers = 1;
    image.samples = VK_SAMPLE_COUNT_1_BIT;
    image.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    VK_CHECK(fn.vkCreateImage(host.device(), &image, nullptr, &m_image));
    VkMemoryRequirements requirements{};
    fn.vkGetImageMemoryRequirements(host.device(), m_image, &requirements);
    m_image_memory = allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    VK_CHECK(fn.vkBindImageMemory(host.device(), m_image, m_image_memory, 0));

    VkBufferCreateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    buffer.size = VkDeviceSize{width} * height * texelBytes(format);
    buffer.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VK_CHECK(fn.vkCreateBuffer(host.device(), &buffer, nullptr, &m_buffer));
    fn.vkGetBufferMemoryRequirements(host.device(), m_buffer, &requirements);
    m_buffer_memory =
        allocate(requirements, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VK_CHECK(fn.vkBindBufferMemory(host.device(), m_buffer, m_buffer_memory, 0));
    void* mapped = nullptr;
    VK_CHECK(fn.vkMapMemory(host.device(), m_buffer_memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    m_mapped = mapped;
}

TargetImage::~TargetImage()
{
    const vk::Functions& fn = m_host.fn();
    fn.vkDestroyImage(m_host.device(), m_image, nullptr);
    fn.vkDestroyBuffer(m_host.device(), m_buffer, nullptr);
    fn.vkFreeMemory(m_host.device(), m_image_memory, nullptr);
    fn.vkFreeMemory(m_host.device(), m_buffer_memory, nullptr);
}

VkDeviceMemory TargetImage::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted)
{
    VkPhysicalDeviceMemoryProperties properties{};
    m_host.fn().vkGetPhysicalDeviceMemoryProperties(m_host.physicalDevice(), &properties);
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = requirements.size;
    while ((requirements.memoryTypeBits & (1U << info.memoryTypeIndex)) == 0 ||
           (properties.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted)
    {
        ++info.memoryTypeIndex;
    }
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VK_CHECK(m_host.fn().vkAllocateMemory(m_host.device(), &info, nullptr, &memory));
    return memory;
}

void TargetImage::change(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to, VkAccessFlags2 before,
                         VkAccessFlags2 after)
{
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.srcAccessMask = before;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstAccessMask = after;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = m_image;
    barrier.subresourceRange = {aspectOf(m_format), 0, 1, 0, 1};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    m_host.fn().vkCmdPipelineBarrier2(commands, &info);
}

void TargetImage::beginCopies(VkCommandBuffer commands)
{
    change(commands, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_2_TRANSFER_WRITE_BIT,
           VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

void TargetImage::read(VkCommandBuffer commands, bool without_barrier)
{
    if (!without_barrier)
    {
        change(commands, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_2_TRANSFER_WRITE_BIT,
               VK_ACCESS_2_TRANSFER_READ_BIT);
    }
    VkBufferImageCopy region{};
    region.imageSubresource = {aspectOf(m_format), 0, 0, 1};
    region.imageExtent = {m_width, m_height, 1};
    m_host.fn().vkCmdCopyImageToBuffer(commands, m_image, VK_IMAGE_LAYOUT_GENERAL, m_buffer, 1, &region);
}

ImageTarget TargetImage::target() const
{
    ImageTarget target;
    target.image = m_image;
    target.format = m_format;
    target.layout = VK_IMAGE_LAYOUT_GENERAL;
    return target;
}

std::vector<std::uint32_t> TargetImage::words() const
{
    const auto* const words = static_cast<const std::uint32_t*>(m_mapped);
    return {words, words + std::size_t{m_width} * m_height * texelBytes(m_format) / 4};
}

EmbeddingHost::EmbeddingHost(const HostOptions& options, const std::function<void(ContextInfo&)>& change)
    : device(options), declaration(device), context(changed(declaration.info, change))
{
}

void EmbeddingHost::frame(const std::function<void(Recorder&, VkCommandBuffer)>& record)
{
    VkCommandBuffer commands = device.begin();
    try
    {
        Recorder recorder(context, commands, last_frame + 1);
        record(recorder, commands);
    }
    catch (...)
    {
        if (submits_failed)
        {
            submit(commands);
        }
        else
        {
            context.frameLost(last_frame + 1);
        }
        throw;
    }
    submit(commands);
}

void EmbeddingHost::submit(VkCommandBuffer commands)
{
    ++last_frame;
    device.submit(commands);
    device.wait();
    context.frameDone(last_frame);
}

void EmbeddingHost::lostFrame(const std::function<void(Recorder&, VkCommandBuffer)>& record)
{
    VkCommandBuffer commands = device.begin();
    {
        Recorder recorder(context, commands, last_frame + 1);
        record(recorder, commands);
    }
    context.frameLost(last_frame + 1);
}

void EmbeddingHost::frame(const std::function<void(Recorder&)>& record)
{
    frame([&](Recorder& recorder, VkCommandBuffer) { record(recorder); });
}

void EmbeddingHost::lostFrame(const std::function<void(Recorder&)>& record)
{
    lostFrame([&](Recorder& recorder, VkCommandBuffer) { record(recorder); });
}

std::uint32_t EmbeddingHost::finish(TreeJob& job)
{
    std::uint32_t count = 0;
    for (; !job.isDone(); ++count)
    {
        frame([&](Recorder& recorder) { job.record(recorder); });
    }
    return count;
}

Tree EmbeddingHost::build(const Model& model, const TreeBuildInfo& info)
{
    TreeBuild build(context, model, info);
    finish(build);
    return build.take();
}

Tree EmbeddingHost::compress(Tree&& octree)
{
    TreeCompression compression(context, std::move(octree));
    finish(compression);
    return compression.take();
}

DynamicObjectId EmbeddingHost::add(DynamicTree& tree, const Model& model, const Mat4& to_world)
{
    DynamicObjectId object = 0;
    frame([&](Recorder& recorder) { object = tree.addObject(recorder, model, to_world); });
    return object;
}

void EmbeddingHost::update(DynamicTree& tree)
{
    do
    {
        frame([&](Recorder& recorder) { tree.update(recorder); });
    } while (tree.needsUpdate());
}

void EmbeddingHost::edit(DynamicTree& tree, const BrushInfo& brush)
{
    for (bool is_recorded = false; !is_recorded;)
    {
        frame([&](Recorder& recorder) { is_recorded = tree.edit(recorder, brush); });
    }
}

} // namespace zvo::test
