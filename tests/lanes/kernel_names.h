// SPDX-License-Identifier: MIT
// What the tests that run every kernel share: names of the kernels that have run, and a scene.
#pragma once

#include "core/scene/scene.h"
#include "vk/timer.h"

#include <set>
#include <string>
#include <vector>

namespace zvo::test
{

/// Names of the kernels that have run.
using KernelNames = std::set<std::string>;

void addNames(KernelNames& names, const std::vector<vk::PassTime>& passes);

/// Expects that all kernels of brushes have run, or all others, of those that the device can run.
void expectAllRan(const KernelNames& names, bool of_brushes);

/// A few triangles in three materials, which use every property of a material: plain, textured and emissive, blended.
Scene smallScene();

} // namespace zvo::test
