// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <string>

namespace zvo::test
{

/// Returns the first rule of core/scene/scene.h and core/scene/rig.h that scene breaks, or "".
std::string sceneFault(const Scene& scene);

} // namespace zvo::test
