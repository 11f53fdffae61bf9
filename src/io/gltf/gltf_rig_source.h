// SPDX-License-Identifier: MIT
// Skins and animations as a document names them; gltf_rig.h puts them into a scene.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace zvo
{

struct GltfSkinSource
{
    std::vector<int> joints; // nodes
    int inverse_bind = -1;   // accessor, or -1: identities
};

/// A channel together with its sampler.
struct GltfChannelSource
{
    int node = -1; // or -1: moves what an extension names
    std::string path;
    std::string interpolation;
    int input = 0;  // accessor
    int output = 0; // accessor
};

struct GltfAnimationSource
{
    std::string name;
    std::vector<GltfChannelSource> channels;
};

/// All skins of root, a document's JSON that is checked by checkGltfSchema().
std::vector<GltfSkinSource> listGltfSkins(const nlohmann::json& root);

/// All animations of root. Throws Error{Input} for a channel whose sampler is not there.
std::vector<GltfAnimationSource> listGltfAnimations(const nlohmann::json& root, const std::filesystem::path& path);

} // namespace zvo
