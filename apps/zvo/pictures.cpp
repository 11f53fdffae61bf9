// SPDX-License-Identifier: MIT
#include "pictures.h"

#include "common/picture_file.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <system_error>
#include <vector>

namespace zvo::cli
{

namespace
{

std::span<const std::uint8_t> bytesOf(const Picture& picture)
{
    static_assert(std::endian::native == std::endian::little); // red is the lowest byte of a texel
    return {reinterpret_cast<const std::uint8_t*>(picture.texels.data()),
            picture.texels.size() * sizeof(std::uint32_t)};
}

std::uint32_t qualityOf(const RenderOptions& options)
{
    return options.quality.value_or(kUsualQuality);
}

} // namespace

Pictures::Pictures(const RenderOptions& options) : m_options(options)
{
    checkName();
    const std::string& path = options.output.path;
    m_marker = path.find('#');
    m_digits = m_marker == std::string::npos ? 0 : path.find_first_not_of('#', m_marker) - m_marker;
    m_is_animation = options.frames && m_digits == 0 && extensionOf(path) == ".webp";
    if (!options.frames || m_is_animation)
    {
        m_first.emplace(path, options.output.overwrite);
        return;
    }
    if (m_digits == 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: with --frames or --turntable, the name needs a place for the "
                                                  "frame's number, such as frame_####.png, or is one of a .webp",
                                                  path));
    }
    for (std::uint32_t i = 0; i < count(); ++i)
    {
        const Output look(pathOf(i), options.output.overwrite);
    }
}

void Pictures::checkName() const
{
    const std::string& path = m_options.output.path;
    if (path == "-")
    {
        return;
    }
    checkPictureName("-o", path, kPictureExtensions);
    if (holdsRadiance(path) && (!m_options.hasRadiance() || !m_options.sheet.empty()))
    {
        const char* const why = m_options.hasRadiance() ? "a --sheet has no radiance" : "--view shows no radiance";
        throw Error(ErrorCode::Usage, fmt::format("-o {}: {}; name it .png, .jpg or .webp", path, why));
    }
    if (extensionOf(path) == ".webp" && std::max(m_options.width, m_options.height) > kWebpEdgeMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: a WebP has at most {} pixels on an edge; make it smaller, or "
                                                  "name it .png",
                                                  path, kWebpEdgeMax));
    }
}

void Pictures::checkInputs(std::span<const std::filesystem::path> inputs) const
{
    checkPaths(m_options.output, inputs);
    for (std::uint32_t i = 0; m_options.frames && !m_is_animation && i < count(); ++i)
    {
        const std::string path = pathOf(i);
        std::error_code ignored;
        if (std::filesystem::exists(path, ignored)) // else it is no input
        {
            checkOutputs(std::array{path}, inputs);
        }
        if (std::filesystem::path(path).filename() == std::filesystem::path(m_options.output.json).filename())
        {
            checkOutputs(std::array{path, m_options.output.json}, {});
        }
    }
}

std::uint32_t Pictures::count() const
{
    return m_options.frames ? m_options.frames->second - m_options.frames->first + 1 : 1;
}

std::uint32_t Pictures::number(std::uint32_t index) const
{
    return m_options.frames ? m_options.frames->first + index : 0;
}

void Pictures::write(std::uint32_t index, const Picture& picture)
{
    if (m_is_animation)
    {
        if (!m_animation)
        {
            m_animation.emplace(picture.width, picture.height, qualityOf(m_options));
        }
        m_animation->add(bytesOf(picture), beginMs(index));
        m_animation_count = index + 1;
        return;
    }
    if (!m_first)
    {
        m_first.emplace(pathOf(index), m_options.output.overwrite);
    }
    const std::vector<std::uint8_t> encoded =
        picture.file.empty()
            ? encodePicture(m_options.output.path, picture.width, picture.height, picture.texels, qualityOf(m_options))
            : std::vector<std::uint8_t>();
    m_first->write(std::as_bytes(std::span(picture.file.empty() ? encoded : picture.file)));
    m_first->finish();
    m_first.reset();
}

void Pictures::finish()
{
    if (m_animation)
    {
        const std::vector<std::uint8_t> file = m_animation->finish(beginMs(m_animation_count));
        m_first->write(std::as_bytes(std::span(file)));
        m_first->finish();
    }
}

std::uint32_t Pictures::beginMs(std::uint32_t index) const
{
    constexpr double kMs = 1000.0; // of a second
    return static_cast<std::uint32_t>(std::lround(index * kMs / m_frames_per_second));
}

std::string Pictures::pathOf(std::uint32_t index) const
{
    const std::string& path = m_options.output.path;
    return fmt::format("{}{:0{}}{}", path.substr(0, m_marker), number(index), m_digits,
                       path.substr(m_marker + m_digits));
}

} // namespace zvo::cli
