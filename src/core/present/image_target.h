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

/// The texel format that a picture needs to be copied into images of a format: R8G8B8A8 and B8G8R8A8, each UNORM or
/// SRGB, A2B10G10R10_UNORM_PACK32, or R16G16B16A16_SFLOAT. UNORM and SRGB images get the same bytes, those of sRGB
/// codes; so sampling an SRGB image gives linear values. Throws Error{Usage} for other formats, listing these.
TexelFormat texelFormat(VkFormat format);

/// Records the copy of all of buffers.image to target. This copy is the only access to the image. Throws Error{Usage}
/// when the format of buffers' texels is not the one that target's format needs, or when target's layout, offset or
/// extent is not valid; then nothing is recorded. Cost: pixels.
void copyToImage(vk::FrameGraph& graph, const TraceBuffers& buffers, const ImageTarget& target);

/// Throws what copyToImage() would throw, without recording anything.
void requireCopyable(const TraceBuffers& buffers, const ImageTarget& target);

/// Records the copy of depth [size.width * size.height], made by traceDepth(), to target: into the depth aspect of an
/// image in D32_SFLOAT or D32_SFLOAT_S8_UINT, whose stencil stays as it is, or into an image in R32_SFLOAT. Throws
/// Error{Usage} for other formats, and for the two depth formats when the host's queue family cannot draw, as Vulkan
/// forbids the copy there; Error{Other} when depth has fewer elements.
void copyDepthToImage(vk::FrameGraph& graph, const vk::BufferOf<float>& depth, PictureSize size,
                      const ImageTarget& target);

/// Throws the errors of copyDepthToImage() that concern target, without recording anything.
void requireDepthCopyable(const vk::Device& device, PictureSize size, const ImageTarget& target);

} // namespace zvo
