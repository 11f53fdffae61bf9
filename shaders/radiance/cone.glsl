// SPDX-License-Identifier: MIT
// Light through a cone (C. Crassin et al., Interactive Indirect Illumination Using Voxel Cone Tracing, 2011). The
// includer includes trace/any_tree.glsl with ZVO_DETAIL, and radiance/light_of_brick.glsl, before.

const uint kConeSteps = 32u;             // nodes that a cone meets, at most
const float kConeThrough = 1.0 / 64.0;   // of its light, at which a cone ends

// The share of the 4x4 columns along an axis in which a node has children, of its mask.
float coverageAlong(uvec2 mask, uint axis)
{
    uvec2 x = mask | (mask >> 1);
    x = (x | (x >> 8)) & 0x00550055u;
    uvec2 y = mask | (mask >> 2);
    y = (y | (y >> 16)) & 0x00003333u;
    uint z = mask.x | mask.y;
    z = (z | (z >> 4)) & 0x0F0F0F0Fu;
    int columns = axis == 0u   ? bitCount(x.x) + bitCount(x.y)
                  : axis == 1u ? bitCount(y.x) + bitCount(y.y)
                               : bitCount(z);
    return float(columns) / 16.0;
}

// The mask of a node, by its cell among those of its level.
uvec2 maskOfNode(TreeTable_ConstPtr tree, uvec3 cell, uint level)
{
    Node_ConstPtr pool = tree.data[0].source.pool;
    Node node = pool.data[0];
    for (uint l = 1u; l <= level; ++l)
    {
        uint index = childIndex(node, cellInBlock(cell >> (2u * (level - l))));
        node = pool.data[listedChild(pool, index, kEntriesPerWord)];
    }
    return uvec2(node.mask_lo, node.mask_hi);
}

// Light of the faces of a node, or of a voxel, that are towards where a ray comes from, by the squares of the
// components of its direction (length 1): of white ones.
vec3 lightAgainst(uvec3 cell, uint level, vec3 direction)
{
    uint known_level = min(level, kBrickLevels);
    uvec3 known_cell = cell << (2u * (level - known_level)); // far nodes are larger than bricks
    vec4 sum = vec4(0.0);
    for (uint axis = 0u; axis < 3u; ++axis)
    {
        float component = axis == 0u ? direction.x : axis == 1u ? direction.y : direction.z;
        uint normal = axis + (component > 0.0 ? 3u : 0u);
        KeptFace face;
        bool found = findFace(known_cell, normal, known_level, face) != kNoFace && keptWeight(face.light) != 0u;
        sum += found ? component * component * vec4(keptRadiance(face.light), 1.0) : vec4(0.0);
    }
    return sum.w > 0.0 ? sum.rgb / sum.w : vec3(0.0);
}

// The emission of what a ray towards a random place in a node meets in it; its mean over rays is that of the node. The
// node's middle and edge are those of its surface.
vec3 emissionInNode(TreeTable_ConstPtr tree, Hit hit, zvo_Surface node, vec3 origin, uint seed)
{
    if (uint64_t(tree.data[0].emission_words) == 0ul)
        return vec3(0.0);
    uint format = tree.data[0].attribute_format;
    Attribute_ConstPtr nodes = tree.data[0].node_attributes;
    if (format == kFormat8 && uint64_t(nodes) != 0ul)
    {
        Attribute mean = readAttribute(format, false, nodes, nodes, hit.index);
        if (((mean.color >> 24) & kAttributeEmissive) == 0u)
            return vec3(0.0);
    }
    vec3 place = vec3(samplePair(0u, seed, 0u), samplePair(0u, seed, 1u).x) - 0.5;
    vec3 towards = node.middle + node.edge * place - origin;
    vec3 inverse = 1.0 / towards;
    vec3 low = (node.middle - 0.5 * node.edge - origin) * inverse;
    vec3 high = (node.middle + 0.5 * node.edge - origin) * inverse;
    vec3 enters = min(low, high);
    vec3 leaves = max(low, high);
    float t_enter = max(max(enters.x, max(enters.y, enters.z)), 0.0);
    float t_leave = min(leaves.x, min(leaves.y, leaves.z));
    Hit voxel = zvo_trace(tree, origin, towards, t_enter, t_leave);
    return zvo_isHit(voxel) ? emissionOf(tree, voxel.index) : vec3(0.0);
}

// The light that comes through a cone, of the voxels and nodes that the ray along its axis meets: nodes that are as
// wide as the cone, whose columns along the ray let through the rest of it. direction: length 1. spread: tangent of the
// angle from the axis to the rim. seed: of rays to lamps. w: the share of the cone that has met nothing.
vec4 lightThroughCone(TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float spread, float t_max, uint seed)
{
    vec2 detail = vec2(2.0 * spread, tree.data[0].voxel_size);
    vec3 sum = vec3(0.0);
    float through = 1.0;
    float t = 0.0;
    for (uint i = 0u; i < kConeSteps && through > kConeThrough && t < t_max; ++i)
    {
        Hit hit = zvo_traceDetail(tree, origin, direction, t, t_max, detail);
        if (!zvo_isHit(hit))
            break;
        zvo_Surface surface = zvo_surface(tree, hit, direction);
        vec3 sides = mix(vec3(-0.5), vec3(0.5), greaterThan(direction, vec3(0.0)));
        vec3 leaves = surface.middle + surface.edge * sides;
        vec3 exits = mix((leaves - origin) / direction, vec3(kTraceTimeMax), equal(direction, vec3(0.0)));
        float t_exit = min(exits.x, min(exits.y, exits.z));
        uint level = tree.data[0].node_levels - hitLevel(hit);
        float coverage = 1.0;
        if (!surface.is_voxel)
        {
            uvec2 mask = maskOfNode(tree, surface.cell, hitLevel(hit));
            coverage = dot(direction * direction,
                           vec3(coverageAlong(mask, 0u), coverageAlong(mask, 1u), coverageAlong(mask, 2u)));
            vec3 emission = emissionInNode(tree, hit, surface, origin, hashPair(seed, i));
            surface.emission = emission / max(coverage, 1.0 / 16.0);
        }
        vec3 light = surface.emission + surface.base_color * lightAgainst(surface.cell, level, direction);
        sum += through * coverage * light;
        through *= 1.0 - coverage;
        t = max(t_exit, hit.t) + 0.01 * tree.data[0].voxel_size;
    }
    return vec4(sum, through > kConeThrough ? through : 0.0);
}
