// SPDX-License-Identifier: MIT
// Uses of a fragment, chosen by kMode: it sets a bit in the brick table, or is added to the voxel's sums.

// The leaf of this thread's last fragment, which neighbours mostly share.
struct BrickCursor
{
    uvec2 key;
    uint entry;
    uint base;    // first voxel of the leaf
    uvec2 masks;
};

// Level of the leaves among the nodes' levels.
uint leafLevel()
{
    return uint(gridDepth() - 1) / 2u;
}

BrickCursor noBrick()
{
    return BrickCursor(uvec2(0u), kNoEntry, 0u, uvec2(0u));
}

void moveToBrick(uvec2 key, inout BrickCursor cursor)
{
    if (!isSameKey(key, cursor.key))
    {
        cursor.key = key;
        if (kMode == kModeCoverage)
        {
            bool claimed;
            cursor.entry = brickFindOrInsert(params.bricks, params.brick_mask, key, claimed);
            if (cursor.entry == kNoEntry)
                atomicAdd(params.brick_counters.data[0].overflow_count, 1u);
        }
        else
        {
            cursor.entry = brickFind(BrickEntry_ConstPtr(params.bricks), params.brick_mask, key);
            BrickEntry leaf = params.bricks.data[cursor.entry == kNoEntry ? 0u : cursor.entry];
            cursor.base = leaf.base;
            cursor.masks = uvec2(leaf.mask_lo, leaf.mask_hi);
            if (kWideKeys && cursor.entry != kNoEntry)
            {
                Node node = params.nodes.data[nodeOf(leaf)];
                cursor.base = node.base_lo;
                cursor.masks = uvec2(node.mask_lo, node.mask_hi);
            }
        }
    }
}

// Sets voxels of a leaf, as the bits of its masks.
void setVoxels(uint entry, uvec2 masks)
{
    if (masks.x != 0u)
        atomicOr(params.bricks.data[entry].mask_lo, masks.x);
    if (masks.y != 0u)
        atomicOr(params.bricks.data[entry].mask_hi, masks.y);
}

uvec2 cellMasks(uint cell)
{
    uint bit = 1u << (cell & 31u);
    return cell < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
}

uint voxelIndex(BrickCursor cursor, uint cell)
{
    uint below = (1u << (cell & 31u)) - 1u;
    return cell < 32u ? cursor.base + bitCount(cursor.masks.x & below)
                      : cursor.base + bitCount(cursor.masks.x) + bitCount(cursor.masks.y & below);
}

void addAttributes(Surface surface, uint voxel, uvec3 weights, uvec3 color)
{
    addToSums(voxel, color, fragmentNormal(surface, weights));
    if (kEmits && any(notEqual(fragmentEmission(surface, weights), uvec3(0u))))
        atomicOr(params.emission_words.data[voxel >> 5].x, 1u << (voxel & 31u));
}

void addEmission(Surface surface, uint voxel, uvec3 weights)
{
    uvec3 emission = fragmentEmission(surface, weights);
    uvec2 word = params.emission_words.data[voxel >> 5];
    uint bit = 1u << (voxel & 31u);
    if (any(notEqual(emission, uvec3(0u))) && (word.x & bit) != 0u)
    {
        uint rank = word.y + bitCount(word.x & (bit - 1u));
        atomicAdd(params.emission_sums.data[rank].red, emission.r >> params.sum_shift);
        atomicAdd(params.emission_sums.data[rank].green, emission.g >> params.sum_shift);
        atomicAdd(params.emission_sums.data[rank].blue, emission.b >> params.sum_shift);
    }
}

// The attributes of a fragment that kMode needs.
struct Fragment
{
    uvec3 weights;
    uvec3 color;
    bool exists;
};

Fragment shadeFragment(RasterTriangle triangle, Surface surface, EDGE_IVEC3 corners, uvec3 voxel)
{
    Fragment fragment = Fragment(uvec3(0u), uvec3(0u), true);
    if (kMode != kModeCoverage || kMaterialClass == kClassAlpha)
    {
        fragment.weights = fixedWeights(corners, triangle.n_w != 0);
        uvec4 color = fragmentColor(surface, fragment.weights);
        fragment.color = color.rgb;
        if (kMaterialClass == kClassAlpha)
            fragment.exists = passesAlpha(surface.material, color.a, voxel);
    }
    return fragment;
}

uvec2 leafKey(uvec3 voxel)
{
    return brickKey(voxel >> 2, leafLevel());
}

// Adds a fragment in the leaf of cursor to the voxel's sums.
void addFragment(Surface surface, Fragment fragment, BrickCursor cursor, uint cell)
{
    if (kMode == kModeAttributes)
        addAttributes(surface, voxelIndex(cursor, cell), fragment.weights, fragment.color);
    if (kMode == kModeEmission)
        addEmission(surface, voxelIndex(cursor, cell), fragment.weights);
}

// Called for each voxel that the triangle covers.
void emitFragment(RasterTriangle triangle, Surface surface, EDGE_IVEC3 corners, uvec3 voxel, inout BrickCursor cursor)
{
    Fragment fragment = shadeFragment(triangle, surface, corners, voxel);
    if (fragment.exists)
    {
        moveToBrick(leafKey(voxel), cursor);
        if (cursor.entry != kNoEntry)
        {
            uint cell = cellInBlock(voxel);
            if (kMode == kModeCoverage)
                setVoxels(cursor.entry, cellMasks(cell));
            else
                addFragment(surface, fragment, cursor, cell);
        }
    }
}
