// SPDX-License-Identifier: MIT
#pragma once

#include "core/frame/frame_options.h"
#include "tree.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo::python
{

/// What a picture shows, and how.
struct PictureOptions
{
    std::uint32_t width = 0;  // pixels
    std::uint32_t height = 0; // pixels
    std::string camera;       // a name, as --camera takes it
    std::vector<float> view;  // in place of camera: eye, target and vertical field of view, 7 numbers
    Integrator integrator = Integrator::Primary; // or Path
    std::uint32_t samples = 1;                   // a pixel, at least 1
    bool denoise = false;                        // Integrator::Path
};

/// Makes a picture of a tree: [width * height] texels red | green << 8 | blue << 16 | 255 << 24, sRGB, rows from the
/// top. Waits. Throws Error{Usage} for a camera that is none, and Error{Memory}.
std::vector<std::uint32_t> render(const Tree& tree, const PictureOptions& options);

/// Writes such a picture as a file of the kind that its name tells, in place of any that is there. Throws Error{Usage}
/// for a name that tells none, and Error{Output}.
void writePicture(const std::string& path, std::uint32_t width, std::uint32_t height,
                  std::span<const std::uint32_t> texels);

} // namespace zvo::python
