// SPDX-License-Identifier: MIT
// What tests of animations share.
#pragma once

#include "core/scene/animation.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace zvo::test
{

/// A triangle on node 0, which the channel moves.
inline Scene movedBy(const Channel& channel)
{
    Scene scene = triangleSoup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    scene.nodes.emplace_back();
    scene.instances[0].node = 0;
    scene.animations.push_back({"", {channel}, channel.times.back()});
    return scene;
}

inline glm::mat4 transformAt(const Scene& scene, double seconds)
{
    return poseAt(scene, seconds).transforms.at(0);
}

inline void expectNear(const glm::mat4& matrix, const glm::mat4& wanted, float tolerance)
{
    for (int i = 0; i < 16; ++i)
    {
        EXPECT_NEAR(matrix[i / 4][i % 4], wanted[i / 4][i % 4], tolerance) << "column " << i / 4 << ", row " << i % 4;
    }
}

} // namespace zvo::test
