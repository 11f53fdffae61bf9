// SPDX-License-Identifier: MIT
#include "common/parse.h"

#include "core/scene/sky.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <system_error>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kFrameMax = 999999;

Error valueError(std::string_view option, std::string_view text, std::string_view expected)
{
    return {ErrorCode::Usage, fmt::format("{} {}: expected {}", option, text, expected)};
}

// All of text as a number, or nothing.
template <typename T> std::optional<T> number(std::string_view text)
{
    T value{};
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    return failure == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

// A finite number that is allowed.
template <typename T, typename Allowed>
T parseNumber(std::string_view option, std::string_view text, const Allowed& isAllowed, std::string_view expected)
{
    const auto value = number<T>(text);
    if (!value || !std::isfinite(*value) || !isAllowed(*value))
    {
        throw valueError(option, text, expected);
    }
    return *value;
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    for (;;)
    {
        const std::size_t at = text.find(separator);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos)
        {
            return parts;
        }
        text.remove_prefix(at + 1);
    }
}

} // namespace

std::uint64_t parseInteger(std::string_view option, std::string_view text, std::uint64_t low, std::uint64_t high)
{
    const auto value = number<std::uint64_t>(text);
    if (!value || *value < low || *value > high)
    {
        throw valueError(option, text, fmt::format("a whole number from {} to {}", low, high));
    }
    return *value;
}

float parsePositive(std::string_view option, std::string_view text)
{
    return parseNumber<float>(
        option, text, [](float value) { return value > 0.0F; }, "a finite number above 0");
}

double parseSeconds(std::string_view option, std::string_view text)
{
    return parseNumber<double>(
        option, text, [](double value) { return value >= 0; }, "a number of seconds from 0 on");
}

double parseDegrees(std::string_view option, std::string_view text)
{
    return parseNumber<double>(
        option, text, [](double) { return true; }, "a number of degrees");
}

float parseBlur(std::string_view option, std::string_view text)
{
    return parseNumber<float>(
        option, text, [](float value) { return value > 0.0F && value <= 90.0F; }, "degrees above 0 and at most 90");
}

glm::dvec3 parseTimeOfDay(std::string_view option, std::string_view text)
{
    constexpr std::uint32_t kHours = 24;
    constexpr std::uint32_t kMinutes = 60;
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::uint32_t hour = number<std::uint32_t>(text.substr(0, colon)).value_or(kHours);
    const std::uint32_t minute =
        number<std::uint32_t>(text.substr(std::min(colon + 1, text.size()))).value_or(kMinutes);
    if (hour >= kHours || minute >= kMinutes)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} {}: expected a time from 0:00 to 23:59", option, text));
    }
    return sunAtHour(hour + static_cast<double>(minute) / kMinutes);
}

std::optional<std::vector<float>> tryParseFloats(std::string_view text)
{
    std::vector<float> values;
    for (const std::string_view part : split(text, ','))
    {
        const auto value = number<float>(part);
        if (!value || !std::isfinite(*value))
        {
            return std::nullopt;
        }
        values.push_back(*value);
    }
    return values;
}

std::vector<float> parseFloats(std::string_view option, std::string_view text)
{
    auto values = tryParseFloats(text);
    if (!values)
    {
        throw valueError(option, text, "numbers with commas between them, such as 0,1.5,-2e3");
    }
    return *std::move(values);
}

std::uint32_t parseResolution(std::string_view option, std::string_view text)
{
    const auto value = number<std::uint32_t>(text);
    if (!value || !std::has_single_bit(*value) || *value < 2 || *value > 1U << Grid::kDepthMax)
    {
        throw valueError(option, text, fmt::format("a power of two from 2 to {}", 1U << Grid::kDepthMax));
    }
    return static_cast<std::uint32_t>(std::countr_zero(*value));
}

std::vector<std::uint32_t> parseResolutions(std::string_view option, std::string_view text)
{
    std::vector<std::uint32_t> depths;
    for (const std::string_view part : split(text, ','))
    {
        depths.push_back(parseResolution(option, part));
    }
    return depths;
}

