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

} // namespace zvo::test
