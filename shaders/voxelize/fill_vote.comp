#version 460
// SPDX-License-Identifier: MIT
// Decides for kFillRobust which voxels are inside: six rays of each vote, up and down along three axes, and then in
// rounds their neighbours across faces, in the brick and not on the surface (iterated conditional modes: J. Besag, On
// the Statistical Analysis of Dirty Pictures, 1986). A thread takes a leaf, whose 64 voxels it counts at once, in binary
// digits. Of closed surfaces all rays and neighbours say the same. Bricks without a surface are left to
// voxelize/fill_nodes.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(FillVoteParams, VOXELIZE_FILL_VOTE_CONSTANTS);
layout(local_size_x = kBrickLeaves) in;

#define BRICKS_BINDING 2
#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "voxelize/fill_columns.glsl"

#ifdef BOUND
TEXELS_2(0, masks);
STORAGE(1, uvec2, crossings);
#define SURFACE(I) texelFetch(texels2_masks, int(I)).xy
#define CROSSINGS(I) storage_crossings.data[I]
#else
#define SURFACE(I) uvec2_ConstPtr(uint64_t(params.masks)).data[I]
#define CROSSINGS(I) uvec2_Ptr(uint64_t(params.crossings)).data[I]
#endif

const uint kFaceRays = 2u * 16u * 16u; // both ways, of the lines of a brick

// The voxels of a leaf that are inside (x, y) and outside (z, w) so far. One of the two arrays is read in a round.
shared uvec4 s_sides[2u * kBrickLeaves];
shared uint s_is_contested;
shared uint s_has_surface;

uint rangePairs() // of a range's crossings
{
    return fillWords(kFillPlanes, true, false) / 2u;
}

struct Count // of 64 voxels, what six rays and twice six neighbours say
{
    uvec2 ones;
    uvec2 twos;
    uvec2 fours;
    uvec2 eights;
    uvec2 sixteens;
};

void addTwo(inout Count count, uvec2 bit)
{
    uvec2 fours = count.twos & bit;
    count.twos ^= bit;
    uvec2 eights = count.fours & fours;
    count.fours ^= fours;
    count.sixteens ^= count.eights & eights;
    count.eights ^= eights;
}

void addOne(inout Count count, uvec2 bit)
{
    uvec2 twos = count.ones & bit;
    count.ones ^= bit;
    addTwo(count, twos);
}

// Turns the coordinates of the voxels in masks of leaves: what stood at (x, y, z) stands at (y, z, x). Words 0 and 1, 2
// and 3 are those of a mask; a voxel's number is x0 y0 z0 x1 y1 z1, from bit 0 on.
uvec4 turnedMasks(uvec4 masks)
{
    uvec4 moved = ((masks >> 1) ^ masks) & 0x22222222u; // x0 and y0
    masks ^= moved ^ (moved << 1);
    moved = ((masks >> 2) ^ masks) & 0x0C0C0C0Cu; // y0 and z0
    masks ^= moved ^ (moved << 2);
    moved = ((masks >> 8) ^ masks) & 0x0000FF00u; // x1 and y1
    masks ^= moved ^ (moved << 8);
    const uint low = 0x0000FFFFu; // y1 and z1
    return uvec4((masks.x & low) | (masks.y << 16), (masks.x >> 16) | (masks.y & ~low), (masks.z & low) | (masks.w << 16),
                 (masks.z >> 16) | (masks.w & ~low));
}

// What rays both ways along an axis say: of a leaf that stands elsewhere in planes of turned voxels.
uvec4 raysOf(uint first, uvec3 leaf, uint line)
{
    uint place = first + line * (2u * kFillPlanes * kBrickLeaves) + cellInBlock(turned(leaf, line));
    return uvec4(CROSSINGS(place), CROSSINGS(place + kFillPlanes * kBrickLeaves));
}

void addRays(inout Count count, uvec4 rays)
{
    addOne(count, rays.xy);
    addOne(count, rays.zw);
}

// For each voxel, the bit of its neighbour ahead or behind along an axis. beside: the leaf there.
uvec4 neighbours(uvec4 own, uvec4 beside, uint axis, bool ahead)
{
    const uint halves = 0x00FF00FFu; // voxels whose x1 is 0
    uvec4 from = ahead ? own : beside;
    uvec4 to = ahead ? beside : own;
    uvec4 next; // the voxels two steps from those of from, on into to
    if (axis == 0u)
        next = ((from >> 8) & halves) | ((to << 8) & ~halves);
    else if (axis == 1u)
        next = (from >> 16) | (to << 16);
    else
        next = uvec4(from.y, to.x, from.w, to.z);
    uint step_bits = 1u << axis;
    uint low = axis == 0u ? 0x55555555u : axis == 1u ? 0x33333333u : 0x0F0F0F0Fu; // voxels whose lower bit is 0
    if (ahead)
        return ((own >> step_bits) & low) | ((next << step_bits) & ~low);
    return ((own << step_bits) & ~low) | ((next >> step_bits) & low);
}

