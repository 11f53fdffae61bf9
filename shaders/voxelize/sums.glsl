// SPDX-License-Identifier: MIT
// Adds fragments to the sums of their voxels. Integers are added, so that every form leaves the same words in memory.
//
// INT64_ATOMICS             two words of VoxelSums are added as one 64-bit number. No word carries into the next:
//                           their values are not negative, and sums of kFragmentsMax of them fit. In sums of more the
//                           count of fragments is right nevertheless, by which the host sees that they do not fit.
// SHARED_SUMS_CONSTANT_ID   constant_id of kSharesSums: fragments are added in shared memory first, where neighbouring
//                           triangles of a dense mesh meet in the same voxels, and the workgroup's sums in the end.
//                           For devices whose atomics in memory are slow. Those of an H100 are faster than this.

// SUM_PAIR, SUM_WORD: a pair of words, or a word, of the sums of a voxel.
#ifdef BOUND
#ifdef INT64_ATOMICS
STORAGE(2, uint64_t, sums);
#define SUM_PAIR(VOXEL, PAIR) storage_sums.data[kVoxelSumsBytes / 8u * (VOXEL) + (PAIR)]
#else
STORAGE(2, uint, sums);
#define SUM_WORD(VOXEL, WORD) storage_sums.data[kVoxelSumsBytes / 4u * (VOXEL) + (WORD)]
#endif
#else
#define SUM_PAIR(VOXEL, PAIR) uint64_t_Ptr(sumsAddress(VOXEL)).data[PAIR]
#define SUM_WORD(VOXEL, WORD) uint_Ptr(sumsAddress(VOXEL)).data[WORD]

uint64_t sumsAddress(uint voxel)
{
    return uint64_t(params.sums) + uint64_t(voxel) * kVoxelSumsBytes;
}
#endif

// The sums of one fragment. color: 16-bit fractions; normal: of length 32767.
VoxelSums sumsOf(uvec3 color, ivec3 normal)
{
    color >>= params.sum_shift;
    uvec3 biased = uvec3(normal >> params.sum_shift) + normalBias(params.sum_shift);
    return VoxelSums(color.r, color.g, color.b, biased.x, biased.y, biased.z, 1u, 0u);
}

// Adds a fragment in memory.
void addInMemory(uint voxel, VoxelSums sums)
{
#ifdef INT64_ATOMICS
    atomicAdd(SUM_PAIR(voxel, 0u), packUint2x32(uvec2(sums.red, sums.green)));
    atomicAdd(SUM_PAIR(voxel, 1u), packUint2x32(uvec2(sums.blue, sums.normal_x)));
    atomicAdd(SUM_PAIR(voxel, 2u), packUint2x32(uvec2(sums.normal_y, sums.normal_z)));
    atomicAdd(SUM_PAIR(voxel, 3u), 1ul);
#else
    atomicAdd(SUM_WORD(voxel, 0u), sums.red);
    atomicAdd(SUM_WORD(voxel, 1u), sums.green);
    atomicAdd(SUM_WORD(voxel, 2u), sums.blue);
    atomicAdd(SUM_WORD(voxel, 3u), sums.normal_x);
    atomicAdd(SUM_WORD(voxel, 4u), sums.normal_y);
    atomicAdd(SUM_WORD(voxel, 5u), sums.normal_z);
    atomicAdd(SUM_WORD(voxel, 6u), 1u);
#endif
}

#ifdef SHARED_SUMS_CONSTANT_ID

layout(constant_id = SHARED_SUMS_CONSTANT_ID) const bool kSharesSums = false;

