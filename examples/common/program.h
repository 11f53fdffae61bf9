// SPDX-License-Identifier: MIT
// What the examples have in common as programs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace host
{

/// What the command line says.
struct Options
{
    bool help = false;         // --help: the usage is printed, and nothing else done
    bool validation = false;   // --validation: any message of the layers makes the program fail
    bool optional = true;      // --no-optional: no feature is enabled that zvo does without
    std::string device;        // --device NAME|NUMBER|cpu, or the environment variable ZVO_DEVICE
    std::filesystem::path ply; // --ply FILE: the mesh is written there, for zvo render
    std::vector<std::string> arguments;
};

/// What main() does: reads options, runs example and tells of errors. usage: its arguments, of which at least
/// arguments_min must be there. Returns the exit code.
int run(int count, char** arguments, const char* usage, std::size_t arguments_min,
        const std::function<void(const Options&)>& example);

} // namespace host