// One round of a leaf.
uvec4 vote(Count count, uint first, uint number, uvec3 leaf, uvec2 is_free)
{
    uvec4 own = s_sides[first + number];
    [[unroll]] for (uint i = 0u; i < 6u; ++i)
    {
        uint axis = i >> 1;
        bool ahead = (i & 1u) == 0u;
        uvec3 step_to = uvec3(axis == 0u ? 1u : 0u, axis == 1u ? 1u : 0u, axis == 2u ? 1u : 0u);
        uvec3 there = ahead ? leaf + step_to : leaf - step_to; // 4, or wraps around, past the brick's end
        bool in_brick = all(lessThan(there, uvec3(4u)));
        uvec4 beside = s_sides[first + cellInBlock(there)];
        uvec4 sides = neighbours(own, in_brick ? beside : uvec4(0u), axis, ahead);
        addOne(count, ~(sides.xy | sides.zw)); // inside counts 2, outside 0
        addTwo(count, sides.xy);
    }
    // A voxel is inside above 9, when more than half say so.
    uvec2 above = count.sixteens | (count.eights & (count.fours | count.twos));
    uvec2 even = ~above & count.eights & count.ones;
    return uvec4((above | (even & own.xy)) & is_free, (~(above | even) | (even & own.zw)) & is_free);
}

// Tells the nodes below the brick, along each axis, whether they are inside.
void enterFace(uint brick_number, uint line)
{
    uvec2 rays_pair = CROSSINGS((brick_number + 1u) * rangePairs() - kFacesWords / 2u + (line >> 1));
    uint rays = (line & 1u) == 0u ? rays_pair.x : rays_pair.y;
    uvec3 brick = turned(brickCell(keyOf(loadBrick(params.ranges.data[brick_number].entry)), brickLevel()), line);
    uvec3 column = uvec3(brick.xz, line);
    uint part = brick.y >> kPartLog2;
    bool entered = rays > kFaceRays / 2u || setInColumn(column, kPartOpen, part, brick.y & 63u);
    if (rays == kFaceRays / 2u)
        entered = setInColumn(column, kPartHalf, part, brick.y & 63u) && entered;
    if (!entered)
        atomicAdd(params.counters.data[0].overflow_count, 1u);
}

void main()
{
    uint brick = workgroupIndex();
    if (brick >= params.counters.data[0].listed_count)
        return;
    uint number = gl_LocalInvocationIndex;
    uvec3 leaf = cellNumbered(number);
    uint first = brick * rangePairs();
    uvec2 is_free = ~SURFACE(brick * ((kMixed ? 2u : 1u) * kBrickLeaves) + number);
    Count count = Count(uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u));
    addRays(count, raysOf(first, leaf, 0u));
    addRays(count, turnedMasks(turnedMasks(raysOf(first, leaf, 1u))));
    addRays(count, turnedMasks(raysOf(first, leaf, 2u)));
    uvec2 most = count.fours; // 4 to 6
    uvec2 three = ~most & count.twos & count.ones;
    uvec4 sides = uvec4(most & is_free, ~(most | three) & is_free);
    uvec2 all = most & count.twos;
    uvec2 contested = is_free & ~all & (count.ones | count.twos | count.fours);
    if (number == 0u)
    {
        s_is_contested = 0u;
        s_has_surface = 0u;
    }
    s_sides[number] = sides;
    barrier();
    if ((contested.x | contested.y) != 0u)
        atomicOr(s_is_contested, 1u);
    if ((is_free.x & is_free.y) != ~0u)
        atomicOr(s_has_surface, 1u);
    barrier();
    if (s_has_surface == 0u)
        sides = uvec4(0u);
    uint rounds = s_has_surface != 0u && s_is_contested != 0u ? kFillRounds : 0u;
    for (uint i = 0u; i < rounds; ++i)
    {
        sides = vote(count, (i & 1u) * kBrickLeaves, number, leaf, is_free);
        s_sides[(1u - (i & 1u)) * kBrickLeaves + number] = sides;
        barrier();
    }
    CROSSINGS(first + number) = sides.xy;
    uvec2 undecided = is_free & ~(sides.xy | sides.zw);
    uint undecided_count = bitCount(undecided.x) + bitCount(undecided.y);
    if (undecided_count != 0u && s_has_surface != 0u)
    {
        uint before = atomicAdd(params.counters.data[0].undecided_lo, undecided_count);
        if (before + undecided_count < before)
            atomicAdd(params.counters.data[0].undecided_hi, 1u);
    }
    if (number < kFillAxes)
        enterFace(brick, number);
}
