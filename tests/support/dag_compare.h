// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <string>

namespace zvo::test
{

/// Returns the first difference in numbers or bytes of two DAGs, or "".
std::string difference(vk::HeadlessDevice& device, const DeviceTree& actual, const DeviceTree& expected);

} // namespace zvo::test
