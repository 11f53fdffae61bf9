// SPDX-License-Identifier: MIT
// WebP pictures, still and moving, by libwebp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace zvo
{

/// The most pixels along an edge of a WebP.
inline constexpr std::uint32_t kWebpEdgeMax = 16383;

/// The quality at which a WebP loses nothing.
inline constexpr std::uint32_t kWebpLossless = 100;

/// A WebP file of width * height pixels from rgba, 4 bytes each, rows from the top; alpha is left out. quality: 1 to
/// kWebpLossless. Equal pictures give equal bytes. Throws Error{Memory}.
std::vector<std::uint8_t> encodeWebp(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                     std::uint32_t quality);

/// Pictures of one size that become a WebP which plays them for ever. Every function throws Error{Memory}.
class WebpAnimation
{
public:
    /// quality: as of encodeWebp().
    WebpAnimation(std::uint32_t width, std::uint32_t height, std::uint32_t quality);
    ~WebpAnimation();
    WebpAnimation(WebpAnimation&&) noexcept;
    WebpAnimation& operator=(WebpAnimation&&) noexcept;

    /// Adds the next picture. begin_ms: from when on it is shown; more than the last one's. rgba: as of encodeWebp().
    void add(std::span<const std::uint8_t> rgba, std::uint32_t begin_ms);

    /// The file. end_ms: until when the last picture is shown. Nothing can be added after that.
    std::vector<std::uint8_t> finish(std::uint32_t end_ms);

private:
    struct Encoder;
    std::unique_ptr<Encoder> m_encoder;
};

} // namespace zvo
