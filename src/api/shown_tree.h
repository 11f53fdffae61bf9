// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "zvo/context.h"
#include "zvo/dynamic_tree.h"
#include "zvo/tree.h"

#include <cstdint>

namespace zvo
{

/// A tree as a recording shows it.
struct ShownTree
{
    const DeviceTree& tree;
    std::uint64_t identity;   // of a dynamic one, the version of another
    std::uint64_t edit_count; // of a dynamic one
};

/// What the recording shows of a tree; a dynamic one then records into its frame. Throws Error{Usage} for a tree of
/// another context, and as usable().
ShownTree shownIn(Recorder::Impl& recorder, const Tree& tree);
ShownTree shownIn(Recorder::Impl& recorder, DynamicTree& tree);

} // namespace zvo
