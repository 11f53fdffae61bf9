// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/light/environment.h"
#include "vk/device.h"

#include <glm/glm.hpp>
#include <optional>

namespace zvo::cli
{

/// What lights a picture with samples: reads the map, if one was asked for. to_sun: direction, any length; not given:
/// the usual sun of the simple sky, and none beside a map. Throws Error{Input}, Error{Memory}.
DeviceEnvironment readEnvironment(vk::Device& device, const EnvironmentOptions& asked,
                                  const std::optional<glm::dvec3>& to_sun);

/// Whether a file, by its name, is a map of radiance.
bool isEnvironmentFile(const std::filesystem::path& path);

} // namespace zvo::cli
