// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace zvo
{

/// Whether all components are finite: neither infinite nor NaN. Of a matrix, the upper three rows are checked.
inline bool isFinite(const glm::vec3& vector)
{
    return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

inline bool isFinite(const glm::mat4& matrix)
{
    return isFinite(glm::vec3(matrix[0])) && isFinite(glm::vec3(matrix[1])) && isFinite(glm::vec3(matrix[2])) &&
           isFinite(glm::vec3(matrix[3]));
}

/// vector scaled to length 1; 0 where it has no direction.
inline glm::vec3 unitOrZero(const glm::dvec3& vector)
{
    const double length = std::sqrt(glm::dot(vector, vector));
    return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : glm::vec3(0.0F);
}

} // namespace zvo
