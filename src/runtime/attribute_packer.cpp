// SPDX-License-Identifier: MIT
#include "runtime/attribute_packer.h"

#include "attributes/attributes.h"
#include "core/attributes/attribute_pack.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace zvo
{

namespace
{

constexpr std::uint64_t kPieceMax = 1U << 20; // attributes that the device packs at once
constexpr std::uint64_t kPieceMin = 1U << 12;
constexpr std::uint64_t kEnough = 1U << 16;     // what waits for the next piece, at most
constexpr std::uint64_t kRoomPerAttribute = 32; // bytes: itself, its words, and as much for copying

} // namespace

void AttributePacker::append(std::vector<gpu::Attribute>&& more)
{
    if (attributes.empty())
    {
        attributes = std::move(more);
    }
    else
    {
        attributes.insert(attributes.end(), more.begin(), more.end());
    }
    if (isPacked(m_format) && attributes.size() >= kEnough)
    {
        pack(attributes.size() / gpu::kBlockVoxels * gpu::kBlockVoxels); // blocks begin where they do in the whole
    }
}

void AttributePacker::finish()
{
    if (isPacked(m_format))
    {
        pack(attributes.size());
    }
}

// Packs the first count attributes, in pieces.
void AttributePacker::pack(std::uint64_t count)
{
    const std::uint64_t room = m_device.device().memory().roomBytes() / kRoomPerAttribute;
    const std::uint64_t piece_max = std::clamp(room, kPieceMin, kPieceMax) / gpu::kBlockVoxels * gpu::kBlockVoxels;
    for (std::uint64_t first = 0; first < count; first += piece_max)
    {
        const auto piece = std::span(attributes).subspan(first, std::min(count - first, piece_max));
        const auto from = m_device.makeBuffer<gpu::Attribute>("attributes to pack", piece);
        vk::BufferOf<gpu::uint> to(m_device.device(), "packed attributes", packedWords(m_format, piece.size()));
        const std::vector<vk::PassTime> more =
            m_device.run([&](vk::FrameGraph& graph) { packAttributes(graph, from, m_format, to); });
        passes.insert(passes.end(), more.begin(), more.end());
        const std::vector<gpu::uint> packed = m_device.download(to);
        words.insert(words.end(), packed.begin(), packed.end());
    }
    attributes.erase(attributes.begin(), attributes.begin() + static_cast<std::ptrdiff_t>(count));
}

} // namespace zvo
