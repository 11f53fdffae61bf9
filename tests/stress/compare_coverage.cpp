// SPDX-License-Identifier: MIT
#include "stress/compare_coverage.h"

#include "core/upload/texture_pool.h"
#include "oracle/attributes.h"
#include "oracle/fragments.h"
#include "oracle/morton.h"
#include "oracle/snap.h"
#include "oracle/voxelizer.h"
#include "runtime/trees.h"
#include "support/octree_access.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace zvo::stress
{
namespace
{

using Color = std::array<std::uint16_t, 3>; // linear, fractions of 65535

constexpr std::size_t kFindingsMax = 8;
constexpr std::size_t kSuspectsMax = 64;

/// One triangle and one voxel that it covers.
struct Record
{
    std::uint64_t code;
    std::uint32_t triangle;

    auto operator<=>(const Record&) const = default;
};

Grid unitGrid(std::uint32_t depth)
{
    return {.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
}

/// Code and colour of each voxel, and faults of the octree's structure.
struct DeviceVoxels
{
    std::vector<std::uint64_t> codes;
    std::vector<std::uint32_t> colors; // sRGB8
    std::map<std::string, std::uint64_t> dropped;
    std::vector<std::string> violations;
};

DeviceVoxels voxelizeOnDevice(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
                              std::optional<VoxelizeCapacities> capacities)
{
    const GpuScene gpu_scene = uploadScene(device, scene, true);
    BuildResult result = buildOctree(device, gpu_scene, grid, {coverage, true, capacities});
    oracle::OctreeContents contents = test::contentsOf(device, result.octree);
    DeviceVoxels voxels{std::move(contents.codes), {}, std::move(result.dropped), std::move(contents.violations)};
    if (result.octree.voxel_count != 0)
        for (const gpu::Attribute& attribute : device.download(result.octree.voxel_attributes))
            voxels.colors.push_back(attribute.color & 0xFFFFFF);
    return voxels;
}

std::uint32_t packedMean(std::uint64_t red, std::uint64_t green, std::uint64_t blue, std::uint64_t count)
{
    static const std::vector<std::uint8_t>& to_srgb = linearToSrgbTable();
    const auto mean = [&](std::uint64_t sum) { return std::uint32_t{to_srgb[(sum + count / 2) / count]}; };
    return mean(red) | mean(green) << 8 | mean(blue) << 16;
}

/// Appends a line for each difference, and returns their number.
std::uint64_t compare(const std::vector<std::uint64_t>& codes, const std::vector<std::uint32_t>& colors,
                      const oracle::Dropped& dropped, const DeviceVoxels& device, std::vector<std::uint64_t>& suspects,
                      std::vector<std::string>& findings)
{
    std::uint64_t differences = 0;
    const auto differs = [&](std::uint64_t code, const char* what)
    {
        ++differences;
        if (suspects.size() < kSuspectsMax)
            suspects.push_back(code);
        const glm::uvec3 voxel = oracle::mortonDecode(code);
        if (findings.size() < kFindingsMax)
            findings.push_back(fmt::format("voxel ({} {} {}) {}", voxel.x, voxel.y, voxel.z, what));
    };
    std::size_t i = 0;
    std::size_t k = 0;
    while (i < codes.size() || k < device.codes.size())
    {
        const bool here = i < codes.size() && (k == device.codes.size() || codes[i] <= device.codes[k]);
        const bool there = k < device.codes.size() && (i == codes.size() || device.codes[k] <= codes[i]);
        if (!there)
            differs(codes[i], "is missing");
        else if (!here)
            differs(device.codes[k], "is too many");
        else if (colors[i] != device.colors[k])
            differs(codes[i], "has another colour");
        i += here ? 1 : 0;
        k += there ? 1 : 0;
    }
    if (dropped != device.dropped)
    {
        ++differences;
        findings.emplace_back("other triangles are dropped");
    }
    for (const std::string& violation : device.violations)
    {
        ++differences;
        findings.push_back("the octree is wrong: " + violation);
    }
    return differences;
}

/// The oracle's voxels of a batch.
struct ExpectedVoxels
{
    std::vector<std::uint64_t> codes;
    std::vector<std::uint32_t> colors;
    oracle::Dropped dropped;
    std::uint64_t fragments = 0;
    std::uint64_t hidden = 0;
};

/// Records of all fragments, sorted.
std::vector<Record> fragmentRecords(const Batch& batch, Coverage coverage, oracle::Dropped& dropped)
{
    const Grid grid = unitGrid(batch.depth);
    std::vector<std::vector<Record>> lists(oracle::threadCount());
    std::vector<oracle::Dropped> drops(oracle::threadCount());
    const auto work = [&](std::uint32_t thread, std::uint64_t first, std::uint64_t last)
    {
        for (std::uint64_t number = first; number < last; ++number)
        {
            std::array<glm::vec3, 3> corners;
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = glm::vec3(batch.triangles[number][i]) / 256.0F;
            const oracle::SnappedTriangle snapped = oracle::snapTriangle(corners, glm::mat4(1.0F), grid, coverage);
            if (snapped.dropped != nullptr)
            {
                ++drops[thread][snapped.dropped];
                continue;
            }
            oracle::forEachCoveredVoxel(
                exact(batch.triangles[number]), grid.resolution(), coverage,
                [&](const glm::uvec3& voxel) {
                    lists[thread].push_back({oracle::mortonEncode(voxel), static_cast<std::uint32_t>(number)});
                });
        }
    };
    oracle::forEachChunk(batch.triangles.size(), work);
    std::vector<Record> records;
    for (const std::vector<Record>& list : lists)
        records.insert(records.end(), list.begin(), list.end());
    for (const oracle::Dropped& counts : drops)
        for (const auto& [reason, count] : counts)
            dropped[reason] += count;
    std::sort(records.begin(), records.end());
    return records;
}

ExpectedVoxels expectedVoxels(const Batch& batch, const std::vector<Color>& colors, Coverage coverage)
{
    ExpectedVoxels expected;
    const std::vector<Record> records = fragmentRecords(batch, coverage, expected.dropped);
    expected.fragments = records.size();
    const auto colorOf = [&](std::size_t record) -> const Color& { return colors[records[record].triangle]; };
    for (std::size_t first = 0; first < records.size();)
    {
        const std::uint64_t code = records[first].code;
        std::uint64_t sums[3] = {0, 0, 0};
        std::size_t last = first;
        for (; last < records.size() && records[last].code == code; ++last)
            for (std::size_t channel = 0; channel < 3; ++channel)
                sums[channel] += colorOf(last)[channel];
        const std::size_t count = last - first;
        const std::uint32_t color = packedMean(sums[0], sums[1], sums[2], count);
        expected.codes.push_back(code);
        expected.colors.push_back(color);
        for (std::size_t i = first; count > 1 && i < last; ++i)
        {
            const Color& own = colorOf(i);
            const bool same = packedMean(sums[0] - own[0], sums[1] - own[1], sums[2] - own[2], count - 1) == color;
            expected.hidden += same ? 1 : 0;
        }
        first = last;
    }
    return expected;
}

/// Random colours, which are the same for the same number of triangles.
std::vector<Color> tagColors(std::size_t count)
{
    std::mt19937 random(17);
    std::vector<Color> colors(count);
    for (Color& color : colors)
        for (std::uint16_t& channel : color)
            channel = static_cast<std::uint16_t>(random() & 65535);
    return colors;
}

VoxelizeCapacities roomFor(const Batch& batch, const ExpectedVoxels& expected)
{
    VoxelizeCapacities capacities;
    constexpr std::uint32_t kBrickBits = 12; // of a code: which of a brick's 16^3 cells
    std::uint64_t bricks = 1;
    for (std::size_t i = 1; i < expected.codes.size(); ++i) // in Morton order
    {
        bricks += expected.codes[i] >> kBrickBits != expected.codes[i - 1] >> kBrickBits ? 1 : 0;
    }
    capacities.bricks = 2 * bricks; // some turn out empty
    capacities.table = std::bit_ceil(std::max<std::uint64_t>(2 * capacities.bricks, 64));
    capacities.setups = batch.triangles.size();
    capacities.items = batch.triangles.size() + expected.codes.size();
    capacities.large = batch.triangles.size();
    return capacities;
}

bool touches(const LatticeTriangle& triangle, const glm::ivec3& voxel)
{
    const glm::ivec3 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
    const glm::ivec3 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
    return glm::all(glm::lessThanEqual(low, voxel * 256 + 512)) &&
           glm::all(glm::greaterThanEqual(high, voxel * 256 - 256));
}

/// Finds the triangles at fault, by voxelizing those near the suspects one by one.
void findCulprits(vk::HeadlessDevice& device, const Batch& batch, Coverage coverage,
                  const std::vector<std::uint64_t>& suspects, std::vector<std::string>& findings)
{
    std::size_t found = 0;
    for (const LatticeTriangle& triangle : batch.triangles)
    {
        const auto near = [&](std::uint64_t code) { return touches(triangle, glm::ivec3(oracle::mortonDecode(code))); };
        if (found >= 3 || std::none_of(suspects.begin(), suspects.end(), near))
            continue;
        const Batch alone{batch.shape, batch.depth, true, {triangle}};
        const std::vector<Color> colors = tagColors(1);
        const ExpectedVoxels expected = expectedVoxels(alone, colors, coverage);
        const DeviceVoxels actual = voxelizeOnDevice(device, latticeScene(alone.triangles, colors),
                                                     unitGrid(batch.depth), coverage, roomFor(alone, expected));
        std::vector<std::uint64_t> own_suspects;
        std::vector<std::string> own;
        if (compare(expected.codes, expected.colors, expected.dropped, actual, own_suspects, own) != 0)
        {
            ++found;
            findings.push_back(fmt::format("alone, {} at depth {}: {}", toText(triangle), batch.depth, own.front()));
        }
    }
}

} // namespace

void Tally::add(const Tally& other)
{
    triangles += other.triangles;
    dropped += other.dropped;
    voxels += other.voxels;
    fragments += other.fragments;
    hidden += other.hidden;
    differences += other.differences;
    findings.insert(findings.end(), other.findings.begin(), other.findings.end());
}

Tally compareBatch(vk::HeadlessDevice& device, const Batch& batch, Coverage coverage)
{
    const std::vector<Color> colors = tagColors(batch.triangles.size());
    const ExpectedVoxels expected = expectedVoxels(batch, colors, coverage);
    const DeviceVoxels actual = voxelizeOnDevice(device, latticeScene(batch.triangles, colors), unitGrid(batch.depth),
                                                 coverage, roomFor(batch, expected));
    Tally tally;
    tally.triangles = batch.triangles.size();
    for (const auto& [reason, count] : expected.dropped)
        tally.dropped += count;
    tally.voxels = expected.codes.size();
    tally.fragments = expected.fragments;
    tally.hidden = expected.hidden;
    std::vector<std::uint64_t> suspects;
    tally.differences = compare(expected.codes, expected.colors, expected.dropped, actual, suspects, tally.findings);
    if (batch.disjoint && expected.fragments != expected.codes.size())
    {
        ++tally.differences;
        tally.findings.emplace_back("the batch's triangles were to have no voxel in common, and have");
    }
    if (tally.differences != 0)
        findCulprits(device, batch, coverage, suspects, tally.findings);
    return tally;
}

Tally compareScene(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage)
{
    const std::vector<oracle::VoxelColor> expected = oracle::voxelColors(scene, grid, coverage);
    const oracle::OracleVoxels set = oracle::voxelize(scene, grid, coverage);
    const DeviceVoxels actual = voxelizeOnDevice(device, scene, grid, coverage, std::nullopt);
    Tally tally;
    tally.triangles = scene.triangleCount();
    for (const auto& [reason, count] : set.dropped)
        tally.dropped += count;
    std::vector<std::uint32_t> colors;
    for (const oracle::VoxelColor& voxel : expected)
    {
        tally.fragments += voxel.count;
        colors.push_back(packedMean(voxel.sum_r, voxel.sum_g, voxel.sum_b, voxel.count));
    }
    tally.voxels = set.codes.size();
    std::vector<std::uint64_t> suspects;
    tally.differences = compare(set.codes, colors, set.dropped, actual, suspects, tally.findings);
    return tally;
}

} // namespace zvo::stress
