// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/ground.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/tree_input.h"
#include "common/view.h"
#include "core/base/kernels.h"
#include "core/tree/device_tree.h"
#include "io/scene/camera_path.h"
#include "pictures.h"
#include "render_report.h"
#include "renderer.h"
#include "runtime/live_scene.h"

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

using Cameras = std::vector<ViewCamera>; // one, or those of a sheet

/// The cameras of each picture.
class CameraWork
{
public:
    explicit CameraWork(const RenderOptions& options) : m_options(options)
    {
        if (options.camera_path)
        {
            m_path = readCameraPath(*options.camera_path);
        }
    }

    /// The cameras of the frame with that number. start: used if there is no path.
    [[nodiscard]] Cameras at(std::uint32_t number, double frames_per_second, const Cameras& start) const
    {
        return !m_path            ? start
               : m_options.frames ? Cameras{m_path->at(number / frames_per_second)}
                                  : Cameras{m_path->at(m_options.voxels.time.value_or(0.0))};
    }

    [[nodiscard]] bool flies() const { return m_path.has_value(); }

private:
    const RenderOptions& m_options;
    std::optional<CameraPath> m_path;
};

/// Makes the pictures of a scene, and the report.
class RenderRun
{
public:
    RenderRun(const RenderOptions& options, const CameraWork& camera_work, Pictures& pictures, Progress& progress)
        : m_options(options), m_camera_work(camera_work), m_pictures(pictures), m_progress(progress),
          m_opened(openDevice(options.device)), m_renderer(m_device, options), m_report(options, m_device)
    {
    }

    [[nodiscard]] vk::HeadlessDevice& device() { return m_device; }

    // Shows a static scene; the cameras orbit or fly.
    void turn(Scene&& scene, const Grid& grid, const Cameras& cameras, const glm::dvec3& center)
    {
        const auto report = [&](const BuildResult& built) { m_report.addOctree(built, m_counts); };
        turn(makeTree(std::move(scene), grid, report), cameras, center);
    }

    // Does the same with the tree of a file.
    void turn(TreeData&& tree, const Cameras& cameras, const glm::dvec3& center)
    {
        m_progress.begin("copying to the device");
        m_report.addFile(tree);
        const DeviceTree uploaded = uploadTree(m_device, tree);
        tree = {};
        turn(uploaded, cameras, center);
    }

    // Voxelizes the static part once, and merges dynamic objects with it at each time.
    void play(AnimatedScene&& animated, const Grid& grid, const Cameras& cameras)
    {
        m_progress.begin("voxelizing what stands still");
        m_counts = SceneCounts::of(animated.fixed, grid, m_options.voxels.coverage);
        LiveScene scene(m_device, std::move(animated), grid,
                        {.coverage = m_options.voxels.coverage,
                         .attributes = m_options.voxels.hasAttributes(),
                         .structure = structure(),
                         .fill = m_options.voxels.fill,
                         .shell = m_options.voxels.shell});
        for (std::uint32_t i = 0; goesOn(i); ++i)
        {
            m_progress.begin("updating");
            const double seconds = timeOf(scene.animated(), i);
            const LiveUpdate update = scene.updateAndWait(seconds);
            if (m_renderer.interrupted())
            {
                break;
            }
            const std::vector<vk::PassTime> paths_passes = m_renderer.show(scene.tree());
            if (i == 0)
            {
                const StaticInfo& part = scene.info().fixed;
                m_counts.triangles += scene.info().moving_triangle_count;
                warnOfDropped(part.voxel_count + update.report.dynamic_count, part.dropped, m_counts,
                              m_options.voxels.load.strict);
                warnOfOpenSurfaces(part.open, m_options.voxels.load.strict);
                m_report.addAnimatedScene(scene, update);
                m_report.addNodePaths(paths_passes);
            }
            m_has_warned = m_has_warned || warnOfDroppedTriangles(seconds, update.report.dropped);
            draw(i, m_camera_work.at(m_pictures.number(i), scene.animated().frames_per_second, cameras));
            m_report.addFrame(updateFrame(m_pictures.number(i), seconds, update));
        }
    }

