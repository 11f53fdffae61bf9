// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace zvo
{

/// Checks the parts of a glTF 2.0 document that the loader relies on: that properties have the type of the
/// specification's schema and that every index is in range. Throws Error{Input} that names the first property that
/// fails.
void checkGltfSchema(const nlohmann::json& document, const std::filesystem::path& path);

/// The items of one of the document's arrays; none where it is missing.
const nlohmann::json& gltfItems(const nlohmann::json& document, const char* array);

} // namespace zvo
