// SPDX-License-Identifier: MIT
// A second exact test of whether a triangle meets a box, to test the first one. It clips the triangle against the box's
// six half-spaces (Sutherland and Hodgman, Reentrant Polygon Clipping, 1974) in rational numbers; they meet if
// something is left. For coordinates below a few hundred.
#pragma once

#include "oracle/coverage.h"

#include <array>
#include <vector>

namespace zvo::oracle::test
{

/// A rational number in lowest terms; the denominator is positive.
struct Rational
{
    Int128 numerator = 0;
    Int128 denominator = 1;

    Rational(Int128 n, Int128 d = 1)
    {
        Int128 a = absolute(n);
        Int128 b = absolute(d);
        while (b != 0)
        {
            const Int128 rest = a % b;
            a = b;
            b = rest;
        }
        const Int128 divisor = d < 0 ? -a : a;
        numerator = n / divisor;
        denominator = d / divisor;
    }

    friend Rational operator+(const Rational& a, const Rational& b)
    {
        return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
    }
    friend Rational operator-(const Rational& a, const Rational& b)
    {
        return {a.numerator * b.denominator - b.numerator * a.denominator, a.denominator * b.denominator};
    }
    friend Rational operator*(const Rational& a, const Rational& b)
    {
        return {a.numerator * b.numerator, a.denominator * b.denominator};
    }
    friend Rational operator/(const Rational& a, const Rational& b)
    {
        return {a.numerator * b.denominator, a.denominator * b.numerator};
    }
};

using RationalPoint = std::array<Rational, 3>;
using Polygon = std::vector<RationalPoint>;

/// The part of the polygon with sign * (coordinate - bound) >= 0.
inline Polygon clipped(const Polygon& polygon, std::size_t axis, Int128 bound, Int128 sign)
{
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const RationalPoint& a = polygon[i];
        const RationalPoint& b = polygon[(i + 1) % polygon.size()];
        const Rational inside_a = Rational(sign) * (a[axis] - Rational(bound));
        const Rational inside_b = Rational(sign) * (b[axis] - Rational(bound));
        if (inside_a.numerator >= 0)
            result.push_back(a);
        if ((inside_a.numerator < 0 && inside_b.numerator > 0) || (inside_a.numerator > 0 && inside_b.numerator < 0))
        {
            const Rational t = inside_a / (inside_a - inside_b);
            result.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
        }
    }
    return result;
}

inline bool overlapsByClipping(const Triangle& triangle, const Box& box)
{
    Polygon polygon;
    for (const Vec& corner : triangle)
        polygon.push_back({Rational(corner[0]), Rational(corner[1]), Rational(corner[2])});
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        polygon = clipped(polygon, axis, box.low[axis], 1);
        polygon = clipped(polygon, axis, box.high[axis], -1);
    }
    return !polygon.empty();
}

} // namespace zvo::oracle::test
