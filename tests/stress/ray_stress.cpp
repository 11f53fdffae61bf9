// SPDX-License-Identifier: MIT
// Traces millions of rays and compares them with two references (oracle/trace.h bit for bit, oracle/ray_bounds.h); rays
// out of closed shells, which must hit; and pictures by every path of the tracer. Prints a checksum of all hits, which
// must not depend on the subgroup size.
//
//   zvo_ray_stress [--rays N] [--seed S]    N random rays, N aimed ones, N / 4 out of closed shells
#include "core/base/kernels.h"
#include "core/trace/trace.h"
#include "io/file/sha256.h"
#include "runtime/trees.h"
#include "stress/program.h"
#include "stress/ray_judge.h"
#include "stress/stress_rays.h"
#include "support/device.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_rays.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string_view>

namespace zvo::stress
{

namespace
{

constexpr std::uint64_t kBatch = 1U << 17;
constexpr gpu::Hit kMiss = {0.0F, gpu::kHitMiss, gpu::uvec2(0)}; // the rest of a miss is undefined on the device

struct Options
{
    std::uint64_t rays = 300000;
    std::uint64_t seed = 1;
};

std::vector<StressTree> makeTrees()
{
    std::mt19937 random(11);
    const auto full = [](const glm::uvec3&) { return true; };
    const auto checkered = [](const glm::uvec3& v) { return ((v.x + v.y + v.z) & 1U) == 0; };
    const auto planes = [](const glm::uvec3& v) { return v.x == 21 || v.y == 42 || v.z == 10; };
    const auto rods = [](const glm::uvec3& v) { return v.x % 5 == 0 && v.y % 7 == 0; };
    std::vector<StressTree> trees;
    trees.push_back({"two voxels of 2", {0, 5}, 1});
    trees.push_back({"random 4", test::randomCodes(2, 20, random), 2});
    trees.push_back({"full 8", test::codesWhere(3, full), 3});
    trees.push_back({"random 8", test::randomCodes(3, 60, random), 3});
    trees.push_back({"checkered 8", test::codesWhere(3, checkered), 3});
    trees.push_back({"full 16", test::codesWhere(4, full), 4});
    trees.push_back({"shell 16", test::sphereShell(4, 7.0), 4});
    trees.push_back({"random 16", test::randomCodes(4, 900, random), 4});
    trees.push_back({"one voxel of 32", {12345}, 5});
    trees.push_back({"dense 32", test::randomCodes(5, 16000, random), 5});
    trees.push_back({"shell 32", test::sphereShell(5, 14.0), 5});
    trees.push_back({"rods 32", test::codesWhere(5, rods), 5});
    trees.push_back({"sponge 64", test::spongeCodes(6), 6});
    trees.push_back({"planes 64", test::codesWhere(6, planes), 6});
    trees.push_back({"sparse 64", test::randomCodes(6, 2000, random), 6});
    trees.push_back({"shell 128", test::sphereShell(7, 60.0), 7});
    trees.push_back({"sparse 512", test::randomCodes(9, 4000, random), 9});
    trees.push_back({"sparse 4096", test::randomCodes(12, 4000, random), 12});
    return trees;
}

using MakeRay = std::function<StressRay(Random&)>;
using Check = std::function<void(const StressRay&, const std::optional<test::DeviceHit>&)>;

// Traces count rays through octree, checks each hit and adds it to sum.
void traceBatch(vk::HeadlessDevice& device, const DeviceTree& octree, std::uint64_t count, std::uint64_t seed,
                const MakeRay& make_ray, const Check& check, Sha256& sum)
{
    std::vector<StressRay> rays(count);
    std::vector<gpu::Ray> device_rays(count);
    inParallel(count,
               [&](std::uint64_t first, std::uint64_t end)
               {
                   Random random(seed * 0x9E3779B97F4A7C15U + first);
                   for (std::uint64_t i = first; i < end; ++i)
                   {
                       rays[i] = make_ray(random);
                       device_rays[i] = rays[i].device;
                   }
               });
    test::TracedRays traced = test::traceRaysOf(device, octree, device_rays);
    if (traced.capped_rays != 0)
    {
        tally().wrong += traced.capped_rays;
        fmt::print("WRONG: {} rays ran into the cap on iterations\n", traced.capped_rays);
    }
    std::vector<gpu::Hit>& hits = traced.hits;
    inParallel(count,
               [&](std::uint64_t first, std::uint64_t end)
               {
                   for (std::uint64_t i = first; i < end; ++i)
                   {
                       check(rays[i], test::unpack(hits[i]));
                       if (hits[i].index == gpu::kHitMiss)
                       {
                           hits[i] = kMiss;
                       }
                   }
               });
    sum.update(std::as_bytes(std::span(hits)));
}

// Traces count rays in all, spread over trees.
void traceTrees(vk::HeadlessDevice& device, const std::vector<StressTree>& trees, const Options& options, bool aimed,
                Sha256& sum)
{
    const std::uint64_t per_tree = (options.rays + trees.size() - 1) / trees.size();
    for (const StressTree& tree : trees)
    {
        const DeviceTree octree = test::octreeOf(device, tree.codes, tree.depth);
        const std::uint32_t resolution = octree.grid.rootResolution();
        const RayJudge judge(tree);
        const MakeRay make_ray = [&](Random& random)
        { return aimed ? aimedRay(random, resolution, tree.codes) : randomRay(random); };
        const Check check = [&](const StressRay& ray, const std::optional<test::DeviceHit>& hit)
        { judge.check(ray, hit, octree.grid.nodeLevels()); };
        std::uint64_t batch = 0;
        const std::uint64_t size = std::min(kBatch, per_tree);
        for (std::uint64_t done = 0; done < per_tree; done += size, ++batch)
        {
            const std::uint64_t seed =
                options.seed * 1000003 + (&tree - trees.data()) * 2003 + batch * 2 + (aimed ? 1 : 0);
            traceBatch(device, octree, std::min(size, per_tree - done), seed, make_ray, check, sum);
        }
    }
}

struct Shell
{
    std::string name;
    Scene scene;
    std::uint32_t depth;
    glm::vec3 low; // whole voxels inside of the shell
    glm::vec3 high;
};

std::vector<Shell> makeShells()
{
    std::vector<Shell> shells;
    for (const std::uint32_t depth : {4U, 5U, 6U, 7U, 8U, 9U})
    {
        const auto edge = static_cast<float>(1U << depth);
        for (const float shift : {0.0F, 0.37F})
        {
            const glm::vec3 low(1.0F + shift);
            const glm::vec3 high(edge - 2.0F + shift);
            shells.push_back({fmt::format("cube in {}", edge), test::boxScene(low, high), depth, glm::ceil(low) + 1.0F,
                              glm::floor(high) - 1.0F});
        }
        const glm::vec3 center(0.5F * edge + 0.13F, 0.5F * edge, 0.5F * edge - 0.31F);
        const float radius = 0.47F * edge - 0.5F;
        const float inner = 0.55F * (radius - 2.0F);
        shells.push_back({fmt::format("sphere in {}", edge), test::sphereScene(center, radius, 40), depth,
                          glm::ceil(center - inner), glm::floor(center + inner)});
    }
    return shells;
}

// Traces rays out of closed shells, voxelized by zvo with thin coverage. Each ray must hit.
void traceShells(vk::HeadlessDevice& device, const Options& options, Sha256& sum)
{
    const std::vector<Shell> shells = makeShells();
    const std::uint64_t per_shell = (options.rays / 4 + shells.size() - 1) / shells.size();
    for (const Shell& shell : shells)
    {
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = shell.depth};
        const GpuScene gpu_scene = uploadScene(device, shell.scene, false);
        const DeviceTree octree = buildOctree(device, gpu_scene, grid, {Coverage::Thin, false, {}}).octree;
        const MakeRay make_ray = [&](Random& random)
        { return rayFromInside(random, grid.rootResolution(), shell.low, shell.high); };
        const Check check = [&](const StressRay& ray, const std::optional<test::DeviceHit>& hit)
        {
            tally().hits += hit ? 1 : 0;
            if (!hit)
            {
                reportWrong(shell.name, ray, "leaks");
            }
        };
        std::uint64_t batch = 0;
        const std::uint64_t size = std::min(kBatch, per_shell);
        for (std::uint64_t done = 0; done < per_shell; done += size, ++batch)
        {
            traceBatch(device, octree, std::min(size, per_shell - done),
                       options.seed * 7919 + (&shell - shells.data()) * 4001 + batch, make_ray, check, sum);
        }
    }
}

// Primary hits, all misses of which are equal, and the most iterations of a ray.
struct Hits
{
    std::vector<gpu::Hit> hits;
    std::uint32_t iterations_max = 0;
};

Hits takePicture(vk::HeadlessDevice& device, const DeviceTree& octree, const TraceCamera& camera,
                 const TraceOptions& options)
{
    test::Picture picture = test::takePicture(device, octree, camera, 333, 217, options);
    tally().wrong += picture.capped_rays;
    std::ranges::replace_if(
        picture.hits, [](const gpu::Hit& hit) { return hit.index == gpu::kHitMiss; }, kMiss);
    return {std::move(picture.hits), *std::ranges::max_element(picture.light)};
}

bool sameHits(const Hits& a, const Hits& b)
{
    return std::equal(a.hits.begin(), a.hits.end(), b.hits.begin(), b.hits.end(),
                      [](const gpu::Hit& x, const gpu::Hit& y)
                      { return x.index == y.index && x.t == y.t && x.where == y.where; });
}

// Takes pictures with and without the beam. Returns their number.
std::uint32_t takePictures(vk::HeadlessDevice& device, const std::vector<StressTree>& trees, Sha256& sum)
{
    std::uint32_t count = 0;
    for (const StressTree& tree : trees)
    {
        const DeviceTree octree = test::octreeOf(device, tree.codes, tree.depth);
        const auto edge = static_cast<double>(octree.grid.resolution());
        const glm::dvec3 middle(0.5 * edge);
        for (const ViewCamera& view : {ViewCamera::framing({glm::vec3(0.0F), glm::vec3(static_cast<float>(edge))}, 1.5),
                                       ViewCamera::lookAt(middle + 0.1, glm::dvec3(0.3 * edge, edge, 0.2 * edge), 1.5),
                                       ViewCamera::lookAt(edge * glm::dvec3(1.01, 1.02, 0.2), middle, 1.0),
                                       ViewCamera::lookAt(edge * glm::dvec3(90.0, 40.0, 70.0), middle, 0.012)})
        {
            const TraceCamera camera = traceCamera(view, octree.grid, 217);
            std::optional<Hits> first;
            for (const bool with_beam : {false, true})
            {
                TraceOptions options;
                options.beam = with_beam;
                options.view = View::Iterations;
                Hits picture = takePicture(device, octree, camera, options);
                ++count;
                // Each cell on the path is left once, and entered by at most one descent for each level.
                const std::uint32_t bound = (3 * octree.grid.rootResolution() + 1) * (octree.grid.nodeLevels() + 1);
                const bool wrong = (first && !sameHits(*first, picture)) || picture.iterations_max > bound;
                if (wrong)
                {
                    ++tally().wrong;
                    fmt::print("WRONG: a picture of {} differs, or takes too many steps ({})\n", tree.name,
                               picture.iterations_max);
                }
                if (!first)
                {
                    sum.update(std::as_bytes(std::span(picture.hits)));
                    first = std::move(picture);
                }
            }
        }
    }
    return count;
}

bool run(const Options& options)
{
    vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
    const std::vector<StressTree> trees = makeTrees();
    Sha256 sum;
    traceTrees(device, trees, options, false, sum);
    printTally(fmt::format("{} random rays", options.rays));
    traceTrees(device, trees, options, true, sum);
    printTally(fmt::format("{} aimed rays", options.rays));
    traceShells(device, options, sum);
    fmt::print("{} rays out of closed shells; {} wrong\n", tally().hits.load(), tally().wrong.load());
    const std::uint32_t pictures = takePictures(device, trees, sum);
    fmt::print("{} pictures; {} wrong\n", pictures, tally().wrong.load());
    fmt::print("hits {}\n", sum.hexDigest());
    return tally().wrong == 0;
}

} // namespace

} // namespace zvo::stress

int main(int argc, char** argv)
{
    zvo::stress::Options options;
    CLI::App app("Rays, device against references");
    app.add_option("--rays", options.rays,
                   "how many random rays, and aimed ones; a quarter as many leave closed shells")
        ->capture_default_str();
    app.add_option("--seed", options.seed, "another number, other rays")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return zvo::stress::runProgram("zvo_ray_stress", [&] { return zvo::stress::run(options); });
}
