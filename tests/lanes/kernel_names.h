// SPDX-License-Identifier: MIT
// What the tests that run every kernel share: notes of the kernels that have run, and a scene.
#pragma once

#include "core/scene/scene.h"
#include "vk/frame_graph.h"
#include "vk/timer.h"

#include <functional>
#include <string>
#include <vector>

namespace zvo::test
{

/// Runs commands on the device that tests share, and notes which kernels run.
void run(const std::function<void(vk::FrameGraph&)>& record);

/// Notes the kernels of passes.
void noteKernels(const std::vector<vk::PassTime>& passes);

/// Whether a kernel has run since forgetKernels().
bool hasRun(const std::string& name);
void forgetKernels();

/// Expects that all kernels of brushes have run, or all others, of those that the device can run.
void expectAllRan(bool of_brushes);

/// A few triangles in three materials, which use every property of a material: plain, textured and emissive, blended.
Scene smallScene();

} // namespace zvo::test
