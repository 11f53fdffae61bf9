// SPDX-License-Identifier: MIT
#include "support/ballast.h"

#include "zvo/error.h"

#include <algorithm>

namespace zvo::test
{

std::vector<vk::BufferOf<std::uint32_t>> ballast(vk::HeadlessDevice& device, std::size_t pieces_left)
{
    constexpr std::uint64_t kLargeBytes = 1 << 20;
    std::vector<vk::BufferOf<std::uint32_t>> pieces;
    for (std::uint64_t bytes = device.device().memory().roomBytes(); bytes != 0;)
    {
        try
        {
            pieces.emplace_back(device.device(), "ballast", bytes / sizeof(std::uint32_t));
        }
        catch (const Error&)
        {
            bytes = bytes > kLargeBytes ? kLargeBytes : bytes > kBallastPieceBytes ? kBallastPieceBytes : 0;
        }
    }
    pieces.resize(pieces.size() - std::min(pieces_left, pieces.size()));
    return pieces;
}

std::vector<vk::Buffer> freeMemoryTaken(vk::HeadlessDevice& device)
{
    constexpr std::uint64_t kBlockBytes = vk::MemoryAllocator::kLimitedBlockBytes;
    const vk::MemoryAllocator& memory = device.device().memory();
    std::vector<vk::Buffer> pieces;
    const auto add = [&](std::uint64_t bytes) { pieces.emplace_back(device.device(), "ballast", bytes); };
    for (std::uint64_t bytes = kBlockBytes / 2; bytes >= 128; bytes /= 8)
    {
        for (const std::uint64_t held = memory.heldBytes(); memory.heldBytes() == held;)
        {
            add(bytes);
        }
        pieces.pop_back();
        add(kBlockBytes / 2); // fills the block that has just been allocated
        add(kBlockBytes / 2);
    }
    return pieces;
}

} // namespace zvo::test
