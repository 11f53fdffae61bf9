// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace zvo::demo
{

/// The way in which the light of a pixel is computed. This is the only place where it is chosen.
enum class Integrator
{
    Primary, ///< primary rays, with rays to the sun and over the hemisphere (core/trace/trace.h)
};

inline constexpr std::array<std::string_view, 1> kIntegratorNames = {"primary rays"};

} // namespace zvo::demo
