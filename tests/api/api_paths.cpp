// SPDX-License-Identifier: MIT
#include "api_paths.h"

#include "core/path/daylight.h"
#include "core/trace/trace.h"
#include "support/engine_device.h"
#include "support/failing_vulkan.h"

namespace zvo::test
{

const HostModel& pathModel()
{
    static const HostModel model(apiScene());
    return model;
}

SpotMap::SpotMap()
{
    picture = {16, 8, std::vector(128, glm::vec3(0.25F, 0.5F, 1.0F))};
    picture.texels[37] = glm::vec3(40.0F, 30.0F, 10.0F);
    for (const glm::vec3& texel : picture.texels)
    {
        texels.push_back({texel.x, texel.y, texel.z});
    }
}

DeviceEnvironment engineSky()
{
    DeviceEnvironment sky(device().device());
    const TraceOptions plain;
    sky.setSun(daylight(plain.to_sun)); // as `zvo render`
    return sky;
}

std::unique_ptr<EmbeddingHost> ApiPaths::s_host;

void ApiPaths::SetUpTestSuite()
{
    failCall(UINT64_MAX);
    HostOptions options;
    options.zvo_functions = failingVulkan();
    options.optional.pass_times = true;
    s_host = std::make_unique<EmbeddingHost>(options, [](ContextInfo& info) { info.timed_passes_per_frame = 300; });
}

ApiPaths::~ApiPaths()
{
    failCall(UINT64_MAX);
    m_host.submits_failed = false;
}

Tree ApiPaths::octree(std::uint32_t depth)
{
    return m_host.build(m_host.upload(pathModel().info()), {.grid = apiGrid(depth)});
}

} // namespace zvo::test
