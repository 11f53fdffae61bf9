// SPDX-License-Identifier: MIT
// The attribute of an inner node: the mean of its children's, which stand together and have equal weights, but for those
// that have none (kAttributeNone).
//
// A thread takes a node or, on devices with threads to spare, several do: its lanes, which stand side by side in a
// workgroup. Sums are integers, so that any number of lanes gives the same bytes.
// Needs the constant kLanes of a node, a power of two (1: nobody meets at barriers), a local size that is a multiple of
// it, and the macro AVERAGE_CHILDREN, the pointer to children's attributes: Attribute_Ptr where the dispatch writes
// some of them itself.
// CHILDREN_BINDING (optional): the binding of `children` in the kernel's bound form (lib/bound.glsl).
#ifndef ZVO_SHADERS_LIB_AVERAGE_GLSL
#define ZVO_SHADERS_LIB_AVERAGE_GLSL

#include "lib/arithmetic.glsl"
#include "lib/attribute.glsl"
#include "lib/bound.glsl"
#include "lib/normal.glsl"
#include "shared/octree.h"
#include "shared/scene.h"

#ifndef AVERAGE_CHILDREN
#error "lib/average.glsl needs AVERAGE_CHILDREN: Attribute_ConstPtr or Attribute_Ptr"
#endif

const uint kChildrenAtOnce = 4u; // that a lane loads before it looks at them
const uint kSumWords = 8u;

// The number of this lane in its node, and of its node in the workgroup.
uint laneOfNode()
{
    return gl_LocalInvocationIndex & (kLanes - 1u);
}

uint nodeOfGroup()
{
    return gl_LocalInvocationIndex / kLanes;
}

struct ChildSums
{
    uvec3 color;
    ivec3 normal;
    uint flags;
    uint without; // children without attributes, which add nothing else
};

const uint kFlagsShift = 24u; // of a colour

shared uint s_child_sums[kLanes > 1u ? gl_WorkGroupSize.x / kLanes * kSumWords : 1u];

#if defined(BOUND) && defined(CHILDREN_BINDING)
TEXELS_2(CHILDREN_BINDING, children);

Attribute loadChild(AVERAGE_CHILDREN children, uint i)
{
    uvec2 words = texelFetch(texels2_children, int(i)).xy;
    return Attribute(words.x, words.y);
}
#else
Attribute loadChild(AVERAGE_CHILDREN children, uint i)
{
    return children.data[i];
}
#endif

bool hasNone(Attribute child)
{
    return (child.color & (kAttributeNone << kFlagsShift)) != 0u;
}

void addChild(LinearTable to_linear, Attribute child, inout ChildSums sums)
{
    bool is_none = hasNone(child);
    sums.without += is_none ? 1u : 0u;
    sums.color += is_none ? uvec3(0u) : linearColor(to_linear, child.color);
    sums.normal += decodeNormal(child.normal);
    sums.flags |= child.color >> kFlagsShift;
}

// Adds kChildrenAtOnce children to the sums, of which the first exists.
void addChildren(LinearTable to_linear, AVERAGE_CHILDREN children, uvec4 indices, bvec4 exists, inout ChildSums sums)
{
    Attribute none = Attribute(0u, 0u);
    Attribute a = loadChild(children, indices.x);
    Attribute b = none;
    Attribute c = none;
    Attribute d = none;
    if (exists.y)
        b = loadChild(children, indices.y);
    if (exists.z)
        c = loadChild(children, indices.z);
    if (exists.w)
        d = loadChild(children, indices.w);
    sums.flags |= (a.color | b.color | c.color | d.color) >> kFlagsShift;
    uvec4 without = uvec4(hasNone(a), hasNone(b), hasNone(c), hasNone(d));
    sums.without += without.x + without.y + without.z + without.w;
    sums.normal += decodeNormal(a.normal) + (exists.y ? decodeNormal(b.normal) : ivec3(0)) +
                   (exists.z ? decodeNormal(c.normal) : ivec3(0)) + (exists.w ? decodeNormal(d.normal) : ivec3(0));
    uvec3 color_a = linearColor(to_linear, a.color);
    uvec3 color_b = uvec3(0u);
    uvec3 color_c = uvec3(0u);
    uvec3 color_d = uvec3(0u);
    if (exists.y)
        color_b = linearColor(to_linear, b.color);
    if (exists.z)
        color_c = linearColor(to_linear, c.color);
    if (exists.w)
        color_d = linearColor(to_linear, d.color);
    sums.color += color_a + color_b + color_c + color_d;
}

