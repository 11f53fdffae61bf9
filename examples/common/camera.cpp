// SPDX-License-Identifier: MIT
#include "common/camera.h"

#include <algorithm>
#include <cmath>

namespace host
{

namespace
{

using zvo::DVec3;

double dot(const DVec3& a, const DVec3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

DVec3 cross(const DVec3& a, const DVec3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

DVec3 scaled(const DVec3& v, double factor)
{
    return {factor * v[0], factor * v[1], factor * v[2]};
}

DVec3 normalized(const DVec3& v)
{
    return scaled(v, 1 / std::sqrt(dot(v, v)));
}

void setRow(zvo::DMat4& matrix, std::size_t row, const DVec3& axis, const DVec3& position)
{
    for (std::size_t column = 0; column < 3; ++column)
    {
        matrix[4 * column + row] = axis[column];
    }
    matrix[12 + row] = -dot(axis, position);
}

} // namespace

zvo::DMat4 reversedViewProjection(const zvo::CameraInfo& camera, double aspect, double near)
{
    const DVec3 forward = normalized(camera.forward);
    const DVec3 right = normalized(cross(forward, camera.up));
    const DVec3 down = cross(forward, right);
    const double tangent = std::tan(0.5 * camera.vertical_fov);
    zvo::DMat4 matrix{};
    setRow(matrix, 0, scaled(right, 1 / (tangent * aspect)), camera.position);
    setRow(matrix, 1, scaled(down, 1 / tangent), camera.position);
    matrix[14] = near;
    setRow(matrix, 3, forward, camera.position);
    return matrix;
}

zvo::Mat4 narrowed(const zvo::DMat4& matrix)
{
    zvo::Mat4 result{};
    std::ranges::transform(matrix, result.begin(), [](double value) { return static_cast<float>(value); });
    return result;
}

} // namespace host
