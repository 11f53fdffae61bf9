// SPDX-License-Identifier: MIT
// What `zvo render` tells of its pictures.
#pragma once

#include "common/report.h"
#include "core/headless/pipeline.h"
#include "core/tree/tree_data.h"
#include "io/scene/animated_scene.h"
#include "options.h"
#include "renderer.h"
#include "runtime/live_scene.h"
#include "vk/headless.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

/// A frame of an animated scene in which what moves is merged with what stands still.
Json updateFrame(std::uint32_t number, double seconds, const LiveUpdate& update);

/// Gathers what there is to tell: first what was made, by exactly one of addOctree(), addFile() and addAnimatedScene(),
/// then the pictures of it. What is given must outlive this.
class RenderReport
{
public:
    RenderReport(const RenderOptions& options, vk::HeadlessDevice& device) : m_options(options), m_device(device) {}

    /// The octree of the first picture, and how many triangles it was made of.
    void addOctree(const BuildResult& result, std::uint64_t triangle_count);

    /// The DAG that was made of it; later ones are not told of.
    void addDag(const StaticPart& part);

    /// What a file holds.
    void addFile(const TreeData& tree);

    /// What stands still, and the first update.
    void addAnimatedScene(const LiveScene& scene, const LiveUpdate& update);

    /// The passes of the first beam grid.
    void addBeam(std::vector<vk::PassTime> passes) { m_beam_passes = std::move(passes); }

    void addPicture(PictureTimes times) { m_times.push_back(std::move(times)); }

    /// A frame, whose picture was added last.
    void addFrame(Json frame);

    /// A frame of an animated scene in which everything is voxelized anew; before the octree is used up.
    [[nodiscard]] Json rebuiltFrame(std::uint32_t number, double seconds, const BuildResult& result,
                                    std::uint64_t triangle_count) const;

    /// All of it, after all pictures.
    [[nodiscard]] Json json(std::uint32_t picture_count, std::uint64_t capped_rays) const;

    /// On one line on standard error, after all pictures.
    void tell(std::uint64_t capped_rays) const;

private:
    const RenderOptions& m_options;
    vk::HeadlessDevice& m_device;
    std::vector<vk::PassTime> m_beam_passes;
    std::vector<PictureTimes> m_times;
    std::string m_built;
    Json m_json;
    Json m_frames = Json::array();
};

} // namespace zvo::cli
