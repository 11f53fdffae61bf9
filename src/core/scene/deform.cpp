// SPDX-License-Identifier: MIT
// Compiled without contraction (zvo_options): no product and sum are fused.
#include "core/scene/deform.h"

#include "deform/deform.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>

namespace zvo
{

namespace
{

static_assert(std::bit_cast<std::uint32_t>(kTurnedRound.x) == gpu::kTurnedRoundBits);

// The exponent, and below it 24 bits: the sign is out of the way.
std::uint32_t sizeBits(float value)
{
    return std::bit_cast<std::uint32_t>(value) << 1;
}

glm::vec3 product(const glm::vec3& v, float s)
{
    return withoutTiny(v * s);
}

glm::vec3 product(const glm::vec3& a, const glm::vec3& b)
{
    return withoutTiny(a * b);
}

glm::vec3 crossProduct(const glm::vec3& a, const glm::vec3& b)
{
    return product(glm::vec3(a.y, a.z, a.x), glm::vec3(b.z, b.x, b.y)) -
           product(glm::vec3(a.z, a.x, a.y), glm::vec3(b.y, b.z, b.x));
}

glm::vec3 transformed(const glm::vec3& x, const glm::vec3& y, const glm::vec3& z, const glm::vec3& v)
{
    return (product(x, v.x) + product(y, v.y)) + product(z, v.z);
}

float canonical(float value)
{
    const std::uint32_t size = sizeBits(value);
    if (size == 0)
    {
        return 0.0F;
    }
    return size >= 255U << 24 ? std::bit_cast<float>(gpu::kCanonicalNan) : value;
}

glm::vec3 canonical(const glm::vec3& v)
{
    return {canonical(v.x), canonical(v.y), canonical(v.z)};
}

using Deltas = std::vector<glm::vec3> MorphTarget::*;

// What morph targets add to one array of a primitive.
class Morph
{
public:
    Morph(const Primitive& primitive, std::span<const float> weights, Deltas deltas)
    {
        const std::size_t count = std::min(weights.size(), primitive.morph_targets.size());
        for (std::size_t i = 0; i < count; ++i)
        {
            const std::vector<glm::vec3>& values = primitive.morph_targets[i].*deltas;
            const float weight = withoutTiny(weights[i]);
            assert(values.empty() || values.size() == primitive.positions.size());
            if (!values.empty() && sizeBits(weight) != 0)
            {
                m_terms.push_back({values.data(), weight});
            }
        }
    }

