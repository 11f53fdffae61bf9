// SPDX-License-Identifier: MIT
#pragma once

#include "vk/buffer.h"
#include "vk/headless.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo::test
{

constexpr std::uint64_t kBallastPieceBytes = 4096; // of the smallest pieces, the last ones

/// Takes what the limit of a device's memory leaves, whole blocks and what is free in them: nothing is left, but for
/// the last pieces, which are not taken.
std::vector<vk::BufferOf<std::uint32_t>> ballast(vk::HeadlessDevice& device, std::size_t pieces_left);

/// Takes what is free of the memory that is allocated, of a device with a limit: for anything more, more will have to
/// be.
std::vector<vk::Buffer> freeMemoryTaken(vk::HeadlessDevice& device);

} // namespace zvo::test