// A hash table by voxel, with linear probing. A triangle has one fragment in a voxel at most, so that sums of a
// workgroup fit kSharedBits bits.
const uint kSlotsLog2 = 8u;
const uint kSlots = 1u << kSlotsLog2;
const uint kSlotProbes = 2u; // fragments of a voxel that finds no slot are added in memory
const uint kFreeSlot = ~0u;
const uint kSharedBits = 16u + kChunkTrianglesLog2; // of a sum of 16 bit values; those above red's count fragments
const uint kSharedWords = 6u;                       // of a slot: red and fragments, green, blue, normal
const uint kWordStride = kSlots + 4u;               // threads that flush neighbouring slots read from different banks
shared uint s_voxels[kSharesSums ? kSlots : 1u];
shared uint s_words[kSharesSums ? kSharedWords * kWordStride : 1u];

void clearSharedSums()
{
    for (uint i = gl_LocalInvocationIndex; i < kSlots; i += kChunkTriangles)
        s_voxels[i] = kFreeSlot;
    for (uint i = gl_LocalInvocationIndex; i < kSharedWords * kWordStride; i += kChunkTriangles)
        s_words[i] = 0u;
    barrier();
}

// The slot of a voxel, or kSlots.
uint slotOf(uint voxel)
{
    uint slot = (voxel * 2654435761u) >> (32u - kSlotsLog2); // Knuth's multiplicative hash
    uint found = kSlots;
    for (uint probe = 0u; found == kSlots && probe < kSlotProbes; ++probe)
    {
        uint holder = atomicCompSwap(s_voxels[slot], kFreeSlot, voxel);
        found = holder == kFreeSlot || holder == voxel ? slot : kSlots;
        slot = (slot + 1u) & (kSlots - 1u);
    }
    return found;
}

void addInSlot(uint slot, VoxelSums sums)
{
    atomicAdd(s_words[slot], sums.red | (1u << kSharedBits));
    atomicAdd(s_words[slot + kWordStride], sums.green);
    atomicAdd(s_words[slot + 2u * kWordStride], sums.blue);
    atomicAdd(s_words[slot + 3u * kWordStride], sums.normal_x);
    atomicAdd(s_words[slot + 4u * kWordStride], sums.normal_y);
    atomicAdd(s_words[slot + 5u * kWordStride], sums.normal_z);
}

// Word number `word` of the VoxelSums that a slot stands for.
uint wordOf(uint slot, uint word)
{
    uint fragments = s_words[slot] >> kSharedBits;
    uint sum = s_words[slot + min(word, kSharedWords - 1u) * kWordStride] & ((1u << kSharedBits) - 1u);
    return word < kSharedWords ? sum : (word == kSharedWords ? fragments : 0u);
}

// Adds what the workgroup has in shared memory. A voxel's atomics are those of neighbouring threads, so that they go to
// one sector of memory together.
void flushSharedSums()
{
#ifdef INT64_ATOMICS
    const uint kLanes = kVoxelSumsBytes / 8u;
#else
    const uint kLanes = kVoxelSumsBytes / 4u;
#endif
    barrier();
    uint lane = gl_LocalInvocationIndex % kLanes;
    for (uint slot = gl_LocalInvocationIndex / kLanes; slot < kSlots; slot += kChunkTriangles / kLanes)
    {
        uint voxel = s_voxels[slot];
        if (voxel != kFreeSlot)
        {
#ifdef INT64_ATOMICS
            uvec2 pair = uvec2(wordOf(slot, 2u * lane), wordOf(slot, 2u * lane + 1u));
            atomicAdd(SUM_PAIR(voxel, lane), packUint2x32(pair));
#else
            if (lane <= kSharedWords)
                atomicAdd(SUM_WORD(voxel, lane), wordOf(slot, lane));
#endif
        }
    }
}

#endif

// Adds a fragment. voxel: index of its sums.
void addToSums(uint voxel, VoxelSums sums)
{
#ifdef SHARED_SUMS_CONSTANT_ID
    if (kSharesSums)
    {
        uint slot = slotOf(voxel);
        if (slot < kSlots)
            addInSlot(slot, sums);
        else
            addInMemory(voxel, sums);
        return;
    }
#endif
    addInMemory(voxel, sums);
}
