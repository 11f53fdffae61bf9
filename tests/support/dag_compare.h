// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <string>

namespace zvo::test
{

/// What tells two DAGs apart: the first difference in numbers or bytes, or "" for none.
std::string difference(vk::HeadlessDevice& device, const DeviceTree& actual, const DeviceTree& expected);

} // namespace zvo::test
