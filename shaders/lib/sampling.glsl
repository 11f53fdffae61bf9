// SPDX-License-Identifier: MIT
// Random numbers of samples, and directions that are made of them.
//
// Numbers: an Owen-scrambled Sobol sequence of two dimensions, for each pair of dimensions in another order (B. Burley,
// Practical Hash-based Owen Scrambling, 2020). All in integers: the same numbers on every device.
#ifndef ZVO_SHADERS_LIB_SAMPLING_GLSL
#define ZVO_SHADERS_LIB_SAMPLING_GLSL

// A hash of 32 bits (C. Wellons, Prospecting for Hash Functions, 2018: lowbias32).
uint hash(uint x)
{
    x ^= x >> 16;
    x *= 0x7FEB352Du;
    x ^= x >> 15;
    x *= 0x846CA68Bu;
    return x ^ (x >> 16);
}

uint hashPair(uint a, uint b)
{
    return hash(a ^ (hash(b) + 0x9E3779B9u + (a << 6) + (a >> 2)));
}

// Scrambles the bits of a number whose bits are in reverse order: each bit by a hash of those above it in the right
// order (S. Laine, T. Karras, Stratified Sampling for Stochastic Transparency, 2011; constants by N. Vegdahl, 2021).
uint scrambleReversed(uint v, uint seed)
{
    v ^= v * 0x3D20ADEAu;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526C56u;
    v ^= v * 0x53A22864u;
    return v;
}

// The second coordinate of the Sobol sequence, its bits in reverse order: bit j is the parity of those bits k of the
// index for which the binomial coefficient of k and j is odd, which are those k that have all bits of j.
uint sobolSecondReversed(uint index)
{
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0F0F0F0Fu;
    index ^= (index >> 8) & 0x00FF00FFu;
    index ^= (index >> 16) & 0x0000FFFFu;
    return index;
}

// Both coordinates of a sample in a pair of dimensions, of all 32 bits. seed: of the pixel.
uvec2 sampleBits(uint index, uint seed, uint pair)
{
    uint pair_seed = hashPair(seed, pair);
    uint shuffled = bitfieldReverse(scrambleReversed(bitfieldReverse(index), pair_seed));
    return bitfieldReverse(uvec2(scrambleReversed(shuffled, hash(pair_seed ^ 0x55AA55AAu)),
                                 scrambleReversed(sobolSecondReversed(shuffled), hash(pair_seed ^ 0xC33CC33Cu))));
}

// Both coordinates of a sample as numbers in [0, 1).
vec2 samplePair(uint index, uint seed, uint pair)
{
    return vec2(sampleBits(index, seed, pair) >> 8) * (1.0 / 16777216.0);
}

// Axes orthogonal to a direction of length 1, which is the last one (T. Duff et al., Building an Orthonormal Basis,
// Revisited, 2017).
mat3 frameAround(vec3 n)
{
    float sign = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (sign + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n);
}

// A direction in such a frame, to the side of its last axis: of even u in [0, 1) and even angles about the axis, they
// are spread by the cosine with it, which is z.
vec3 cosineDirection(float u, float angle)
{
    return vec3(sqrt(u) * vec2(cos(angle), sin(angle)), sqrt(1.0 - u));
}

#endif