std::pair<std::uint32_t, std::uint32_t> parseSize(std::string_view option, std::string_view text)
{
    const std::vector<std::string_view> parts = split(text, 'x');
    if (parts.size() == 2)
    {
        const auto width = number<std::uint32_t>(parts[0]);
        const auto height = number<std::uint32_t>(parts[1]);
        if (width && height && std::min(*width, *height) >= 1 && std::max(*width, *height) <= kImageEdgeMax)
        {
            return {*width, *height};
        }
    }
    throw valueError(option, text,
                     fmt::format("width x height such as 1280x720, each from 1 to {} pixels", kImageEdgeMax));
}

std::pair<std::uint32_t, std::uint32_t> parseFrames(std::string_view option, std::string_view text)
{
    const std::size_t dots = text.find("..");
    if (dots != std::string_view::npos)
    {
        const auto first = number<std::uint32_t>(text.substr(0, dots));
        const auto last = number<std::uint32_t>(text.substr(dots + 2));
        if (first && last && *first <= *last && *last <= kFrameMax)
        {
            return {*first, *last};
        }
    }
    throw valueError(option, text, fmt::format("first..last such as 0..35, from 0 to {}", kFrameMax));
}

std::pair<std::uint32_t, std::uint32_t> parseFrameCount(std::string_view option, std::string_view text)
{
    return {0, static_cast<std::uint32_t>(parseInteger(option, text, 1, kFrameMax + 1) - 1)};
}

std::vector<std::string> parseNames(std::string_view option, std::string_view text)
{
    constexpr std::size_t kNamesMax = 64;
    const std::vector<std::string_view> names = split(text, ',');
    if (names.size() > kNamesMax || std::ranges::any_of(names, &std::string_view::empty))
    {
        throw valueError(option, text, fmt::format("1 to {} names with commas between them", kNamesMax));
    }
    return {names.begin(), names.end()};
}

std::uint64_t parseBytes(std::string_view option, std::string_view text)
{
    constexpr std::string_view kUnits = "KMGT";
    constexpr double kMax = 0x1p63;
    const bool is_spelt_out = text.ends_with("iB"); // GiB means the same as G
    std::string_view digits = text.substr(0, text.size() - (is_spelt_out ? 2 : 0));
    double scale = 1;
    const std::size_t unit = digits.empty() ? std::string_view::npos : kUnits.find(digits.back());
    if (unit != std::string_view::npos)
    {
        digits.remove_suffix(1);
        scale = std::exp2(10.0 * static_cast<double>(unit + 1));
    }
    const auto value = number<double>(digits);
    if (!value || (is_spelt_out && unit == std::string_view::npos) || !(*value > 0) || *value * scale >= kMax)
    {
        throw valueError(option, text, "a number of bytes above 0, such as 2G or 512MiB (K, M, G, T: powers of 1024)");
    }
    return static_cast<std::uint64_t>(*value * scale);
}

Bounds parseBounds(std::string_view option, std::string_view text)
{
    const auto values = tryParseFloats(text);
    if (values && values->size() == 6)
    {
        const std::vector<float>& v = *values;
        const Bounds bounds = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
        if (!bounds.empty() && bounds.min != bounds.max)
        {
            return bounds;
        }
    }
    throw valueError(option, text, "x0,y0,z0,x1,y1,z1 with x0 <= x1, y0 <= y1, z0 <= z1 and not all equal");
}

glm::dvec3 parseDirection(std::string_view option, std::string_view text)
{
    const auto values = tryParseFloats(text);
    if (values && values->size() == 3)
    {
        const glm::dvec3 direction((*values)[0], (*values)[1], (*values)[2]);
        if (direction != glm::dvec3(0.0))
        {
            return direction;
        }
    }
    throw valueError(option, text, "three finite numbers x,y,z, not all 0");
}

} // namespace zvo::cli
