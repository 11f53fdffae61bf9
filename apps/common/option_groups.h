// SPDX-License-Identifier: MIT
// Options that several commands have, for the options.cpp of each program.
#pragma once

#include "common/names.h"
#include "common/scene_options.h"
#include "core/tree/attribute_format.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace zvo::cli
{

/// Adds an option with one argument, which `read` converts to a value.
template <typename T, typename Read>
CLI::Option* addValue(CLI::App& app, const char* name, T& target, Read read, const char* type, const std::string& what)
{
    const std::string option = std::string(name).substr(std::string(name).rfind(',') + 1);
    const auto assign = [&target, read, option](const std::string& text) { target = read(option, text); };
    return app.add_option_function<std::string>(name, assign, what)->type_name(type);
}

/// Adds an option whose value has a name. expected: as in parseNamed().
template <typename T, std::size_t count, typename Target>
CLI::Option* addNamed(CLI::App& app, const char* name, Target& target, const Names<T, count>& names,
                      const std::string& what, std::string_view expected = {})
{
    const auto read = [&names, expected](std::string_view option, std::string_view text)
    { return parseNamed(option, text, names, expected); };
    return addValue(app, name, target, read, "", what)->type_name(listOf(names, "|"));
}

CLI::Option* addText(CLI::App& app, const char* name, std::string& target, const char* type, const char* what);

/// The same for a file to write, whose name must not be empty.
CLI::Option* addOutput(CLI::App& app, const std::string& name, std::string& target, const char* type, const char* what);

void addFolder(CLI::App& app, const char* name, std::optional<std::filesystem::path>& folder, const std::string& what);

/// Returns text, which must be one of names. Throws Error{Usage}.
std::string oneOf(std::string_view option, std::string_view text, std::initializer_list<std::string_view> names);

void addDeviceOptions(CLI::App& app, DeviceOptions& options);
void addCoverageOption(CLI::App& app, Coverage& coverage);
void addFillOption(CLI::App& app, Fill& fill);
void addShellOption(CLI::App& app, Shell& shell);
void addAttributesOption(CLI::App& app, bool& attributes);
void addAttributesOption(CLI::App& app, AttributeFormat& attributes); // Bytes8 or None

/// structure: a TreeStructure, or an optional one.
template <typename Structure>
CLI::Option* addStructureOption(CLI::App& app, Structure& structure, const std::string& what)
{
    return addNamed(app, "--structure", structure, kStructures, what, "svo or svdag");
}

void addLoadOptions(CLI::App& app, LoadOptions& options);
void addMaterialOptions(CLI::App& app,
                        LoadOptions& options); // those of addLoadOptions() that hold for scene files, too

/// The options of what is voxelized and how, except attributes. also: what else SCENE may be.
void addVoxelOptions(CLI::App& app, VoxelOptions& options, const std::string& also = "");

/// also: what else goes with a map.
void addEnvironmentOptions(CLI::App& app, EnvironmentOptions& options, const std::string& also = "");

CLI::Option* addTimeOfDayOption(CLI::App& app, const std::function<void(const glm::dvec3& to_sun)>& use);

/// what: the name of what is written to the output.
void addOutputOptions(CLI::App& app, OutputOptions& options, const char* what);

/// --quiet, which holds until the next setQuiet().
void addQuietOption(CLI::App& app);

void addCameraOption(CLI::App& app, std::string& camera);

} // namespace zvo::cli
