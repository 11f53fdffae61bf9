// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"
#include "io/voxel/write_bytes.h"

#include <cstddef>
#include <span>
#include <string>

namespace zvo::test
{

/// The file that a writer, such as writeGlb, makes of a tree.
inline std::string writtenBytes(void (*write)(const TreeData&, const WriteBytes&), const TreeData& tree)
{
    std::string bytes;
    write(tree, [&bytes](std::span<const std::byte> more)
          { bytes.append(reinterpret_cast<const char*>(more.data()), more.size()); });
    return bytes;
}

} // namespace zvo::test
