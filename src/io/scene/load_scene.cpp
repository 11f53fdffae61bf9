// SPDX-License-Identifier: MIT
#include "io/scene/load_scene.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/file/zvo_file.h"
#include "core/scene/animation.h"
#include "core/scene/hulls.h"
#include "core/scene/points.h"
#include "io/file/text_cursor.h"
#include "io/file/utf16.h"
#include "io/gltf/gltf_loader.h"
#include "io/mesh/obj_file.h"
#include "io/mesh/ply_file.h"
#include "io/mesh/stl_file.h"
#include "io/mesh/xyz_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

enum class FileFormat
{
    Gltf,
    Obj,
    Ply,
    Stl,
    Xyz
};

constexpr const char* kHoldsVoxels = "it holds voxels and no triangles, of which scenes are made; zvo render shows it "
                                     "alone, zvo convert makes a .zvo file or a mesh (.glb) of it";

std::string lowerExtension(const std::filesystem::path& path)
{
    return lowered(path.extension().string());
}

std::optional<FileFormat> formatOf(std::span<const std::uint8_t> bytes, const std::string& extension)
{
    const std::string_view content = asText(bytes);
    if (content.starts_with("glTF") || extension == ".gltf" || extension == ".glb")
    {
        return FileFormat::Gltf;
    }
    if (content.starts_with("ply\n") || content.starts_with("ply\r") || extension == ".ply")
    {
        return FileFormat::Ply;
    }
    if (extension == ".obj")
    {
        return FileFormat::Obj;
    }
    if (extension == ".stl" || isBinaryStl(bytes) || isTextStl(bytes))
    {
        return FileFormat::Stl;
    }
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && content[first] == '{')
    {
        return FileFormat::Gltf;
    }
    const bool has_vertices = content.starts_with("v ") || content.find("\nv ") != std::string_view::npos;
    return has_vertices                ? std::optional(FileFormat::Obj)
           : isXyzExtension(extension) ? std::optional(FileFormat::Xyz)
                                       : std::nullopt;
}

Scene loadFile(const std::filesystem::path& path, ImageDecoding decoding)
{
    if (isSceneFile(path))
    {
        throw inputError(path, "a scene file, which cannot be part of another scene; name the files in it");
    }
    if (isZvoFile(path))
    {
        throw inputError(path, kHoldsVoxels);
    }
    std::vector<std::uint8_t> bytes = readFile(path);
    const std::string extension = lowerExtension(path);
    // Any text may begin with the mark of UTF-8.
    if (auto utf8 = asUtf8(bytes); utf8 && (extension == ".obj" || (bytes[0] == 0xEF && bytes[1] != 0)))
    {
        bytes = *std::move(utf8);
    }
    if (extension == ".vox" || asText(bytes).starts_with("VOX "))
    {
        throw inputError(path, kHoldsVoxels);
    }
    const std::optional<FileFormat> format = formatOf(bytes, extension);
    if (!format)
    {
        throw inputError(path,
                         "neither glTF 2.0 nor OBJ, PLY, STL or text with points; export it as one of them, or name "
                         "it .gltf, .glb, .obj, .ply, .stl or .xyz");
    }
    switch (*format)
    {
    case FileFormat::Obj:
        return readObj(path, bytes, decoding);
    case FileFormat::Ply:
        return readPly(path, bytes, decoding);
    case FileFormat::Stl:
        return readStl(path, bytes);
    case FileFormat::Xyz:
        return readXyz(path, bytes);
    default:
        return loadGltf(path, std::move(bytes), decoding);
    }
}

/// Throws Error{Input} for the first of a file's warnings, if there is one.
void refuseWarnings(const std::vector<std::string>& warnings)
{
    if (!warnings.empty())
    {
        const std::string more = warnings.size() > 1 ? fmt::format(" for this and {} more", warnings.size() - 1) : "";
        throw Error(ErrorCode::Input, fmt::format("{}; strict loading refuses the file{}", warnings.front(), more));
    }
}