    [[nodiscard]] glm::vec3 apply(glm::vec3 value, std::size_t vertex) const
    {
        value = withoutTiny(value);
        for (const Term& term : m_terms)
        {
            value = value + product(withoutTiny(term.deltas[vertex]), term.weight);
        }
        return value;
    }

private:
    struct Term
    {
        const glm::vec3* deltas;
        float weight;
    };
    std::vector<Term> m_terms;
};

// The exponent of the largest component.
std::uint32_t exponentOf(const glm::vec3& v)
{
    return std::max({sizeBits(v.x), sizeBits(v.y), sizeBits(v.z)}) >> 24;
}

bool isDirection(const glm::vec3& v)
{
    const std::uint32_t exponent = exponentOf(v);
    return exponent >= gpu::kDirectionExponentMin && exponent <= gpu::kDirectionExponentMax;
}

// normal through the cofactors of linear, scaled by a power of two, turned round where linear mirrors. Without a
// direction, what tells whether the triangle's normal is to be turned round.
glm::vec3 turnedNormal(const glm::mat3& linear, const glm::vec3& normal)
{
    const std::uint32_t exponent = std::max({exponentOf(linear[0]), exponentOf(linear[1]), exponentOf(linear[2])});
    if (exponent < gpu::kNormalExponentMin || exponent > gpu::kNormalExponentMax)
    {
        return glm::vec3(0.0F);
    }
    const auto scale = std::bit_cast<float>((254 - exponent) << 23);
    const glm::mat3 m(product(linear[0], scale), product(linear[1], scale), product(linear[2], scale));
    const glm::mat3 cofactors(crossProduct(m[1], m[2]), crossProduct(m[2], m[0]), crossProduct(m[0], m[1]));
    const glm::vec3 terms = product(m[0], cofactors[0]);
    const float determinant = (terms.x + terms.y) + terms.z;
    const glm::vec3 turned = transformed(cofactors[0], cofactors[1], cofactors[2], normal);
    const bool mirrors = determinant < 0.0F;
    if (!isDirection(turned))
    {
        return mirrors ? kTurnedRound : glm::vec3(0.0F);
    }
    return mirrors ? -turned : turned;
}

} // namespace

float withoutTiny(float value)
{
    return sizeBits(value) < gpu::kTinyExponent << 24 ? 0.0F : value;
}

glm::vec3 withoutTiny(const glm::vec3& value)
{
    return {withoutTiny(value.x), withoutTiny(value.y), withoutTiny(value.z)};
}

glm::mat4x3 withoutTiny(const glm::mat4& transform)
{
    return {withoutTiny(glm::vec3(transform[0])), withoutTiny(glm::vec3(transform[1])),
            withoutTiny(glm::vec3(transform[2])), withoutTiny(glm::vec3(transform[3]))};
}

bool isDeformed(const Primitive& primitive, const Instance& instance)
{
    return !primitive.morph_targets.empty() || (instance.skin != kNone && !primitive.joints.empty());
}

JointBinding bindingOf(const Primitive& primitive, std::size_t vertex, std::size_t joint_count)
{
    JointBinding binding{glm::uvec4(primitive.joints[vertex]), glm::vec4(0.0F)};
    bool hangs = false;
    for (int i = 0; i < 4; ++i)
    {
        binding.weights[i] = withoutTiny(primitive.weights[vertex][i]);
        hangs = hangs || sizeBits(binding.weights[i]) != 0;
    }
    binding.weights.x = hangs ? binding.weights.x : 1.0F;
    for (int i = 0; i < 4; ++i)
    {
        binding.joints[i] = sizeBits(binding.weights[i]) != 0 ? binding.joints[i] : 0;
        if (binding.joints[i] >= joint_count)
        {
            throw Error(ErrorCode::Input, fmt::format("vertex {} of a mesh hangs on joint {}, but its skin has {}; "
                                                      "export the model again",
                                                      vertex, binding.joints[i], joint_count));
        }
    }
    return binding;
}

DeformedVertices deformVertices(const Primitive& primitive, std::span<const float> morph_weights,
                                std::span<const glm::mat4> joint_matrices)
{
    const bool skinned = !joint_matrices.empty() && !primitive.joints.empty();
    const bool has_normals = !primitive.normals.empty();
    assert(!has_normals || primitive.normals.size() == primitive.positions.size());
    assert(!skinned || (primitive.joints.size() == primitive.positions.size() &&
                        primitive.weights.size() == primitive.positions.size()));
    const Morph morph(primitive, morph_weights, &MorphTarget::positions);
    const Morph morph_normals(primitive, morph_weights, &MorphTarget::normals);
    std::vector<glm::mat4x3> joints;
    for (const glm::mat4& matrix : joint_matrices)
    {
        joints.push_back(withoutTiny(matrix));
    }

    DeformedVertices result;
    result.positions.reserve(primitive.positions.size());
    result.normals.reserve(has_normals || skinned ? primitive.positions.size() : 0);
    for (std::size_t vertex = 0; vertex < primitive.positions.size(); ++vertex)
    {
        glm::vec3 position = morph.apply(primitive.positions[vertex], vertex);
        glm::vec3 normal = has_normals ? morph_normals.apply(primitive.normals[vertex], vertex) : glm::vec3(0.0F);
        if (skinned)
        {
            const JointBinding binding = bindingOf(primitive, vertex, joints.size());
            glm::vec3 blended(0.0F);
            glm::mat3 linear(0.0F);
            for (int i = 0; i < 4; ++i)
            {
                if (sizeBits(binding.weights[i]) == 0)
                {
                    continue;
                }
                const glm::mat4x3& m = joints[binding.joints[i]];
                const glm::vec3 moved = transformed(m[0], m[1], m[2], position) + m[3];
                blended = blended + product(moved, binding.weights[i]);
                for (int column = 0; column < 3; ++column)
                {
                    linear[column] = linear[column] + product(m[column], binding.weights[i]);
                }
            }
            position = blended;
            normal = turnedNormal(linear, normal);
        }
        result.positions.push_back(canonical(position));
        if (has_normals || skinned)
        {
            result.normals.push_back(canonical(normal));
        }
    }
    return result;
}

} // namespace zvo
