// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace zvo::demo
{

/// How rays become light: the one place where that is chosen.
enum class Integrator
{
    Primary, ///< primary rays, with rays to the sun and over the hemisphere (core/trace/trace.h)
};

inline constexpr std::array<std::string_view, 1> kIntegratorNames = {"primary rays"};

} // namespace zvo::demo
