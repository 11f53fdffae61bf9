// SPDX-License-Identifier: MIT
// Converts structs of the C interface, which readStruct() has completed, to those of the C++ interface, and back. All
// functions throw Error{Usage} for values that an enumeration does not have, and for arrays that are null but not
// empty.
#pragma once

#include "zvo/zvo.h"
#include "zvo/zvo.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The C++ ModelInfo of a C one, with the arrays that it refers to. Vertices stay the host's.
class ModelOfC
{
public:
    explicit ModelOfC(const ZvoModelInfo& info);
    ModelOfC(const ModelOfC&) = delete;
    ModelOfC& operator=(const ModelOfC&) = delete;

    [[nodiscard]] const ModelInfo& info() const { return m_info; }

private:
    std::vector<MeshInfo> m_meshes;
    std::vector<InstanceInfo> m_instances;
    std::vector<MaterialInfo> m_materials;
    std::vector<TextureInfo> m_textures;
    ModelInfo m_info;
};

/// Converts everything but memory and log, which are functions of other types.
ContextInfo ofC(const ZvoContextInfo& info);
OptionalFeatures ofC(const ZvoOptionalFeatures& features);
TextureInfo ofC(const ZvoTextureInfo& info);
MaterialInfo ofC(const ZvoMaterialInfo& info);
MeshInfo ofC(const ZvoMeshInfo& info);
InstanceInfo ofC(const ZvoInstanceInfo& info);
GridInfo ofC(const ZvoGrid& grid);
TreeBuildInfo ofC(const ZvoTreeBuildInfo& info);
DynamicTreeInfo ofC(const ZvoDynamicTreeInfo& info);
BrushInfo ofC(const ZvoBrushInfo& info);
SunInfo ofC(const ZvoSunInfo& info);
EnvironmentMapInfo ofC(const ZvoEnvironmentMapInfo& map);
CameraInfo ofC(const ZvoCameraInfo& info);
TraceInfo ofC(const ZvoTraceInfo& info);
PathInfo ofC(const ZvoPathInfo& info);
ImageTarget ofC(const ZvoImageTarget& target);
DepthTarget ofC(const ZvoDepthTarget& target);
KeptLightInfo ofC(const ZvoKeptLightInfo& info);
KeptFrameInfo ofC(const ZvoKeptFrameInfo& info);
KeptPictureInfo ofC(const ZvoKeptPictureInfo& info);

ZvoDeviceInfo toC(const DeviceReport& report); // texts are the report's
ZvoMemoryUse toC(const MemoryUse& use);
ZvoPassTime toC(const PassTime& time); // the name is time's
ZvoGrid toC(const GridInfo& grid);
ZvoTreeInfo toC(const TreeInfo& info);
ZvoUpdateStats toC(const UpdateStats& info);
ZvoDroppedTriangles toC(const std::map<std::string, std::uint64_t>& dropped);
ZvoCameraInfo toC(const CameraInfo& info);
ZvoCameraRays toC(const CameraRays& rays);
ZvoKeptLightStats toC(const KeptLightStats& stats);

} // namespace zvo
