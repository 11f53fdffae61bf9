// SPDX-License-Identifier: MIT
#include "oracle/fragments.h"

#include "oracle/morton.h"
#include "oracle/snap.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace zvo::oracle
{
namespace
{

/// The colours and texture of a triangle, as integers that its fragments interpolate.
struct Appearance
{
    const Material* material = nullptr;
    const MipChain* mips = nullptr; // null: no texture
    const Texture* texture = nullptr;
    std::uint32_t level = 0;
    std::array<std::array<std::int64_t, 2>, 3> uv{};
    std::array<std::array<std::uint32_t, 4>, 3> colors{}; // per vertex; 65535 if the mesh has none
};

std::int64_t interpolated(const std::array<std::uint32_t, 3>& weights, std::int64_t a, std::int64_t b, std::int64_t c)
{
    return (weights[0] * a + weights[1] * b + weights[2] * c) >> 16;
}

/// The product of texture, factor and vertex colour, for colour and alpha.
Texel16 shade(const Appearance& look, const std::array<std::uint32_t, 3>& weights)
{
    Texel16 result;
    if (look.mips != nullptr)
    {
        const std::int64_t u = interpolated(weights, look.uv[0][0], look.uv[1][0], look.uv[2][0]);
        const std::int64_t v = interpolated(weights, look.uv[0][1], look.uv[1][1], look.uv[2][1]);
        result = look.mips->sample(look.level, u, v, look.texture->wrap_u, look.texture->wrap_v);
    }
    for (std::size_t channel = 0; channel < 4; ++channel)
    {
        std::uint32_t& value = channel == 3 ? result.alpha : result.color[channel];
        const auto vertex = static_cast<std::uint32_t>(
            interpolated(weights, look.colors[0][channel], look.colors[1][channel], look.colors[2][channel]));
        value = mul16(mul16(value, fraction16(look.material->base_color[static_cast<int>(channel)])), vertex);
    }
    return result;
}

std::int64_t crossUv(const std::array<std::array<std::int64_t, 2>, 3>& uv)
{
    const std::int64_t d1[2] = {uv[1][0] - uv[0][0], uv[1][1] - uv[0][1]};
    const std::int64_t d2[2] = {uv[2][0] - uv[0][0], uv[2][1] - uv[0][1]};
    return std::abs(d1[0] * d2[1] - d2[0] * d1[1]);
}

/// Twice the area of (a, b, c) in the plane (u, v), positive when they turn from u to v.
Int128 turn(const Vec& a, const Vec& b, const Vec& c, std::size_t u, std::size_t v)
{
    return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

} // namespace

std::array<std::uint32_t, 3> fragmentWeights(const Triangle& triangle, const glm::uvec3& voxel)
{
    const Vec normal = normalOf(triangle);
    const std::size_t w = majorAxis(normal);
    if (normal[w] == 0)
        return {21846, 21845, 21845};
    const std::size_t u = (w + 1) % 3;
    const std::size_t v = (w + 2) % 3;
    const Vec center = voxelBox(voxel, voxel).low - Vec{-128, -128, -128};
    const Int128 sign = normal[w] < 0 ? -1 : 1;

    std::array<Int128, 3> b{};
    for (std::size_t i = 0; i < 3; ++i)
    {
        const Int128 edge = sign * turn(triangle[(i + 1) % 3], triangle[(i + 2) % 3], center, u, v);
        b[i] = std::max(edge, Int128{0});
    }
    const Int128 sum = b[0] + b[1] + b[2];
    int k = 0;
    while ((sum >> k) >= 65536)
        ++k;
    const auto w_0 = static_cast<std::uint32_t>((b[0] >> k) * 65536 / (sum >> k));
    const auto w_1 = static_cast<std::uint32_t>((b[1] >> k) * 65536 / (sum >> k));
    return {w_0, w_1, 65536 - w_0 - w_1};
}

std::uint32_t ditherRank(const glm::uvec3& voxel)
{
    std::uint32_t rank = 0;
    for (std::uint32_t bit = 0; bit < 2; ++bit)
    {
        const std::uint32_t x = (voxel.x >> bit) & 1;
        const std::uint32_t y = (voxel.y >> bit) & 1;
        const std::uint32_t z = (voxel.z >> bit) & 1;
        rank = rank * 2 + x;
        rank = rank * 2 + (x ^ y);
        rank = rank * 2 + (y ^ z);
    }
    return rank;
}

bool alphaPasses(const Material& material, std::uint32_t alpha, const glm::uvec3& voxel)
{
    switch (material.alpha_mode)
    {
    case AlphaMode::Mask:
        return material.alpha_cutoff <= 1.0F && alpha >= fraction16(material.alpha_cutoff);
    case AlphaMode::Blend:
        return alpha >= 1024 * ditherRank(voxel) + 512;
    case AlphaMode::Opaque:
        break;
    }
    return true;
}

FragmentWalker::FragmentWalker(const Scene& scene, const Grid& grid, Coverage coverage)
    : m_scene(scene), m_grid(grid), m_coverage(coverage), m_first_triangle{0}
{
    for (const Instance& instance : scene.instances)
        m_first_triangle.push_back(m_first_triangle.back() + scene.primitives[instance.primitive].triangles.size());
    for (const Material& material : scene.materials)
    {
        if (!material.base_color_texture)
            continue;
        const std::uint32_t image = scene.textures[*material.base_color_texture].image;
        if (!m_mips.contains(image))
            m_mips.emplace(image, MipChain(scene.images[image]));
    }
}

void FragmentWalker::walk(std::uint64_t first, std::uint64_t last, const std::function<void(const Fragment&)>& sink,
                          Dropped& dropped) const
{
    for (std::uint64_t number = first; number < last; ++number)
    {
        const auto next = std::upper_bound(m_first_triangle.begin(), m_first_triangle.end(), number);
        const auto index = static_cast<std::size_t>(next - m_first_triangle.begin()) - 1;
        const Instance& instance = m_scene.instances[index];
        const Primitive& primitive = m_scene.primitives[instance.primitive];
        walkTriangle(instance, primitive.triangles[number - m_first_triangle[index]], sink, dropped);
    }
}

void FragmentWalker::walkTriangle(const Instance& instance, const glm::uvec3& indices,
                                  const std::function<void(const Fragment&)>& sink, Dropped& dropped) const
{
    const Primitive& primitive = m_scene.primitives[instance.primitive];
    const std::array<std::uint32_t, 3> vertex{indices.x, indices.y, indices.z};
    const SnappedTriangle snapped =
        snapTriangle({primitive.positions[vertex[0]], primitive.positions[vertex[1]], primitive.positions[vertex[2]]},
                     instance.transform, m_grid, m_coverage);
    if (snapped.dropped != nullptr)
    {
        ++dropped[snapped.dropped];
        return;
    }

    Appearance look;
    look.material = &m_scene.materials[primitive.material];
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (std::size_t channel = 0; channel < 4; ++channel)
            look.colors[corner][channel] =
                primitive.colors.empty() ? 65535
                                         : fraction16(primitive.colors[vertex[corner]][static_cast<int>(channel)]);
    if (look.material->base_color_texture && !primitive.uvs.empty())
    {
        look.texture = &m_scene.textures[*look.material->base_color_texture];
        look.mips = &m_mips.at(look.texture->image);
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 2; ++axis)
                look.uv[corner][axis] = textureCoordinate(primitive.uvs[vertex[corner]][static_cast<int>(axis)]);
        const Vec normal = normalOf(snapped.triangle);
        const auto area = static_cast<std::int64_t>(absolute(normal[majorAxis(normal)]));
        look.level = look.mips->levelFor(crossUv(look.uv), area);
    }

    const auto visit = [&](const glm::uvec3& voxel)
    {
        const Texel16 shaded = shade(look, fragmentWeights(snapped.triangle, voxel));
        if (alphaPasses(*look.material, shaded.alpha, voxel))
            sink({mortonEncode(voxel), shaded.color});
    };
    forEachCoveredVoxel(snapped.triangle, m_grid.resolution(), m_coverage, visit);
}

std::uint32_t threadCount()
{
    return std::clamp(std::thread::hardware_concurrency(), 1U, 8U);
}

void forEachChunk(std::uint64_t count,
                  const std::function<void(std::uint32_t thread, std::uint64_t first, std::uint64_t last)>& work)
{
    constexpr std::uint64_t kChunk = 1024;
    std::atomic<std::uint64_t> next{0};
    const auto run = [&](std::uint32_t thread)
    {
        for (std::uint64_t first = next.fetch_add(kChunk); first < count; first = next.fetch_add(kChunk))
            work(thread, first, std::min(first + kChunk, count));
    };
    std::vector<std::thread> threads;
    for (std::uint32_t thread = 1; thread < threadCount(); ++thread)
        threads.emplace_back(run, thread);
    run(0);
    for (std::thread& thread : threads)
        thread.join();
}

} // namespace zvo::oracle
