// SPDX-License-Identifier: MIT
// Pictures and depth in a host's images. What was made in a buffer arrives at the requested position, and nothing else
// changes.
#include "core/base/kernels.h"
#include "core/present/image_target.h"
#include "core/trace/trace_depth.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/host_image.h"
#include "support/trace_octrees.h"
#include "vk/owner_functions.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::expectParts;
using test::HostImage;
using Words = std::vector<gpu::uint>;

constexpr VkFormat kColorFormats[] = {VK_FORMAT_R8G8B8A8_UNORM,           VK_FORMAT_R8G8B8A8_SRGB,
                                      VK_FORMAT_B8G8R8A8_UNORM,           VK_FORMAT_B8G8R8A8_SRGB,
                                      VK_FORMAT_A2B10G10R10_UNORM_PACK32, VK_FORMAT_R16G16B16A16_SFLOAT};
constexpr VkFormat kDepthFormats[] = {VK_FORMAT_D32_SFLOAT, VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_R32_SFLOAT};
constexpr VkImageLayout kLayouts[] = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_GENERAL};
constexpr VkExtent2D kExtent = {40, 28};
constexpr std::uint32_t kMipLevels = 3;
constexpr std::uint32_t kLayers = 2;

using test::device;

// Position and size of a picture in an image: sizes that are no multiples of a tile, up to the far corner of a mip
// level, or the whole level.
struct Place
{
    PictureSize size;
    VkOffset2D offset;
    std::uint32_t mip_level;
    std::uint32_t array_layer;
};
constexpr Place kPlaces[] = {
    {{40, 28}, {0, 0}, 0, 0}, {{17, 9}, {23, 19}, 0, 1}, {{13, 9}, {7, 5}, 1, 1},
    {{10, 7}, {0, 0}, 2, 0},  {{1, 1}, {3, 2}, 2, 1},
};

ImageTarget targetAt(const HostImage& image, VkFormat format, VkImageLayout layout, const Place& place)
{
    return {image.handle(), format, layout, place.offset, place.mip_level, place.array_layer};
}

// The words of all mip levels and layers.
class Contents
{
public:
    explicit Contents(HostImage& image)
    {
        for (std::uint32_t mip_level = 0; mip_level < kMipLevels; ++mip_level)
        {
            for (std::uint32_t layer = 0; layer < kLayers; ++layer)
            {
                m_words[mip_level][layer] = image.download(mip_level, layer);
            }
        }
    }

    // Puts a picture into the expected words, where a copy should put it.
    void place(const HostImage& image, const Place& place, const Words& picture)
    {
        const std::size_t words = image.texelWords();
        Words& texels = m_words[place.mip_level][place.array_layer];
        for (std::size_t y = 0; y < place.size.height; ++y)
        {
            const std::size_t row = static_cast<std::size_t>(place.offset.y) + y;
            const std::size_t to =
                row * image.extentOf(place.mip_level).width + static_cast<std::size_t>(place.offset.x);
            for (std::size_t i = 0; i < place.size.width * words; ++i)
            {
                texels.at(to * words + i) = picture.at(y * place.size.width * words + i);
            }
        }
    }

    friend bool operator==(const Contents&, const Contents&) = default;

private:
    std::array<std::array<Words, kLayers>, kMipLevels> m_words;
};

// Fills an image with words that differ from those of pictures; as floats, they lie in [0, 1].
void fillWithOthers(HostImage& image)
{
    for (std::uint32_t mip_level = 0; mip_level < kMipLevels; ++mip_level)
    {
        for (std::uint32_t layer = 0; layer < kLayers; ++layer)
        {
            const VkExtent2D extent = image.extentOf(mip_level);
            Words words(std::size_t{extent.width} * extent.height * image.texelWords());
            for (std::size_t i = 0; i < words.size(); ++i)
            {
                words[i] = 0x3E000000U + (mip_level << 16) + (layer << 20) + static_cast<gpu::uint>(i);
            }
            image.upload(mip_level, layer, words);
        }
    }
}

class ImageTargets : public testing::Test
{
protected:
    ImageTargets() : m_octree(test::octreeOf(device(), test::sphereShell(5, 14.0), 5)), m_paths(device().device()) {}

