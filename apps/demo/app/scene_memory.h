// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "io/file/json_cursor.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace zvo::demo
{

using Bookmarks = std::array<std::optional<ViewCamera>, 9>;

/// How the files of a scene were looked at last.
struct SceneMemory
{
    static constexpr std::size_t kMost = 12; // scenes that are kept

    std::vector<std::filesystem::path> files; // absolute
    ViewCamera camera;
    Bookmarks bookmarks;
    glm::dvec3 to_sun{0.0, 1.0, 0.0};
    float exposure = 1;

    bool operator==(const SceneMemory& other) const;
};

/// Files by which a scene is known, wherever the program is started.
std::vector<std::filesystem::path> absoluteFiles(const std::vector<std::filesystem::path>& files);

/// Puts a memory in front of the others, in place of an older one of the same files. The oldest ones are dropped.
void remember(std::vector<SceneMemory>& memories, SceneMemory memory);

/// The memory of a scene; null if there is none.
const SceneMemory* recall(const std::vector<SceneMemory>& memories, const std::vector<std::filesystem::path>& files);

/// For the settings' file. Reading throws Error{Input}.
nlohmann::ordered_json memoryJson(const SceneMemory& memory);
SceneMemory readMemory(const JsonCursor& object);

} // namespace zvo::demo
