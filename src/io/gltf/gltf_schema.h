// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace zvo
{

struct GltfDocument;

/// Checks the parts of a glTF 2.0 document that the loader reads: that properties have the type of the specification's
/// schema and that every index is in range. Removes all others from root, so that nothing in them matters. A part that
/// the scene may do without, such as an accessor, becomes empty where it fails, and document.faults gets an entry.
/// Whole numbers that are written with a decimal point become whole, with a warning. Throws Error{Input} that names the
/// first property that fails in other parts.
void checkGltfSchema(nlohmann::json& root, GltfDocument& document);

/// The items of one of the document's arrays; none where it is missing.
const nlohmann::json& gltfItems(const nlohmann::json& document, const char* array);

} // namespace zvo
