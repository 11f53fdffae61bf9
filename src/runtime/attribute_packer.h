// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// Packs attributes (docs/attributes.md) that come to the host piece by piece. The result is that of packing all of
/// them at once.
class AttributePacker
{
public:
    /// format: any. For a format that is not packed, attributes are collected as they are.
    AttributePacker(vk::HeadlessDevice& device, AttributeFormat format) : m_device(device), m_format(format) {}

    /// Adds attributes behind those before, packs as many as make whole pieces, and waits. Throws Error{Memory}.
    void append(std::vector<gpu::Attribute>&& more);

    /// Packs the remaining attributes.
    void finish();

    std::vector<gpu::Attribute>
        attributes; ///< attributes that are not packed; empty after finish() if the format is a packed one
    std::vector<gpu::uint> words; ///< the packed attributes
    std::vector<vk::PassTime> passes;

private:
    void pack(std::uint64_t count);

    vk::HeadlessDevice& m_device;
    AttributeFormat m_format;
};

} // namespace zvo
