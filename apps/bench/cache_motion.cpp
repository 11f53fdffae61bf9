// SPDX-License-Identifier: MIT
#include "bench/cache_motion.h"

#include "bench/bench_scenes.h"
#include "bench/lit_scenes.h"
#include "bench/picture_quality.h"
#include "common/view.h"
#include "core/frame/frame_renderer.h"
#include "core/light/light_tree.h"
#include "core/path/path_tracer.h"
#include "runtime/live_scene.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr std::array<std::uint32_t, 5> kFramesAfter = {0, 4, 8, 16, 32};

// Where what moves is looked for, in frames before it stands: all that it passes while flicker is measured.
constexpr std::array<std::uint32_t, 6> kPassed = {0, 8, 16, 24, kFlickerFrames, kRunFrames};
constexpr std::uint32_t kPassedSamples = 48; // a pixel of pictures that find it
constexpr int kSmoothRadius = 2;             // pixels around, over whose mean it is looked for
constexpr std::uint32_t kPathBounces = 32;
const FrameOptions kCached = {.integrator = Integrator::Cache, .shading = Shading::Faces}; // as paths

using Values = std::vector<double>;
using Mask = std::vector<bool>;

std::optional<double> meanWhere(const Mask& mask, const Values& values)
{
    Values chosen;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        if (mask[i])
        {
            chosen.push_back(values[i]);
        }
    }
    return chosen.empty() ? std::nullopt : std::optional(meanOf(chosen));
}

double shareOf(const Mask& mask)
{
    return static_cast<double>(std::ranges::count(mask, true)) / static_cast<double>(mask.size());
}

// The mean of the pixels around each one.
HdrImage smoothed(const HdrImage& picture)
{
    HdrImage mean = picture;
    const int width = static_cast<int>(picture.width);
    const int height = static_cast<int>(picture.height);
    for (int y = 0; y < height; ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            glm::dvec3 sum(0.0);
            double count = 0;
            for (int v = std::max(y - kSmoothRadius, 0); v <= std::min(y + kSmoothRadius, height - 1); ++v)
            {
                for (int u = std::max(x - kSmoothRadius, 0); u <= std::min(x + kSmoothRadius, width - 1); ++u)
                {
                    sum += picture.texels[static_cast<std::size_t>(v * width + u)];
                    ++count;
                }
            }
            mean.texels[static_cast<std::size_t>(y * width + x)] = sum / count;
        }
    }
    return mean;
}

/// Mean and deviation of each pixel's luminance over frames.
class Flicker
{
public:
    void add(const HdrImage& picture)
    {
        const Values luminances = luminancesOf(picture);
        m_sums.resize(luminances.size());
        m_squares.resize(luminances.size());
        for (std::size_t i = 0; i < luminances.size(); ++i)
        {
            m_sums[i] += luminances[i];
            m_squares[i] += luminances[i] * luminances[i];
        }
        ++m_count;
    }

    /// The standard deviation of each pixel over its mean. Dark pixels count as in relativeErrors().
    [[nodiscard]] Values relative() const
    {
        const double least = std::max(0.01 * meanOf(m_sums) / m_count, 1e-20);
        Values deviations;
        for (std::size_t i = 0; i < m_sums.size(); ++i)
        {
            const double mean = m_sums[i] / m_count;
            const double variance = std::max(m_squares[i] / m_count - mean * mean, 0.0);
            deviations.push_back(std::sqrt(variance * m_count / (m_count - 1)) / (mean + least));
        }
        return deviations;
    }

private:
    Values m_sums;
    Values m_squares;
    double m_count = 0;
};

/// Makes pictures of one scene by one light while something moves in it, or stands.
class MotionBench
{
public:
    MotionBench(vk::HeadlessDevice& device, LiveScene& live, DeviceEnvironment& light, const TraceCamera& camera,
                const BenchCacheOptions& options)
        : m_device(device), m_live(live), m_light(light), m_camera(camera), m_options(options),
          m_stand(standingFrame(live.animated()))
    {
    }

