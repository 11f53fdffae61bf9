// SPDX-License-Identifier: MIT
#include "common/environment_input.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/words.h"
#include "core/base/read_file.h"
#include "core/path/daylight.h"
#include "io/image/hdr_image_io.h"

#include <fmt/format.h>

#include <numbers>
#include <string>
#include <vector>

namespace zvo::cli
{

namespace
{

// Of "none", a map without light.
HdrImage readMap(const std::filesystem::path& file)
{
    if (file == "none")
    {
        return {1, 1, {glm::vec3(0.0F)}};
    }
    std::vector<std::string> warnings;
    HdrImage map = decodeHdrImage(readFile(file), file.string(), warnings);
    for (const std::string& warning : warnings)
    {
        talk("warning: " + warning);
    }
    return map;
}

// Limits a map, so that its light stays in range when it is multiplied by strength.
void limit(HdrImage& map, float strength)
{
    const float most = kRadianceMax / strength;
    std::uint64_t count = 0; // of brighter texels
    for (glm::vec3& texel : map.texels)
    {
        const glm::vec3 limited = glm::min(texel, most);
        count += limited == texel ? 0 : 1;
        texel = limited;
    }
    if (count != 0)
    {
        talk(fmt::format("warning: --environment-strength {:g} brings {} of the map above {:g}; they are taken as that",
                         strength, counted(count, "texel"), kRadianceMax));
    }
}

} // namespace

DeviceEnvironment readEnvironment(vk::Device& device, const EnvironmentOptions& asked,
                                  const std::optional<glm::dvec3>& to_sun)
{
    const Sun sun = to_sun ? daylight(*to_sun) : daylight();
    if (!asked.map)
    {
        DeviceEnvironment environment(device);
        environment.setSun(sun);
        return environment;
    }
    HdrImage map = readMap(*asked.map);
    limit(map, asked.strength);
    DeviceEnvironment environment(device, map, asked.turn * std::numbers::pi / 180.0, double{asked.strength});
    if (asked.background_blur > 0.0F)
    {
        environment.setBackground(
            device, blurredMap(map.width, map.height, map.texels, glm::radians(double{asked.background_blur})));
    }
    if (to_sun)
    {
        environment.setSun(sun);
    }
    return environment;
}

bool isEnvironmentFile(const std::filesystem::path& path)
{
    const std::string extension = extensionOf(path.string());
    return extension == ".hdr" || extension == ".exr";
}

} // namespace zvo::cli
