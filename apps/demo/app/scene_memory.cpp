// SPDX-License-Identifier: MIT
#include "demo/app/scene_memory.h"

#include "demo/world/view_state.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>
#include <system_error>
#include <utility>

namespace zvo::demo
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr double kHalfHeightMax = 1e30;

Json vectorJson(const glm::dvec3& vector)
{
    return {vector.x, vector.y, vector.z};
}

Json cameraJson(const ViewCamera& camera)
{
    Json json = {{"position", vectorJson(camera.position)},
                 {"forward", vectorJson(camera.forward)},
                 {"right", vectorJson(camera.right)},
                 {"up", vectorJson(camera.up)}};
    json[camera.orthographic ? "half_height" : "fov"] = camera.orthographic ? camera.half_height : camera.vertical_fov;
    return json;
}

ViewCamera readCamera(const JsonCursor& object)
{
    object.allowKeys({"position", "forward", "right", "up", "half_height", "fov"});
    ViewCamera camera;
    camera.position = object.at("position").vector();
    for (const auto& [key, axis] :
         {std::pair("forward", &camera.forward), std::pair("right", &camera.right), std::pair("up", &camera.up)})
    {
        *axis = object.at(key).nonZeroVector();
    }
    if (const std::optional<JsonCursor> half_height = object.find("half_height"))
    {
        camera.orthographic = true;
        camera.half_height = half_height->positive(kHalfHeightMax);
    }
    else
    {
        camera.vertical_fov = object.at("fov").positive(std::numbers::pi);
    }
    return camera;
}

} // namespace

bool SceneMemory::operator==(const SceneMemory& other) const
{
    return memoryJson(*this) == memoryJson(other);
}

std::vector<std::filesystem::path> absoluteFiles(const std::vector<std::filesystem::path>& files)
{
    std::vector<std::filesystem::path> whole;
    for (const std::filesystem::path& file : files)
    {
        std::error_code failure;
        const std::filesystem::path found = std::filesystem::weakly_canonical(file, failure);
        whole.push_back(failure ? file : found);
    }
    return whole;
}

void remember(std::vector<SceneMemory>& memories, SceneMemory memory)
{
    std::erase_if(memories, [&](const SceneMemory& older) { return older.files == memory.files; });
    memories.insert(memories.begin(), std::move(memory));
    memories.resize(std::min(memories.size(), SceneMemory::kMost));
}

const SceneMemory* recall(const std::vector<SceneMemory>& memories, const std::vector<std::filesystem::path>& files)
{
    const auto found = std::ranges::find(memories, files, &SceneMemory::files);
    return found == memories.end() ? nullptr : &*found;
}

Json memoryJson(const SceneMemory& memory)
{
    Json json;
    json["files"] = Json::array();
    for (const std::filesystem::path& file : memory.files)
    {
        json["files"].push_back(file.string());
    }
    json["camera"] = cameraJson(memory.camera);
    json["bookmarks"] = Json::array();
    for (std::size_t number = 0; number < memory.bookmarks.size(); ++number)
    {
        if (const std::optional<ViewCamera>& bookmark = memory.bookmarks[number])
        {
            json["bookmarks"].push_back({{"number", number + 1}, {"camera", cameraJson(*bookmark)}});
        }
    }
    json["sun"] = vectorJson(memory.to_sun);
    json["exposure"] = double{memory.exposure};
    return json;
}

SceneMemory readMemory(const JsonCursor& object)
{
    object.allowKeys({"files", "camera", "bookmarks", "sun", "exposure"});
    SceneMemory memory;
    for (const JsonCursor& file : object.at("files").items())
    {
        memory.files.emplace_back(file.text());
    }
    if (memory.files.empty())
    {
        throw object.at("files").mismatch("at least one file");
    }
    memory.camera = readCamera(object.at("camera"));
    for (const JsonCursor& bookmark : object.at("bookmarks").items())
    {
        bookmark.allowKeys({"number", "camera"});
        const std::uint32_t number = bookmark.at("number").whole(1, memory.bookmarks.size());
        memory.bookmarks[number - 1] = readCamera(bookmark.at("camera"));
    }
    memory.to_sun = object.at("sun").nonZeroVector();
    memory.exposure = static_cast<float>(object.at("exposure").positive(ViewState::kPositiveMax));
    return memory;
}

} // namespace zvo::demo
