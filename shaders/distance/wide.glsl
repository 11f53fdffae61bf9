// SPDX-License-Identifier: MIT
// Integers of 192 bits, modulo 2^192; negative ones are two's complements.
#ifndef ZVO_SHADERS_DISTANCE_WIDE_GLSL
#define ZVO_SHADERS_DISTANCE_WIDE_GLSL

#include "shared/gpu.h"

struct Wide
{
    uint64_t low;
    uint64_t middle;
    uint64_t high;
};

Wide sum(Wide a, Wide b)
{
    uint64_t low = a.low + b.low;
    uint64_t carry = low < a.low ? 1ul : 0ul;
    uint64_t middle = a.middle + b.middle;
    uint64_t high = a.high + b.high + (middle < a.middle ? 1ul : 0ul);
    uint64_t carried = middle + carry;
    return Wide(low, carried, high + (carried < middle ? 1ul : 0ul));
}

Wide negative(Wide a)
{
    return sum(Wide(~a.low, ~a.middle, ~a.high), Wide(1ul, 0ul, 0ul));
}

Wide difference(Wide a, Wide b)
{
    return sum(a, negative(b));
}

bool isNegative(Wide a)
{
    return int64_t(a.high) < 0l;
}

Wide absolute(Wide a)
{
    Wide b = negative(a);
    bool flips = isNegative(a);
    return Wide(flips ? b.low : a.low, flips ? b.middle : a.middle, flips ? b.high : a.high);
}

// a of 64 bits at most, times 2^8.
Wide shifted8(Wide a)
{
    return Wide(a.low << 8, (a.middle << 8) | (a.low >> 56), (a.high << 8) | (a.middle >> 56));
}

uint64_t product32(uint a, uint b)
{
    uint high;
    uint low;
    umulExtended(a, b, high, low);
    return packUint2x32(uvec2(low, high));
}

Wide product64(uint64_t a, uint64_t b)
{
    uvec2 p = unpackUint2x32(a);
    uvec2 q = unpackUint2x32(b);
    uint64_t low = product32(p.x, q.x);
    uint64_t cross = product32(p.x, q.y);
    uint64_t other = product32(p.y, q.x);
    uint64_t middle = (low >> 32) + (cross & 0xfffffffful) + (other & 0xfffffffful);
    return Wide((low & 0xfffffffful) | (middle << 32),
                product32(p.y, q.y) + (cross >> 32) + (other >> 32) + (middle >> 32), 0ul);
}

Wide signedProduct(int64_t a, int64_t b)
{
    int64_t sign_a = a >> 63; // 0 or -1; comparisons with 0 fail where lavapipe has widened a factor
    int64_t sign_b = b >> 63;
    Wide size = product64(uint64_t((a ^ sign_a) - sign_a), uint64_t((b ^ sign_b) - sign_b));
    uint64_t flips = uint64_t(sign_a ^ sign_b);
    return sum(Wide(size.low ^ flips, size.middle ^ flips, size.high ^ flips), Wide(flips & 1ul, 0ul, 0ul));
}

// a b for a below 2^128 and not negative.
Wide times(Wide a, uint b)
{
    Wide low = product64(a.low, uint64_t(b));
    Wide high = product64(a.middle, uint64_t(b));
    return sum(low, Wide(0ul, high.low, high.middle));
}

// a / 2^64 of one that is not negative.
float scaled(Wide a)
{
    return float(a.low) * exp2(-64.0) + float(a.middle) + float(a.high) * exp2(64.0);
}

// min(floor(a / b), kNoDistance) for b from 1 up, below 2^128, and a up to 2^160, except that quotients from kFar on are
// kNoDistance. The quotient is estimated in floating point, twice, and corrected by the exact remainder.
uint quotient(Wide a, Wide b)
{
    const float kFar = 4.0e9;
    float divisor = scaled(b);
    float dividend = scaled(a);
    bool is_far = dividend >= divisor * kFar;
    uint result = is_far ? 0u : uint(dividend / divisor);
    Wide rest = difference(a, times(b, result));
    bool is_above = isNegative(rest);
    uint step = is_far ? 0u : uint(scaled(absolute(rest)) / divisor) + (is_above ? 1u : 0u);
    Wide change = times(b, step);
    Wide minus = negative(change);
    rest = sum(rest, Wide(is_above ? change.low : minus.low, is_above ? change.middle : minus.middle,
                          is_above ? change.high : minus.high));
    result += is_above ? 0u - step : step;
    result += isNegative(rest) ? ~0u : (isNegative(difference(rest, b)) ? 0u : 1u);
    return is_far ? ~0u : result;
}

#endif
