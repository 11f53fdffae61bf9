// SPDX-License-Identifier: MIT
#include "bench/bench_report.h"

#include "bench/table.h"
#include "common/output.h"
#include "core/base/read_file.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr std::size_t kSlowestPasses = 12; // of each row

// The number of a field: itself, the median of several runs, or the greatest of a range. Nothing if there is none.
std::optional<double> numberOf(const Json& row, const std::string& field)
{
    const auto value = row.find(field);
    if (value == row.end())
    {
        return std::nullopt;
    }
    if (value->is_number())
    {
        return value->get<double>();
    }
    for (const char* const part : {"median", "max"})
    {
        if (value->is_object() && value->contains(part))
        {
            return value->at(part).get<double>();
        }
    }
    return std::nullopt;
}

std::string reportScene(const Json& row)
{
    return fmt::format("{} at {}", row.value("scene", "?"), row.value("resolution", 0));
}

// The least of a target's sums of fields in a row; nothing if each lacks a field.
std::optional<double> leastSum(const Json& sums, const Json& row)
{
    std::optional<double> least;
    for (const Json& fields : sums)
    {
        std::optional<double> sum = 0.0;
        for (const Json& field : fields)
        {
            const std::optional<double> number = numberOf(row, field.get<std::string>());
            sum = sum && number ? std::optional(*sum + *number) : std::nullopt;
        }
        if (sum && (!least || *sum < *least))
        {
            least = sum;
        }
    }
    return least;
}

std::optional<double> measured(const Json& target, const std::vector<Json>& reports)
{
    for (const Json& report : reports)
    {
        if (report.at("schema") != target.at("schema"))
        {
            continue;
        }
        for (const Json& row : report.at("rows"))
        {
            const bool fits = row.at("scene") == target.at("scene") && row.at("resolution") == target.at("resolution");
            const std::optional<double> sum = fits ? leastSum(target.at("sums"), row) : std::nullopt;
            if (sum)
            {
                return sum;
            }
        }
    }
    return std::nullopt;
}

// A target or none as text.
std::string amount(const Json& target, const char* field)
{
    const Json& value = target.at(field);
    return value.is_null()     ? "-"
           : value.is_string() ? value.get<std::string>()
                               : fmt::format("{:g}", value.get<double>());
}

// What a measured figure means. Less is better in all targets; some works have published figures alone.
std::string verdict(const Json& target, std::optional<double> figure)
{
    if (!figure)
    {
        return "not measured";
    }
    for (const auto& [field, text] : {std::pair("moonshot", "moonshot reached"), std::pair("reach", "reached")})
    {
        if (target.at(field).is_number() && *figure <= target.at(field).get<double>())
        {
            return text;
        }
    }
    for (const auto& [field, text] : {std::pair("reach", "target"), std::pair("moonshot", "moonshot")})
    {
        if (target.at(field).is_number())
        {
            return fmt::format("{:.2f} times the {}", *figure / target.at(field).get<double>(), text);
        }
    }
    return "no target";
}

struct TargetLine
{
    const Json& target;
    std::optional<double> figure;
};

const Columns<TargetLine>& targetColumns()
{
    const auto field = [](const char* name)
    { return [name](const TargetLine& line) { return amount(line.target, name); }; };
    static const Columns<TargetLine> all = {
        {"work", 44, [](const TargetLine& line) { return line.target.at("work").get<std::string>(); }},
        {"unit", 11, field("unit")},
        {"published", 40, field("published")},
        {"floor", 10, field("floor")},
        {"must reach", 10, field("reach")},
        {"moonshot", 8, field("moonshot")},
        {"measured", 9, [](const TargetLine& line) { return line.figure ? fmt::format("{:.3f}", *line.figure) : "-"; }},
        {"which is", 22, [](const TargetLine& line) { return verdict(line.target, line.figure); }},
    };
    return all;
}

struct CostLine
{
    std::string pass;
    double ms = 0;
    double share = 0;
    std::array<std::optional<double>, 4> ns; // for each triangle, voxel, node and ray
};

const Columns<CostLine>& costColumns()
{
    const auto ns = [](std::size_t element)
    {
        return [element](const CostLine& line)
        { return line.ns[element] ? fmt::format("{:.4g}", *line.ns[element]) : std::string("-"); };
    };
    static const Columns<CostLine> all = {
        {"pass", 28, [](const CostLine& line) { return line.pass; }},
        {"ms", 9, [](const CostLine& line) { return fmt::format("{:.4f}", line.ms); }},
        {"share", 6, [](const CostLine& line) { return fmt::format("{:.1f}%", 100 * line.share); }},
        {"ns a triangle", 13, ns(0)},
        {"ns a voxel", 10, ns(1)},
        {"ns a node", 9, ns(2)},
        {"ns a ray", 8, ns(3)},
    };
    return all;
}