    // Voxelizes everything anew at each time.
    void rebuild(const AnimatedScene& animated, const Grid& grid, const Cameras& cameras)
    {
        for (std::uint32_t i = 0; goesOn(i); ++i)
        {
            const double seconds = timeOf(animated, i);
            Json frame;
            const auto report = [&](const BuildResult& built)
            {
                if (i == 0)
                {
                    m_report.addOctree(built, m_counts);
                }
                frame = m_report.rebuiltFrame(m_pictures.number(i), seconds, built, m_counts.triangles);
            };
            const DeviceTree tree = makeTree(sceneAt(animated, seconds), grid, report);
            if (m_renderer.interrupted())
            {
                break;
            }
            const std::vector<vk::PassTime> paths_passes = m_renderer.show(tree);
            if (i == 0)
            {
                m_report.addNodePaths(paths_passes);
            }
            draw(i, m_camera_work.at(m_pictures.number(i), animated.frames_per_second, cameras));
            m_report.addFrame(std::move(frame));
        }
    }

    // Completes the pictures and the report.
    void finish(std::optional<Output>& file)
    {
        m_pictures.finish();
        if (file)
        {
            writeReport(*file, m_report.json(m_renderer.cappedRays(), m_renderer.cache()));
        }
        m_report.tell(m_pictures.count(), m_renderer.cappedRays());
    }

private:
    void turn(const DeviceTree& tree, const Cameras& cameras, const glm::dvec3& center)
    {
        m_report.addNodePaths(m_renderer.show(tree));
        for (std::uint32_t i = 0; goesOn(i); ++i)
        {
            const double turn = 2.0 * std::numbers::pi * m_pictures.number(i) / m_pictures.count();
            Cameras turned = m_camera_work.at(m_pictures.number(i), AnimatedScene().frames_per_second, cameras);
            for (ViewCamera& camera : turned)
            {
                camera = m_camera_work.flies() ? camera : camera.turnedAround(center, turn);
            }
            draw(i, turned);
        }
    }

    // Whether the index-th picture is to be made.
    [[nodiscard]] bool goesOn(std::uint32_t index) const
    {
        return index < m_pictures.count() && !m_renderer.interrupted();
    }

    [[nodiscard]] TreeStructure structure() const { return m_options.structure.value_or(TreeStructure::Svo); }

    [[nodiscard]] double timeOf(const AnimatedScene& animated, std::uint32_t index) const
    {
        return m_options.frames ? frameTime(animated, m_pictures.number(index))
                                : loopedTime(animated, m_options.voxels.time.value_or(0.0));
    }

    // Makes the tree of a scene to be traced. report is called with the octree.
    template <typename Report> DeviceTree makeTree(Scene&& scene, const Grid& grid, const Report& report)
    {
        if (m_counts.triangles == 0) // of the first scene, which is reported
        {
            m_counts = SceneCounts::of(scene, grid, m_options.voxels.coverage);
        }
        m_counts.triangles = scene.triangleCount();
        StaticListener listener;
        listener.operation = [&](std::string_view operation) { m_progress.begin(operation); };
        listener.decoded = [&](double done) { m_progress.within(done); };
        listener.warn = [](const std::string& warning) { talk(fmt::format("warning: {}", warning)); };
        listener.built = [&](const BuildResult& built)
        {
            // Only once, not for each frame.
            m_has_warned =
                m_has_warned ||
                warnOfDropped(built.octree.voxel_count, built.dropped, m_counts, m_options.voxels.load.strict) ||
                warnOfOpenSurfaces(built.open, m_options.voxels.load.strict);
            report(built);
        };
        StaticPart part;
        m_device.withPauses([this] { m_progress.goOn(); }, m_options.device.dispatch_ms,
                            [&] {
                                part = makeStaticPart(m_device, std::move(scene), grid, m_options.voxels.build(),
                                                      structure(), listener);
                            });
        if (structure() == TreeStructure::Svdag)
        {
            m_report.addDag(part);
        }
        return std::move(part.tree);
    }

    void draw(std::uint32_t index, const Cameras& cameras)
    {
        m_progress.begin("tracing");
        PictureTimes times;
        const Picture picture = m_renderer.render(cameras, m_progress, times);
        m_report.addPicture(std::move(times));
        checkValidation(m_device);
        m_pictures.write(index, picture);
    }

