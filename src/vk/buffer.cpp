// SPDX-License-Identifier: MIT
#include "vk/buffer.h"

#include "vk/check.h"
#include "vk/descriptor_sets.h"
#include "vk/device.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo::vk
{

namespace
{

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

// The alignment of the largest GPU_BUFFER in the shaders.
constexpr VkDeviceSize kAddressAlignment = 16;

constexpr VkMemoryPropertyFlags kHostMemory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

} // namespace

// Delegates, so that the destructor cleans up when something below throws.
Buffer::Buffer(Device& device, std::string name, std::uint64_t bytes, MemoryKind kind) : Buffer()
{
    m_device = &device;
    m_name = std::move(name);
    m_bytes = bytes;
    if (bytes == 0)
    {
        return;
    }
    if (bytes > device.report().max_buffer_bytes)
    {
        throw Error(ErrorCode::Memory, fmt::format("{} needs {} bytes, but a buffer on this device has at most {}: use "
                                                   "a lower resolution",
                                                   m_name, bytes, device.report().max_buffer_bytes));
    }
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes + device.handles().overrides.buffer_slack;
    info.usage = kUsage;
    const Functions& fn = device.fn();
    VK_CHECK(fn.vkCreateBuffer(device.handle(), &info, device.allocationCallbacks(), &m_handle));
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(m_handle), m_name);

    VkMemoryRequirements requirements{};
    fn.vkGetBufferMemoryRequirements(device.handle(), m_handle, &requirements);
    requirements.alignment = std::max(requirements.alignment, kAddressAlignment);
    const VkMemoryPropertyFlags required =
        kind == MemoryKind::Device ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT} : kHostMemory;
    const VkMemoryPropertyFlags preferred =
        kind == MemoryKind::Readback ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT} : 0;
    m_memory = device.memory().allocate(requirements, required, preferred, m_name.c_str());
    VK_CHECK(fn.vkBindBufferMemory(device.handle(), m_handle, m_memory.memory, m_memory.offset));

    VkBufferDeviceAddressInfo address{};
    address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    address.buffer = m_handle;
    m_address = fn.vkGetBufferDeviceAddress(device.handle(), &address);
}

Buffer::~Buffer()
{
    if (m_handle != VK_NULL_HANDLE)
    {
        m_device->descriptors().forget(m_handle);
        m_device->fn().vkDestroyBuffer(m_device->handle(), m_handle, m_device->allocationCallbacks());
        m_device->memory().release(m_memory);
    }
}

Buffer::Buffer(Buffer&& other) noexcept
    : m_device(std::exchange(other.m_device, nullptr)), m_name(std::exchange(other.m_name, {})),
      m_handle(std::exchange(other.m_handle, VK_NULL_HANDLE)), m_bytes(std::exchange(other.m_bytes, 0)),
      m_address(std::exchange(other.m_address, 0)), m_memory(std::exchange(other.m_memory, {}))
{
}

Buffer& Buffer::operator=(Buffer&& other) noexcept
{
    Buffer old(std::move(other));
    std::swap(m_device, old.m_device);
    std::swap(m_name, old.m_name);
    std::swap(m_handle, old.m_handle);
    std::swap(m_bytes, old.m_bytes);
    std::swap(m_address, old.m_address);
    std::swap(m_memory, old.m_memory);
    return *this;
}

} // namespace zvo::vk
