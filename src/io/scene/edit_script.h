// SPDX-License-Identifier: MIT
#pragma once

#include "io/scene/load_scene.h"
#include "zvo/types.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace zvo
{

/// What an edit covers, in world space: a sphere, whose centre and radius go to the nearest voxels that a brush can
/// have; the voxels whose centres are in a box; or those of a mesh.
struct EditSphere
{
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

struct EditSpan // a box
{
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
};

struct EditMesh
{
    std::filesystem::path file;
    UpAxis up = UpAxis::Y;
    glm::dmat4 transform{1.0}; // of its scene, whose up axis is y already; affine
    Fill fill = Fill::Solid;
};

/// An edit of a script.
struct ScriptedEdit
{
    std::string where; // its path in the JSON, for messages: edits[1]
    BrushAction action = BrushAction::Carve;
    bool outside = false; // Carve, of a mesh: what it does not have
    std::variant<EditSphere, EditSpan, EditMesh> shape;
    std::uint32_t color = 0; // Fill, Paint: sRGB red | green << 8 | blue << 16
    glm::vec3 emission{0.0F};
};

/// The edits of a script, whose schema is in docs/editing.md; path is for messages, and files of meshes are beside it.
/// Throws Error{Input}: one line that names file, path in the JSON, what is there and what is expected.
std::vector<ScriptedEdit> parseEditScript(std::string_view text, const std::filesystem::path& path);
std::vector<ScriptedEdit> readEditScript(const std::filesystem::path& path);

/// The mesh of an edit, placed. Throws as loadScene().
Scene loadEditMesh(const EditMesh& mesh);

} // namespace zvo
