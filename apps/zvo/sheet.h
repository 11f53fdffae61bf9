// SPDX-License-Identifier: MIT
#pragma once

#include "commands.h"
#include "picture.h"

#include <cstdint>

namespace zvo::cli
{

/// Where the views of one picture stand: in rows from the top, which have as many as there are rows, or one more. Of a
/// single view, all of the picture.
struct SheetLayout
{
    std::uint32_t view_count;
    std::uint32_t columns;
    std::uint32_t rows;
    std::uint32_t width; // of a view, in pixels. The last ones are cut where the picture ends
    std::uint32_t height;
};

SheetLayout layoutOf(const RenderOptions& options);

/// Copies a view, which has the layout's size, to its place in a sheet.
void placeView(const SheetLayout& layout, std::uint32_t index, const Picture& view, Picture& sheet);

} // namespace zvo::cli
