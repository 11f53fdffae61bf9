// SPDX-License-Identifier: MIT
// A mesh moves in a circle through a grid of 64^3, for many periods. Frames must equal a full rebuild, and the same
// frame of other periods. Memory must not grow after the first periods. Ends with 1 if anything differs.
//
//   zvo_dynamic_soak [--frames N]
#include "core/base/kernels.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/scene/animation.h"
#include "runtime/trees.h"
#include "stress/program.h"
#include "support/device.h"
#include "support/materials_scene.h"
#include "support/octree_contents.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace zvo::stress
{
namespace
{

constexpr float kExtent = 16.0F;
constexpr std::uint32_t kDepth = 6;
constexpr std::uint64_t kPeriod = 50;
constexpr std::uint64_t kWarmUp = 4 * kPeriod; // frames after which memory must not grow
constexpr std::uint32_t kFramesInFlight = 2;
constexpr std::uint64_t kHostSlackBytes = 64 << 20; // validation layers keep 300 bytes a frame

using Cells = std::vector<test::Cell>;

// Bytes of this process in physical memory.
std::uint64_t residentBytes()
{
    std::uint64_t pages = 0;
    std::uint64_t resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

// A circle around the middle, up and down, with a rotation. A part of it lies outside of the grid.
glm::dmat4 transformAt(std::uint64_t frame)
{
    const double angle = glm::two_pi<double>() * static_cast<double>(frame % kPeriod) / kPeriod;
    const double middle = 0.4 * kExtent;
    const glm::dvec3 place(middle + 0.6 * kExtent * std::cos(angle), middle + 0.3 * kExtent * std::sin(2 * angle),
                           middle + 0.5 * kExtent * std::sin(angle));
    return glm::rotate(glm::translate(glm::dmat4(1.0), place), angle, glm::dvec3(0.3, 0.8, -0.5));
}

class Soak
{
public:
    Soak()
        : m_device(test::sharedDevice(zvoKernels())), m_fixed(test::materialsScene(kExtent, 8, 17)),
          m_moving(test::materialsScene(kExtent / 3, 12, 31))
    {
        m_scale = std::max(brightestEmission(m_fixed), brightestEmission(m_moving));
        DynamicOptions options;
        options.merge = MergeRule::Average;
        options.frames_in_flight = kFramesInFlight;
        options.history = {3, UINT64_MAX};
        options.emission_scale = m_scale;
        m_octree = std::make_unique<DynamicOctree>(m_device, build(m_fixed, true).octree, options);
        m_object =
            m_octree->add(uploadDynamicMesh(m_device, m_moving, true, m_scale), poseAt(m_moving, 0, transformAt(0)));
    }

    void run(std::uint64_t frame_count)
    {
        for (std::uint64_t frame = 0; frame < frame_count; ++frame)
        {
            submit(frame);
            // In every other period all frames are waited for and compared, in the others only the last one.
            if (frame / kPeriod % 2 == 0 || frame % kPeriod == kPeriod - 1 || frame == frame_count - 1)
            {
                settle();
                compare(frame);
                watchMemory(frame);
            }
        }
    }

    [[nodiscard]] std::uint64_t comparedCount() const { return m_compared_count; }
    [[nodiscard]] std::uint64_t failedCount() const { return m_failed_count; }
    [[nodiscard]] std::uint64_t peakBytes() const { return m_device.device().memory().peakBytes(); }
    [[nodiscard]] std::uint64_t warmResident() const { return m_resident; }

private:
    struct Flight
    {
        std::uint64_t frame;
        vk::Submission submission;
    };

    [[nodiscard]] BuildResult build(const Scene& scene, bool keep_sums) const
    {
        BuildOptions options;
        options.keep_sums = keep_sums;
        const Grid grid = {
            .origin = glm::vec3(0.0F), .voxel_size = kExtent / static_cast<float>(1U << kDepth), .depth = kDepth};
        return buildOctree(m_device, uploadScene(m_device, scene, true, m_scale), grid, options);
    }

    void submit(std::uint64_t frame)
    {
        if (m_flights.size() == kFramesInFlight)
        {
            waitForOldest();
        }
        m_octree->setPose(m_object, poseAt(m_moving, 0, transformAt(frame)));
        const std::uint64_t number = m_octree->beginFrame();
        m_flights.push_back({number, m_device.submit(
                                         [&](vk::FrameGraph& graph)
                                         {
                                             m_octree->update(graph);
                                             graph.releaseToHost();
                                         })});
    }

    void waitForOldest()
    {
        const std::vector<vk::PassTime> passes = m_flights.front().submission.wait();
        for (const UpdateReport& report : m_octree->frameDone(m_flights.front().frame, passes))
        {
            m_failed_count += report.failed != 0 ? 1 : 0;
        }
        m_flights.pop_front();
    }

    // Waits until the dynamic objects of the last frame are shown.
    void settle()
    {
        for (int attempt = 0; attempt < 64; ++attempt)
        {
            while (!m_flights.empty())
            {
                waitForOldest();
            }
            if (!m_octree->needsUpdate())
            {
                return;
            }
            const std::uint64_t number = m_octree->beginFrame();
            m_device.run([&](vk::FrameGraph& graph) { m_octree->update(graph); });
            m_octree->frameDone(number);
        }
        throw std::runtime_error("no update succeeded");
    }

    void compare(std::uint64_t frame)
    {
        Cells cells = test::cellsOf(m_device, m_octree->tree());
        if (frame < kPeriod)
        {
            Scene all = m_fixed;
            Scene moved = posedScene(m_moving, poseAt(m_moving, 0, transformAt(frame)));
            all.append(std::move(moved));
            expectSame(frame, cells, test::cellsOf(m_device, build(all, false).octree), "a rebuild");
            m_period.push_back(std::move(cells));
        }
        else
        {
            expectSame(frame, cells, m_period[frame % kPeriod], "the first period");
        }
        ++m_compared_count;
    }

    static void expectSame(std::uint64_t frame, const Cells& cells, const Cells& expected, const char* what)
    {
        const std::string difference = test::difference(cells, expected);
        if (!difference.empty())
        {
            throw std::runtime_error(fmt::format("frame {} differs from {}: {}", frame, what, difference));
        }
    }

    void watchMemory(std::uint64_t frame)
    {
        const vk::MemoryAllocator& memory = m_device.device().memory();
        if (frame < kWarmUp)
        {
            m_held = memory.heldBytes();
            m_peak = memory.peakBytes();
            m_resident = residentBytes();
            return;
        }
        const bool grew = memory.heldBytes() > m_held || memory.peakBytes() > m_peak ||
                          residentBytes() > m_resident + kHostSlackBytes;
        if (grew)
        {
            throw std::runtime_error(fmt::format(
                "frame {}: memory grew: {} bytes held instead of {}, at most {} in use instead of {}, {} resident "
                "instead of {}",
                frame, memory.heldBytes(), m_held, memory.peakBytes(), m_peak, residentBytes(), m_resident));
        }
    }

    vk::HeadlessDevice& m_device;
    Scene m_fixed;
    Scene m_moving;
    float m_scale = 0;
    std::unique_ptr<DynamicOctree> m_octree;
    DynamicObjectId m_object = 0;
    std::deque<Flight> m_flights;
    std::vector<Cells> m_period; // contents of the frames of the first period
    std::uint64_t m_compared_count = 0;
    std::uint64_t m_failed_count = 0; // updates that found no room
    std::uint64_t m_held = 0;         // after the warm-up
    std::uint64_t m_peak = 0;
    std::uint64_t m_resident = 0;
};

bool run(std::uint64_t frame_count)
{
    const auto start = std::chrono::steady_clock::now();
    Soak soak;
    soak.run(frame_count);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    fmt::print("{} frames in {:.1f} s, {} compared, {} without room; {} KiB of the device's memory at most, {} KiB "
               "resident after the first periods and {} KiB in the end\n",
               frame_count, seconds.count(), soak.comparedCount(), soak.failedCount(), soak.peakBytes() >> 10,
               soak.warmResident() >> 10, residentBytes() >> 10);
    return true;
}

} // namespace

} // namespace zvo::stress

int main(int argc, char** argv)
{
    std::uint64_t frame_count = 100'000;
    CLI::App app("A mesh that moves for a long time");
    app.add_option("--frames", frame_count, "how many frames")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return zvo::stress::runProgram("zvo_dynamic_soak", [&] { return zvo::stress::run(frame_count); });
}
