// SPDX-License-Identifier: MIT
#pragma once

#include "commands.h"
#include "common/output.h"
#include "io/image/webp_write.h"
#include "io/scene/animated_scene.h"
#include "picture.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace zvo::cli
{

/// The files of the pictures: one, or one for each frame, or a WebP in which all frames are.
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

    /// Sets how fast the frames of a WebP follow each other.
    void setFrameRate(double frames_per_second) { m_frames_per_second = frames_per_second; }

    /// Writes the index-th picture.
    void write(std::uint32_t index, const Picture& picture);

    /// Writes the WebP in which all frames are, if there is one. After the last picture.
    void finish();

private:
    [[nodiscard]] std::string pathOf(std::uint32_t index) const;
    [[nodiscard]] std::uint32_t beginMs(std::uint32_t index) const; // of a frame in a WebP
    void checkName() const;

    const RenderOptions& m_options;
    std::size_t m_marker = 0; // position of the frame's number in the name
    std::size_t m_digits = 0;
    std::optional<Output> m_first; // the first file, which is open already
    bool m_is_animation = false;   // all frames are in one file
    std::optional<WebpAnimation> m_animation;
    std::uint32_t m_animation_count = 0; // frames in it
    double m_frames_per_second = AnimatedScene().frames_per_second;
};

} // namespace zvo::cli
