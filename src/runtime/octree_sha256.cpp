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

std::string octreeSha256(vk::HeadlessDevice& device, const DeviceTree& tree)
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
    const Header header = {tree.grid.origin, tree.grid.voxel_size, tree.grid.depth,
                           tree.node_count,  tree.voxel_count,     tree.emission_scale};
    sha.update(std::as_bytes(std::span(&header, 1)));
    hashBuffer(device, sha, tree.nodes);
    hashBuffer(device, sha, tree.leaf_groups);
    hashBuffer(device, sha, tree.voxel_attributes);
    hashBuffer(device, sha, tree.node_attributes);
    hashBuffer(device, sha, tree.packed.voxels);
    hashBuffer(device, sha, tree.packed.nodes);
    hashBuffer(device, sha, tree.emission_words);
    hashBuffer(device, sha, tree.emission);
    return sha.hexDigest();
}

} // namespace zvo
