// SPDX-License-Identifier: MIT
#pragma once

#include "demo/app/shader_sources.h"
#include "vk/kernel.h"

#include <cstddef>
#include <string>

namespace zvo::demo
{

/// The result of reloading shaders.
struct ReloadedShaders
{
    std::size_t count = 0; // kernels that were replaced
    std::string message;   // why other kernels were not replaced; empty: all were
};

/// Compiles the kernels in sources that have changed, and replaces them. Kernels that do not compile, or do not fit
/// this program, stay as they were. The device must be done with all work.
ReloadedShaders reloadShaders(vk::KernelCache& kernels, ShaderSources& sources);

} // namespace zvo::demo
