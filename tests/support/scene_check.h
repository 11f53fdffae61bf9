// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <string>

namespace zvo::test
{

/// The first promise of core/scene/scene.h and core/scene/rig.h that scene does not keep; "" where it is whole.
std::string sceneFault(const Scene& scene);

} // namespace zvo::test
