// SPDX-License-Identifier: MIT
#include "core/radiance/kept_light_table.h"

namespace zvo
{

gpu::KeptLightTable keptLightTable(const RadianceCache& cache, const DeviceEnvironment& environment)
{
    return {.faces = {cache.faces().address()},
            .environment = {environment.buffer().address()},
            .run_count = static_cast<std::uint32_t>(cache.faces().count() / gpu::kFaceRun),
            .frame_count = cache.frameCount()};
}

} // namespace zvo
