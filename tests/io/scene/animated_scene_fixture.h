// SPDX-License-Identifier: MIT
// What tests of animated scenes share.
#pragma once

#include "io/gltf/gltf_builder.h"
#include "io/scene/animated_scene.h"
#include "support/scenes.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace zvo::test
{

/// A folder with scene files in scenes/ and models in models/.
class AnimatedSceneTest : public testing::Test
{
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(m_dir.path() / "scenes" / "below");
        std::filesystem::create_directories(m_dir.path() / "models");
        m_dir.write("scenes/triangle.glb", triangleDocument().glb());
        m_dir.write("scenes/below/other.glb", triangleDocument().glb());
        m_dir.write("models/far.glb", movedTriangle().glb());
        m_dir.write("outside.glb", triangleDocument().glb());
    }

    // Its corners: (10, 20, 30), (12, 20, 30), (10, 22, 30).
    static GltfBuilder movedTriangle()
    {
        GltfBuilder builder = triangleDocument();
        builder.document["nodes"][0]["translation"] = {10, 20, 30};
        builder.document["nodes"][0]["scale"] = {2, 2, 2};
        builder.add("cameras", {{"type", "orthographic"},
                                {"name", "far"},
                                {"orthographic", {{"xmag", 1}, {"ymag", 3}, {"znear", 0.1}, {"zfar", 9}}}});
        builder.add("nodes", {{"camera", 0}, {"translation", {0, 0, 1}}});
        return builder;
    }

    AnimatedScene load(const std::string& content, bool with_models = true) const
    {
        const std::filesystem::path path = m_dir.write("scenes/test.scene.json", content);
        AnimatedSceneOptions options;
        if (with_models)
        {
            options.scenes_folder = m_dir.path() / "models";
        }
        return loadAnimatedScene(path, options);
    }

    AnimatedScene loadFileOf(const std::string& file, bool with_models = true) const
    {
        return load(R"({"objects": [{"file": ")" + file + "\"}]}", with_models);
    }

    TempDir m_dir;
};

/// The corners of all triangles, in order.
inline std::vector<glm::vec3> corners(const Scene& scene)
{
    std::vector<glm::vec3> points;
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives.at(instance.primitive);
        for (const glm::uvec3& triangle : primitive.triangles)
        {
            for (int i = 0; i < 3; ++i)
            {
                points.push_back(transformPoint(instance.transform, primitive.positions.at(triangle[i])));
            }
        }
    }
    return points;
}

} // namespace zvo::test
