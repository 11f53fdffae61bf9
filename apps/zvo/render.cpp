// SPDX-License-Identifier: MIT
#include "render.h"

#include "core/gpu_scene.h"
#include "core/kernels.h"
#include "core/pipeline.h"
#include "core/stage_octree.h"
#include "core/tree_view.h"
#include "core/zvo_file.h"
#include "output.h"
#include "pictures.h"
#include "progress.h"
#include "renderer.h"
#include "report.h"
#include "session.h"
#include "view.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

/// The pictures of a scene, and what there is to tell of them.
class Run
{
public:
    Run(const RenderOptions& options, Pictures& pictures, Progress& progress)
        : m_options(options), m_pictures(pictures), m_progress(progress),
          m_device(headlessOptions(options.device), zvoKernels()), m_renderer(m_device, options)
    {
    }

    // A camera that turns around what stands still.
    void turn(Scene&& scene, const Grid& grid, const ViewCamera& camera, const glm::dvec3& centre)
    {
        BuildResult result = voxelize(std::move(scene), grid);
        report(result);
        const DeviceTree tree = structured(std::move(result.octree));
        std::visit([&](const auto& made) { turn(TreeView(made), camera, centre); }, tree);
    }

    // The same around what a file holds.
    void turn(TreeData&& tree, const ViewCamera& camera, const glm::dvec3& centre)
    {
        m_progress.step("copying to the device");
        report(tree);
        const DeviceTree uploaded = uploadTree(m_device, tree);
        tree = {};
        std::visit([&](const auto& on_device) { turn(TreeView(on_device), camera, centre); }, uploaded);
    }

    // What stands still is voxelized once, what moves is merged with it at each time.
    void play(const Stage& stage, const Grid& grid, const ViewCamera& camera)
    {
        m_progress.step("voxelizing what stands still");
        StageOctree octree(m_device, stage, grid,
                           {m_options.voxels.coverage, m_options.voxels.hasAttributes(), structure()});
        for (std::uint32_t i = 0; i < m_pictures.count(); ++i)
        {
            m_progress.step("updating");
            const double seconds = timeOf(stage, i);
            const StageUpdate update = octree.update(seconds);
            const std::vector<vk::PassTime> beam_passes = m_renderer.show(octree.tree());
            if (i == 0)
            {
                report(stage, octree, update);
                m_beam_passes = beam_passes;
            }
            m_has_warned = m_has_warned || warnOfDroppedMovers(seconds, update.report.dropped);
            draw(i, camera);
            m_frames.push_back({{"frame", m_pictures.number(i)},
                                {"seconds", seconds},
                                {"voxels_dynamic", update.report.dynamic_count},
                                {"nodes_dynamic", update.report.node_count},
                                {"dropped", update.report.dropped},
                                {"dynamic_ms", sumMs(update.passes)},
                                {"retries", update.retry_count},
                                {"trace_ms", m_times.back().trace_ms},
                                {"shade_ms", m_times.back().shade_ms}});
        }
    }

    // Everything is voxelized together, at each time anew.
    void rebuild(const Stage& stage, const Grid& grid, const ViewCamera& camera)
    {
        for (std::uint32_t i = 0; i < m_pictures.count(); ++i)
        {
            const double seconds = timeOf(stage, i);
            BuildResult result = voxelize(stageAt(stage, seconds), grid);
            if (i == 0)
            {
                report(result);
            }
            Json frame = frameJson(m_pictures.number(i), seconds, result);
            const DeviceTree tree = structured(std::move(result.octree));
            const std::vector<vk::PassTime> beam_passes =
                std::visit([&](const auto& made) { return m_renderer.show(made); }, tree);
            m_beam_passes = i == 0 ? beam_passes : m_beam_passes;
            draw(i, camera);
            frame["trace_ms"] = m_times.back().trace_ms;
            frame["shade_ms"] = m_times.back().shade_ms;
            m_frames.push_back(std::move(frame));
        }
    }

