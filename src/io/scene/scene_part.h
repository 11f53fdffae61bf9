// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <string>
#include <vector>

namespace zvo
{

/// The instances of scene for which keep [instances] is set, in order, with the primitives, materials, textures and
/// images that they need. Cameras, nodes, skins, animations and warnings are all kept.
Scene partOf(const Scene& scene, const std::vector<bool>& keep);
Scene partOf(Scene&& scene, const std::vector<bool>& keep);

/// The meshes as they were modelled, without anything that could move them: no nodes, skins, animations and morph
/// targets.
Scene asModelled(Scene scene);

/// The scene at rest, without what could move it: skins and the weights of morph targets are applied, animations are
/// not. Throws as posedScene().
Scene atRest(Scene scene);

/// Leaves out what has materials with certain names.
class SkippedMaterials
{
public:
    /// patterns: of names, as in a shell: *, ? and [...].
    explicit SkippedMaterials(std::vector<std::string> patterns);

    /// Leaves out the instances whose material has a name that matches a pattern.
    void leaveOut(Scene& scene);

    /// A line for each pattern that no material of any scene so far has matched.
    [[nodiscard]] std::vector<std::string> warnings() const;

private:
    std::vector<std::string> m_patterns;
    std::vector<bool> m_found; // by pattern
};

} // namespace zvo
