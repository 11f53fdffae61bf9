// SPDX-License-Identifier: MIT
#pragma once

#include "commands.h"
#include "common/output.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace zvo::cli
{

/// The files of the pictures: one, or one for each frame.
class Pictures
{
public:
    /// Checks at once whether all of them can be written. Throws Error{Usage} for a name that is not valid,
    /// Error{Output} for a path that cannot be written to.
    explicit Pictures(const RenderOptions& options);

    /// Throws Error{Usage} if a picture would overwrite an input, or take the place of the report.
    void checkInputs(std::span<const std::filesystem::path> inputs) const;

    [[nodiscard]] std::uint32_t count() const;

    /// The number of a frame, 0 where none was asked for.
    [[nodiscard]] std::uint32_t number(std::uint32_t index) const;

    /// Writes the index-th picture.
    void write(std::uint32_t index, std::span<const std::uint8_t> png);

private:
    [[nodiscard]] std::string pathOf(std::uint32_t index) const;

    const RenderOptions& m_options;
    std::size_t m_marker = 0; // position of the frame's number in the name
    std::size_t m_digits = 0;
    std::optional<Output> m_first; // the first file, which is open already
};

} // namespace zvo::cli