    // The report, if one was asked for, after all pictures.
    Json json()
    {
        double trace_ms = 0;
        double shade_ms = 0;
        for (const PictureTimes& picture : m_times)
        {
            trace_ms += picture.trace_ms / static_cast<double>(m_times.size());
            shade_ms += picture.shade_ms / static_cast<double>(m_times.size());
        }
        for (const std::vector<vk::PassTime>* passes : {&m_beam_passes, &m_times.front().passes})
        {
            const Json more = passesJson(*passes);
            m_json["passes"].insert(m_json["passes"].end(), more.begin(), more.end());
        }
        m_json["bytes"]["peak_device"] = m_device.device().memory().peakBytes();
        m_json["trace_ms"] = trace_ms;
        m_json["shade_ms"] = shade_ms;
        m_json["beam_grid_ms"] = sumMs(m_beam_passes);
        m_json["capped_rays"] = m_renderer.cappedRays();
        m_json["picture"] = {{"width", m_options.width}, {"height", m_options.height}, {"count", m_pictures.count()}};
        if (!m_frames.empty())
        {
            m_json["frames"] = m_frames;
        }
        return m_json;
    }

    // What was made, on one line.
    void tell()
    {
        if (m_renderer.cappedRays() != 0)
        {
            talk(fmt::format("warning: {} rays took too many steps and were given up", m_renderer.cappedRays()));
        }
        talk(fmt::format("{}; trace {:.1f} ms, light and shade {:.1f} ms on {}", m_built, m_times.front().trace_ms,
                         m_times.front().shade_ms, m_device.device().report().name));
    }

private:
    void turn(const TreeView& tree, const ViewCamera& camera, const glm::dvec3& centre)
    {
        m_beam_passes = m_renderer.show(tree);
        for (std::uint32_t i = 0; i < m_pictures.count(); ++i)
        {
            const double turn = 2.0 * std::numbers::pi * m_pictures.number(i) / m_pictures.count();
            draw(i, camera.turnedAround(centre, turn));
        }
    }

    [[nodiscard]] TreeStructure structure() const { return m_options.structure.value_or(TreeStructure::Svo); }

    // What was voxelized, as it is to be traced. Tells of the first.
    DeviceTree structured(Octree&& octree)
    {
        if (structure() == TreeStructure::Svo)
        {
            return std::move(octree);
        }
        m_progress.step("compressing");
        CompressResult result = compress(m_device, std::move(octree));
        if (!m_json.empty() && !m_json.contains("dag"))
        {
            m_json["dag"] = {{"nodes", result.dag.tree.node_count},
                             {"geometry_bytes", result.dag.geometryBytes()},
                             {"compress_ms", result.ms()}};
        }
        return std::move(result.dag);
    }

    [[nodiscard]] double timeOf(const Stage& stage, std::uint32_t index) const
    {
        return m_options.frames ? frameTime(stage, m_pictures.number(index))
                                : loopedTime(stage, m_options.voxels.time.value_or(0.0));
    }

    BuildResult voxelize(Scene scene, const Grid& grid)
    {
        m_progress.step("copying to the device");
        m_triangle_count = scene.triangleCount();
        const GpuScene gpu_scene = uploadScene(m_device, scene, m_options.voxels.hasAttributes());
        scene = {};
        m_progress.step("voxelizing");
        BuildResult result =
            buildOctree(m_device, gpu_scene, grid, {m_options.voxels.coverage, m_options.voxels.hasAttributes(), {}});
        m_has_warned = m_has_warned || warnOfDropped(result.octree.voxel_count, result.dropped); // not for each frame
        return result;
    }

    // The octree of the first picture.
    void report(const BuildResult& result)
    {
        m_built = fmt::format("{} voxels of {}^3 from {} triangles; voxelize {:.1f} ms, build {:.1f} ms",
                              result.octree.voxel_count, result.octree.grid.resolution(), m_triangle_count,
                              result.stageMs("voxelize"), result.stageMs("octree"));
        if (!m_options.output.json.empty())
        {
            m_json = octreeJson("zvo.render/1", m_device.device().report(), m_options.voxels, m_triangle_count, result,
                                octreeSha256(m_device, result.octree), 0);
        }
    }

