// SPDX-License-Identifier: MIT
#pragma once

#include "vk/kernel.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::demo
{

/// A kernel that was compiled, or why it was not.
struct CompiledShader
{
    std::string name;                 // "<operation>/<kernel>"
    std::vector<std::uint32_t> words; // empty: it does not compile
    std::string message;              // the compiler's
};

/// The folder that the kernels' sources are in, and what has changed there.
class ShaderSources
{
public:
    /// Sources that change from now on have changed.
    explicit ShaderSources(std::filesystem::path root);

    [[nodiscard]] bool exist() const;
    [[nodiscard]] const std::filesystem::path& root() const { return m_root; }

    /// Those of names whose source, or something that it includes, has changed since the last call, and those that did
    /// not compile then, in order.
    std::vector<std::string> takeChanged(const std::vector<std::string>& names);

    /// Compiles kernels, several at a time; glslangValidator has to be in the path. Waits.
    std::vector<CompiledShader> compile(const std::vector<std::string>& names);

private:
    std::filesystem::path m_root;
    std::filesystem::file_time_type m_checked;
    std::set<std::string> m_failed;
};

/// The result of reloading shaders.
struct ReloadedShaders
{
    std::size_t count = 0; // kernels that were replaced
    std::string message;   // why other kernels were not replaced; empty: all were
};

/// Compiles the kernels in sources that have changed, and replaces them. Kernels that do not compile, or do not fit
/// this program, stay as they were. The device must be done with all work.
ReloadedShaders reloadShaders(vk::KernelCache& kernels, ShaderSources& sources);

/// Where the sources of a program's shaders are: what was installed with it or, where nothing was, what it was built
/// from.
std::filesystem::path shadersOf(const std::filesystem::path& program);

/// The program that runs; empty where the system does not tell.
std::filesystem::path thisProgram();

/// The files that a source names in its lines "#include".
std::vector<std::string> includesOf(std::string_view source);

} // namespace zvo::demo
