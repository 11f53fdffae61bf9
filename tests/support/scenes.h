// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace zvo::test
{

/// One instance of the triangles, each three corners in a row, with one default material.
Scene triangleSoup(const std::vector<glm::vec3>& corners);

/// count random triangles in [0, extent]^3, a mixture of tiny, long, thin, flat and huge ones.
Scene randomTriangles(std::uint32_t seed, std::size_t count, float extent);

/// count random points with colours and normals in a cube that reaches beyond [0, extent]^3 by an eighth of extent.
/// Coordinates are multiples of 1/512; many lie between voxels of edge 1.
Scene randomPoints(std::uint32_t seed, std::size_t count, int extent);

/// The box from min to max, twelve triangles.
Scene boxScene(const glm::vec3& min, const glm::vec3& max);

/// A sphere of rings x 2 rings quads.
Scene sphereScene(const glm::vec3& center, float radius, std::uint32_t rings);

/// Where the big scenes are that are not in the project; the folder may be absent.
std::filesystem::path modelsFolder();

/// Path of one of the big scenes that are not in the project (scenes/README.md), if it is there.
std::optional<std::filesystem::path> sharedScene(const std::string& name);

/// The first missing model that one of the project's scene files ("atrium_knot" and so on) needs; empty if none is
/// missing.
std::string missingModelOf(const std::string& scene_file);

/// Path of one of the project's scenes.
std::filesystem::path ownScene(const std::string& name);

/// Path of one of the project's scenes, or else of one of the big ones, if it is there.
std::optional<std::filesystem::path> findScene(const std::string& name);

} // namespace zvo::test