/// Adds a root node with that transform above all others.
void placeNodes(Scene& scene, const glm::mat4& to_world)
{
    Scene placed;
    placed.nodes.emplace_back().matrix = to_world;
    placed.append(std::move(scene));
    for (std::size_t i = 1; i < placed.nodes.size(); ++i)
    {
        std::uint32_t& parent = placed.nodes[i].parent;
        parent = parent == kNone ? 0 : parent;
    }
    scene = std::move(placed);
}

void leaveOutHulls(Scene& scene, const std::filesystem::path& path)
{
    const LeftOutHulls left_out = leaveOutHulls(scene);
    if (left_out.hull_count != 0)
    {
        scene.warnings.emplace_back(
            inputError(path, fmt::format("left out {} inverted hull{}, which would hide what they lie around ({} "
                                         "triangles of material {}); --keep-hulls keeps them",
                                         left_out.hull_count, left_out.hull_count == 1 ? "" : "s",
                                         left_out.triangle_count, fmt::join(left_out.materials, ", ")))
                .what());
    }
}

} // namespace

bool isSceneFile(const std::filesystem::path& path)
{
    return lowerExtension(path) == ".json" && lowerExtension(path.stem()) == ".scene";
}

glm::mat3 rotationToY(UpAxis up)
{
    static const std::array<glm::mat3, 6> kRotations = {{
        // the axes to which x, y and z of the file are mapped
        {0, 1, 0, -1, 0, 0, 0, 0, 1},
        {1, 0, 0, 0, 1, 0, 0, 0, 1},
        {1, 0, 0, 0, 0, -1, 0, 1, 0},
        {0, -1, 0, 1, 0, 0, 0, 0, 1},
        {1, 0, 0, 0, -1, 0, 0, 0, -1},
        {1, 0, 0, 0, 0, 1, 0, -1, 0},
    }};
    return kRotations.at(static_cast<std::size_t>(up));
}

Scene loadScene(std::span<const std::filesystem::path> paths, const LoadOptions& options)
{
    SkippedMaterials skipped(options.skip_materials);
    Scene scene = loadScene(paths, options, skipped);
    std::ranges::move(skipped.warnings(), std::back_inserter(scene.warnings));
    return scene;
}

Scene loadScene(std::span<const std::filesystem::path> paths, const LoadOptions& options, SkippedMaterials& skipped)
{
    Scene scene;
    for (const std::filesystem::path& path : paths)
    {
        Scene loaded = loadFile(path, options.strict ? ImageDecoding::WhenLoaded : options.images);
        skipped.leaveOut(loaded);
        if (!options.keep_hulls)
        {
            leaveOutHulls(loaded, path);
        }
        if (options.strict)
        {
            refuseWarnings(loaded.warnings);
        }
        if (!options.every_animation)
        {
            keepAnimation(loaded);
        }
        widenPoints(loaded, options.point_size);
        scene.append(options.bind_pose ? asModelled(std::move(loaded)) : std::move(loaded));
    }
    applyLoadOptions(scene, options);
    return scene;
}

void applyLoadOptions(Scene& scene, const LoadOptions& options)
{
    if (options.up == UpAxis::Y && options.scale == 1.0F)
    {
        return;
    }
    const glm::mat4 rotation(rotationToY(options.up));
    glm::mat4 to_world = options.scale * rotation;
    to_world[3][3] = 1.0F;
    const auto checkFinite = [&](const glm::mat4& transform)
    {
        for (int i = 0; i < 16; ++i)
        {
            if (!std::isfinite(transform[i / 4][i % 4]))
            {
                throw Error(ErrorCode::Usage,
                            fmt::format("scaled by {} the scene is larger than single precision holds; scale it less",
                                        options.scale));
            }
        }
    };
    for (Instance& instance : scene.instances)
    {
        instance.transform = to_world * instance.transform;
        checkFinite(instance.transform);
    }
    if (!scene.nodes.empty())
    {
        placeNodes(scene, to_world);
    }
    for (Camera& camera : scene.cameras)
    {
        camera.transform = rotation * camera.transform;
        camera.transform[3] = glm::vec4(options.scale * glm::vec3(camera.transform[3]), 1.0F);
        camera.half_height *= options.scale;
        checkFinite(camera.transform);
    }
}

} // namespace zvo