    MotionResult measure(Progress& progress)
    {
        const auto [near, calm] = findMasks();
        MotionResult result;
        result.resolution = m_live.tree().grid.resolution();
        result.near_share = shareOf(near);
        result.calm_share = shareOf(calm);
        show(m_stand);
        const HdrImage reference = trace(m_options.reference_samples, {.bounces = kPathBounces, .seed = 1},
                                         [&](double done) { progress.within(0.2 + 0.6 * done); });
        const auto stand = [](std::uint32_t) {};
        FrameRenderer standing = tracerOf();
        result.flicker_still = meanWhere(calm, keepLight(standing, {.faces = m_options.faces}, stand));
        const HdrImage still = pictureOf(standing.samples(kCached));
        const auto errorOf = [&, &near = near](const HdrImage& picture, std::uint32_t frames)
        {
            const Values errors = relativeErrors(reference, picture);
            return MotionError{frames, meanOf(errors), meanWhere(near, errors), compareTo(reference, picture).flip,
                               meanWhere(near, relativeErrors(still, picture))};
        };
        result.still = errorOf(still, kLightFrames);
        const RadianceOptions other = {.faces = m_options.faces,
                                       .seed = 1}; // noise that has nothing to do with that of the still picture
        FrameRenderer beside = tracerOf();
        keepLight(beside, other, stand);
        result.still.lag = meanWhere(near, relativeErrors(still, pictureOf(beside.samples(kCached))));
        progress.within(0.9);
        FrameRenderer moving = tracerOf();
        const auto move = [&](std::uint32_t frame) { show(m_stand - std::min(kLightFrames - 1 - frame, kRunFrames)); };
        result.flicker_moving = meanWhere(calm, keepLight(moving, other, move));
        std::uint32_t frame = 0; // since it stands
        for (const std::uint32_t frames : kFramesAfter)
        {
            for (; frame < frames; ++frame)
            {
                addFrame(moving, other);
            }
            result.after.push_back(errorOf(pictureOf(moving.samples(kCached)), frames));
        }
        return result;
    }

private:
    // In the middle of the scene's time, after as many frames as a movement takes.
    static std::uint64_t standingFrame(const AnimatedScene& animated)
    {
        const auto count =
            static_cast<std::uint64_t>(std::max(1.0, std::round(animated.seconds * animated.frames_per_second)));
        return count / 2 + count * kRunFrames;
    }

    void show(std::uint64_t frame) { m_live.settle(frameTime(m_live.animated(), frame)); }

    FrameRenderer tracerOf()
    {
        FrameRenderer tracer(m_device.device());
        tracer.resize(m_options.width, m_options.height);
        return tracer;
    }

    void addFrame(FrameRenderer& tracer, const RadianceOptions& options)
    {
        // Each frame is a picture, as in a window where something moves.
        const FrameOptions frame = {
            .integrator = Integrator::Cache, .radiance = options, .shading = Shading::Faces}; // as paths
        tracer.beginPicture(frame);
        m_device.run(
            [&](vk::FrameGraph& graph) {
                tracer.addSample(graph, {m_live.tree(), m_camera, &m_light}, frame);
            });
    }

    // Brings light up to date. before: called before each frame. Returns the flicker of each pixel in the last frames.
    template <typename Before>
    Values keepLight(FrameRenderer& tracer, const RadianceOptions& options, const Before& before)
    {
        Flicker flicker;
        for (std::uint32_t frame = 0; frame < kLightFrames; ++frame)
        {
            before(frame);
            addFrame(tracer, options);
            if (frame >= kLightFrames - kFlickerFrames)
            {
                flicker.add(pictureOf(tracer.samples(kCached)));
            }
        }
        return flicker.relative();
    }

    template <typename Told> HdrImage trace(std::uint32_t samples, const PathOptions& options, const Told& told)
    {
        PathTracer tracer(m_device.device());
        tracer.resize(m_options.width, m_options.height);
        for (std::uint32_t i = 0; i < samples; ++i)
        {
            m_device.run([&](vk::FrameGraph& graph)
                         { tracer.addSample(graph, m_live.tree(), m_light, m_camera, options); });
            told(static_cast<double>(i + 1) / samples);
        }
        return pictureOf(tracer.picture());
    }

