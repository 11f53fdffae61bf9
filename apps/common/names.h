// SPDX-License-Identifier: MIT
// What options, settings and reports call the values of enumerations.
#pragma once

#include "core/frame/frame_options.h"
#include "io/scene/load_scene.h"
#include "vk/swapchain.h"
#include "zvo/error.h"
#include "zvo/types.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <string>
#include <string_view>

namespace zvo::cli
{

template <typename T> struct Named
{
    std::string_view name;
    T value;
    std::string_view old_name = {}; // is understood, too
};
template <typename T, std::size_t count> using Names = std::array<Named<T>, count>;

inline constexpr auto kViews = std::to_array<Named<View>>({{"color", View::Color},
                                                           {"albedo", View::Albedo},
                                                           {"normal", View::Normal},
                                                           {"depth", View::Depth},
                                                           {"level", View::Level},
                                                           {"iterations", View::Iterations},
                                                           {"voxel", View::Voxel},
                                                           {"bricks", View::Bricks},
                                                           {"origin", View::Origin}});
inline constexpr auto kIntegrators = std::to_array<Named<Integrator>>({{"primary", Integrator::Primary},
                                                                       {"path", Integrator::Path},
                                                                       {"cache", Integrator::Cache, "cached"},
                                                                       {"cones", Integrator::Cones}});
inline constexpr auto kShadings =
    std::to_array<Named<Shading>>({{"smooth", Shading::Smooth}, {"faces", Shading::Faces}});
inline constexpr const char* kShadingHelp = "light by the normals of voxels, or by their faces (default smooth)";
inline constexpr const char* kIntegratorHelp =
    "light by a ray to the sun and a simple sky, by path tracing, from the radiance cache, or through cones that read "
    "that, to compare with (default primary)";
inline constexpr auto kPresentModes =
    std::to_array<Named<vk::PresentMode>>({{"fifo", vk::PresentMode::Fifo},
                                           {"mailbox", vk::PresentMode::Mailbox},
                                           {"immediate", vk::PresentMode::Immediate}});
inline constexpr auto kCoverages =
    std::to_array<Named<Coverage>>({{"thin", Coverage::Thin}, {"conservative", Coverage::Conservative}});
inline constexpr auto kFills = std::to_array<Named<Fill>>(
    {{"none", Fill::None}, {"solid", Fill::Solid}, {"parity", Fill::Parity}, {"robust", Fill::Robust}});
inline constexpr auto kAxes = std::to_array<Named<UpAxis>>({{"x", UpAxis::X},
                                                            {"y", UpAxis::Y},
                                                            {"z", UpAxis::Z},
                                                            {"-x", UpAxis::MinusX},
                                                            {"-y", UpAxis::MinusY},
                                                            {"-z", UpAxis::MinusZ}});
inline constexpr auto kShells = std::to_array<Named<Shell>>({{"surface", Shell::Surface}, {"none", Shell::None}});
inline constexpr auto kStructures =
    std::to_array<Named<TreeStructure>>({{"svo", TreeStructure::Svo}, {"svdag", TreeStructure::Svdag}});
inline constexpr auto kMergeRules = std::to_array<Named<MergeRule>>(
    {{"average", MergeRule::Average}, {"dynamic", MergeRule::DynamicWins}, {"static", MergeRule::StaticWins}});

/// The name of a value, which names must have.
template <typename T, std::size_t count> constexpr std::string_view nameOf(const Names<T, count>& names, T value)
{
    return std::ranges::find(names, value, &Named<T>::value)->name;
}

/// All names: "a, b, c", or with another text between them.
template <typename T, std::size_t count>
std::string listOf(const Names<T, count>& names, std::string_view between = ", ")
{
    std::string list;
    for (const Named<T>& named : names)
    {
        list += fmt::format("{}{}", list.empty() ? "" : between, named.name);
    }
    return list;
}

/// The element of that name, or old name; the end if there is none.
template <typename T, std::size_t count> constexpr auto findNamed(const Names<T, count>& names, std::string_view name)
{
    return std::ranges::find_if(names, [&](const Named<T>& named)
                                { return named.name == name || (!name.empty() && named.old_name == name); });
}

/// The value of that name. Throws Error{Usage}, which names the option. expected: what the message says; if empty, it
/// lists the names.
template <typename T, std::size_t count>
T parseNamed(std::string_view option, std::string_view text, const Names<T, count>& names,
             std::string_view expected = {})
{
    const auto found = findNamed(names, text);
    if (found == names.end())
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} {}: expected {}", option, text,
                                expected.empty() ? "one of " + listOf(names) : std::string(expected)));
    }
    return found->value;
}

} // namespace zvo::cli
