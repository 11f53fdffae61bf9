// SPDX-License-Identifier: MIT
#include "core/radiance/radiance_cache_table.h"

namespace zvo
{

gpu::RadianceCacheTable radianceCacheTable(const DeviceRadianceCache& cache, const DeviceEnvironment& environment)
{
    return {.faces = {cache.faces().address()},
            .environment = {environment.buffer().address()},
            .run_count = static_cast<std::uint32_t>(cache.faces().count() / gpu::kFaceRun),
            .frame_count = cache.frameCount()};
}

} // namespace zvo