    // What a file holds.
    void report(const TreeData& tree)
    {
        m_built =
            fmt::format("{} voxels of {}^3 in {} nodes", tree.voxel_count, tree.grid.resolution(), tree.nodes.size());
        m_json["schema"] = "zvo.render_tree/1";
        m_json["zvo"] = ZVO_VERSION;
        m_json["device"] = deviceJson(m_device.device().report());
        m_json["structure"] = structureName(tree.structure);
        m_json["grid"] = gridJson(tree.grid);
        m_json["resolution"] = tree.grid.resolution();
        m_json["voxels"] = tree.voxel_count;
        m_json["nodes"] = tree.nodes.size();
        m_json["bytes"] = {{"geometry", tree.geometryBytes()}, {"attributes", tree.attributeBytes()}};
        m_json["passes"] = Json::array();
    }

    // What stands still, and the first update.
    void report(const Stage& stage, StageOctree& octree, const StageUpdate& update)
    {
        const StaticPart& part = octree.staticPart();
        const Grid& grid = octree.tree().octree().grid;
        const std::uint64_t triangle_count = part.triangle_count + octree.moverTriangleCount();
        warnOfDropped(std::uint64_t{part.voxel_count} + update.report.dynamic_count, part.dropped);
        const double voxelize_ms = operationMs(part.passes, "voxelize");
        const double build_ms = operationMs(part.passes, "octree");
        m_built = fmt::format("{} static and {} dynamic voxels of {}^3 from {} triangles; voxelize {:.1f} ms, build "
                              "{:.1f} ms, update {:.1f} ms",
                              part.voxel_count, update.report.dynamic_count, grid.resolution(), triangle_count,
                              voxelize_ms, build_ms, sumMs(update.passes));
        m_json = headJson("zvo.render_dynamic/1", m_device.device().report(), m_options.voxels, grid);
        m_json["merge"] = mergeRuleName(stage.merge);
        m_json["scene"] = {{"triangles_static", part.triangle_count},
                           {"triangles_dynamic", octree.moverTriangleCount()},
                           {"movers", stage.movers.size()},
                           {"dropped", part.dropped}};
        m_json["voxels_static"] = part.voxel_count;
        m_json["nodes_static"] = part.node_count;
        m_json["structure"] = structureName(structure());
        m_json["bytes"]["geometry_static"] = part.geometry_bytes;
        m_json["passes"] = Json::array();
        for (const std::vector<vk::PassTime>* passes : {&part.passes, &part.compress_passes, &update.passes})
        {
            const Json more = passesJson(*passes);
            m_json["passes"].insert(m_json["passes"].end(), more.begin(), more.end());
        }
        m_json["voxelize_ms"] = voxelize_ms;
        m_json["build_ms"] = build_ms;
        m_json["compress_ms"] = structure() == TreeStructure::Svdag ? Json(sumMs(part.compress_passes)) : Json(nullptr);
    }

    Json frameJson(std::uint32_t number, double seconds, const BuildResult& result)
    {
        const bool is_wanted = !m_options.output.json.empty();
        return {{"frame", number},
                {"seconds", seconds},
                {"triangles", m_triangle_count},
                {"voxels", result.octree.voxel_count},
                {"nodes", result.octree.node_count},
                {"octree_sha256", is_wanted ? octreeSha256(m_device, result.octree) : ""},
                {"voxelize_ms", result.stageMs("voxelize")},
                {"build_ms", result.stageMs("octree")}};
    }

    void draw(std::uint32_t index, const ViewCamera& camera)
    {
        m_progress.step("tracing");
        m_times.emplace_back();
        const std::vector<std::uint8_t> png = m_renderer.render(camera, m_times.back());
        checkValidation(m_device);
        m_pictures.write(index, png);
    }

    const RenderOptions& m_options;
    Pictures& m_pictures;
    Progress& m_progress;
    vk::HeadlessDevice m_device;
    Renderer m_renderer;
    std::uint64_t m_triangle_count = 0; // of the scene voxelized last
    std::vector<vk::PassTime> m_beam_passes;
    std::vector<PictureTimes> m_times;
    bool m_has_warned = false; // of triangles that were dropped, which one frame after the other may have
    std::string m_built;
    Json m_json;
    Json m_frames = Json::array();
};

bool hasZvoFile(const VoxelOptions& options)
{
    return std::any_of(options.scenes.begin(), options.scenes.end(), isZvoFile);
}

