// SPDX-License-Identifier: MIT
#include "core/scene/scene_size.h"

#include "core/base/input_error.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <unistd.h>

namespace zvo
{

std::uint64_t sceneBytesMax()
{
    const auto page_count = static_cast<std::uint64_t>(std::max(sysconf(_SC_PHYS_PAGES), 0L));
    const auto page_bytes = static_cast<std::uint64_t>(std::max(sysconf(_SC_PAGESIZE), 0L));
    return page_count * page_bytes / 2;
}

void checkSceneSize(const std::filesystem::path& path, const SceneSize& size)
{
    if (size.instance_count > kInstancesMax)
    {
        throw inputError(path, fmt::format("shows {:.0f} primitives, more than {}; join the meshes, or split the file",
                                           size.instance_count, kInstancesMax));
    }
    if (size.triangle_count > std::numeric_limits<std::uint32_t>::max())
    {
        throw inputError(path, fmt::format("shows {:.3g} triangles, more than 32-bit numbers count; split the file",
                                           size.triangle_count));
    }
    if (size.vertex_count > std::numeric_limits<std::uint32_t>::max())
    {
        throw inputError(path, fmt::format("has a mesh of {:.3g} vertices, more than 32-bit numbers count; split it",
                                           size.vertex_count));
    }
    if (const std::uint64_t bytes_max = sceneBytesMax(); size.bytes > static_cast<double>(bytes_max))
    {
        throw inputError(path, fmt::format("its meshes take {:.3g} bytes, more than the {} that half of this machine's "
                                           "memory has; let them share less data, or split the file",
                                           size.bytes, bytes_max));
    }
}

void SceneBytesLeft::take(std::uint64_t bytes)
{
    if (bytes > m_left)
    {
        throw inputError(m_path, fmt::format("its mesh takes more than the {} bytes that half of this machine's memory "
                                             "has; split the file",
                                             sceneBytesMax()));
    }
    m_left -= bytes;
}

} // namespace zvo
