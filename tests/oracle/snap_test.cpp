// SPDX-License-Identifier: MIT
#include "oracle/snap.h"

#include "oracle/test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace zvo::oracle
{
namespace
{

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

SnappedTriangle snapped(const std::array<glm::vec3, 3>& corners, const Grid& grid = test::kUnitGrid,
                        Coverage coverage = Coverage::Conservative)
{
    return snapTriangle(corners, glm::mat4(1.0F), grid, coverage);
}

/// The lattice coordinate x of a point with this world x.
std::int64_t latticeX(float x, const Grid& grid = test::kUnitGrid)
{
    const glm::vec3 p(x, 0.0F, 0.0F);
    return static_cast<std::int64_t>(snapped({p, p, p}, grid).triangle[0][0]);
}

TEST(OracleSnap, RoundsToTheNearestLatticePointAndTiesToEven)
{
    EXPECT_EQ(latticeX(1.0F), 256);
    EXPECT_EQ(latticeX(0.5F / 256), 0);
    EXPECT_EQ(latticeX(1.5F / 256), 2);
    EXPECT_EQ(latticeX(2.5F / 256), 2);
    EXPECT_EQ(latticeX(-0.75F / 256), -1);
    EXPECT_EQ(latticeX(std::nextafter(1.5F, 0.0F) / 256), 1);
}

TEST(OracleSnap, SubtractsTheOriginBeforeItScales)
{
    const Grid grid{.origin = glm::vec3(1.0F), .voxel_size = 0.25F, .depth = 2};
    EXPECT_EQ(latticeX(1.25F, grid), 256);
    // 1e8 - 1 is 1e8 in single precision.
    const Grid coarse{.origin = glm::vec3(1.0F), .voxel_size = 256.0F, .depth = 2};
    EXPECT_EQ(latticeX(1e8F, coarse), 100000000);
}

TEST(OracleSnap, RoundsEveryStepOfTheTransform)
{
    // (1 + 2^-12)^2 = 1 + 2^-11 + 2^-24. The rounded product loses the last term; a fused operation would keep it.
    const float a = 1.0F + 0x1p-12F;
    glm::mat4 transform(1.0F);
    transform[0][0] = a;
    transform[3][0] = -1.0F - 0x1p-11F;
    const Grid fine{.origin = glm::vec3(0.0F), .voxel_size = 0x1p-20F, .depth = 2};
    const glm::vec3 p(a, 0.0F, 0.0F);
    EXPECT_EQ(snapTriangle({p, p, p}, transform, fine, Coverage::Conservative).triangle[0][0], 0);
}

TEST(OracleSnap, TransformsByColumns)
{
    glm::mat4 transform(1.0F);
    transform[1][0] = 2.0F;                           // x += 2 y
    transform[3] = glm::vec4(0.0F, 0.0F, 3.0F, 1.0F); // z += 3
    const glm::vec3 p(0.25F, 0.5F, 0.125F);
    const SnappedTriangle result = snapTriangle({p, p, p}, transform, test::kUnitGrid, Coverage::Conservative);
    EXPECT_EQ(result.triangle[0], (Vec{320, 128, 800}));
}

TEST(OracleSnap, NamesWhyATriangleIsDropped)
{
    const glm::vec3 o(0.0F);
    EXPECT_STREQ(snapped({o, o, glm::vec3(kNan, 0, 0)}).dropped, "nonfinite");
    EXPECT_STREQ(snapped({o, o, glm::vec3(INFINITY, 0, 0)}).dropped, "nonfinite");
    EXPECT_STREQ(snapped({o, o, glm::vec3(2097152.5F, 0, 0)}).dropped, "out_of_range");
    EXPECT_STREQ(snapped({o, o, glm::vec3(3e38F, 0, 0)}).dropped, "out_of_range");
    EXPECT_EQ(snapped({o, o, glm::vec3(2097152.0F, 0, 0)}).dropped, nullptr); // 2^29 itself
    const glm::vec3 left(-0.01F, 0.0F, 0.0F);
    EXPECT_STREQ(snapped({left, left, left}).dropped, "outside");
    const glm::vec3 right(4.01F, 0.0F, 0.0F);
    EXPECT_STREQ(snapped({right, right, right}).dropped, "outside");
    const glm::vec3 end(4.0F);
    EXPECT_EQ(snapped({end, end, end}).dropped, nullptr);
    EXPECT_STREQ(snapped({end, end, o}, test::kUnitGrid, Coverage::Thin).dropped, "zero_area");
}

TEST(OracleSnap, TheFirstReasonOfTheListCounts)
{
    const glm::vec3 far(3e38F, -1.0F, 0.0F);
    EXPECT_STREQ(snapped({far, far, glm::vec3(kNan)}, test::kUnitGrid, Coverage::Thin).dropped, "nonfinite");
    EXPECT_STREQ(snapped({far, far, far}, test::kUnitGrid, Coverage::Thin).dropped, "out_of_range");
    const glm::vec3 left(-1.0F);
    EXPECT_STREQ(snapped({left, left, left}, test::kUnitGrid, Coverage::Thin).dropped, "outside");
}

} // namespace
} // namespace zvo::oracle