    // Traces a picture and its depth, then records further work into the same submission.
    void trace(TraceBuffers& buffers, vk::BufferOf<float>& depth, const std::function<void(vk::FrameGraph&)>& record)
    {
        const ViewCamera view =
            ViewCamera::framing({glm::vec3(0.0F), glm::vec3(32.0F)}, double(buffers.width) / buffers.height);
        const TraceCamera camera = traceCamera(view, m_octree.grid, buffers.height);
        ClipDepth clip; // 1 / (1 + distance)
        clip.z = {0.0, 0.0, 0.0, 1.0};
        clip.w = glm::dvec4(view.forward, 1.0 - glm::dot(view.forward, view.position));
        clip.miss = 0.0F;
        device().run(
            [&](vk::FrameGraph& graph)
            {
                buildNodePaths(graph, m_octree, m_paths);
                zvo::trace(graph, m_octree, m_paths, camera, {}, buffers);
                traceDepth(graph, m_octree.grid, camera, clip, buffers, depth);
                record(graph);
            });
    }

    template <typename Copy, typename Made>
    void expectToArrive(VkFormat format, TexelFormat texels, const Copy& copy, const Made& made);

    DeviceTree m_octree;
    NodePaths m_paths;
};

// Makes pictures and their depths, whose buffers take a texel format, of the size of every place, and copies from them
// into images of a format. copy(graph, buffers, depth, target, size) records the copy, made(buffers, depth) has the
// words that it should copy.
template <typename Copy, typename Made>
void ImageTargets::expectToArrive(VkFormat format, TexelFormat texels, const Copy& copy, const Made& made)
{
    HostImage image(device(), format, kExtent, kMipLevels, kLayers);
    fillWithOthers(image);
    Contents expected(image);
    for (const VkImageLayout layout : kLayouts)
    {
        for (const Place& place : kPlaces)
        {
            SCOPED_TRACE(testing::Message() << "format " << format << ", layout " << layout << ", mip level "
                                            << place.mip_level << ", " << place.size.width << " pixels wide");
            TraceBuffers buffers(device().device(), place.size.width, place.size.height, texels);
            vk::BufferOf<float> depth(device().device(), "depth", buffers.hits.count());
            trace(buffers, depth,
                  [&](vk::FrameGraph& graph)
                  {
                      image.beginCopies(graph, layout);
                      copy(graph, buffers, depth, targetAt(image, format, layout, place), place.size);
                      image.endCopies(graph);
                  });
            const Words words = made(buffers, depth);
            EXPECT_EQ(words.size(), buffers.hits.count() * image.texelWords());
            EXPECT_GE(std::set<gpu::uint>(words.begin(), words.end()).size(), buffers.hits.count() / 20);
            expected.place(image, place, words);
            EXPECT_TRUE(Contents(image) == expected);
        }
    }
}

TEST_F(ImageTargets, PicturesArriveInEveryFormatAtAnyPlace)
{
    for (const VkFormat format : kColorFormats)
    {
        expectToArrive(
            format, texelFormat(format),
            [](vk::FrameGraph& graph, const TraceBuffers& buffers, const auto&, const ImageTarget& target, PictureSize)
            { copyToImage(graph, buffers, target); },
            [](const TraceBuffers& buffers, const auto&) { return device().download(buffers.image); });
    }
}

TEST_F(ImageTargets, DepthArrivesInEveryFormatAtAnyPlace)
{
    for (const VkFormat format : kDepthFormats)
    {
        expectToArrive(
            format, TexelFormat::Rgba8,
            [](vk::FrameGraph& graph, const auto&, const vk::BufferOf<float>& depth, const ImageTarget& target,
               PictureSize size) { copyDepthToImage(graph, depth, size, target); },
            [](const auto&, const vk::BufferOf<float>& depth)
            {
                Words words;
                for (const float value : device().download(depth))
                {
                    words.push_back(std::bit_cast<gpu::uint>(value));
                }
                return words;
            });
    }
}

