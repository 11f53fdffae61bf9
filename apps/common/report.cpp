// SPDX-License-Identifier: MIT
#include "common/report.h"

#include "common/names.h"
#include "common/words.h"
#include "zvo/version.h"

#include <algorithm>
#include <numeric>

namespace zvo::cli
{

SceneCounts SceneCounts::of(const Scene& scene, const Grid& grid, Coverage coverage)
{
    SceneCounts counts;
    counts.triangles = scene.triangleCount();
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        const Material& material = scene.materials[primitive.material];
        counts.points += primitive.is_points ? primitive.triangles.size() : 0;
        if (material.alpha_mode != AlphaMode::Opaque)
        {
            counts.transparent[material.name] += primitive.triangles.size();
        }
    }
    if (coverage == Coverage::Thin)
    {
        counts.parts = countParts(scene, grid);
    }
    return counts;
}

std::string SceneCounts::told() const
{
    const std::string cloud = counted(points, "point");
    const std::string mesh = counted(triangles - std::min(points, triangles), "triangle");
    return points == 0 ? mesh : points < triangles ? mesh + " and " + cloud : cloud;
}

Json sceneJson(const SceneCounts& counts, const std::map<std::string, std::uint64_t>& dropped)
{
    Json json = {{"triangles", counts.triangles},
                 {"points", counts.points},
                 {"dropped", dropped},
                 {"transparent", counts.transparent}};
    if (counts.parts)
    {
        json["parts"] = counts.parts->parts;
        json["parts_without_voxels"] = counts.parts->lost;
    }
    return json;
}

Json deviceJson(const vk::DeviceReport& device)
{
    return {{"name", device.name},
            {"driver", device.driver},
            {"type", device.type},
            {"subgroup_size", device.subgroup_size}};
}

Json gridJson(const Grid& grid)
{
    return {{"origin", {double{grid.origin.x}, double{grid.origin.y}, double{grid.origin.z}}},
            {"voxel_size", double{grid.voxel_size}},
            {"depth", grid.depth}};
}

Json headJson(const std::string& schema, const vk::DeviceReport& device)
{
    return {{"schema", schema}, {"zvo", ZVO_VERSION_TEXT}, {"device", deviceJson(device)}};
}

Json headJson(const std::string& schema, const vk::DeviceReport& device, const VoxelOptions& options, const Grid& grid)
{
    Json json = headJson(schema, device);
    json["grid"] = gridJson(grid);
    json["resolution"] = grid.resolution();
    json["coverage"] = coverageName(options.coverage);
    json["fill"] = nameOf(kFills, options.fill);
    json["shell"] = nameOf(kShells, options.shell);
    json["attributes"] = options.hasAttributes() ? "full" : "none";
    json["snapping"] = "lattice256";
    return json;
}

Json octreeJson(const std::string& schema, const vk::DeviceReport& device, const VoxelOptions& options,
                const SceneCounts& counts, const BuildResult& result, const std::string& octree_sha256,
                std::uint64_t peak_bytes)
{
    const DeviceTree& octree = result.octree;
    const Grid& grid = octree.grid;
    Json json = headJson(schema, device, options, grid);
    json["scene"] = sceneJson(counts, result.dropped);
    json["voxels"] = octree.occupiedCount();
    json["interior_voxels"] = octree.interior_count;
    json["bricks"] = octree.levels.empty() ? 0U : octree.levels.back().node_count;
    json["nodes"] = octree.node_count;
    json["bytes"] = {
        {"geometry", octree.geometryBytes()}, {"attributes", octree.attributeBytes()}, {"peak_device", peak_bytes}};
    json["octree_sha256"] = octree_sha256;
    json["cold_run"] = true; // times include what a device does only at first
    json["retries"] = result.retry_count;
    json["passes"] = passesJson(result.passes);
    json["voxelize_ms"] = result.operationMs("voxelize");
    json["build_ms"] = result.operationMs("octree");
    json["trace_ms"] = nullptr;
    return json;
}

Json passesJson(const std::vector<vk::PassTime>& passes)
{
    Json json = Json::array();
    for (const vk::PassTime& pass : passes)
    {
        json.push_back({{"name", pass.name}, {"ms", pass.ms}});
    }
    return json;
}

std::vector<vk::PassTime> sumByName(const std::vector<vk::PassTime>& passes)
{
    std::vector<vk::PassTime> sums;
    for (const vk::PassTime& pass : passes)
    {
        const auto known =
            std::find_if(sums.begin(), sums.end(), [&](const auto& sum) { return sum.name == pass.name; });
        if (known == sums.end())
        {
            sums.push_back(pass);
        }
        else
        {
            known->ms += pass.ms;
        }
    }
    return sums;
}

double sumMs(const std::vector<vk::PassTime>& passes)
{
    return std::accumulate(passes.begin(), passes.end(), 0.0,
                           [](double sum, const vk::PassTime& pass) { return sum + pass.ms; });
}

std::string jsonText(const Json& json)
{
    // Strings from drivers and files need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeReport(Output& report, const Json& json)
{
    report.write(jsonText(json));
    report.finish();
}

std::string_view coverageName(Coverage coverage)
{
    return nameOf(kCoverages, coverage);
}

} // namespace zvo::cli
