// SPDX-License-Identifier: MIT
#pragma once

#include "vk/buffer.h"
#include "vk/headless.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo::test
{

constexpr std::uint64_t kBallastPieceBytes = 4096; // size of the smallest pieces, which are the last

/// Allocates all memory that a device's limit leaves: whole blocks, and free ranges in them. The last pieces_left
/// pieces are given back.
std::vector<vk::BufferOf<std::uint32_t>> ballast(vk::HeadlessDevice& device, std::size_t pieces_left);

/// Takes what is free in the allocated memory of a device with a limit. Any further allocation needs a new block.
std::vector<vk::Buffer> freeMemoryTaken(vk::HeadlessDevice& device);

} // namespace zvo::test
