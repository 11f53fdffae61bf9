// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"
#include "vk/kernel.h"

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace zvo::vk
{

class Buffer;
class Device;

/// The descriptor sets of a device's kernels, and the buffer views in them. A set is made when it is first asked for,
/// and never changed, so that recorded work can go on using it; it goes with the first of its buffers that is
/// destroyed. Not thread safe.
class DescriptorSets
{
public:
    explicit DescriptorSets(Device& device);
    ~DescriptorSets();
    DescriptorSets(const DescriptorSets&) = delete;
    DescriptorSets& operator=(const DescriptorSets&) = delete;

    /// The layout of sets for these bindings; it lives as long as this object. Throws Error{Memory}.
    VkDescriptorSetLayout layout(std::span<const ModuleBinding> bindings);

    /// Whether a descriptor of that binding can cover the whole buffer.
    [[nodiscard]] bool canBind(const ModuleBinding& binding, const Buffer& buffer) const;

    /// The set with these buffers, one for each binding, all of which canBind(). Throws Error{Memory}.
    VkDescriptorSet get(std::span<const ModuleBinding> bindings, std::span<const VkBuffer> buffers);

    /// Frees what refers to buffer, which is about to be destroyed.
    void forget(VkBuffer buffer) noexcept;

private:
    struct SetKey
    {
        VkDescriptorSetLayout layout;
        std::vector<VkBuffer> buffers;

        auto operator<=>(const SetKey&) const = default;
    };
    struct Set
    {
        VkDescriptorPool pool;
        VkDescriptorSet handle;
    };
    using ViewKey = std::pair<VkBuffer, std::uint32_t>; // words of a texel

    VkBufferView view(VkBuffer buffer, std::uint32_t texel_words);
    Set allocate(VkDescriptorSetLayout layout);

    Device& m_device;
    bool m_has_texels3 = false; // texels of three words, which Vulkan does not promise
    using LayoutKey = std::vector<std::pair<std::uint32_t, std::uint32_t>>; // numbers and texel_words of bindings
    std::map<LayoutKey, VkDescriptorSetLayout> m_layouts;
    std::vector<VkDescriptorPool> m_pools;
    std::map<ViewKey, VkBufferView> m_views;
    std::map<SetKey, Set> m_sets;
};

} // namespace zvo::vk
