// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_document.h"

#include <nlohmann/json_fwd.hpp>

namespace zvo
{

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// Whether buffer is a place holder for unpacked data that nothing has to read: it is marked as a fallback, and has no
/// URI or only views that are packed. root: the document's JSON, checked by checkGltfSchema().
bool isMeshoptFallback(const nlohmann::json& root, std::size_t buffer);

/// Unpacks all buffer views of root that EXT_meshopt_compression packs into document.unpacked_views. Throws
/// Error{Input} for sizes that contradict each other, data that does not decode, and what is out of proportion.
/// After: Arseny Kapoulkine, EXT_meshopt_compression, Khronos Group, 2021.
void unpackMeshoptViews(const nlohmann::json& root, GltfDocument& document);

} // namespace zvo
