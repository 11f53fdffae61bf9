// SPDX-License-Identifier: MIT
// What frame graphs and their passes have in common.
#pragma once

#include "vk/buffer.h"
#include "vk/hazard_tracker.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace zvo::vk
{

[[noreturn]] inline void misuse(const std::string& what)
{
    throw Error(ErrorCode::Other, "frame graph: " + what);
}

inline void checkRange(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes)
{
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
    {
        misuse(fmt::format("{} bytes from byte {} on lie outside buffer {} of {} bytes", bytes, offset, buffer.name(),
                           buffer.bytes()));
    }
}

inline BufferAccess accessOf(const Buffer& buffer, Access access)
{
    return {reinterpret_cast<std::uint64_t>(buffer.handle()), access, buffer.name()};
}

} // namespace zvo::vk
