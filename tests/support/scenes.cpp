// SPDX-License-Identifier: MIT
#include "support/scenes.h"

#include "support/places.h"

#include <map>
#include <numbers>
#include <random>
#include <vector>

namespace zvo::test
{

Scene triangleSoup(const std::vector<glm::vec3>& corners)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.primitives.emplace_back();
    scene.primitives[0].positions = corners;
    for (std::uint32_t i = 0; i < corners.size(); i += 3)
    {
        scene.primitives[0].triangles.emplace_back(i, i + 1, i + 2);
    }
    scene.instances.emplace_back();
    return scene;
}

Scene randomTriangles(std::uint32_t seed, std::size_t count, float extent)
{
    std::mt19937 random(seed);
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const auto point = [&](float size) {
        return glm::vec3{uniform(-size, size), uniform(-size, size), uniform(-size, size)};
    }; // drawn in this order
    std::vector<glm::vec3> corners;
    for (std::size_t i = 0; i < count; ++i)
    {
        const glm::vec3 center = point(extent / 2) + glm::vec3(extent / 2);
        const float size = extent * std::exp2(uniform(-10.0F, 0.5F));
        glm::vec3 triangle[3] = {center + point(size), center + point(size), center + point(size)};
        switch (random() % 6)
        {
        case 0: // a needle
            triangle[2] = triangle[1] + point(size * 1e-3F);
            break;
        case 1: // a sliver
            triangle[2] = (triangle[0] + triangle[1]) * 0.5F + point(size * 1e-3F);
            break;
        case 2: // axis-aligned, on whole units
            for (glm::vec3& corner : triangle)
            {
                corner = glm::round(corner);
                corner[static_cast<int>(i % 3)] = std::round(center[static_cast<int>(i % 3)]);
            }
            break;
        default:
            break;
        }
        corners.insert(corners.end(), std::begin(triangle), std::end(triangle));
    }
    return triangleSoup(corners);
}

Scene randomPoints(std::uint32_t seed, std::size_t count, int extent)
{
    std::mt19937 random(seed);
    const auto within = [&](int low, int high)
    { return static_cast<float>(low + static_cast<int>(random() % static_cast<std::uint32_t>(high - low + 1))); };
    const auto coordinate = [&]
    {
        const bool is_between = random() % 4 == 0;
        return is_between ? within(-extent / 8, extent + extent / 8)
                          : within(-64 * extent, 576 * extent) * (1.0F / 512.0F);
    };
    Scene scene;
    scene.materials.emplace_back();
    scene.instances.emplace_back();
    Primitive& cloud = scene.primitives.emplace_back();
    cloud.is_points = true;
    for (std::size_t i = 0; i < count; ++i)
    {
        cloud.triangles.emplace_back(static_cast<std::uint32_t>(i));
        const float x = coordinate();
        const float y = coordinate();
        cloud.positions.emplace_back(x, y, coordinate());
        const float red = within(0, 255) / 255.0F;
        const float green = within(0, 255) / 255.0F;
        cloud.colors.emplace_back(red, green, within(0, 255) / 255.0F, 1.0F);
        const float along = within(-100, 100);
        cloud.normals.push_back(glm::normalize(glm::vec3(along, within(-100, 100), 101.0F)));
    }
    return scene;
}

Scene boxScene(const glm::vec3& min, const glm::vec3& max)
{
    std::vector<glm::vec3> corners;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const float side : {min[axis], max[axis]})
        {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            glm::vec3 quad[4];
            for (int i = 0; i < 4; ++i)
            {
                quad[i][axis] = side;
                quad[i][u] = i == 1 || i == 2 ? max[u] : min[u];
                quad[i][v] = i >= 2 ? max[v] : min[v];
            }
            corners.insert(corners.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
        }
    }
    return triangleSoup(corners);
}

Scene sphereScene(const glm::vec3& center, float radius, std::uint32_t rings)
{
    const auto point = [&](std::uint32_t ring, std::uint32_t segment)
    {
        const double theta = std::numbers::pi * ring / rings;
        const double phi = std::numbers::pi * segment / rings;
        return center +
               radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    std::vector<glm::vec3> corners;
    for (std::uint32_t ring = 0; ring < rings; ++ring)
    {
        for (std::uint32_t segment = 0; segment < 2 * rings; ++segment)
        {
            const glm::vec3 a = point(ring, segment);
            const glm::vec3 b = point(ring, segment + 1);
            const glm::vec3 c = point(ring + 1, segment + 1);
            const glm::vec3 d = point(ring + 1, segment);
            corners.insert(corners.end(), {a, b, c, a, c, d});
        }
    }
    return triangleSoup(corners);
}

std::filesystem::path modelsFolder()
{
    return placeOf(ZVO_SHARED_SCENES_DIR, "models");
}

std::optional<std::filesystem::path> sharedScene(const std::string& name)
{
    const std::filesystem::path path = modelsFolder() / name;
    return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

std::string missingModelOf(const std::string& scene_file)
{
    static const std::map<std::string, std::vector<std::string>> models = {
        {"atrium_knot", {}},
        {"buddha_dragon", {"buddha_113k.glb", "dragon.glb"}},
        {"sponza_bunny", {"sponza.glb", "bunny.glb"}},
    };
    for (const std::string& model : models.at(scene_file))
    {
        if (!sharedScene(model))
        {
            return model;
        }
    }
    return "";
}

std::filesystem::path ownScene(const std::string& name)
{
    return placeOf(ZVO_SCENES_DIR, "scenes") / name;
}

std::optional<std::filesystem::path> findScene(const std::string& name)
{
    const std::filesystem::path own = ownScene(name);
    return std::filesystem::exists(own) ? std::optional(own) : sharedScene(name);
}

} // namespace zvo::test