// Options that a tree takes no notice of must not look as if it did.
void checkTreeOptions(const RenderOptions& options)
{
    const VoxelOptions& voxels = options.voxels;
    const VoxelOptions plain;
    if (voxels.scenes.size() > 1)
    {
        throw Error(ErrorCode::Usage, "a .zvo file stands alone; build one of all that is to be seen");
    }
    const std::pair<const char*, bool> given[] = {
        {"--up", voxels.load.up != plain.load.up},
        {"--scale", voxels.load.scale != plain.load.scale},
        {"--scenes", voxels.scenes_folder.has_value()},
        {"--time", voxels.time.has_value()},
        {"--resolution", voxels.depth.has_value()},
        {"--coverage", voxels.coverage != plain.coverage},
        {"--attributes", voxels.attributes != plain.attributes},
        {"--bounds", voxels.bounds.has_value()},
        {"--grid", voxels.grid_place.has_value()},
        {"--structure", options.structure.has_value()},
        {"--rebuild", options.rebuild},
    };
    for (const auto& [name, is_given] : given)
    {
        if (is_given)
        {
            throw Error(ErrorCode::Usage, fmt::format("{} does not go with {}, whose voxels are made already", name,
                                                      voxels.scenes.front().string()));
        }
    }
}

// The voxels' box in world space.
Bounds boundsOf(const TreeData& tree)
{
    const std::optional<CellBox> box = voxelBox(tree);
    Bounds bounds;
    if (box)
    {
        const auto corner = [&grid = tree.grid](const glm::uvec3& cell)
        { return glm::vec3(glm::dvec3(grid.origin) + glm::dvec3(cell) * double{grid.voxel_size}); };
        bounds = {corner(box->min), corner(box->max)};
    }
    return bounds;
}

void renderTree(const RenderOptions& options, Pictures& pictures, std::optional<Output>& report)
{
    checkTreeOptions(options);
    Progress progress(2 + pictures.count());
    progress.step("loading");
    TreeData tree = readZvo(options.voxels.scenes.front()).tree;
    if (tree.voxel_count == 0)
    {
        talk("warning: the file has no voxels");
    }
    const Bounds subject = subjectOf(boundsOf(tree), tree.grid);
    const ViewCamera camera =
        chooseCamera(options.camera, Scene(), subject, static_cast<double>(options.width) / options.height);
    Run run(options, pictures, progress);
    run.turn(std::move(tree), camera, 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max)));
    if (report)
    {
        report->write(jsonText(run.json()));
        report->finish();
    }
    run.tell();
}

} // namespace

void render(const RenderOptions& options)
{
    checkPlaces(options.output, options.voxels.scenes);
    Pictures pictures(options);
    std::optional<Output> report = openReport(options.output);
    if (hasZvoFile(options.voxels))
    {
        renderTree(options, pictures, report);
        return;
    }

    Progress progress(3 + pictures.count());
    progress.step("loading");
    Stage stage = loadStageWithWarnings(options.voxels, options.frames || options.voxels.time);
    const bool moves = !stage.movers.empty();
    const std::uint32_t compressions = options.structure == TreeStructure::Svdag ? 1 : 0;
    progress.expect(!moves            ? 3 + compressions + pictures.count()
                    : options.rebuild ? 1 + (3 + compressions) * pictures.count()
                                      : 2 + 2 * pictures.count());
    checkPlaces(options.output, stage.files);
    const Bounds bounds = stageBounds(stage);
    const Grid grid = placeGrid(options.voxels, stage, bounds);
    const Bounds subject = subjectOf(bounds, grid);
    const ViewCamera camera =
        chooseCamera(options.camera, stage, subject, static_cast<double>(options.width) / options.height);

    Run run(options, pictures, progress);
    if (moves && options.rebuild)
    {
        warnOfMergeRule(stage);
        run.rebuild(stage, grid, camera);
    }
    else if (moves)
    {
        run.play(stage, grid, camera);
    }
    else
    {
        run.turn(std::move(stage.fixed), grid, camera, 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max)));
    }
    if (report)
    {
        report->write(jsonText(run.json()));
        report->finish();
    }
    run.tell();
}

} // namespace zvo::cli
