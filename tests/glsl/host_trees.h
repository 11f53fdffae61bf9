// SPDX-License-Identifier: MIT
// Trees that the tests show to kernels of hosts.
#pragma once

#include "core/tree/attribute_format.h"
#include "core/tree/device_tree.h"
#include "shared/tree_table.h"
#include "support/trace_octrees.h"
#include "vk/frame_graph.h"

#include <cstdint>

namespace zvo::test
{

/// With attributes and emission, if format has any.
DeviceTree octreeWith(const CodeSet& set, AttributeFormat format);
DeviceTree dagWith(const CodeSet& set, AttributeFormat format, std::uint32_t entries_per_word = 0);

vk::BufferOf<gpu::TreeTable> tableOf(const DeviceTree& tree);

/// Declares the buffers that the pass reads through the table.
void readTree(vk::AnyPass& pass, const DeviceTree& tree);

} // namespace zvo::test
