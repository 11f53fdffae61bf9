// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_rig_source.h"

#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_schema.h"

#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace zvo
{

namespace
{

using nlohmann::json;

GltfAnimationSource readAnimation(const json& source, const std::string& where, const std::filesystem::path& path)
{
    const json& samplers = source["samplers"];
    GltfAnimationSource animation;
    animation.name = source.value("name", std::string());
    for (const json& item : source["channels"])
    {
        const auto wanted = item["sampler"].get<std::uint64_t>();
        if (wanted >= samplers.size())
        {
            throw gltfError(path, fmt::format("{}.channels[{}].sampler is {}, but the animation has {} samplers; {}",
                                              where, animation.channels.size(), wanted, samplers.size(), kExportAgain));
        }
        const json& sampler = samplers[wanted];
        const json& target = item["target"];
        animation.channels.push_back({.node = target.value("node", -1),
                                      .path = target["path"].get<std::string>(),
                                      .interpolation = sampler.value("interpolation", std::string("LINEAR")),
                                      .input = sampler["input"].get<int>(),
                                      .output = sampler["output"].get<int>()});
    }
    return animation;
}

} // namespace

std::vector<GltfSkinSource> listGltfSkins(const json& root)
{
    std::vector<GltfSkinSource> skins;
    for (const json& skin : gltfItems(root, "skins"))
    {
        skins.push_back({skin["joints"].get<std::vector<int>>(), skin.value("inverseBindMatrices", -1)});
    }
    return skins;
}

std::vector<GltfAnimationSource> listGltfAnimations(const json& root, const std::filesystem::path& path)
{
    std::vector<GltfAnimationSource> animations;
    for (const json& animation : gltfItems(root, "animations"))
    {
        animations.push_back(readAnimation(animation, fmt::format("animations[{}]", animations.size()), path));
    }
    return animations;
}

} // namespace zvo
