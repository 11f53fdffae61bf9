// SPDX-License-Identifier: MIT
#pragma once

#include "common/host.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace host
{

/// A compute shader that writes an image (set 0, binding 0), in groups of 8 x 8 pixels.
class ImageKernel
{
public:
    /// image: has VK_IMAGE_USAGE_STORAGE_BIT.
    ImageKernel(const Device& device, std::span<const std::uint32_t> shader, const Image& image,
                std::uint32_t push_bytes);
    ~ImageKernel();
    ImageKernel(const ImageKernel&) = delete;
    ImageKernel& operator=(const ImageKernel&) = delete;

    /// Records a run over a picture of that size. push: push_bytes.
    void run(VkCommandBuffer commands, VkExtent2D size, std::span<const std::byte> push) const;

    /// What it does to the image.
    static constexpr Edge kWrites = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                     VK_IMAGE_LAYOUT_GENERAL};

private:
    void bindImage(const Image& image);
    void makePipeline(std::span<const std::uint32_t> shader, std::uint32_t push_bytes);

    const Device& m_device;
    VkDescriptorSetLayout m_set_layout = VK_NULL_HANDLE;
    VkDescriptorPool m_pool = VK_NULL_HANDLE;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    VkPipelineLayout m_layout = VK_NULL_HANDLE;
    VkPipeline m_pipeline = VK_NULL_HANDLE;
};

} // namespace host
