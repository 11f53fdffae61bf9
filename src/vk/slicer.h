// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <cstdint>

namespace zvo::vk
{

class Buffer;

/// Lets a frame graph spread its passes, and pieces of one pass, over several command buffers that are submitted to one
/// queue in order. HeadlessDevice has a slicer that keeps submissions short; a host that wants long work spread over
/// its frames brings its own. key: equal for work of the same kind. units: workgroups, or pieces of a fill.
class Slicer
{
public:
    virtual ~Slicer() = default;

    /// How many of `units` may be recorded now; 0: call next() first. Does not return 0 twice in a row.
    virtual std::uint64_t admit(std::uint64_t key, std::uint64_t units) = 0;

    /// Whether an indirect dispatch of at most `bound` workgroups may be recorded now, as a whole. If not, and if there
    /// is a readback(), the dispatch's arguments are copied there and next() submits the passes so far. Then the number
    /// of workgroups is passed to learnCount(), and the dispatch is recorded as a direct one.
    virtual bool admitUnseen(std::uint64_t key, std::uint64_t bound) = 0;
    virtual void learnCount(std::uint64_t key, std::uint64_t bound, std::uint64_t units) = 0;

    /// A mapped buffer of at least 12 bytes; null if the host cannot wait for the device.
    virtual Buffer* readback() = 0;

    /// Ends the current command buffer and returns the next one, in the recording state. If there is a readback(), all
    /// work recorded so far is complete on return.
    virtual VkCommandBuffer next() = 0;
};

} // namespace zvo::vk
