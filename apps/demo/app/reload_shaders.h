// SPDX-License-Identifier: MIT
#pragma once

#include "demo/app/shader_sources.h"
#include "vk/kernel.h"

#include <cstddef>
#include <string>

namespace zvo::demo
{

/// What came of shaders that have changed.
struct ReloadedShaders
{
    std::size_t count = 0; // that run from now on
    std::string message;   // why others do not; empty: there are none
};

/// Compiles what has changed in sources and puts it in place of the kernels. Those that do not compile, or do not fit
/// this program, stay as they were. The device is done with all work.
ReloadedShaders reloadShaders(vk::KernelCache& kernels, ShaderSources& sources);

} // namespace zvo::demo
