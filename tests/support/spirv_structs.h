// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace zvo::test
{

/// Byte offsets of the members of every named struct in a SPIR-V module, by struct and member name. Names come from the
/// shader's source (OpName, OpMemberName). Structs without offsets are left out. A struct with several layouts appears
/// once if they agree. Throws std::runtime_error if they do not, or if words are not SPIR-V.
std::map<std::string, std::map<std::string, std::uint32_t>> structOffsets(std::span<const std::uint32_t> words);

} // namespace zvo::test
