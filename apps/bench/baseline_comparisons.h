// SPDX-License-Identifier: MIT
// The comparisons of `zvo-bench baselines`: each measures the algorithms of one source beside zvo's on a subject, and
// throws Error{Usage} or Error{Memory} where they cannot take it.
#pragma once

#include "bench/baseline_rows.h"
#include "bench/bench_options.h"
#include "bench/bench_trace.h"
#include "core/base/grid.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/tree_tracer.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "core/upload/gpu_scene.h"
#include "io/scene/animated_scene.h"
#include "runtime/trees.h"
#include "vk/headless.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace zvo::cli
{

// The picture's size in the thesis.
inline constexpr std::uint32_t kBaselineWidth = 1280;
inline constexpr std::uint32_t kBaselineHeight = 720;

/// A scene in a grid, and zvo's side of the comparisons.
class BaselineSubject
{
public:
    /// Builds the octree. scene: what stands still; uploaded: the same in device memory. All references must outlive
    /// this object.
    BaselineSubject(const BenchBaselinesOptions& options, vk::HeadlessDevice& device, std::string name,
                    const Scene& scene, const GpuScene& uploaded, const Grid& grid, const ViewCamera& camera);

    /// Milliseconds of the device for the parts of a build.
    double buildMs(bool voxelize, bool build);

    /// The same for voxelization, construction and compression to a DAG.
    double dagMs();

    /// The same for the construction of an octree without attributes.
    double geometryBuildMs();

    /// What traces a picture by zvo's beam and primary passes. Node paths are made once for an octree, before.
    std::function<double()> rays();

    void measure(BaselineRows& rows, const BaselineWork& work) const
    {
        rows.measure(m_case, work, m_options.run_count);
    }
    void addSize(BaselineRows& rows, const char* form, std::uint64_t nodes, std::uint64_t bytes) const
    {
        rows.sizes.push_back({m_case, form, nodes, bytes});
    }

    [[nodiscard]] const BenchBaselinesOptions& options() const { return m_options; }
    [[nodiscard]] vk::HeadlessDevice& device() const { return m_device; }
    [[nodiscard]] const BaselineCase& what() const { return m_case; }
    [[nodiscard]] const Scene& scene() const { return m_scene; }
    [[nodiscard]] const GpuScene& uploaded() const { return m_uploaded; }
    [[nodiscard]] const Grid& grid() const { return m_octree.grid; }
    [[nodiscard]] const TraceCamera& camera() const { return m_camera; }
    [[nodiscard]] const DeviceTree& octree() const { return m_octree; }

private:
    const BenchBaselinesOptions& m_options;
    vk::HeadlessDevice& m_device;
    const Scene& m_scene;
    const GpuScene& m_uploaded;
    BuildOptions m_build;
    BuildOptions m_geometry_build;
    TraceCamera m_camera;
    DeviceTree m_octree;
    BaselineCase m_case;
    std::optional<TreeTracer> m_tracer;
    std::optional<PrimaryRays> m_rays;
};

/// The octree of the subject's scene without attributes.
TreeData geometryOf(const BaselineSubject& subject);

/// The thesis: voxelization, construction, rays; with and without its bounds by Morton codes.
void compareThesis(BaselineSubject& subject, BaselineRows& rows);

/// The thesis's update, of the octree of the subject's scene by the objects of animated, and rays through the result.
void compareThesisUpdate(BaselineSubject& subject, const AnimatedScene& animated, BaselineRows& rows);

/// The top-down construction of Crassin and Green.
void compareCrassinGreen(BaselineSubject& subject, BaselineRows& rows);

/// The slides: voxelization and construction, of an octree and of a DAG, and rays in all forms.
void compareSlides(BaselineSubject& subject, BaselineRows& rows);

/// Programs on the host: Embree where it is there, cell by cell through a bit grid, a DAG by a hash table.
void compareHost(BaselineSubject& subject, BaselineRows& rows);

/// zvo's octree with nodes in the order of Morton and of Hilbert, and shuffled: rays, and updates where animated has
/// dynamic objects.
void compareOrders(BaselineSubject& subject, const AnimatedScene* animated, BaselineRows& rows);

} // namespace zvo::cli
