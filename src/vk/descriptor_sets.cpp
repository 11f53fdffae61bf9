// SPDX-License-Identifier: MIT
#include "vk/descriptor_sets.h"

#include "vk/buffer.h"
#include "vk/check.h"
#include "vk/device.h"

#include <algorithm>
#include <cassert>

namespace zvo::vk
{

namespace
{

constexpr std::uint32_t kSetsOfPool = 64;
constexpr std::uint32_t kDescriptorsOfSet = 8; // on average; where sets have more, a pool has room for fewer
constexpr std::uint32_t kTexelWordBytes = 4;

VkDescriptorType typeOf(std::uint32_t texel_words)
{
    return texel_words != 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

VkFormat formatOf(std::uint32_t texel_words)
{
    switch (texel_words)
    {
    case 1:
        return VK_FORMAT_R32_UINT;
    case 2:
        return VK_FORMAT_R32G32_UINT;
    case 3:
        return VK_FORMAT_R32G32B32_UINT;
    default:
        return VK_FORMAT_R32G32B32A32_UINT;
    }
}

} // namespace

DescriptorSets::DescriptorSets(Device& device) : m_device(device)
{
    VkFormatProperties properties{};
    device.fn().vkGetPhysicalDeviceFormatProperties(device.handles().physical_device, formatOf(3), &properties);
    m_has_texels3 = (properties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT) != 0;
}

DescriptorSets::~DescriptorSets()
{
    const Functions& fn = m_device.fn();
    for (const VkDescriptorPool pool : m_pools)
    {
        fn.vkDestroyDescriptorPool(m_device.handle(), pool, m_device.allocationCallbacks());
    }
    for (const auto& [key, view] : m_views)
    {
        fn.vkDestroyBufferView(m_device.handle(), view, m_device.allocationCallbacks());
    }
    for (const auto& [key, layout] : m_layouts)
    {
        fn.vkDestroyDescriptorSetLayout(m_device.handle(), layout, m_device.allocationCallbacks());
    }
}

VkDescriptorSetLayout DescriptorSets::layout(std::span<const ModuleBinding> bindings)
{
    LayoutKey key;
    std::vector<VkDescriptorSetLayoutBinding> descriptions;
    for (const ModuleBinding& binding : bindings)
    {
        key.emplace_back(binding.binding, binding.texel_words);
        descriptions.push_back({binding.binding, typeOf(binding.texel_words), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    }
    const auto [found, is_new] = m_layouts.try_emplace(std::move(key), VK_NULL_HANDLE);
    if (found->second == VK_NULL_HANDLE) // new, or it could not be made before
    {
        VkDescriptorSetLayoutCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        info.bindingCount = static_cast<std::uint32_t>(descriptions.size());
        info.pBindings = descriptions.data();
        VK_CHECK(m_device.fn().vkCreateDescriptorSetLayout(m_device.handle(), &info, m_device.allocationCallbacks(),
                                                           &found->second));
    }
    return found->second;
}

bool DescriptorSets::canBind(const ModuleBinding& binding, const Buffer& buffer) const
{
    const VkPhysicalDeviceLimits& limits = m_device.limits();
    if (binding.texel_words == 0)
    {
        return buffer.bytes() <= limits.maxStorageBufferRange;
    }
    const std::uint64_t texels = buffer.bytes() / (kTexelWordBytes * binding.texel_words);
    return texels != 0 && texels <= limits.maxTexelBufferElements && (binding.texel_words != 3 || m_has_texels3);
}

VkBufferView DescriptorSets::view(VkBuffer buffer, std::uint32_t texel_words)
{
    VkBufferView& result = m_views[{buffer, texel_words}];
    if (result == VK_NULL_HANDLE)
    {
        VkBufferViewCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
        info.buffer = buffer;
        info.format = formatOf(texel_words);
        info.range = VK_WHOLE_SIZE;
        VK_CHECK(m_device.fn().vkCreateBufferView(m_device.handle(), &info, m_device.allocationCallbacks(), &result));
    }
    return result;
}

// From the first pool that has room; from a new one, where none has.
DescriptorSets::Set DescriptorSets::allocate(VkDescriptorSetLayout layout)
{
    const Functions& fn = m_device.fn();
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    Set set{};
    for (const VkDescriptorPool pool : m_pools)
    {
        info.descriptorPool = set.pool = pool;
        const VkResult result = fn.vkAllocateDescriptorSets(m_device.handle(), &info, &set.handle);
        if (result == VK_SUCCESS)
        {
            return set;
        }
        if (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL)
        {
            VK_CHECK(result);
        }
    }
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, kSetsOfPool * kDescriptorsOfSet},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSetsOfPool * kDescriptorsOfSet},
    };
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    pool_info.maxSets = kSetsOfPool;
    pool_info.poolSizeCount = static_cast<std::uint32_t>(std::size(sizes));
    pool_info.pPoolSizes = sizes;
    m_pools.reserve(m_pools.size() + 1); // so that a pool cannot get lost
    VK_CHECK(fn.vkCreateDescriptorPool(m_device.handle(), &pool_info, m_device.allocationCallbacks(), &set.pool));
    m_pools.push_back(set.pool);
    info.descriptorPool = set.pool;
    VK_CHECK(fn.vkAllocateDescriptorSets(m_device.handle(), &info, &set.handle));
    return set;
}

VkDescriptorSet DescriptorSets::get(std::span<const ModuleBinding> bindings, std::span<const VkBuffer> buffers)
{
    assert(bindings.size() == buffers.size());
    SetKey key{layout(bindings), {buffers.begin(), buffers.end()}};
    if (const auto found = m_sets.find(key); found != m_sets.end())
    {
        return found->second.handle;
    }
    std::vector<VkBufferView> views(bindings.size());
    std::vector<VkDescriptorBufferInfo> whole(bindings.size());
    for (std::size_t i = 0; i < bindings.size(); ++i)
    {
        whole[i] = {buffers[i], 0, VK_WHOLE_SIZE};
        views[i] = bindings[i].texel_words != 0 ? view(buffers[i], bindings[i].texel_words) : VK_NULL_HANDLE;
    }
    const Set set = allocate(key.layout);
    std::vector<VkWriteDescriptorSet> writes(bindings.size());
    for (std::size_t i = 0; i < bindings.size(); ++i)
    {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set.handle;
        writes[i].dstBinding = bindings[i].binding;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = typeOf(bindings[i].texel_words);
        writes[i].pBufferInfo = &whole[i];
        writes[i].pTexelBufferView = &views[i];
    }
    m_device.fn().vkUpdateDescriptorSets(m_device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                         nullptr);
    m_sets.emplace(std::move(key), set);
    return set.handle;
}

void DescriptorSets::forget(VkBuffer buffer) noexcept
{
    const Functions& fn = m_device.fn();
    std::erase_if(m_sets,
                  [&](const auto& entry)
                  {
                      const bool refers = std::ranges::find(entry.first.buffers, buffer) != entry.first.buffers.end();
                      if (refers)
                      {
                          fn.vkFreeDescriptorSets(m_device.handle(), entry.second.pool, 1, &entry.second.handle);
                      }
                      return refers;
                  });
    const auto first = m_views.lower_bound({buffer, 0});
    auto last = first;
    for (; last != m_views.end() && last->first.first == buffer; ++last)
    {
        fn.vkDestroyBufferView(m_device.handle(), last->second, m_device.allocationCallbacks());
    }
    m_views.erase(first, last);
}

} // namespace zvo::vk
