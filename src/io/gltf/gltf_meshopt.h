// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_document.h"

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace zvo
{

/// Whether a buffer is only a placeholder for unpacked data that need not be read: it is marked as a fallback, and it
/// has no URI, or all views of it are packed. root: the document's JSON, checked by checkGltfSchema().
bool isMeshoptFallback(const nlohmann::json& root, std::size_t buffer);

/// The buffer views of root that EXT_meshopt_compression or KHR_meshopt_compression packs.
std::map<int, GltfPackedView> listMeshoptViews(const nlohmann::json& root);

/// Unpacks the buffer view with that index. Throws Error{Input} for sizes that contradict each other, data that does
/// not decode, and unpacked data out of proportion to the file. After: Arseny Kapoulkine, EXT_meshopt_compression,
/// Khronos Group, 2021.
std::vector<std::uint8_t> unpackMeshoptView(const GltfDocument& document, int index, const GltfPackedView& packed);

} // namespace zvo
