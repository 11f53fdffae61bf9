// SPDX-License-Identifier: MIT
#include "core/tree/normal.h"

#include "core/tree/attribute_format.h"

#include <cmath>

namespace zvo
{

glm::vec3 decodeNormal(std::uint32_t code)
{
    if (code == gpu::kNoNormal)
    {
        return glm::vec3(0.0F);
    }
    constexpr double kOne = 32767.0; // 1 as a snorm16
    const double x = static_cast<std::int16_t>(code) / kOne;
    const double y = static_cast<std::int16_t>(code >> 16) / kOne;
    glm::dvec3 v(x, y, 1.0 - std::abs(x) - std::abs(y));
    if (v.z < 0.0)
    {
        v.x = std::copysign(1.0 - std::abs(y), x);
        v.y = std::copysign(1.0 - std::abs(x), y);
    }
    return glm::vec3(glm::normalize(v));
}

} // namespace zvo
