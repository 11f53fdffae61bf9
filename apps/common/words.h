// SPDX-License-Identifier: MIT
// Words in messages.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace zvo::cli
{

/// A number of things: "1 voxel", "2 voxels". noun: one whose plural ends in s.
std::string counted(std::uint64_t count, std::string_view noun);

/// " (did you mean render?)": the one of names that is most like word, if a slip of the hand or two makes it of it.
/// Else nothing.
std::string suggestion(std::string_view word, std::span<const std::string> names);

} // namespace zvo::cli