TEST_F(ImageTargets, StencilStays)
{
    constexpr VkFormat kFormat = VK_FORMAT_D32_SFLOAT_S8_UINT;
    constexpr Place kPlace = {{17, 9}, {23, 19}, 0, 1};
    const VkBufferImageCopy region = {0, 0, 0, {VK_IMAGE_ASPECT_STENCIL_BIT, 0, 1, 1}, {}, {40, 28, 1}};
    HostImage image(device(), kFormat, kExtent, kMipLevels, kLayers);
    Words stencils(40 * 28 / 4);
    for (std::size_t i = 0; i < stencils.size(); ++i)
    {
        stencils[i] = static_cast<gpu::uint>(i) * 0x9E3779B9U;
    }
    const vk::BufferOf<gpu::uint> before = device().makeBuffer<gpu::uint>("stencils", stencils);
    vk::BufferOf<gpu::uint> after(device().device(), "stencils after", stencils.size());
    TraceBuffers buffers(device().device(), kPlace.size.width, kPlace.size.height);
    vk::BufferOf<float> depth(device().device(), "depth", buffers.hits.count());
    const vk::Functions& fn = device().device().fn();
    device().run(
        [&](vk::FrameGraph& graph)
        {
            image.beginCopies(graph, VK_IMAGE_LAYOUT_GENERAL);
            graph.record("upload", {vk::CopyUse::read(before)},
                         [&](VkCommandBuffer commands) {
                             fn.vkCmdCopyBufferToImage(commands, before.handle(), image.handle(),
                                                       VK_IMAGE_LAYOUT_GENERAL, 1, &region);
                         });
            image.endCopies(graph);
        });
    trace(buffers, depth,
          [&](vk::FrameGraph& graph)
          {
              image.beginCopies(graph, VK_IMAGE_LAYOUT_GENERAL);
              copyDepthToImage(graph, depth, kPlace.size, targetAt(image, kFormat, VK_IMAGE_LAYOUT_GENERAL, kPlace));
              image.endCopies(graph);
              graph.record("download", {vk::CopyUse::write(after)},
                           [&](VkCommandBuffer commands)
                           {
                               fn.vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                                         after.handle(), 1, &region);
                           });
          });
    EXPECT_EQ(device().download(after), stencils);
}

// Calls record, which must throw before it has recorded anything. Returns the message.
std::string refusal(const std::function<void(vk::FrameGraph&)>& record, ErrorCode code = ErrorCode::Usage,
                    vk::Device& on = device().device())
{
    vk::FrameGraph graph(on, VK_NULL_HANDLE);
    const std::string message = test::messageOf([&] { record(graph); }, code);
    EXPECT_EQ(graph.passCount(), 0U);
    return message;
}

TEST_F(ImageTargets, OtherFormatsAreRefusedWithAListOfThoseThatAreSupported)
{
    expectParts(refusal([](vk::FrameGraph&) { texelFormat(VK_FORMAT_R8_UNORM); }),
                {"VkFormat 9", "R8G8B8A8_UNORM", "R8G8B8A8_SRGB", "B8G8R8A8_UNORM", "B8G8R8A8_SRGB",
                 "A2B10G10R10_UNORM_PACK32", "R16G16B16A16_SFLOAT"});
    const TraceBuffers buffers(device().device(), 9, 7);
    const vk::BufferOf<float> depth(device().device(), "depth", 63);
    ImageTarget target;
    target.format = VK_FORMAT_D32_SFLOAT;
    expectParts(refusal([&](vk::FrameGraph& graph) { copyToImage(graph, buffers, target); }), {"VkFormat 126"});
    target.format = VK_FORMAT_D16_UNORM;
    expectParts(refusal(
                    [&](vk::FrameGraph& graph) {
                        copyDepthToImage(graph, depth, {9, 7}, target);
                    }),
                {"VkFormat 124", "D32_SFLOAT, D32_SFLOAT_S8_UINT, R32_SFLOAT"});
}

TEST_F(ImageTargets, APictureOfAnotherFormatIsRefused)
{
    const TraceBuffers buffers(device().device(), 9, 7, TexelFormat::Bgra8);
    ImageTarget target;
    for (const VkFormat format : kColorFormats)
    {
        target.format = format;
        if (texelFormat(format) != TexelFormat::Bgra8)
        {
            expectParts(refusal([&](vk::FrameGraph& graph) { copyToImage(graph, buffers, target); }),
                        {"BGRA with 8 bits", "texelFormat()"});
        }
    }
}

