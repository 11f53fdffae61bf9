// SPDX-License-Identifier: MIT
#include "oracle/voxelizer.h"

#include "oracle/fragments.h"

#include <algorithm>

namespace zvo::oracle
{
namespace
{

void sortUnique(std::vector<std::uint64_t>& codes)
{
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
}

/// One thread's codes, which are made unique whenever their number has doubled.
struct CodeList
{
    std::vector<std::uint64_t> codes;
    std::size_t limit = std::size_t{1} << 22;

    void add(std::uint64_t code)
    {
        codes.push_back(code);
        if (codes.size() < limit)
            return;
        sortUnique(codes);
        limit = std::max(limit, 2 * codes.size());
    }
};

} // namespace

OracleVoxels voxelize(const Scene& scene, const Grid& grid, Coverage coverage)
{
    const FragmentWalker walker(scene, grid, coverage);
    std::vector<CodeList> lists(threadCount());
    std::vector<Dropped> dropped(threadCount());
    const auto work = [&](std::uint32_t thread, std::uint64_t first, std::uint64_t last)
    {
        const auto add = [&](const Fragment& fragment) { lists[thread].add(fragment.code); };
        walker.walk(first, last, add, dropped[thread]);
    };
    forEachChunk(walker.triangleCount(), work);

    OracleVoxels result;
    for (const CodeList& list : lists)
        result.codes.insert(result.codes.end(), list.codes.begin(), list.codes.end());
    sortUnique(result.codes);
    for (const Dropped& counts : dropped)
        for (const auto& [reason, count] : counts)
            result.dropped[reason] += count;
    return result;
}

} // namespace zvo::oracle