    const RenderOptions& m_options;
    const CameraWork& m_camera_work;
    Pictures& m_pictures;
    Progress& m_progress;
    std::shared_ptr<vk::HeadlessDevice> m_opened;
    vk::HeadlessDevice& m_device = *m_opened;
    Renderer m_renderer;
    RenderReport m_report;
    SceneCounts m_counts;      // triangles of the last voxelized scene, all else of the first one
    bool m_has_warned = false; // of dropped triangles, which may occur in every frame
};

// The cameras that options ask for, which show subject. animated: has the scene's own cameras.
Cameras chooseCameras(const RenderOptions& options, const AnimatedScene& animated, const Bounds& subject)
{
    const SheetLayout layout = layoutOf(options);
    const double aspect = static_cast<double>(layout.width) / layout.height;
    Cameras cameras;
    for (const std::string& name : options.sheet)
    {
        cameras.push_back(chooseCamera(name, animated, subject, aspect));
    }
    return cameras.empty() ? Cameras{chooseCamera(options.camera, animated, subject, aspect)} : cameras;
}

void renderTree(const RenderOptions& options, const CameraWork& camera_work, Pictures& pictures,
                std::optional<Output>& report)
{
    checkTreeOptions(options);
    Progress progress(2 + pictures.count());
    progress.begin("loading");
    RenderRun run(options, camera_work, pictures, progress);
    TreeData tree = loadTree(
        options.voxels.scenes.front(), [&run]() -> vk::HeadlessDevice& { return run.device(); },
        options.voxels.load.strict);
    if (tree.voxel_count == 0)
    {
        warnOrRefuse({"the file has no voxels"}, options.voxels.load.strict);
    }
    const Bounds subject = subjectOf(boundsOf(tree), tree.grid);
    const Cameras cameras = chooseCameras(options, AnimatedScene(), subject);
    run.turn(std::move(tree), cameras, 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max)));
    run.finish(report);
}

} // namespace

void render(const RenderOptions& options)
{
    checkIntegratorOptions(options);
    std::vector<std::filesystem::path> inputs = options.voxels.scenes;
    if (options.camera_path)
    {
        inputs.push_back(*options.camera_path);
    }
    if (options.environment.map)
    {
        inputs.push_back(*options.environment.map);
    }
    checkPaths(options.output, inputs);
    Pictures pictures(options);
    pictures.checkInputs(inputs);
    const CameraWork camera_work(options);
    std::optional<Output> report = openReport(options.output);
    if (std::ranges::any_of(options.voxels.scenes, isTreeFile))
    {
        renderTree(options, camera_work, pictures, report);
        return;
    }

    Progress progress(3 + pictures.count());
    progress.begin("loading");
    VoxelOptions voxels = options.voxels;
    if (options.camera_path)
    {
        voxels.time.reset(); // only the camera moves, so the time is its own
    }
    AnimatedScene animated = loadAnimatedSceneWithWarnings(
        voxels, (options.frames && !options.turntable) || options.voxels.time,
        options.rebuild ? ImageDecoding::WhenLoaded : ImageDecoding::WhenUploaded); // once for all frames
    const bool moves = !animated.objects.empty() && !options.turntable;
    const std::uint32_t compressions = options.structure == TreeStructure::Svdag ? 1 : 0;
    progress.expect(!moves            ? 3 + compressions + pictures.count()
                    : options.rebuild ? 1 + (3 + compressions) * pictures.count()
                                      : 2 + 2 * pictures.count());
    pictures.checkInputs(animated.files);
    const Bounds bounds = boundsOverTime(animated);
    const Grid grid = placeGrid(options.voxels, animated, bounds);
    const Bounds subject = subjectOf(animated, bounds, grid);
    const Cameras cameras = chooseCameras(options, animated, subject);
    if (options.voxels.ground)
    {
        addGround(animated, bounds, grid);
    }
    pictures.setFrameRate(animated.frames_per_second);

    RenderRun run(options, camera_work, pictures, progress);
    if (moves && options.rebuild)
    {
        warnOfMergeRule(animated);
        run.rebuild(animated, grid, cameras);
    }
    else if (moves)
    {
        run.play(std::move(animated), grid, cameras);
    }
    else
    {
        const double seconds = loopedTime(animated, options.voxels.time.value_or(0.0));
        run.turn(sceneAt(std::move(animated), seconds), grid, cameras,
                 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max)));
    }
    run.finish(report);
}

} // namespace zvo::cli
