// SPDX-License-Identifier: MIT
// The attribute of an inner node: the mean of its children's.
#include "lib/attribute.glsl"

// The mean of the attributes of a node's children, which stand together and have equal weights.
Attribute averageChildren(SceneView_ConstPtr scene, Node node, Attribute_ConstPtr children)
{
    uint count = bitCount(node.mask_lo) + bitCount(node.mask_hi);
    uvec3 color = uvec3(0u);
    ivec3 normal = ivec3(0);
    uint flags = 0u;
    for (uint i = 0u; i < count; ++i)
    {
        Attribute child = children.data[node.base_lo + i];
        color += unpackColor(scene, child.color);
        normal += decodeNormal(child.normal);
        flags |= child.color >> 24;
    }
    color = divideSmall(color + count / 2u, count);
    return Attribute(packColor(scene, color, flags), encodeNormal(normal));
}
