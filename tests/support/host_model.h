// SPDX-License-Identifier: MIT
// Scenes of the tests as descriptions that a host would make.
#pragma once

#include "core/scene/scene.h"
#include "zvo/model.h"

#include <vector>

namespace zvo::test
{

/// The zvo::ModelInfo of a scene at rest, with the arrays that it points to.
class HostModel
{
public:
    explicit HostModel(Scene scene);
    HostModel(const HostModel&) = delete;
    HostModel& operator=(const HostModel&) = delete;

    [[nodiscard]] ModelInfo info() const;

private:
    Scene m_scene; // the others refer to it
    std::vector<MeshInfo> m_meshes;
    std::vector<InstanceInfo> m_instances;
    std::vector<MaterialInfo> m_materials;
    std::vector<TextureInfo> m_textures;
};

} // namespace zvo::test
