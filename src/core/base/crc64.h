// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace zvo
{

/// CRC-64/XZ: the polynomial 0x42f0e1eba9ea3693 of ECMA-182, bits reflected, starting from and inverted by all ones.
/// crc: of what came before, to go on from there; 0 at the start. Every change of up to 64 adjacent bits is noticed.
/// Speed: eight bytes a step (M. Kounavis, F. Berry, A Systematic Approach to Building High Performance Software-based
/// CRC Generators, 2005).
std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t crc = 0);

} // namespace zvo