// Whether a pass belongs to pictures: its cost depends on rays, not on what the tree is made of.
bool isOfRays(const std::string& pass)
{
    constexpr std::string_view kParts[] = {"trace/", "live tiles", "trace args", "trace status"};
    return std::ranges::any_of(kParts, [&](std::string_view part) { return pass.find(part) != std::string::npos; });
}

// Milliseconds as nanoseconds for each of count elements.
std::optional<double> nsEach(double ms, std::optional<double> count)
{
    return count && *count > 0 ? std::optional(1e6 * ms / *count) : std::nullopt;
}

// A row's number of elements: in all, or of what moves.
std::optional<double> elementsOf(const Json& row, const std::string& elements)
{
    const std::optional<double> all = numberOf(row, elements);
    return all ? all : numberOf(row, elements + "_dynamic");
}

std::vector<CostLine> costsOf(const Json& row)
{
    std::vector<CostLine> lines;
    double sum = 0;
    for (const Json& pass : row.value("passes", Json::array()))
    {
        CostLine line = {pass.at("name").get<std::string>(), pass.at("ms").get<double>(), 0, {}};
        if (isOfRays(line.pass))
        {
            line.ns[3] = nsEach(line.ms, numberOf(row, "rays"));
        }
        else
        {
            line.ns = {nsEach(line.ms, elementsOf(row, "triangles")), nsEach(line.ms, elementsOf(row, "voxels")),
                       nsEach(line.ms, elementsOf(row, "nodes")), std::nullopt};
        }
        sum += line.ms;
        lines.push_back(std::move(line));
    }
    for (CostLine& line : lines)
    {
        line.share = sum > 0 ? line.ms / sum : 0.0;
    }
    return lines;
}

// A file with an object of JSON whose schema begins with the given text.
Json readJson(const std::filesystem::path& path, std::string_view schema)
{
    const std::vector<std::uint8_t> bytes = readFile(path);
    Json json = Json::parse(bytes, nullptr, false);
    if (!json.is_object() || !json.value("schema", "").starts_with(schema))
    {
        throw Error(ErrorCode::Input, fmt::format("{} is no JSON with the schema {}", path.string(), schema));
    }
    return json;
}

} // namespace

std::string targetTable(const Json& targets, const std::vector<Json>& reports)
{
    try
    {
        std::string table = columnNames(targetColumns());
        for (const Json& target : targets.at("targets"))
        {
            table += columnValues(targetColumns(), TargetLine{target, measured(target, reports)});
        }
        return table;
    }
    catch (const Json::exception& error)
    {
        throw Error(ErrorCode::Input,
                    fmt::format("targets or reports are not what zvo-bench writes: {}", error.what()));
    }
}

std::string slowestPasses(const Json& row, std::size_t row_count)
{
    try
    {
        std::vector<CostLine> lines = costsOf(row);
        if (lines.empty())
        {
            return "";
        }
        std::ranges::stable_sort(lines, std::ranges::greater(), &CostLine::ms);
        lines.resize(std::min(lines.size(), row_count));
        std::string table = columnNames(costColumns());
        for (const CostLine& line : lines)
        {
            table += columnValues(costColumns(), line);
        }
        return table;
    }
    catch (const Json::exception& error)
    {
        throw Error(ErrorCode::Input, fmt::format("a report is not what zvo-bench writes: {}", error.what()));
    }
}

void benchReport(const BenchReportOptions& options)
{
    std::vector<Json> reports;
    for (const std::filesystem::path& path : options.reports)
    {
        reports.push_back(readJson(path, "zvo.bench"));
    }
    Output output("-", true);
    if (options.targets)
    {
        const Json targets = readJson(*options.targets, "zvo.targets/1");
        output.write(fmt::format("## Figures beside targets\nTargets for: {}.\n\n{}\n", targets.value("device", "?"),
                                 targetTable(targets, reports)));
    }
    output.write("## Slowest passes\n");
    for (const Json& report : reports)
    {
        for (const Json& row : report.value("rows", Json::array()))
        {
            const std::string table = slowestPasses(row, kSlowestPasses);
            if (!table.empty())
            {
                output.write(fmt::format("\n{}:\n\n{}", reportScene(row), table));
            }
        }
    }
}

} // namespace zvo::cli
