// SPDX-License-Identifier: MIT
// Attributes in fewer bytes (docs/attributes.md), for those who wait for the device.
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// Replaces the attributes of tree by such in a packed format (TreePacker), and waits. Returns the passes. Throws
/// Error{Memory} when the device's budget does not suffice.
std::vector<vk::PassTime> packTree(vk::HeadlessDevice& device, AttributeFormat format, DeviceTree& tree);

/// Attributes that come to the host piece by piece, packed on the device as if all of them had come at once.
class AttributePacker
{
public:
    /// format: any; what is not packed is collected as it is.
    AttributePacker(vk::HeadlessDevice& device, AttributeFormat format) : m_device(device), m_format(format) {}

    /// Adds attributes behind those that came before, packs what is enough for it, and waits. Throws Error{Memory}.
    void append(std::vector<gpu::Attribute>&& more);

    /// Packs the rest.
    void finish();

    std::vector<gpu::Attribute> attributes; ///< those that are not packed; in a packed format none, after finish()
    std::vector<gpu::uint> words;           ///< of those that are
    std::vector<vk::PassTime> passes;

private:
    void pack(std::uint64_t count);

    vk::HeadlessDevice& m_device;
    AttributeFormat m_format;
};

} // namespace zvo
