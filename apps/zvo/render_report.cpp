// SPDX-License-Identifier: MIT
#include "render_report.h"

#include "common/names.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/words.h"
#include "core/file/zvo_file.h"
#include "runtime/octree_sha256.h"

#include <fmt/format.h>

namespace zvo::cli
{

Json updateFrame(std::uint32_t number, double seconds, const LiveUpdate& update)
{
    return {{"frame", number},
            {"seconds", seconds},
            {"voxels_dynamic", update.report.dynamic_count},
            {"nodes_dynamic", update.report.node_count},
            {"dropped", update.report.dropped},
            {"dynamic_ms", sumMs(update.passes)},
            {"retries", update.retry_count}};
}

void RenderReport::addOctree(const BuildResult& result, const SceneCounts& counts)
{
    m_built = fmt::format("{} of {}^3 from {}; voxelize {:.1f} ms, build {:.1f} ms",
                          counted(result.octree.occupiedCount(), "voxel"), result.octree.grid.resolution(),
                          counts.told(), result.operationMs("voxelize"), result.operationMs("octree"));
    if (!m_options.output.json.empty())
    {
        m_json = octreeJson("zvo.render/1", m_device.device().report(), m_options.voxels, counts, result,
                            octreeSha256(m_device, result.octree), 0);
    }
}

void RenderReport::addDag(const StaticPart& part)
{
    if (!m_json.empty() && !m_json.contains("dag"))
    {
        m_json["dag"] = {{"nodes", part.info.node_count},
                         {"geometry_bytes", part.info.geometry_bytes},
                         {"compress_ms", sumMs(part.info.compress_passes)}};
    }
}

void RenderReport::addFile(const TreeData& tree)
{
    m_built = fmt::format("{} of {}^3 in {}", counted(tree.occupiedCount(), "voxel"), tree.grid.resolution(),
                          counted(tree.nodes.size(), "node"));
    m_json = headJson("zvo.render_tree/1", m_device.device().report());
    m_json["structure"] = structureName(tree.structure);
    m_json["grid"] = gridJson(tree.grid);
    m_json["resolution"] = tree.grid.resolution();
    m_json["voxels"] = tree.occupiedCount();
    m_json["nodes"] = tree.nodes.size();
    m_json["bytes"] = {{"geometry", tree.geometryBytes()}, {"attributes", tree.attributeBytes()}};
    m_json["passes"] = Json::array();
}

void RenderReport::addAnimatedScene(const LiveScene& scene, const LiveUpdate& update)
{
    const StaticInfo& part = scene.info().fixed;
    const Grid& grid = scene.tree().grid;
    const std::uint64_t triangle_count = part.triangle_count + scene.info().moving_triangle_count;
    const double voxelize_ms = operationMs(part.passes, "voxelize");
    const double build_ms = operationMs(part.passes, "octree");
    m_built = fmt::format("{} static and {} dynamic voxels of {}^3 from {}; voxelize {:.1f} ms, build {:.1f} ms, "
                          "update {:.1f} ms",
                          part.voxel_count, update.report.dynamic_count, grid.resolution(),
                          counted(triangle_count, "triangle"), voxelize_ms, build_ms, sumMs(update.passes));
    m_json = headJson("zvo.render_dynamic/1", m_device.device().report(), m_options.voxels, grid);
    m_json["merge"] = nameOf(kMergeRules, scene.animated().merge);
    m_json["scene"] = {{"triangles_static", part.triangle_count},
                       {"triangles_dynamic", scene.info().moving_triangle_count},
                       {"movers", scene.animated().objects.size()},
                       {"dropped", part.dropped}};
    m_json["voxels_static"] = part.voxel_count;
    m_json["nodes_static"] = part.node_count;
    const TreeStructure structure = m_options.structure.value_or(TreeStructure::Svo);
    m_json["structure"] = structureName(structure);
    m_json["bytes"]["geometry_static"] = part.geometry_bytes;
    m_json["passes"] = Json::array();
    for (const std::vector<vk::PassTime>* passes : {&part.passes, &part.compress_passes, &update.passes})
    {
        const Json more = passesJson(*passes);
        m_json["passes"].insert(m_json["passes"].end(), more.begin(), more.end());
    }
    m_json["voxelize_ms"] = voxelize_ms;
    m_json["build_ms"] = build_ms;
    m_json["compress_ms"] = structure == TreeStructure::Svdag ? Json(sumMs(part.compress_passes)) : Json(nullptr);
}

void RenderReport::addFrame(Json frame)
{
    frame["trace_ms"] = m_times.back().trace_ms;
    frame["shade_ms"] = m_times.back().shade_ms;
    m_frames.push_back(std::move(frame));
}

Json RenderReport::rebuiltFrame(std::uint32_t number, double seconds, const BuildResult& result,
                                std::uint64_t triangle_count) const
{
    const bool is_wanted = !m_options.output.json.empty();
    return {{"frame", number},
            {"seconds", seconds},
            {"triangles", triangle_count},
            {"voxels", result.octree.voxel_count},
            {"nodes", result.octree.node_count},
            {"octree_sha256", is_wanted ? octreeSha256(m_device, result.octree) : ""},
            {"voxelize_ms", result.operationMs("voxelize")},
            {"build_ms", result.operationMs("octree")}};
}

Json RenderReport::json(std::uint64_t capped_rays, const DeviceRadianceCache* cache) const
{
    Json json = m_json;
    double trace_ms = 0;
    double shade_ms = 0;
    for (const PictureTimes& picture : m_times)
    {
        trace_ms += picture.trace_ms / static_cast<double>(m_times.size());
        shade_ms += picture.shade_ms / static_cast<double>(m_times.size());
    }
    // Of many samples, kernels are summed up.
    const std::vector<vk::PassTime> picture =
        m_times.front().samples != 0 ? sumByName(m_times.front().passes) : m_times.front().passes;
    for (const std::vector<vk::PassTime>* passes : {&m_paths_passes, &picture})
    {
        const Json more = passesJson(*passes);
        json["passes"].insert(json["passes"].end(), more.begin(), more.end());
    }
    json["bytes"]["peak_device"] = m_device.device().memory().peakBytes();
    json["trace_ms"] = trace_ms;
    json["shade_ms"] = shade_ms;
    json["node_paths_ms"] = sumMs(m_paths_passes);
    json["capped_rays"] = capped_rays;
    json["picture"] = {{"width", m_options.width}, {"height", m_options.height}, {"count", m_times.size()}};
    if (cache != nullptr)
    {
        json["cached"] = cacheJson(*cache);
    }
    else if (m_options.frame.integrator == Integrator::Path)
    {
        json["paths"] = pathsJson();
    }
    else if (m_times.front().samples != 0)
    {
        json["primary"] = samplesJson();
    }
    if (!m_frames.empty())
    {
        json["frames"] = m_frames;
    }
    return json;
}

// What all kinds of pictures with samples have in common.
Json RenderReport::samplesJson() const
{
    const EnvironmentOptions& environment = m_options.environment;
    Json pictures = Json::array();
    bool stopped = m_options.frames && m_times.size() <= m_options.frames->second - m_options.frames->first;
    for (const PictureTimes& times : m_times)
    {
        Json picture;
        if (m_options.frames)
        {
            picture["frame"] = m_options.frames->first + pictures.size();
        }
        picture["samples"] = times.samples;
        picture["exposure"] = times.exposure ? Json(*times.exposure) : Json(nullptr);
        pictures.push_back(std::move(picture));
        stopped = stopped || times.samples < m_options.sampleCount();
    }
    return {{"samples", m_times.front().samples},
            {"samples_asked", m_options.sampleCount()},
            {"stopped", stopped},
            {"seed", m_options.frame.path.seed},
            {"environment", environment.map ? Json(environment.map->string()) : Json(nullptr)},
            {"environment_turn", environment.turn},
            {"environment_strength", environment.strength},
            {"background_blur", environment.background_blur},
            {"time_limit", m_options.time_limit ? Json(*m_options.time_limit) : Json(nullptr)},
            {"pictures", pictures}};
}

Json RenderReport::pathsJson() const
{
    const FrameOptions& frame = m_options.frame;
    const PathForm form = frame.path_form.value_or(pathFormOn(m_device.device()));
    Json json = samplesJson();
    json["bounces"] = frame.path.bounces;
    json["form"] = nameOf(kPathForms, form);
    json["aperture"] = frame.path.lens_radius;
    json["focus"] = m_times.front().focus.value_or(frame.path.focus_distance);
    json["denoise"] = frame.denoise;
    return json;
}

Json RenderReport::cacheJson(const DeviceRadianceCache& cache) const
{
    const gpu::RadianceCounters counters = m_device.download(cache.counters()).front();
    Json json = samplesJson();
    json["settle"] = m_options.settle;
    json["rays"] = m_options.frame.radiance.faces;
    json["faces"] = counters.face_count;
    json["faces_refused"] = counters.refused;
    json["room"] = cache.room();
    json["crowded"] = cache.isCrowded();
    json["bytes"] = cache.bytes();
    return json;
}

std::string RenderReport::countedSamples(std::uint32_t count) const
{
    const Integrator integrator = m_options.frame.integrator;
    return integrator == Integrator::Primary ? counted(count, "sample") + " a pixel"
           : integrator == Integrator::Path  ? counted(count, "path") + " a pixel"
                                             : counted(count, "frame");
}

void RenderReport::tell(std::uint32_t picture_count, std::uint64_t capped_rays) const
{
    if (m_times.size() < picture_count)
    {
        tellRun(fmt::format("stopped after {} of {} pictures", m_times.size(), picture_count));
    }
    if (capped_rays != 0)
    {
        talk(fmt::format("warning: {} took too many steps and {} given up", counted(capped_rays, "ray"),
                         capped_rays == 1 ? "was" : "were"));
    }
    if (m_times.front().samples != 0)
    {
        tellRun(fmt::format("{}; {} in {:.1f} ms on {}", m_built, countedSamples(m_times.front().samples),
                            m_times.front().trace_ms, m_device.device().report().name));
        return;
    }
    tellRun(fmt::format("{}; trace {:.1f} ms, light and shade {:.1f} ms on {}", m_built, m_times.front().trace_ms,
                        m_times.front().shade_ms, m_device.device().report().name));
}

} // namespace zvo::cli
