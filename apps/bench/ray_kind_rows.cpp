// SPDX-License-Identifier: MIT
#include "bench/ray_kind_rows.h"

#include "bench/table.h"

#include <fmt/format.h>

namespace zvo::cli
{

namespace
{

using Row = RayKindRow;

std::string numberOr(const std::optional<double>& value)
{
    return value ? fmt::format("{:.1f}", *value) : "-";
}

std::string bytesOf(const std::optional<RaysInTree>& tree)
{
    return tree ? fmt::format("{:.0f} / {:.0f} / {:.1f}", tree->bytes, tree->warp_bytes, tree->load_sectors) : "-";
}

const Columns<Row>& kindColumns()
{
    static const Columns<Row> all = {
        {"rays", 8, [](const Row& row) { return row.kind; }},
        {"million", 7, [](const Row& row) { return fmt::format("{:.2f}", static_cast<double>(row.rays) / 1e6); }},
        {"hits %", 6,
         [](const Row& row)
         { return fmt::format("{:.0f}", 100.0 * static_cast<double>(row.hits) / static_cast<double>(row.rays)); }},
        {"iterations", 10, [](const Row& row) { return numberOr(row.iterations); }},
        {"longest", 7, [](const Row& row) { return fmt::format("{:.2f}", row.longest); }},
        {"Mrays/s", 7, [](const Row& row) { return numberOr(row.octree.mrays_per_s); }},
        {"bytes", 16, [](const Row& row) { return bytesOf(row.octree); }},
        {"DAG", 7,
         [](const Row& row) { return numberOr(row.dag ? std::optional(row.dag->mrays_per_s) : std::nullopt); }},
        {"bytes", 16, [](const Row& row) { return bytesOf(row.dag); }},
        {"Embree", 6, [](const Row& row) { return numberOr(row.embree_mrays_per_s); }},
    };
    return all;
}

Json treeJson(const RaysInTree& tree)
{
    return {{"mrays_per_s", tree.mrays_per_s},
            {"bytes", tree.bytes},
            {"warp_bytes", tree.warp_bytes},
            {"load_sectors", tree.load_sectors}};
}

} // namespace

std::string rayKindTable(const std::string& scene, std::uint32_t resolution, const std::vector<Row>& rows)
{
    std::string table = fmt::format(
        "\n{}, {}: rays from the root, million a second. Longest ray of a warp of 32, over the mean. Bytes, in sectors "
        "of 32: of a ray / a ray's share of its warp's / and sectors of a load of the warp.\n\n{}",
        scene, resolution, columnNames(kindColumns()));
    for (const Row& row : rows)
    {
        table += columnValues(kindColumns(), row);
    }
    return table;
}

Json rayKindsJson(const std::vector<Row>& rows)
{
    Json json = nullptr;
    for (const Row& row : rows)
    {
        json.push_back({{"kind", row.kind},
                        {"rays", row.rays},
                        {"hits", row.hits},
                        {"iterations", row.iterations},
                        {"longest_of_warp", row.longest},
                        {"octree", treeJson(row.octree)},
                        {"dag", row.dag ? treeJson(*row.dag) : Json(nullptr)},
                        {"embree_mrays_per_s", row.embree_mrays_per_s ? Json(*row.embree_mrays_per_s) : Json(nullptr)},
                        {"embree_hits", row.embree_hits ? Json(*row.embree_hits) : Json(nullptr)}});
    }
    return json;
}

} // namespace zvo::cli
