// SPDX-License-Identifier: MIT
// What the tests of the slides' algorithms share.
#pragma once

#include "vk/headless.h"

namespace zvo::test
{

/// The device that the tests of the binary share, with the kernels of zvo and of the baselines.
vk::HeadlessDevice& slidesDevice();

} // namespace zvo::test
