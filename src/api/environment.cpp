// SPDX-License-Identifier: MIT
#include "zvo/light.h"

#include "api/checked.h"
#include "api/convert.h"
#include "api/environment_impl.h"
#include "core/path/daylight.h"

namespace zvo
{

namespace
{

static_assert(sizeof(Vec3) == sizeof(glm::vec3) && alignof(Vec3) == alignof(glm::vec3));

DeviceEnvironment uploaded(vk::Uploader& uploads, const EnvironmentMapInfo& map, const glm::dvec3& up)
{
    const std::span texels(reinterpret_cast<const glm::vec3*>(map.texels.data()), map.texels.size());
    DeviceEnvironment light(uploads, map.width, map.height, texels, map.turn, double{map.strength});
    light.setUp(up);
    if (map.background_blur > 0.0F)
    {
        light.setBackground(uploads.device(), blurredMap(map.width, map.height, texels, double{map.background_blur}));
    }
    return light;
}

Sun sunOf(const SunInfo& info)
{
    return {.direction = toGlm(info.direction), .irradiance = toGlm(info.irradiance)};
}

} // namespace

Environment::Environment(Recorder& recorder)
{
    recording(recorder,
              [&](Recorder::Impl& impl)
              {
                  m_impl = std::make_unique<Impl>(impl, DeviceEnvironment(impl.context.device));
                  m_impl->light.setUp(impl.context.up);
                  m_impl->light.setSun(sunOf({}));
                  m_impl->light.prepare(impl.graph);
              });
}

Environment::Environment(Recorder& recorder, const EnvironmentMapInfo& map)
{
    checked(map);
    recording(recorder,
              [&](Recorder::Impl& impl)
              {
                  vk::RecordedUploads& uploads = impl.context.uploads;
                  m_impl = std::make_unique<Impl>(impl, uploaded(uploads, map, impl.context.up));
                  uploads.flush();
                  m_impl->light.prepare(impl.graph);
              });
}

SunInfo sunlight(const DVec3& direction, const DVec3& up)
{
    const SunInfo asked = {.direction = direction};
    const Sun sun = daylight(toGlm(checked(asked).direction), checkedUp(up, "up"));
    return {direction, {sun.irradiance.x, sun.irradiance.y, sun.irradiance.z}};
}

Environment::~Environment() = default;
Environment::Environment(Environment&&) noexcept = default;
Environment& Environment::operator=(Environment&&) noexcept = default;

void Environment::setSun(const SunInfo& sun)
{
    usable(*this).light.setSun(sunOf(checked(sun)));
}

} // namespace zvo
