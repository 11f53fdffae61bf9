// SPDX-License-Identifier: MIT
#include "oracle/deform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace zvo::oracle
{
namespace
{

constexpr double kRounding = 0x1p-24;
constexpr double kTiny = 1e-25; // error of dropped small terms, for matrices and vertices of ordinary size

/// A sum of vectors, and the sum of their absolute values.
struct Summed
{
    glm::dvec3 value{0.0};
    glm::dvec3 size{0.0};
};

Summed morph(const glm::vec3& rest, const Primitive& primitive, std::size_t vertex, std::span<const float> weights,
             std::vector<glm::vec3> MorphTarget::*deltas)
{
    Summed result{glm::dvec3(rest), glm::abs(glm::dvec3(rest))};
    for (std::size_t i = 0; i < std::min(weights.size(), primitive.morph_targets.size()); ++i)
    {
        const std::vector<glm::vec3>& values = primitive.morph_targets[i].*deltas;
        if (!values.empty())
        {
            const glm::dvec3 delta = glm::dvec3(values[vertex]) * static_cast<double>(weights[i]);
            result.value += delta;
            result.size += glm::abs(delta);
        }
    }
    return result;
}

glm::dmat4 absolute(const glm::dmat4& m)
{
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2]), glm::abs(m[3])};
}

/// Cofactors with both products added, and all factors positive.
glm::dmat3 cofactorSizes(const glm::dmat3& m)
{
    const auto cross = [](const glm::dvec3& a, const glm::dvec3& b)
    { return glm::dvec3(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x); };
    return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
}

} // namespace

DeformedVertex deformVertex(const Primitive& primitive, std::size_t vertex, std::span<const float> morph_weights,
                            std::span<const glm::mat4> joints)
{
    const double steps = static_cast<double>(morph_weights.size()) + 24.0; // roundings that any term passes through
    DeformedVertex result;
    Summed position = morph(primitive.positions[vertex], primitive, vertex, morph_weights, &MorphTarget::positions);
    Summed normal;
    if (!primitive.normals.empty())
    {
        normal = morph(primitive.normals[vertex], primitive, vertex, morph_weights, &MorphTarget::normals);
    }
    bool sure_of_side = true;
    if (!joints.empty() && !primitive.joints.empty())
    {
        glm::dmat4 blended(0.0);
        glm::dmat4 sizes(0.0);
        const glm::dvec4 weights(primitive.weights[vertex]);
        const bool none = weights == glm::dvec4(0.0);
        for (int i = 0; i < 4; ++i)
        {
            const double weight = none ? (i == 0 ? 1.0 : 0.0) : weights[i];
            if (weight != 0.0)
            {
                const glm::dmat4 matrix(joints[primitive.joints[vertex][i]]);
                blended += matrix * weight;
                sizes += absolute(matrix) * std::abs(weight);
            }
        }
        position.value = glm::dvec3(blended * glm::dvec4(position.value, 1.0));
        position.size = glm::dvec3(sizes * glm::dvec4(position.size, 1.0));
        const glm::dmat3 linear(blended);
        const double determinant = glm::determinant(linear);
        const glm::dmat3 cofactors = cofactorSizes(glm::dmat3(sizes));
        const double determinant_size = glm::dot(glm::dvec3(sizes[0]), cofactors[0]);
        sure_of_side = std::abs(determinant) > steps * kRounding * determinant_size;
        result.side = !sure_of_side ? 0 : determinant < 0.0 ? -1 : 1;
        if (sure_of_side)
        {
            normal.value = glm::transpose(glm::inverse(linear)) * normal.value * std::abs(determinant);
            normal.size = cofactors * normal.size;
        }
    }
    result.position = position.value;
    result.position_bound = position.size * (steps * kRounding) + kTiny;
    const double length = glm::length(normal.value);
    const double error = glm::length(normal.size) * steps * kRounding;
    result.normal_bound = std::numeric_limits<double>::infinity();
    if (sure_of_side && length > 0.0 && error < 0.25 * length)
    {
        result.normal = normal.value / length;
        result.normal_bound = 3 * error / length; // the error moves direction and length
    }
    return result;
}

} // namespace zvo::oracle
