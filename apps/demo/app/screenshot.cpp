// SPDX-License-Identifier: MIT
#include "demo/app/screenshot.h"

#include "io/file/atomic_file.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <span>
#include <utility>
#include <vector>

namespace zvo::demo
{

namespace
{

constexpr int kNumberMax = 9999;

// The first name that no file has.
std::string newName()
{
    for (int i = 1; i <= kNumberMax; ++i)
    {
        std::string name = fmt::format("zvo-{:04}.png", i);
        std::error_code ignored;
        if (!std::filesystem::exists(name, ignored))
        {
            return name;
        }
    }
    throw Error(ErrorCode::Output, fmt::format("there are {} screenshots here already; move some away", kNumberMax));
}

} // namespace

Screenshot::Screenshot(vk::Device& device, PictureSize size, std::unique_ptr<cli::Output> output, bool has_panels)
    : m_size(size), m_pixels(device, "screenshot", std::uint64_t{size.width} * size.height, vk::MemoryKind::Readback),
      m_output(std::move(output)), m_has_panels(has_panels)
{
}

std::string Screenshot::write()
{
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(m_pixels.mappedData());
    const std::vector<std::uint8_t> png = encodePng(m_size.width, m_size.height, {bytes, m_pixels.bytes()});
    if (m_output != nullptr)
    {
        m_output->write(std::as_bytes(std::span(png)));
        m_output->finish();
        return {};
    }
    std::string name = newName();
    writeFileAtomically(name, std::as_bytes(std::span(png)), Overwrite::Refuse);
    return name;
}

} // namespace zvo::demo
