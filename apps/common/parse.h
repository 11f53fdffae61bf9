// SPDX-License-Identifier: MIT
// The words of the command line as values. The format of numbers does not depend on the locale. A word that is not
// exactly a value of the expected kind is an Error{Usage} that names the option.
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace zvo::cli
{

/// A whole number in [low, high].
std::uint64_t parseInteger(std::string_view option, std::string_view text, std::uint64_t low, std::uint64_t high);

/// A function that parses whole numbers in [low, high].
inline auto integerIn(std::uint32_t low, std::uint32_t high)
{
    return [low, high](std::string_view option, std::string_view text)
    { return static_cast<std::uint32_t>(parseInteger(option, text, low, high)); };
}

/// Any text, as a path.
inline std::filesystem::path parsePath(std::string_view, const std::string& text)
{
    return text;
}

/// A finite number above 0.
float parsePositive(std::string_view option, std::string_view text);

/// A finite number from 0 on.
double parseSeconds(std::string_view option, std::string_view text);

/// A finite number.
double parseDegrees(std::string_view option, std::string_view text);

/// An angle of blur: degrees above 0 and at most 90.
float parseBlur(std::string_view option, std::string_view text);

/// A time of day, "6:30", as the direction to the sun (sunAtHour()).
glm::dvec3 parseTimeOfDay(std::string_view option, std::string_view text);

/// Three finite numbers with commas between them, not all 0.
glm::dvec3 parseDirection(std::string_view option, std::string_view text);

/// Finite numbers with commas between them.
std::vector<float> parseFloats(std::string_view option, std::string_view text);

/// The same, or nothing where text is not such a list: it may be a name instead.
std::optional<std::vector<float>> tryParseFloats(std::string_view text);

/// A resolution that is a power of two, as a depth.
std::uint32_t parseResolution(std::string_view option, std::string_view text);

/// Resolutions with commas between them, as depths.
std::vector<std::uint32_t> parseResolutions(std::string_view option, std::string_view text);

/// Width and height in pixels: "1280x720".
std::pair<std::uint32_t, std::uint32_t> parseSize(std::string_view option, std::string_view text);

/// First and last frame: "0..35".
std::pair<std::uint32_t, std::uint32_t> parseFrames(std::string_view option, std::string_view text);

/// First and last frame of so many: "36" is 0..35.
std::pair<std::uint32_t, std::uint32_t> parseFrameCount(std::string_view option, std::string_view text);

/// Names with commas between them, 64 at most.
std::vector<std::string> parseNames(std::string_view option, std::string_view text);

/// A number of bytes with an optional K, M, G or T, or KiB and so on (powers of 1024): "512M", "1.5GiB".
std::uint64_t parseBytes(std::string_view option, std::string_view text);

/// Six numbers, minimum corner then maximum corner; some extent on at least one axis.
Bounds parseBounds(std::string_view option, std::string_view text);

} // namespace zvo::cli
