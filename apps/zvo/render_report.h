// SPDX-License-Identifier: MIT
// The report of `zvo render` about its pictures.
#pragma once

#include "commands.h"
#include "common/report.h"
#include "core/tree/tree_data.h"
#include "io/scene/animated_scene.h"
#include "renderer.h"
#include "runtime/live_scene.h"
#include "runtime/trees.h"
#include "vk/headless.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

/// A frame of an animated scene whose dynamic objects are merged with its static part.
Json updateFrame(std::uint32_t number, double seconds, const LiveUpdate& update);

/// Collects the numbers of a run: first those of the tree, by exactly one of addOctree(), addFile() and
/// addAnimatedScene(), then those of the pictures. All arguments must outlive this object.
class RenderReport
{
public:
    RenderReport(const RenderOptions& options, vk::HeadlessDevice& device) : m_options(options), m_device(device) {}

    /// Adds the octree of the first picture, and the counts of its scene.
    void addOctree(const BuildResult& result, const SceneCounts& counts);

    /// Adds the DAG that was made of that octree. Later DAGs are not reported.
    void addDag(const StaticPart& part);

    /// Adds the tree of a file.
    void addFile(const TreeData& tree);

    /// Adds the static part of an animated scene, and its first update.
    void addAnimatedScene(const LiveScene& scene, const LiveUpdate& update);

    /// Adds the passes of the first node paths.
    void addNodePaths(std::vector<vk::PassTime> passes) { m_paths_passes = std::move(passes); }

    void addPicture(PictureTimes times) { m_times.push_back(std::move(times)); }

    /// Adds the frame of the picture that was added last.
    void addFrame(Json frame);

    /// Adds a frame of an animated scene in which everything is voxelized anew. Call it before the octree is used up.
    [[nodiscard]] Json rebuiltFrame(std::uint32_t number, double seconds, const BuildResult& result,
                                    std::uint64_t triangle_count) const;

    /// The whole report, after all pictures. cache: null for other integrators.
    [[nodiscard]] Json json(std::uint64_t capped_rays, const DeviceRadianceCache* cache) const;

    /// Tells of the run on standard error, after all pictures. picture_count: how many were asked for.
    void tell(std::uint32_t picture_count, std::uint64_t capped_rays) const;

private:
    [[nodiscard]] Json pathsJson() const;
    [[nodiscard]] Json cacheJson(const DeviceRadianceCache& cache) const;
    [[nodiscard]] Json samplesJson() const;
    [[nodiscard]] std::string countedSamples(std::uint32_t count) const;

    const RenderOptions& m_options;
    vk::HeadlessDevice& m_device;
    std::vector<vk::PassTime> m_paths_passes;
    std::vector<PictureTimes> m_times;
    std::string m_built;
    Json m_json;
    Json m_frames = Json::array();
};

} // namespace zvo::cli
