// SPDX-License-Identifier: MIT
#pragma once

#include "common/output.h"
#include "core/present/present.h"
#include "shared/gpu.h"
#include "vk/buffer.h"
#include "vk/device.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace zvo::demo
{

/// A frame's pixels on their way into a PNG file.
class Screenshot
{
public:
    /// A screenshot of that size. It goes to output or, if that is null, to a new file zvo-NNNN.png in the working
    /// folder.
    Screenshot(vk::Device& device, PictureSize size, std::unique_ptr<cli::Output> output, bool has_panels);

    /// The buffer to which the frame copies its pixels.
    [[nodiscard]] vk::BufferOf<gpu::uint>& pixels() { return m_pixels; }
    [[nodiscard]] bool hasPanels() const { return m_has_panels; }

    /// Writes the file, once the device is done with the frame. Returns the file's name if it was chosen here. Throws
    /// Error{Output}.
    std::string write();

private:
    PictureSize m_size;
    vk::BufferOf<gpu::uint> m_pixels;
    std::unique_ptr<cli::Output> m_output;
    bool m_has_panels;
};

} // namespace zvo::demo
