// SPDX-License-Identifier: MIT
// Scenes of the tests as a host describes them.
#pragma once

#include "core/scene/scene.h"
#include "zvo/model.h"

#include <vector>

namespace zvo::test
{

/// What zvo::Model takes for a scene at rest.
class HostModel
{
public:
    explicit HostModel(Scene scene);
    HostModel(const HostModel&) = delete;
    HostModel& operator=(const HostModel&) = delete;

    [[nodiscard]] ModelInfo info() const;

private:
    Scene m_scene; // that the others refer to
    std::vector<MeshInfo> m_meshes;
    std::vector<InstanceInfo> m_instances;
    std::vector<MaterialInfo> m_materials;
    std::vector<TextureInfo> m_textures;
};

} // namespace zvo::test
