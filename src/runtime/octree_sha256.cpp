// SPDX-License-Identifier: MIT
#include "runtime/octree_sha256.h"

#include "io/file/sha256.h"

#include <algorithm>
#include <span>
#include <vector>

namespace zvo
{

namespace
{

template <typename T> void hashBuffer(vk::HeadlessDevice& device, Sha256& sha, const vk::BufferOf<T>& buffer)
{
    constexpr std::uint64_t kPieceBytes = 64ULL << 20;
    constexpr std::uint64_t kPiece = kPieceBytes / sizeof(T);
    for (std::uint64_t first = 0; first < buffer.count(); first += kPiece)
    {
        const std::vector<T> piece = device.download(buffer, first, std::min(kPiece, buffer.count() - first));
        sha.update(std::as_bytes(std::span(piece)));
    }
}

} // namespace

std::string octreeSha256(vk::HeadlessDevice& device, const DeviceTree& octree)
{
    Sha256 sha;
    struct Header // 8 words without padding
    {
        glm::vec3 origin;
        float voxel_size;
        std::uint32_t depth;
        std::uint32_t node_count;
        std::uint32_t voxel_count;
        float emission_scale;
    };
    const Header header = {octree.grid.origin, octree.grid.voxel_size, octree.grid.depth,
                           octree.node_count,  octree.voxel_count,     octree.emission_scale};
    sha.update(std::as_bytes(std::span(&header, 1)));
    hashBuffer(device, sha, octree.nodes);
    hashBuffer(device, sha, octree.voxel_attributes);
    hashBuffer(device, sha, octree.node_attributes);
    hashBuffer(device, sha, octree.packed.voxels);
    hashBuffer(device, sha, octree.packed.nodes);
    hashBuffer(device, sha, octree.emission_words);
    hashBuffer(device, sha, octree.emission);
    return sha.hexDigest();
}

} // namespace zvo
