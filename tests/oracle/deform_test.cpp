// SPDX-License-Identifier: MIT
#include "oracle/deform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace zvo::oracle
{
namespace
{

Primitive oneVertex()
{
    Primitive primitive;
    primitive.positions = {{1.0F, 2.0F, 3.0F}};
    primitive.normals = {{0.6F, 0.8F, 0.0F}};
    primitive.joints = {{1, 0, 0, 0}};
    primitive.weights = {{0.25F, 0.75F, 0.0F, 0.0F}};
    primitive.morph_targets = {{{{4.0F, 0.0F, -2.0F}}, {}}, {{}, {{0.0F, 0.0F, 1.0F}}}};
    return primitive;
}

TEST(OracleDeform, MorphTargetsAdd)
{
    const float weights[] = {0.5F, 2.0F};
    const DeformedVertex vertex = deformVertex(oneVertex(), 0, weights, {});
    EXPECT_EQ(vertex.position, glm::dvec3(3.0, 2.0, 2.0));
    const glm::dvec3 normal(0.6, 0.8, 2.0);
    EXPECT_LT(glm::distance(vertex.normal, glm::normalize(normal)), 1e-7);
}

TEST(OracleDeform, JointsShareAVertexByWeight)
{
    // A quarter of (x doubled, 8 along y) and three quarters of (4 along z): x * 1.25, 2 along y, 3 along z.
    glm::mat4 first(1.0F);
    first[0][0] = 2.0F;
    first[3] = {0.0F, 8.0F, 0.0F, 1.0F};
    const glm::mat4 joints[] = {glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, 4.0F}), first};
    const DeformedVertex vertex = deformVertex(oneVertex(), 0, {}, joints);
    EXPECT_EQ(vertex.position, glm::dvec3(1.25, 4.0, 6.0));
    EXPECT_LT(glm::distance(vertex.normal, glm::normalize(glm::dvec3(0.6 / 1.25, 0.8, 0.0))), 1e-7);
}

TEST(OracleDeform, NormalsStayOutsideOfWhatIsMirrored)
{
    glm::mat4 mirror(1.0F);
    mirror[0][0] = -1.0F;
    const glm::mat4 joints[] = {mirror, mirror};
    const DeformedVertex vertex = deformVertex(oneVertex(), 0, {}, joints);
    EXPECT_LT(glm::distance(vertex.normal, glm::dvec3(-0.6, 0.8, 0.0)), 1e-7);
}

TEST(OracleDeform, NothingIsKnownOfTheNormalOfAFlattenedVertex)
{
    const glm::mat4 flat[] = {glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 1.0F, 0.0F)),
                              glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 1.0F, 0.0F))};
    EXPECT_TRUE(std::isinf(deformVertex(oneVertex(), 0, {}, flat).normal_bound));
}

} // namespace
} // namespace zvo::oracle
