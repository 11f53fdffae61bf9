// SPDX-License-Identifier: MIT
#include "baseline/pointer_tree.h"
#include "baseline/thesis_build.h"
#include "baseline/thesis_voxelize.h"
#include "bench/baseline_comparisons.h"
#include "bench/bench_runs.h"
#include "common/report.h"
#include "runtime/live_scene.h"
#include "zvo/error.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr baseline::TileNumbering kAsPublished = baseline::TileNumbering::Atomic;

baseline::ThesisTarget thesisTarget(const BenchBaselinesOptions& options)
{
    return options.attributes ? baseline::ThesisTarget::Colors : baseline::ThesisTarget::Occupancy;
}

double pictureMs(vk::HeadlessDevice& device, const baseline::PointerOctree& octree, const TraceCamera& camera,
                 baseline::PointerPicture& picture)
{
    return sumMs(device.run([&](auto& graph) { tracePicture(graph, octree, camera, picture); }));
}

// What an update took.
struct UpdateMs
{
    double voxelize = 0; // the dynamic objects
    double merge = 0;
};

// The thesis's update of an octree.
class ThesisUpdater
{
public:
    ThesisUpdater(vk::HeadlessDevice& device, const BenchBaselinesOptions& options, const Grid& grid, bool bounds)
        : m_device(device), m_options(options), m_bounds(bounds), m_cells(device.device(), grid),
          m_levels(device.device(), grid)
    {
    }

    // Builds the octree of what stands still.
    void build(const GpuScene& fixed)
    {
        voxelize(fixed);
        m_octree = buildThesis(m_device, m_cells, {kAsPublished, m_range}, m_levels).octree;
    }

    // Replaces the last update by one with these objects.
    UpdateMs update(const GpuScene& objects)
    {
        UpdateMs ms;
        ms.voxelize = voxelize(objects);
        ms.merge = sumMs(updateThesis(m_device, m_cells, {kAsPublished, m_range}, m_levels, m_octree));
        return ms;
    }

    [[nodiscard]] const baseline::PointerOctree& octree() const { return m_octree; }

private:
    double voxelize(const GpuScene& scene)
    {
        baseline::ThesisTriangles triangles(m_device.device(), scene);
        baseline::CodeRange range;
        const auto passes = voxelizeThesis(m_device, {scene, m_cells.grid, m_options.coverage, triangles, m_bounds},
                                           thesisTarget(m_options), m_cells, &range);
        m_range = m_bounds ? std::optional(range) : std::nullopt;
        return sumMs(passes);
    }

    vk::HeadlessDevice& m_device;
    const BenchBaselinesOptions& m_options;
    bool m_bounds; // visit only cells between the codes that occur
    baseline::ThesisCells m_cells;
    baseline::ThesisLevels m_levels;
    std::optional<baseline::CodeRange> m_range;
    baseline::PointerOctree m_octree;
};

UpdateMs liveUpdateMs(const LiveUpdate& update)
{
    UpdateMs ms;
    for (const vk::PassTime& pass : update.passes)
    {
        (voxelizesObjects(pass.name) ? ms.voxelize : ms.merge) += pass.ms;
    }
    return ms;
}

// Times of several updates.
struct UpdateRuns
{
    std::vector<double> voxelize;
    std::vector<double> merge;
    std::vector<double> both;

    void add(const UpdateMs& ms)
    {
        voxelize.push_back(ms.voxelize);
        merge.push_back(ms.merge);
        both.push_back(ms.voxelize + ms.merge);
    }
};

} // namespace

