// SPDX-License-Identifier: MIT
// The numbers of a run as JSON. The names of the fields are an interface and do not change.
#pragma once

#include "common/output.h"
#include "common/scene_options.h"
#include "core/upload/lost_parts.h"
#include "runtime/trees.h"
#include "vk/device.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::cli
{

using Json = nlohmann::ordered_json;

/// What a scene has, and what of it may have no voxels.
struct SceneCounts
{
    std::uint64_t triangles = 0;                           // and points, which are counted like triangles everywhere
    std::uint64_t points = 0;                              // of these
    std::map<std::string, std::uint64_t> transparent = {}; // triangles by the names of materials that are not opaque
    std::optional<PartCount> parts = std::nullopt;         // for thin coverage

    static SceneCounts of(const Scene& scene, const Grid& grid, Coverage coverage);

    /// "12 triangles", "1 point", "12 triangles and 1 point".
    [[nodiscard]] std::string told() const;
};

/// counts as a report has them, with the dropped triangles by reason.
Json sceneJson(const SceneCounts& counts, const std::map<std::string, std::uint64_t>& dropped);

/// Name, driver, type and subgroup size.
Json deviceJson(const vk::DeviceReport& device);

/// Origin and voxel size of a grid, in the fewest digits that give the single precision numbers back bit for bit.
Json gridJson(const Grid& grid);

/// The beginning of every report: schema, version and device.
Json headJson(const std::string& schema, const vk::DeviceReport& device);

/// The same, then grid, and how it was voxelized.
Json headJson(const std::string& schema, const vk::DeviceReport& device, const VoxelOptions& options, const Grid& grid);

/// The part of the reports of `zvo render` and `zvo voxelize` about the way from triangles to the octree; trace_ms is
/// null. peak_bytes: the most device memory of the whole run.
Json octreeJson(const std::string& schema, const vk::DeviceReport& device, const VoxelOptions& options,
                const SceneCounts& counts, const BuildResult& result, const std::string& octree_sha256,
                std::uint64_t peak_bytes);

/// Each pass with its time, in order.
Json passesJson(const std::vector<vk::PassTime>& passes);

/// The sums of the times of passes with the same name, in the order in which the names first occur.
std::vector<vk::PassTime> sumByName(const std::vector<vk::PassTime>& passes);

/// The sum of the times of all passes.
double sumMs(const std::vector<vk::PassTime>& passes);

/// json as indented text with a line break at the end.
std::string jsonText(const Json& json);

/// Writes a report and completes it. Throws as Output.
void writeReport(Output& report, const Json& json);

/// As --coverage has it.
std::string_view coverageName(Coverage coverage);

} // namespace zvo::cli
