// SPDX-License-Identifier: MIT
// A compute shader of a host, with buffers of its own.
#pragma once

#include "support/host_device.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace zvo::test
{

/// A buffer that shaders reach by its address, in memory that the host sees.
class HostBuffer
{
public:
    HostBuffer(HostDevice& host, std::uint64_t bytes);
    ~HostBuffer();
    HostBuffer(const HostBuffer&) = delete;
    HostBuffer& operator=(const HostBuffer&) = delete;

    [[nodiscard]] std::uint64_t address() const { return m_address; }
    [[nodiscard]] const void* mapped() const { return m_mapped; }

private:
    HostDevice& m_host;
    VkBuffer m_buffer = VK_NULL_HANDLE;
    VkDeviceMemory m_memory = VK_NULL_HANDLE;
    std::uint64_t m_address = 0;
    void* m_mapped = nullptr;
};

class HostKernel
{
public:
    /// name: of a kernel below tests/glsl.
    HostKernel(HostDevice& host, std::string_view name, std::uint32_t push_bytes);
    ~HostKernel();
    HostKernel(const HostKernel&) = delete;
    HostKernel& operator=(const HostKernel&) = delete;

    /// Records a run of so many workgroups.
    void run(VkCommandBuffer commands, std::uint32_t groups, std::span<const std::byte> push) const;

private:
    HostDevice& m_host;
    VkPipelineLayout m_layout = VK_NULL_HANDLE;
    VkPipeline m_pipeline = VK_NULL_HANDLE;
};

} // namespace zvo::test