void compareThesis(BaselineSubject& subject, BaselineRows& rows)
{
    using namespace baseline;
    vk::HeadlessDevice& device = subject.device();
    ThesisTriangles triangles(device.device(), subject.uploaded());
    ThesisCells cells(device.device(), subject.grid());
    ThesisLevels levels(device.device(), subject.grid());
    PointerOctree octree;
    for (const bool bounds : {false, true})
    {
        const std::string suffix = bounds ? ", range of codes" : "";
        CodeRange range;
        const ThesisJob job{subject.uploaded(), subject.grid(), subject.options().coverage, triangles, bounds};
        subject.measure(
            rows, {"thesis", "voxelize" + suffix,
                   [&] { return sumMs(voxelizeThesis(device, job, thesisTarget(subject.options()), cells, &range)); },
                   [&] { return subject.buildMs(true, false); }});
        const ThesisBuildOptions build = {kAsPublished, bounds ? std::optional(range) : std::nullopt};
        subject.measure(rows, {"thesis", "build, bottom-up" + suffix,
                               [&]
                               {
                                   octree = {};
                                   ThesisBuild built = buildThesis(device, cells, build, levels);
                                   octree = std::move(built.octree);
                                   return sumMs(built.passes);
                               },
                               [&] { return subject.buildMs(false, true); }});
    }
    subject.addSize(rows, "thesis, 12-byte nodes", octree.node_count, octree.bytes());
    PointerPicture picture(device.device(), kBaselineWidth, kBaselineHeight);
    subject.measure(
        rows, {"thesis", "rays", [&] { return pictureMs(device, octree, subject.camera(), picture); }, subject.rays()});
}

void compareThesisUpdate(BaselineSubject& subject, const AnimatedScene& animated, BaselineRows& rows)
{
    vk::HeadlessDevice& device = subject.device();
    const BenchBaselinesOptions& options = subject.options();
    AnimatedScene moving;
    moving.objects = animated.objects;
    LiveScene live(device, AnimatedScene(animated), subject.grid(),
                   {options.coverage, options.attributes, TreeStructure::Svo});
    BaselineCase what = subject.what();
    const auto frame_count = static_cast<std::uint64_t>(std::lround(animated.seconds * animated.frames_per_second));
    // Different times of the animation, twice each: the first time, both sides find the room that they need.
    const auto secondsOf = [&](std::uint32_t run)
    { return frameTime(animated, (run % options.run_count + 1) * frame_count / (options.run_count + 1)); };
    for (const bool bounds : {false, true})
    {
        ThesisUpdater thesis(device, options, subject.grid(), bounds);
        thesis.build(subject.uploaded());
        UpdateRuns thesis_ms;
        UpdateRuns zvo_ms;
        for (std::uint32_t run = 0; run < 2 * options.run_count; ++run)
        {
            const double seconds = secondsOf(run);
            const GpuScene objects =
                uploadScene(device, sceneAt(moving, seconds), options.attributes, brightestEmission(animated));
            std::optional<UpdateMs> thesis_run;
            if (run % 2 == 0)
            {
                thesis_run = thesis.update(objects);
            }
            live.updateAndWait(animated.seconds / 2); // another pose, so that the next one is voxelized
            const LiveUpdate update = live.updateAndWait(seconds);
            if (run % 2 != 0)
            {
                thesis_run = thesis.update(objects);
            }
            what.moving_voxels = update.report.dynamic_count;
            if (run >= options.run_count && update.retry_count == 0)
            {
                thesis_ms.add(*thesis_run);
                zvo_ms.add(liveUpdateMs(update));
            }
        }
        if (zvo_ms.both.empty())
        {
            throw Error(ErrorCode::Memory, "updates find no room");
        }
        const std::string suffix = bounds ? ", range of codes" : "";
        rows.add(what, "thesis", "update: voxelize" + suffix, thesis_ms.voxelize, zvo_ms.voxelize);
        rows.add(what, "thesis", "update: merge" + suffix, thesis_ms.merge, zvo_ms.merge);
        rows.add(what, "thesis", "update" + suffix, thesis_ms.both, zvo_ms.both);
        if (bounds)
        {
            continue;
        }
        baseline::PointerPicture picture(device.device(), kBaselineWidth, kBaselineHeight);
        TreeTracer tracer(device.device());
        tracer.resize(kBaselineWidth, kBaselineHeight);
        PrimaryRays rays(device, live.tree(), subject.camera(), tracer);
        rows.measure(what,
                     {"thesis", "rays after the update",
                      [&] { return pictureMs(device, thesis.octree(), subject.camera(), picture); },
                      [&] { return sumMs(rays.trace()); }},
                     options.run_count);
    }
}

} // namespace zvo::cli
