// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_document.h"

#include <nlohmann/json_fwd.hpp>

namespace zvo
{

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// Whether a buffer is only a placeholder for unpacked data that need not be read: it is marked as a fallback, and it
/// has no URI, or all views of it are packed. root: the document's JSON, checked by checkGltfSchema().
bool isMeshoptFallback(const nlohmann::json& root, std::size_t buffer);

/// Unpacks all buffer views of root that EXT_meshopt_compression packs, into document.unpacked_views. Throws
/// Error{Input} for sizes that contradict each other, data that does not decode, and unpacked data out of proportion to
/// the file. After: Arseny Kapoulkine, EXT_meshopt_compression, Khronos Group, 2021.
void unpackMeshoptViews(const nlohmann::json& root, GltfDocument& document);

} // namespace zvo
