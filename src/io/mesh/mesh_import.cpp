// SPDX-License-Identifier: MIT
#include "io/mesh/mesh_import.h"

#include "core/base/input_error.h"
#include "core/scene/scene_size.h"
#include "io/mesh/obj_file.h"
#include "io/mesh/ply_file.h"
#include "io/mesh/stl_file.h"

#include <string>
#include <vector>

namespace zvo
{

Scene importMesh(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, MeshFormat format,
                 ImageDecoding decoding)
{
    if (format == MeshFormat::Obj)
    {
        return readObj(path, bytes, decoding);
    }
    std::vector<std::string> notes;
    Scene scene;
    scene.primitives.push_back(format == MeshFormat::Ply ? readPly(path, bytes, notes) : readStl(path, bytes));
    const Primitive& primitive = scene.primitives.front();
    checkSceneSize(path, {.instance_count = 1,
                          .triangle_count = static_cast<double>(primitive.triangles.size()),
                          .vertex_count = static_cast<double>(primitive.positions.size())});
    scene.materials.emplace_back().name = "default";
    scene.instances.emplace_back();
    for (const std::string& note : notes)
    {
        scene.warnings.emplace_back(inputError(path, note).what());
    }
    return scene;
}

} // namespace zvo
