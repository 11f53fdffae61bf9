// SPDX-License-Identifier: MIT
#include "support/moved_scene.h"

#include "core/octree/octree_build.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/deforming_scenes.h"
#include "support/engine_device.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace zvo::test
{

Made makeOctree(vk::HeadlessDevice& device, const PosedGpuScene& scene, Coverage coverage)
{
    const BuildResult result = buildOctree(device, scene, kGrid, {coverage, true, {}});
    return {octreeSha256(device, result.octree), result.dropped, result.octree.voxel_count};
}

Made makeAnew(const Scene& scene, Coverage coverage)
{
    const GpuScene uploaded = uploadScene(device(), scene, true);
    return makeOctree(device(), uploaded, coverage);
}

std::uint32_t expectEqualsPosed(MovedScene& object, const Scene& scene, const Pose& pose)
{
    object.setPose(pose);
    const Scene posed = posedScene(scene, pose);
    std::uint32_t voxel_count = 0;
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        const Made moved = object.make(coverage);
        const Made expected = makeAnew(posed, coverage);
        EXPECT_EQ(moved.sha, expected.sha);
        EXPECT_EQ(moved.dropped, expected.dropped);
        voxel_count = moved.voxel_count;
    }
    return voxel_count;
}

std::pair<Scene, Pose> mixedScene(std::mt19937& random)
{
    Scene scene;
    Pose pose;
    for (int i = 0; i < 4; ++i)
    {
        scene.materials.emplace_back().base_color = glm::vec4(0.2F * static_cast<float>(i), 0.5F, 1.0F, 1.0F);
    }
    scene.materials[2].emission = {3.0F, 1.0F, 0.25F};
    const DeformingParts parts[] = {{true, 5, 3}, {true, 0, 0}, {false, 9, 0}, {true, 0, 2}, {false, 0, 0}};
    for (const DeformingParts& part : parts)
    {
        scene.primitives.push_back(deformingPrimitive(random, 60, part));
        scene.primitives.back().material = static_cast<std::uint32_t>(scene.primitives.size() % 4);
        for (glm::vec3& position : scene.primitives.back().positions)
        {
            position *= 0.3F;
        }
    }
    for (const auto& [primitive, joint_count] : std::vector<std::pair<std::uint32_t, std::size_t>>{
             {1, 0}, {0, 5}, {3, 0}, {2, 9}, {0, 5}, {2, 0}, {0, 0}, {4, 0}, {3, 0}, {1, 0}})
    {
        addDeforming(random, scene, pose, primitive, joint_count);
    }
    return {std::move(scene), std::move(pose)};
}

} // namespace zvo::test