TEST_F(ImageTargets, PlacesThatCannotBeAreRefused)
{
    const TraceBuffers buffers(device().device(), 9, 7);
    const vk::BufferOf<float> depth(device().device(), "depth", 62);
    ImageTarget target;
    target.format = VK_FORMAT_R8G8B8A8_UNORM;
    target.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const auto copy = [&](vk::FrameGraph& graph) { copyToImage(graph, buffers, target); };
    expectParts(refusal(copy), {"VkImageLayout 5", "TRANSFER_DST_OPTIMAL or GENERAL"});
    target.layout = VK_IMAGE_LAYOUT_GENERAL;
    target.offset = {0, -1};
    expectParts(refusal(copy), {"(0, -1)"});
    target.offset = {0, 0};
    target.format = VK_FORMAT_R32_SFLOAT;
    expectParts(refusal(
                    [&](vk::FrameGraph& graph) {
                        copyDepthToImage(graph, depth, {9, 7}, target);
                    },
                    ErrorCode::Other),
                {"9 x 7", "depth"});
}

// The machine's Vulkan without queue families that draw.
PFN_vkGetInstanceProcAddr g_instance_proc_addr = nullptr;

VKAPI_ATTR void VKAPI_CALL familiesThatOnlyCompute(VkPhysicalDevice physical, std::uint32_t* count,
                                                   VkQueueFamilyProperties* families)
{
    device().device().fn().vkGetPhysicalDeviceQueueFamilyProperties(physical, count, families);
    for (std::uint32_t i = 0; families != nullptr && i < *count; ++i)
    {
        families[i].queueFlags &= ~VkQueueFlags{VK_QUEUE_GRAPHICS_BIT};
    }
}

PFN_vkVoidFunction computeOnlyProcAddr(VkInstance instance, const char* name)
{
    return std::strcmp(name, "vkGetPhysicalDeviceQueueFamilyProperties") == 0
               ? reinterpret_cast<PFN_vkVoidFunction>(familiesThatOnlyCompute)
               : g_instance_proc_addr(instance, name);
}

TEST_F(ImageTargets, DepthImagesNeedAQueueThatDraws)
{
    vk::DeviceHandles handles = device().device().handles();
    g_instance_proc_addr = handles.get_instance_proc_addr;
    handles.get_instance_proc_addr = computeOnlyProcAddr;
    const vk::Functions functions = vk::ownerFunctions(computeOnlyProcAddr, handles.instance, handles.device);
    handles.functions = &functions;
    vk::Device computes(handles, zvoKernels());
    EXPECT_EQ(computes.queueFlags() & VK_QUEUE_GRAPHICS_BIT, 0U);
    EXPECT_NE(computes.queueFlags() & VK_QUEUE_COMPUTE_BIT, 0U);
    const vk::BufferOf<float> depth(device().device(), "depth", 63);
    ImageTarget target;
    for (const VkFormat format : {VK_FORMAT_D32_SFLOAT, VK_FORMAT_D32_SFLOAT_S8_UINT})
    {
        target.format = format;
        const auto copy = [&](vk::FrameGraph& graph) { copyDepthToImage(graph, depth, {9, 7}, target); };
        expectParts(refusal(copy, ErrorCode::Usage, computes), {"cannot draw", "VK_QUEUE_GRAPHICS_BIT", "R32_SFLOAT"});
    }
}

TEST_F(ImageTargets, TheGraphKnowsWhatACopyReads)
{
    HostImage image(device(), VK_FORMAT_R8G8B8A8_UNORM, kExtent, kMipLevels, kLayers);
    TraceBuffers buffers(device().device(), 17, 9);
    vk::BufferOf<float> depth(device().device(), "depth", buffers.hits.count());
    std::string dump;
    trace(buffers, depth,
          [&](vk::FrameGraph& graph)
          {
              const std::size_t before = graph.dump().size();
              image.beginCopies(graph, VK_IMAGE_LAYOUT_GENERAL);
              copyToImage(graph, buffers,
                          targetAt(image, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_LAYOUT_GENERAL, kPlaces[1]));
              image.endCopies(graph);
              dump = graph.dump().substr(before);
          });
    expectParts(dump, {"barrier compute -> transfer", "pass copy image to an image", "copies from image"});
}

} // namespace
} // namespace zvo
