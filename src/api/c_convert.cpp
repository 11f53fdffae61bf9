// SPDX-License-Identifier: MIT
#include "api/c_convert.h"

#include <array>
#include <cstdint>
#include <span>

namespace zvo
{

namespace
{

// A span of To over an array of From; each To consists of a few From.
template <typename To, typename From> std::span<const To> spanOf(const From* first, std::size_t count, const char* name)
{
    static_assert(sizeof(To) % sizeof(From) == 0 && alignof(To) == alignof(From));
    if (count == 0)
    {
        return {};
    }
    requireCount(count, sizeof(To), name);
    return {reinterpret_cast<const To*>(&at(first, name)), count};
}

template <typename To, typename From>
std::span<const To> optionalSpanOf(const From* first, std::size_t count, const char* name)
{
    return first == nullptr ? std::span<const To>() : spanOf<To>(first, count, name);
}

template <typename To, typename From> std::vector<To> eachOfC(const From* first, std::size_t count, const char* name)
{
    std::vector<To> result;
    for (const From& element : readStructs(first, count, name))
    {
        result.push_back(ofC(element));
    }
    return result;
}

std::uint64_t countOf(const DroppedTriangles& dropped, const char* reason)
{
    const auto found = dropped.find(reason);
    return found == dropped.end() ? 0 : found->second;
}

} // namespace

void assignOwn(ContextInfo& to, const ZvoContextInfo& from)
{
    to.instance_extensions = spanOf<const char*>(from.instance_extensions, from.instance_extension_count,
                                                 "ZvoContextInfo::instance_extensions");
    to.device_extensions =
        spanOf<const char*>(from.device_extensions, from.device_extension_count, "ZvoContextInfo::device_extensions");
    to.tuning = from.tuning != nullptr ? from.tuning : "";
}

void assignOwn(TextureInfo& to, const ZvoTextureInfo& from)
{
    to.rgba = spanOf<std::uint8_t>(from.rgba, from.rgba_bytes, "ZvoTextureInfo::rgba");
}

void assignOwn(MeshInfo& to, const ZvoMeshInfo& from)
{
    to.positions = spanOf<Vec3>(from.positions, from.vertex_count, "ZvoMeshInfo::positions");
    to.normals = optionalSpanOf<Vec3>(from.normals, from.vertex_count, "ZvoMeshInfo::normals");
    to.uvs = optionalSpanOf<Vec2>(from.uvs, from.vertex_count, "ZvoMeshInfo::uvs");
    to.colors = optionalSpanOf<Vec4>(from.colors, from.vertex_count, "ZvoMeshInfo::colors");
    to.triangles = spanOf<std::array<std::uint32_t, 3>>(from.triangles, from.triangle_count, "ZvoMeshInfo::triangles");
}

void assignOwn(EnvironmentMapInfo& to, const ZvoEnvironmentMapInfo& from)
{
    to.texels = spanOf<Vec3>(from.texels, std::size_t{from.width} * from.height, "ZvoEnvironmentMapInfo::texels");
}

void assignOwn(DepthTarget& to, const ZvoDepthTarget& from)
{
    to.image = read(from.image, "ZvoDepthTarget::image");
}

void assignOwn(ZvoDeviceInfo& to, const DeviceReport& from)
{
    assignMember(to.usable, from.usable());
}

void assignOwn(ZvoModelStats& to, const Model& from)
{
    to.triangle_count = from.triangleCount();
    to.emission_scale = from.emissionScale();
}

void assignOwn(ZvoDroppedTriangles& to, const DroppedTriangles& from)
{
    to.nonfinite = countOf(from, "nonfinite");
    to.out_of_range = countOf(from, "out_of_range");
    to.outside = countOf(from, "outside");
    to.zero_area = countOf(from, "zero_area");
}

void assignOwn(ZvoUpdateStats& to, const UpdateStats& from)
{
    to.dropped_nonfinite = countOf(from.dropped, "nonfinite");
    to.dropped_out_of_range = countOf(from.dropped, "out_of_range");
    to.dropped_outside = countOf(from.dropped, "outside");
    to.dropped_zero_area = countOf(from.dropped, "zero_area");
}

ModelOfC::ModelOfC(const ZvoModelInfo& info)
    : m_meshes(eachOfC<MeshInfo>(info.meshes, info.mesh_count, "ZvoModelInfo::meshes")),
      m_instances(eachOfC<InstanceInfo>(info.instances, info.instance_count, "ZvoModelInfo::instances")),
      m_materials(eachOfC<MaterialInfo>(info.materials, info.material_count, "ZvoModelInfo::materials")),
      m_textures(eachOfC<TextureInfo>(info.textures, info.texture_count, "ZvoModelInfo::textures")), m_info(ofC(info))
{
    m_info.meshes = m_meshes;
    m_info.instances = m_instances;
    m_info.materials = m_materials;
    m_info.textures = m_textures;
    if (!(info.emission_scale < 0))
    {
        m_info.emission_scale = info.emission_scale;
    }
}

} // namespace zvo
