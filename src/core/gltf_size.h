// SPDX-License-Identifier: MIT
#pragma once

#include "core/gltf_document.h"
#include "core/gltf_nodes.h"

#include <cstdint>
#include <span>

namespace zvo
{

/// The most instances (a primitive in a place) of a document; each is a draw on the device.
inline constexpr std::uint64_t kGltfInstancesMax = std::uint64_t{1} << 24U;

/// Bytes that all the arrays and pictures of a scene may take: half of this machine's memory, as the other half holds
/// them once more on their way to the device.
std::uint64_t sceneBytesMax();

/// Adds up what the nodes will show, before anything of it is read: a small file can name the same data any number of
/// times. Throws Error{Input} where the scene would have more than kGltfInstancesMax instances, more triangles than
/// 32-bit numbers count, or arrays of more than sceneBytesMax().
void checkGltfSize(const GltfDocument& document, std::span<const GltfPlacedNode> nodes);

} // namespace zvo
