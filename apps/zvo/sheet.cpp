// SPDX-License-Identifier: MIT
#include "sheet.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace zvo::cli
{

namespace
{

std::uint32_t divideUp(std::uint32_t a, std::uint32_t b)
{
    return (a + b - 1) / b;
}

} // namespace

SheetLayout layoutOf(const RenderOptions& options)
{
    const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(options.sheet.size(), 1));
    std::uint32_t columns = 1;
    while (columns * columns < count)
    {
        ++columns;
    }
    const std::uint32_t rows = divideUp(count, columns);
    return {count, columns, rows, divideUp(options.width, columns), divideUp(options.height, rows)};
}

void placeView(const SheetLayout& layout, std::uint32_t index, const Picture& view, Picture& sheet)
{
    assert(view.width == layout.width && view.height == layout.height);
    const std::uint32_t left = index % layout.columns * layout.width;
    const std::uint32_t top = index / layout.columns * layout.height;
    const std::uint32_t right = std::min(left + view.width, sheet.width);
    const std::uint32_t bottom = std::min(top + view.height, sheet.height);
    for (std::uint32_t y = top; y < bottom; ++y)
    {
        for (std::uint32_t x = left; x < right; ++x)
        {
            sheet.texels[std::size_t{y} * sheet.width + x] =
                view.texels[std::size_t{y - top} * view.width + (x - left)];
        }
    }
}

} // namespace zvo::cli
