// SPDX-License-Identifier: MIT
#include "oracle/distance.h"

#include <algorithm>
#include <array>

namespace zvo::oracle
{

namespace
{

// An integer of 448 bits in two's complement, for products of four lengths and more.
class Big
{
public:
    Big(Int128 value)
    {
        for (std::size_t i = 0; i < m_words.size(); ++i)
        {
            m_words[i] = static_cast<std::uint32_t>(i < 4 ? value >> (32 * i) : value >> 127);
        }
    }

    friend Big operator+(const Big& a, const Big& b)
    {
        Big result(0);
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < kWords; ++i)
        {
            carry += std::uint64_t{a.m_words[i]} + b.m_words[i];
            result.m_words[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32U;
        }
        return result;
    }

    friend Big operator-(const Big& a, const Big& b)
    {
        Big inverted = b;
        for (std::uint32_t& word : inverted.m_words)
        {
            word = ~word;
        }
        return a + inverted + Big(1);
    }

    friend Big operator*(const Big& a, const Big& b)
    {
        Big result(0);
        for (std::size_t i = 0; i < kWords; ++i)
        {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; i + j < kWords; ++j)
            {
                carry += std::uint64_t{a.m_words[i]} * b.m_words[j] + result.m_words[i + j];
                result.m_words[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32U;
            }
        }
        return result;
    }

    [[nodiscard]] bool isNegative() const { return m_words.back() >> 31U != 0; }

private:
    static constexpr std::size_t kWords = 14;
    std::array<std::uint32_t, kWords> m_words{};
};

// The largest n below limit with n divisor <= dividend, or UINT32_MAX if limit is not above it.
std::uint32_t floorQuotient(const Big& dividend, const Big& divisor, std::uint32_t limit)
{
    const auto reaches = [&](std::uint64_t n) { return !(dividend - Big(n) * divisor).isNegative(); };
    if (reaches(limit))
    {
        return UINT32_MAX;
    }
    std::uint32_t low = 0;
    for (std::uint32_t bit = 1U << 31U; bit != 0; bit >>= 1U)
    {
        low += std::uint64_t{low} + bit < limit && reaches(std::uint64_t{low} + bit) ? bit : 0;
    }
    return low;
}

// The Gram determinants of two and three vectors.
Big gram(const Vec& a, const Vec& b)
{
    return Big(dot(a, a)) * Big(dot(b, b)) - Big(dot(a, b)) * Big(dot(a, b));
}

Big gram(const Vec& a, const Vec& b, const Vec& c)
{
    const Big aa = dot(a, a);
    const Big bb = dot(b, b);
    const Big cc = dot(c, c);
    const Big ab = dot(a, b);
    const Big ac = dot(a, c);
    const Big bc = dot(b, c);
    return aa * (bb * cc - bc * bc) - ab * (ab * cc - bc * ac) + ac * (ab * bc - bb * ac);
}

// Whether the point is on the inner side of the plane through an edge that stands upright on the triangle.
bool isWithin(const Vec& point, const Vec& from, const Vec& to, const Vec& normal)
{
    const Vec side = cross(to - from, point - from);
    const Big sum = Big(side[0]) * Big(normal[0]) + Big(side[1]) * Big(normal[1]) + Big(side[2]) * Big(normal[2]);
    return !sum.isNegative();
}

} // namespace

std::uint32_t squaredDistance(const Vec& point, const Triangle& triangle, std::uint32_t limit)
{
    std::uint32_t least = UINT32_MAX;
    const auto tryQuotient = [&](const Big& squares, const Big& divisor)
    { least = std::min(least, floorQuotient(Big(256) * squares, divisor, std::min(limit, least))); };
    const Vec normal = normalOf(triangle);
    bool over_face = dot(normal, normal) != 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const Vec& from = triangle[i];
        const Vec& to = triangle[(i + 1) % 3];
        const Vec edge = to - from;
        tryQuotient(Big(dot(point - from, point - from)), Big(1));
        if (dot(point - from, edge) > 0 && dot(point - to, edge) < 0) // then the edge is nearer than its ends
        {
            tryQuotient(gram(edge, point - from), Big(dot(edge, edge)));
        }
        over_face = over_face && isWithin(point, from, to, normal);
    }
    if (over_face)
    {
        const Vec a = triangle[1] - triangle[0];
        const Vec b = triangle[2] - triangle[0];
        tryQuotient(gram(a, b, point - triangle[0]), gram(a, b));
    }
    return least;
}

} // namespace zvo::oracle
