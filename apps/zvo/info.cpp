// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/output.h"
#include "common/report.h"
#include "vk/headless.h"
#include "vk/instance.h"
#include "zvo/error.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <optional>

namespace zvo::cli
{

namespace
{

constexpr double kGiB = 1 << 30;

Json devicesJson(const std::vector<vk::DeviceReport>& reports, const vk::DeviceReport* chosen)
{
    Json devices = Json::array();
    for (std::size_t i = 0; i < reports.size(); ++i)
    {
        const vk::DeviceReport& report = reports[i];
        Json device = {{"index", i}};
        device.update(deviceJson(report));
        device["api_version"] = report.api_version;
        device["memory_bytes"] = report.memory_bytes;
        device["max_buffer_bytes"] = report.max_buffer_bytes;
        device["timestamps"] = report.timestamp_valid_bits != 0 && report.timestamp_period_ns > 0;
        device["present"] = report.present;
        device["missing"] = report.missing;
        device["usable"] = report.usable();
        device["reasons"] = report.reasons;
        device["chosen"] = &report == chosen;
        devices.push_back(device);
    }
    return {{"schema", "zvo.info/1"}, {"zvo", ZVO_VERSION_TEXT}, {"devices", devices}};
}

std::string deviceText(const vk::DeviceReport& report, std::size_t index, bool chosen)
{
    std::string text = fmt::format("{} {}{}\n", index, report.name, chosen ? "  <- would be used" : "");
    const auto add = [&](const char* label, const std::string& value)
    { text += fmt::format("    {:<10}{}\n", label, value); };
    add("type", report.type);
    add("driver", report.driver);
    add("Vulkan", report.api_version);
    add("memory", fmt::format("{:.1f} GiB, buffers up to {:.1f} GiB", static_cast<double>(report.memory_bytes) / kGiB,
                              static_cast<double>(report.max_buffer_bytes) / kGiB));
    add("subgroups", fmt::format("of {} threads", report.subgroup_size));
    add("present", fmt::format("{}", fmt::join(report.present, ", ")));
    add("missing", report.missing.empty() ? "nothing" : fmt::format("{}", fmt::join(report.missing, ", ")));
    add("verdict", report.usable() ? "usable" : fmt::format("not usable: {}", fmt::join(report.reasons, ", ")));
    return text;
}

} // namespace

void info(const InfoOptions& options)
{
    const std::vector<vk::DeviceReport> reports = vk::queryAllDevices();
    const vk::DeviceReport* chosen = nullptr;
    std::optional<Error> none;
    try
    {
        chosen = &vk::chooseDevice(reports, options.device);
    }
    catch (const Error& error)
    {
        none = error;
    }
    Output output("-", true);
    if (options.json)
    {
        output.write(jsonText(devicesJson(reports, chosen)));
    }
    else
    {
        for (std::size_t i = 0; i < reports.size(); ++i)
        {
            output.write(deviceText(reports[i], i, &reports[i] == chosen));
        }
    }
    if (none)
    {
        throw Error(*none);
    }
}

} // namespace zvo::cli
