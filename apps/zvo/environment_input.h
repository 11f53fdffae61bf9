// SPDX-License-Identifier: MIT
#pragma once

#include "commands.h"
#include "core/light/environment.h"
#include "vk/device.h"

namespace zvo::cli
{

/// What lights a picture with samples: reads the map, if one was asked for. Throws Error{Input}, Error{Memory}.
DeviceEnvironment readEnvironment(vk::Device& device, const RenderOptions& options);

} // namespace zvo::cli
