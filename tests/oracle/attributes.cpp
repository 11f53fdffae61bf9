// SPDX-License-Identifier: MIT
#include "oracle/attributes.h"

#include "oracle/fragments.h"

#include <algorithm>

namespace zvo::oracle
{
namespace
{

/// Sorts by code and adds up entries of the same code.
void sortAndSum(std::vector<VoxelColor>& voxels)
{
    std::sort(voxels.begin(), voxels.end(), [](const auto& a, const auto& b) { return a.code < b.code; });
    std::vector<VoxelColor> sums;
    for (const VoxelColor& voxel : voxels)
    {
        if (sums.empty() || sums.back().code != voxel.code)
        {
            sums.push_back(voxel);
            continue;
        }
        sums.back().sum_r += voxel.sum_r;
        sums.back().sum_g += voxel.sum_g;
        sums.back().sum_b += voxel.sum_b;
        sums.back().count += voxel.count;
    }
    voxels = std::move(sums);
}

/// One thread's sums, which are merged whenever their number has doubled.
struct SumList
{
    std::vector<VoxelColor> voxels;
    std::size_t limit = std::size_t{1} << 21;

    void add(const Fragment& fragment)
    {
        voxels.push_back({fragment.code, fragment.color[0], fragment.color[1], fragment.color[2], 1});
        if (voxels.size() < limit)
            return;
        sortAndSum(voxels);
        limit = std::max(limit, 2 * voxels.size());
    }
};

} // namespace

std::vector<VoxelColor> voxelColors(const Scene& scene, const Grid& grid, Coverage coverage)
{
    const FragmentWalker walker(scene, grid, coverage);
    std::vector<SumList> lists(threadCount());
    const auto work = [&](std::uint32_t thread, std::uint64_t first, std::uint64_t last)
    {
        const auto add = [&](const Fragment& fragment) { lists[thread].add(fragment); };
        Dropped dropped;
        walker.walk(first, last, add, dropped);
    };
    forEachChunk(walker.triangleCount(), work);

    std::vector<VoxelColor> result;
    for (const SumList& list : lists)
        result.insert(result.end(), list.voxels.begin(), list.voxels.end());
    sortAndSum(result);
    return result;
}

} // namespace zvo::oracle
