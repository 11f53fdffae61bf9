// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <cstdint>

namespace zvo::vk
{

class Buffer;

/// Lets a frame graph spread its passes, and pieces of one pass, over several command buffers that are submitted to one
/// queue in order. HeadlessDevice has one that keeps submissions short; an embedding host that wants long work spread
/// over its frames brings its own. key: the same for the same kind of work; units: workgroups, or pieces of a fill.
class Slicer
{
public:
    virtual ~Slicer() = default;

    /// How many of units may be recorded now; 0: next() first. Not 0 again after that.
    virtual std::uint64_t admit(std::uint64_t key, std::uint64_t units) = 0;

    /// Whether an indirect dispatch of at most bound workgroups may be recorded now, as a whole. When not, and there is
    /// a readback(), its arguments are copied there and the passes so far submitted by next(); then it is recorded as a
    /// direct dispatch of the units that learnCount() is told of.
    virtual bool admitUnseen(std::uint64_t key, std::uint64_t bound) = 0;
    virtual void learnCount(std::uint64_t key, std::uint64_t bound, std::uint64_t units) = 0;

    /// A mapped buffer of at least 12 bytes, or null where the host cannot wait for the device.
    virtual Buffer* readback() = 0;

    /// Ends the current command buffer and returns the one to go on with, in the recording state. With a readback(),
    /// everything recorded so far is complete on return.
    virtual VkCommandBuffer next() = 0;
};

} // namespace zvo::vk