// Sums up what the lanes of a node have, for all of them. Call in uniform control flow.
void addLanes(inout ChildSums sums)
{
    bool is_first = laneOfNode() == 0u;
    uint at = nodeOfGroup() * kSumWords;
    barrier(); // the array may still be read by an earlier call
    if (is_first)
    {
        [[unroll]] for (uint axis = 0u; axis < 3u; ++axis)
        {
            s_child_sums[at + axis] = sums.color[axis];
            s_child_sums[at + 3u + axis] = uint(sums.normal[axis]);
        }
        s_child_sums[at + 6u] = sums.flags;
        s_child_sums[at + 7u] = sums.without;
    }
    barrier();
    if (!is_first)
    {
        [[unroll]] for (uint axis = 0u; axis < 3u; ++axis)
        {
            atomicAdd(s_child_sums[at + axis], sums.color[axis]);
            atomicAdd(s_child_sums[at + 3u + axis], uint(sums.normal[axis]));
        }
        atomicOr(s_child_sums[at + 6u], sums.flags);
        atomicAdd(s_child_sums[at + 7u], sums.without);
    }
    barrier();
    [[unroll]] for (uint axis = 0u; axis < 3u; ++axis)
    {
        sums.color[axis] = s_child_sums[at + axis];
        sums.normal[axis] = int(s_child_sums[at + 3u + axis]);
    }
    sums.flags = s_child_sums[at + 6u];
    sums.without = s_child_sums[at + 7u];
}

// The mean of the attributes of a node's children, for each of its lanes; of a node without any, none. Call in uniform
// control flow.
Attribute averageChildren(SceneView_ConstPtr scene, Node node, AVERAGE_CHILDREN children)
{
    LinearTable to_linear = LINEAR_TABLE(scene);
    uint count = bitCount(node.mask_lo) + bitCount(node.mask_hi);
    ChildSums sums = ChildSums(uvec3(0u), ivec3(0), 0u, 0u);
    if (kLanes == 1u)
    {
        for (uint i = 0u; i < count; ++i)
            addChild(to_linear, loadChild(children, node.base_lo + i), sums);
    }
    else
    {
        for (uint first = 0u; first < 64u; first += kChildrenAtOnce * kLanes) // one round of 16 lanes
        {
            uvec4 numbers = first + laneOfNode() + uvec4(0u, kLanes, 2u * kLanes, 3u * kLanes);
            if (numbers.x < count)
                addChildren(to_linear, children, node.base_lo + numbers, lessThan(numbers, uvec4(count)), sums);
        }
        addLanes(sums);
    }
    count -= sums.without;
    uint flags = count == 0u ? kAttributeNone : sums.flags & ~kAttributeNone;
    uint divisor = max(count, 1u); // lanes without a node look up a color like all others
    uvec3 color = divideSmall(sums.color + divisor / 2u, divisor);
    // The absolute values of the components of each normal add up to kNormalOne. So the mean is measured by theirs.
    uvec3 size = uvec3(abs(sums.normal));
    bool is_short = (size.x + size.y + size.z) * kNoNormalRatio < divisor * uint(kNormalOne);
    return Attribute(packColor(scene, color, flags), is_short ? kNoNormal : encodeNormal(sums.normal));
}

#endif
