// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "io/file/atomic_file.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace zvo::cli
{

/// What a command writes: standard output for "-", otherwise a file that appears complete or not at all. Made before
/// the work starts, so that a place that cannot be written to is an error at once. Every function throws Error{Output}.
class Output
{
public:
    Output(const std::string& target, bool overwrite);

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// Puts the file in its place.
    void finish();

private:
    std::unique_ptr<AtomicFile> m_file; // null: standard output
};

/// Where the report goes, if one was asked for.
std::optional<Output> openReport(const OutputOptions& options);

/// Throws Error{Usage} if two results go to one place, or if one would overwrite an input.
void checkPaths(const OutputOptions& options, std::span<const std::filesystem::path> inputs);

/// The extension of a path in lower case, with its dot.
std::string extensionOf(const std::string& path);

} // namespace zvo::cli
