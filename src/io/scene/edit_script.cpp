// SPDX-License-Identifier: MIT
#include "io/scene/edit_script.h"

#include "core/base/read_file.h"
#include "io/file/json_cursor.h"
#include "io/scene/place.h"
#include "io/scene/scene_part.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <span>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::string_view kEditSchema = "zvo.edits/1";
constexpr std::uint32_t kDefaultColor = 0xC0C0C0;
constexpr std::size_t kKeep = 3; // among the names of actions

// "#rrggbb" as red | green << 8 | blue << 16.
std::uint32_t readColor(const JsonCursor& color)
{
    const std::string text = color.text();
    std::uint32_t value = 0;
    const char* const end = text.data() + text.size();
    const bool is_long = text.size() == 7 && text.front() == '#';
    if (!is_long || std::from_chars(text.data() + 1, end, value, 16).ptr != end)
    {
        throw color.mismatch("a colour as \"#c08040\"");
    }
    return value >> 16 | (value & 0xFF00U) | (value & 0xFFU) << 16;
}

glm::vec3 readEmission(const JsonCursor& emission)
{
    const glm::dvec3 radiance = emission.vector();
    if (glm::any(glm::lessThan(radiance, glm::dvec3(0.0))))
    {
        throw emission.mismatch("a radiance, three numbers from 0 on");
    }
    return glm::vec3(radiance);
}

EditSphere readSphere(const JsonCursor& sphere)
{
    sphere.allowKeys({"centre", "radius"});
    return {sphere.at("centre").vector(), sphere.at("radius").positive(kJsonNumberMax)};
}

EditSpan readBox(const JsonCursor& box)
{
    box.allowKeys({"min", "max"});
    const EditSpan span = {box.at("min").vector(), box.at("max").vector()};
    if (glm::any(glm::lessThan(span.max, span.min)))
    {
        throw box.error("has a max that is below min");
    }
    return span;
}

EditMesh readMesh(const JsonCursor& mesh, const std::filesystem::path& folder)
{
    mesh.allowKeys({"file", "up", "place", "fill"});
    EditMesh result;
    result.file = folder / mesh.at("file").text();
    result.up = mesh.valueOr("up", readUpAxis, UpAxis::Y);
    result.transform = mesh.valueOr("place", readPlace, Place()).transform(result.up);
    if (const auto fill = mesh.find("fill"))
    {
        result.fill = static_cast<Fill>(fill->oneOf({"none", "solid", "parity", "robust"}));
    }
    return result;
}

ScriptedEdit readEdit(const JsonCursor& json, const std::filesystem::path& folder)
{
    json.allowKeys({"action", "sphere", "box", "mesh", "color", "emission"});
    ScriptedEdit edit;
    edit.where = json.where();
    const std::size_t action = json.at("action").oneOf({"carve", "fill", "paint", "keep"});
    edit.outside = action == kKeep;
    edit.action = edit.outside ? BrushAction::Carve : static_cast<BrushAction>(action);
    edit.color = json.valueOr("color", readColor, kDefaultColor);
    edit.emission = json.valueOr("emission", readEmission, edit.emission);
    const auto sphere = json.find("sphere");
    const auto box = json.find("box");
    const auto mesh = json.find("mesh");
    if (sphere.has_value() + box.has_value() + mesh.has_value() != 1)
    {
        throw json.error("does not have one shape; expected one of sphere, box, mesh");
    }
    if (mesh && (edit.action == BrushAction::Paint || json.find("color") || json.find("emission")))
    {
        throw mesh->error("goes with carve, fill and keep, and looks as its file says");
    }
    if (edit.action == BrushAction::Carve && (json.find("color") || json.find("emission")))
    {
        throw json.error("has a look, but what is carved has none");
    }
    if (!mesh && edit.outside)
    {
        throw json.at("action").error("is \"keep\", which goes with a mesh");
    }
    if (sphere)
    {
        edit.shape = readSphere(*sphere);
    }
    else if (box)
    {
        edit.shape = readBox(*box);
    }
    else
    {
        edit.shape = readMesh(*mesh, folder);
    }
    return edit;
}

} // namespace

std::vector<ScriptedEdit> parseEditScript(std::string_view text, const std::filesystem::path& path)
{
    const nlohmann::json document = parseJsonStrictly(text, path);
    const JsonCursor root(document, path);
    root.allowKeys({"schema", "about", "edits"});
    static_cast<void>(root.at("schema").oneOf({kEditSchema}));
    static_cast<void>(root.valueOr("about", &JsonCursor::text, std::string()));
    std::vector<ScriptedEdit> edits;
    for (const JsonCursor& edit : root.at("edits").items())
    {
        edits.push_back(readEdit(edit, path.parent_path()));
    }
    return edits;
}

std::vector<ScriptedEdit> readEditScript(const std::filesystem::path& path)
{
    return parseEditScript(asText(readFile(path)), path);
}

Scene loadEditMesh(const EditMesh& mesh)
{
    Scene scene = atRest(loadScene(std::span(&mesh.file, 1)));
    for (Instance& instance : scene.instances)
    {
        instance.transform = glm::mat4(mesh.transform * glm::dmat4(instance.transform));
    }
    return scene;
}

} // namespace zvo
