// SPDX-License-Identifier: MIT
#include "core/scene/rig.h"

#include <cmath>

namespace zvo
{

namespace
{

constexpr double kAffineTolerance = 1e-6; // of the last row; some exporters round

glm::dmat3 rotationMatrix(const glm::dquat& rotation)
{
    const glm::dvec4 q(rotation.x, rotation.y, rotation.z, rotation.w);
    const double length_squared = glm::dot(q, q);
    const double s = length_squared > 0.0 ? 2.0 / length_squared : 0.0;
    const glm::dvec3 column_x(1.0 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y + q.w * q.z),
                              s * (q.x * q.z - q.w * q.y));
    const glm::dvec3 column_y(s * (q.x * q.y - q.w * q.z), 1.0 - s * (q.x * q.x + q.z * q.z),
                              s * (q.y * q.z + q.w * q.x));
    const glm::dvec3 column_z(s * (q.x * q.z + q.w * q.y), s * (q.y * q.z - q.w * q.x),
                              1.0 - s * (q.x * q.x + q.y * q.y));
    return {column_x, column_y, column_z};
}

} // namespace

glm::dmat4 composeTransform(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale)
{
    const glm::dmat3 turn = rotationMatrix(rotation);
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 3; ++column)
    {
        matrix[column] = glm::dvec4(turn[column] * scale[column], 0.0);
    }
    matrix[3] = glm::dvec4(translation, 1.0);
    return matrix;
}

bool isAffine(const glm::dmat4& matrix)
{
    for (int column = 0; column < 4; ++column)
    {
        if (!(std::abs(matrix[column][3] - (column == 3 ? 1.0 : 0.0)) <= kAffineTolerance))
        {
            return false;
        }
    }
    return true;
}

glm::dmat4 withAffineRow(glm::dmat4 matrix)
{
    for (int column = 0; column < 4; ++column)
    {
        matrix[column][3] = column == 3 ? 1.0 : 0.0;
    }
    return matrix;
}

} // namespace zvo
