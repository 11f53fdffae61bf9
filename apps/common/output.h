// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "io/file/atomic_file.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace zvo::cli
{

inline constexpr std::array<std::string_view, 1> kPngAlone = {".png"};

/// The output of a command: standard output for "-", otherwise a file that appears complete or not at all. Made before
/// the work starts, so that a path that cannot be written to is an error at once. Every function throws Error{Output}.
class Output
{
public:
    Output(const std::string& target, bool overwrite);

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// Gives the file its name.
    void finish();

private:
    std::unique_ptr<AtomicFile> m_file; // null: standard output
};

/// The output of the report, if one was asked for.
std::optional<Output> openReport(const OutputOptions& options);

/// Throws Error{Usage} if two results would go to one file, or if one would overwrite an input.
void checkPaths(const OutputOptions& options, std::span<const std::filesystem::path> inputs);

/// Throws Error{Usage} if two of the outputs are one file, or if one would overwrite an input. "" and "-" are no files.
void checkOutputs(std::span<const std::string> outputs, std::span<const std::filesystem::path> inputs);

/// Throws Error{Usage}, which names the option, unless the path ends in one of extensions.
void checkPictureName(std::string_view option, const std::string& path,
                      std::span<const std::string_view> extensions = kPngAlone);

/// Whether a picture of that name holds radiance: .exr and .hdr do.
bool holdsRadiance(const std::string& path);

/// The extension of a path in lower case, with its dot.
std::string extensionOf(const std::string& path);

} // namespace zvo::cli
