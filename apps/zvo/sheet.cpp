// SPDX-License-Identifier: MIT
#include "sheet.h"

#include "core/base/divide_up.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace zvo::cli
{

SheetLayout layoutOf(const RenderOptions& options)
{
    const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(options.sheet.size(), 1));
    std::uint32_t columns = 1;
    while (columns * columns < count)
    {
        ++columns;
    }
    const auto rows = static_cast<std::uint32_t>(divideUp(count, columns));
    return {count, columns, rows, static_cast<std::uint32_t>(divideUp(options.width, columns)),
            static_cast<std::uint32_t>(divideUp(options.height, rows))};
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
