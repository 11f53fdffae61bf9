// SPDX-License-Identifier: MIT
#pragma once

#include "shared/gpu.h"
#include "vk/memory.h"

#include <cstdint>
#include <string>

namespace zvo::vk
{

class Device;

/// Where a buffer's memory lives.
enum class MemoryKind
{
    Device,  ///< fastest for the device; the host cannot map it
    Upload,  ///< mapped, written by the host in order, read by the device
    Readback ///< mapped, cached, written by the device and read by the host
};

/// A storage buffer that kernels reach by its device address. Move-only; the memory is returned on destruction.
class Buffer
{
public:
    Buffer() = default;

    /// Allocates bytes (may be 0: then there is no memory and the address is 0). The contents are undefined.
    /// Throws Error{Memory} when the device's budget does not allow it.
    Buffer(Device& device, std::string name, std::uint64_t bytes, MemoryKind kind = MemoryKind::Device);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    [[nodiscard]] VkBuffer handle() const { return m_handle; }
    [[nodiscard]] std::uint64_t address() const { return m_address; }
    [[nodiscard]] std::uint64_t bytes() const { return m_bytes; }
    [[nodiscard]] const std::string& name() const { return m_name; }

    /// Host address of a mapped buffer; null for MemoryKind::Device.
    [[nodiscard]] void* mapped() const { return m_memory.mapped; }

private:
    Device* m_device = nullptr;
    std::string m_name;
    VkBuffer m_handle = VK_NULL_HANDLE;
    std::uint64_t m_bytes = 0;
    std::uint64_t m_address = 0;
    MemoryBlock m_memory;
};

/// A buffer of count() elements of T.
template <typename T> class BufferOf : public Buffer
{
public:
    BufferOf() = default;
    BufferOf(Device& device, std::string name, std::uint64_t count, MemoryKind kind = MemoryKind::Device)
        : Buffer(device, std::move(name), count * sizeof(T), kind)
    {
    }

    [[nodiscard]] std::uint64_t count() const { return bytes() / sizeof(T); }
    [[nodiscard]] T* mappedData() const { return static_cast<T*>(mapped()); }
};

} // namespace zvo::vk