    // The pixels in which what moves counts where it stands or was shortly before, and those in which it never does.
    // All pictures have the same random numbers, so that only paths that it changes make a difference.
    std::pair<Mask, Mask> findMasks()
    {
        const auto smoothPicture = [&] { return smoothed(trace(kPassedSamples, {}, [](double) {})); };
        moveAway(true);
        show(m_stand);
        const HdrImage without = smoothPicture();
        moveAway(false);
        Mask near(without.texels.size(), false);
        Mask calm(without.texels.size(), true);
        for (const std::uint32_t frames : kPassed)
        {
            show(m_stand - frames);
            const Values changes = relativeErrors(without, smoothPicture());
            for (std::size_t i = 0; i < changes.size(); ++i)
            {
                near[i] = near[i] || (frames <= kLingers && changes[i] > kNearChange);
                calm[i] = calm[i] && changes[i] < kCalmChange;
            }
        }
        return {near, calm};
    }

    // Moves all objects out of the grid, or back.
    void moveAway(bool away)
    {
        const Grid& grid = m_live.tree().grid;
        for (std::size_t i = 0; i < m_live.animated().objects.size(); ++i)
        {
            m_live.setOffset(i,
                             away ? glm::dvec3(16.0 * grid.resolution() * double{grid.voxel_size}) : glm::dvec3(0.0));
        }
    }

    HdrImage pictureOf(const SampledPicture& picture)
    {
        return zvo::pictureOf(m_device.download(picture.sums), picture.width, picture.height, picture.sample_count);
    }

    vk::HeadlessDevice& m_device;
    LiveScene& m_live;
    DeviceEnvironment& m_light;
    TraceCamera m_camera;
    const BenchCacheOptions& m_options;
    std::uint64_t m_stand; // the frame of the scene's time in which what moves stands
};

} // namespace

std::vector<MovingScene> loadMovingScenes(const BenchCacheOptions& options,
                                          std::span<const std::filesystem::path> paths)
{
    std::vector<MovingScene> scenes;
    for (const std::filesystem::path& path : paths)
    {
        scenes.push_back({path.stem().stem().string(), loadSceneFile(options, path)});
        if (scenes.back().animated.objects.empty())
        {
            throw Error(ErrorCode::Input, fmt::format("{}: nothing moves in this scene", path.string()));
        }
    }
    return scenes;
}

std::size_t motionCount(const BenchCacheOptions& options, std::span<const MovingScene> scenes)
{
    return 2 * scenes.size() * (options.depths ? options.depths->size() : 1);
}

std::vector<MotionResult> measureMotion(vk::HeadlessDevice& device, const BenchCacheOptions& options,
                                        std::span<const MovingScene> scenes, std::uint32_t depth, Progress& progress)
{
    std::vector<MotionResult> results;
    for (const auto& [name, animated] : scenes)
    {
        const Bounds bounds = boundsOverTime(animated);
        for (const std::uint32_t scene_depth : options.depths.value_or(std::vector{depth}))
        {
            const Grid grid = gridOf(animated, bounds, scene_depth);
            const ViewCamera view = chooseCamera(options.camera, animated, subjectOf(bounds, grid),
                                                 static_cast<double>(options.width) / options.height);
            LiveScene live(device, AnimatedScene(animated), grid,
                           {options.coverage, options.attributes, options.structure});
            for (const bool by_day : {true, false})
            {
                if (!by_day && !hasEmission(live.tree()))
                {
                    continue;
                }
                const char* const light_name = by_day ? "day" : "night";
                progress.begin(fmt::format("{} by {}", name, light_name));
                DeviceEnvironment light = lightFor(device, name, by_day);
                MotionBench bench(device, live, light, traceCamera(view, grid, options.height), options);
                results.push_back(bench.measure(progress));
                results.back().scene = name;
                results.back().light = light_name;
            }
        }
    }
    return results;
}

} // namespace zvo::cli
