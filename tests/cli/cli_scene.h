// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_builder.h"

#include <array>

namespace zvo::test
{

/// The cube from (0, 0, 0) to (1, 1, 1), a normal and a colour for each of its faces, and a camera called "front".
inline GltfBuilder coloredCube()
{
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> colors;
    std::vector<std::uint16_t> indices;
    for (int face = 0; face < 6; ++face)
    {
        const int axis = face / 2;
        const bool upper = face % 2 == 1;
        for (int corner = 0; corner < 4; ++corner)
        {
            std::array<float, 3> position{};
            std::array<float, 3> normal{};
            position[axis] = upper ? 1.0F : 0.0F;
            position[(axis + 1) % 3] = corner == 1 || corner == 2 ? 1.0F : 0.0F;
            position[(axis + 2) % 3] = corner >= 2 ? 1.0F : 0.0F;
            normal[axis] = upper ? 1.0F : -1.0F;
            positions.insert(positions.end(), position.begin(), position.end());
            normals.insert(normals.end(), normal.begin(), normal.end());
            for (int channel = 0; channel < 3; ++channel)
            {
                colors.push_back(channel == axis ? 1.0F : 0.0F);
            }
        }
        for (const int corner : {0, 1, 2, 0, 2, 3})
        {
            indices.push_back(static_cast<std::uint16_t>(4 * face + corner));
        }
    }
    GltfBuilder builder;
    const json attributes = {{"POSITION", builder.addPositions(positions)},
                             {"NORMAL", builder.addAccessor("VEC3", kF32, 24, normals)},
                             {"COLOR_0", builder.addAccessor("VEC3", kF32, 24, colors)}};
    builder.addMeshNode({{"attributes", attributes}, {"indices", builder.addAccessor("SCALAR", kU16, 36, indices)}});
    builder.add("cameras",
                {{"type", "perspective"}, {"name", "front"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
    builder.add("nodes", {{"camera", 0}, {"translation", {0.5, 0.5, 4.0}}});
    return builder;
}

} // namespace zvo::test
