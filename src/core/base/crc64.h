// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace zvo
{

/// CRC-64/XZ: the polynomial 0x42f0e1eba9ea3693 of ECMA-182 with reflected bits; the initial value and the final XOR
/// are all ones. To continue a sum over several pieces, pass the result for the pieces before as `crc`; 0 begins a new
/// one. Every change of up to 64 adjacent bits is noticed. Eight bytes are taken at a time (M. Kounavis, F. Berry, A
/// Systematic Approach to Building High Performance Software-based CRC Generators, 2005).
std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t crc = 0);

} // namespace zvo
