// SPDX-License-Identifier: MIT
#include "pictures.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <array>
#include <system_error>

namespace zvo::cli
{

Pictures::Pictures(const RenderOptions& options) : m_options(options)
{
    const std::string& path = options.output.path;
    if (path != "-")
    {
        checkPictureName("-o", path, options.hasRadiance());
    }
    if (!options.frames)
    {
        m_first.emplace(path, options.output.overwrite);
        return;
    }
    m_marker = path.find('#');
    m_digits = m_marker == std::string::npos ? 0 : path.find_first_not_of('#', m_marker) - m_marker;
    if (m_digits == 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: with --frames, the name needs a place for the frame's "
                                                  "number, such as frame_####.png",
                                                  path));
    }
    for (std::uint32_t i = 0; i < count(); ++i)
    {
        const Output look(pathOf(i), options.output.overwrite);
    }
}

void Pictures::checkInputs(std::span<const std::filesystem::path> inputs) const
{
    checkPaths(m_options.output, inputs);
    for (std::uint32_t i = 0; m_options.frames && i < count(); ++i)
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

void Pictures::write(std::uint32_t index, std::span<const std::uint8_t> picture)
{
    if (!m_first)
    {
        m_first.emplace(pathOf(index), m_options.output.overwrite);
    }
    m_first->write(std::as_bytes(picture));
    m_first->finish();
    m_first.reset();
}

std::string Pictures::pathOf(std::uint32_t index) const
{
    const std::string& path = m_options.output.path;
    return fmt::format("{}{:0{}}{}", path.substr(0, m_marker), number(index), m_digits,
                       path.substr(m_marker + m_digits));
}

} // namespace zvo::cli
