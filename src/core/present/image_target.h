// SPDX-License-Identifier: MIT
// Pictures in images of a host.
//
// zvo binds no descriptors: pictures and depth are made in buffers, in the bytes of the image's format, and copied. So
// a host's image needs no usage but VK_IMAGE_USAGE_TRANSFER_DST_BIT, and no view. zvo records no barrier for it and
// never changes its layout. Around the copies, within the host's command buffer or by a semaphore, the host orders
//
//     before: whatever used the image last, and its change to ImageTarget::layout
//             -> VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT
//     after:  VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT
//             -> whatever uses it next, and its change to the layout of that use
//
// and likewise between two copies to the same texels. Only the copy touches the image: the passes of zvo that come
// before it may run while the image is still in use. The image belongs to the queue family that records, or is shared.
#pragma once

#include "core/present/present.h"
#include "core/trace/trace.h"
#include "vk/functions.h"
#include "zvo/image_target.h"

#include <cstdint>

namespace zvo
{

/// The texel format that a picture needs to be copied into images of a format: R8G8B8A8 and B8G8R8A8, UNORM and SRGB,
/// A2B10G10R10_UNORM_PACK32, R16G16B16A16_SFLOAT. Those in UNORM and SRGB alike get the bytes of sRGB codes: what
/// samples an SRGB image gets linear values. Throws Error{Usage} for other formats, listing these.
TexelFormat texelFormat(VkFormat format);

/// Records the copy of buffers.image, all of it, to target. Its only access to the image is the one above. Throws
/// Error{Usage} when target's format does not take the format of buffers' texels, or its layout, offset or extent will
/// not do; then nothing is recorded. Cost: pixels.
void copyToImage(vk::FrameGraph& graph, const TraceBuffers& buffers, const ImageTarget& target);

/// Throws what copyToImage() throws, before there is anything to copy.
void requireCopyable(const TraceBuffers& buffers, const ImageTarget& target);

/// The same for depth[size.width * size.height] of traceDepth(): into the depth aspect of an image in D32_SFLOAT or
/// D32_SFLOAT_S8_UINT, whose stencil stays, or into one in R32_SFLOAT. Throws Error{Usage} for others, and for the
/// first two when the host's queue family cannot draw, without which Vulkan forbids the copy; Error{Other} when depth
/// has fewer elements.
void copyDepthToImage(vk::FrameGraph& graph, const vk::BufferOf<float>& depth, PictureSize size,
                      const ImageTarget& target);

/// Throws what copyDepthToImage() throws of target.
void requireDepthCopyable(const vk::Device& device, PictureSize size, const ImageTarget& target);

} // namespace zvo
