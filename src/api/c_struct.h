// SPDX-License-Identifier: MIT
// Reading and filling structs of the C interface, whose sizes tell their versions.
#pragma once

#include "api/c_guard.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace zvo
{

/// A struct with the values of its ZVO_..._INIT.
template <typename Struct> Struct initial();

// Members fill structs to the end: else members that are added would lie in what older hosts never wrote.
#define ZVO_C_STRUCT(Struct, last, init)                                                                               \
    template <> inline Struct initial<Struct>()                                                                        \
    {                                                                                                                  \
        return init;                                                                                                   \
    }                                                                                                                  \
    static_assert(offsetof(Struct, struct_size) == 0 && std::is_standard_layout_v<Struct>);                            \
    static_assert(offsetof(Struct, last) + sizeof(Struct::last) == sizeof(Struct))

ZVO_C_STRUCT(ZvoOptionalFeatures, reserved, ZVO_OPTIONAL_FEATURES_INIT);
ZVO_C_STRUCT(ZvoDeviceInfo, reserved, ZVO_DEVICE_INFO_INIT);
ZVO_C_STRUCT(ZvoContextInfo, tuning, ZVO_CONTEXT_INFO_INIT);
ZVO_C_STRUCT(ZvoMemoryUse, peak_held, ZVO_MEMORY_USE_INIT);
ZVO_C_STRUCT(ZvoPassTime, ms, ZVO_PASS_TIME_INIT);
ZVO_C_STRUCT(ZvoTextureInfo, wrap_v, ZVO_TEXTURE_INFO_INIT);
ZVO_C_STRUCT(ZvoMaterialInfo, reserved, ZVO_MATERIAL_INFO_INIT);
ZVO_C_STRUCT(ZvoMeshInfo, reserved, ZVO_MESH_INFO_INIT);
ZVO_C_STRUCT(ZvoInstanceInfo, reserved, ZVO_INSTANCE_INFO_INIT);
ZVO_C_STRUCT(ZvoModelInfo, emission_scale, ZVO_MODEL_INFO_INIT);
ZVO_C_STRUCT(ZvoModelStats, reserved, ZVO_MODEL_STATS_INIT);
ZVO_C_STRUCT(ZvoTreeInfo, bytes, ZVO_TREE_INFO_INIT);
ZVO_C_STRUCT(ZvoTreeBuildInfo, keep_sums, ZVO_TREE_BUILD_INFO_INIT);
ZVO_C_STRUCT(ZvoDroppedTriangles, zero_area, ZVO_DROPPED_TRIANGLES_INIT);
ZVO_C_STRUCT(ZvoDynamicTreeInfo, edit_bytes, ZVO_DYNAMIC_TREE_INFO_INIT);
ZVO_C_STRUCT(ZvoBrushInfo, reserved, ZVO_BRUSH_INFO_INIT);
ZVO_C_STRUCT(ZvoUpdateStats, reserved, ZVO_UPDATE_STATS_INIT);
ZVO_C_STRUCT(ZvoSunInfo, irradiance, ZVO_SUN_INFO_INIT);
ZVO_C_STRUCT(ZvoEnvironmentMapInfo, reserved, ZVO_ENVIRONMENT_MAP_INFO_INIT);
ZVO_C_STRUCT(ZvoCameraInfo, reserved, ZVO_CAMERA_INFO_INIT);
ZVO_C_STRUCT(ZvoTraceInfo, reserved, ZVO_TRACE_INFO_INIT);
ZVO_C_STRUCT(ZvoPathInfo, history_max, ZVO_PATH_INFO_INIT);
ZVO_C_STRUCT(ZvoImageTarget, extent, ZVO_IMAGE_TARGET_INIT);
ZVO_C_STRUCT(ZvoDepthTarget, reserved, ZVO_DEPTH_TARGET_INIT);
ZVO_C_STRUCT(ZvoKeptLightInfo, height, ZVO_KEPT_LIGHT_INFO_INIT);
ZVO_C_STRUCT(ZvoKeptFrameInfo, seed, ZVO_KEPT_FRAME_INFO_INIT);
ZVO_C_STRUCT(ZvoKeptPictureInfo, exposure, ZVO_KEPT_PICTURE_INFO_INIT);
ZVO_C_STRUCT(ZvoKeptLightStats, refused, ZVO_KEPT_LIGHT_STATS_INIT);

#undef ZVO_C_STRUCT

/// No struct will ever be larger. A size that a host forgot to set is larger in most cases.
inline constexpr std::size_t kStructBytesMax = 4096;

/// Sizes of structs are multiples of this.
inline constexpr std::size_t kMemberBytes = 4;

/// The size that a host gave a struct. Throws Error{Usage} for null and for a size that no version of the struct can
/// have.
template <typename Struct> std::size_t sizeOf(const Struct* given, const char* name)
{
    std::size_t size = 0;
    std::memcpy(&size, &at(given, name), sizeof(size));
    if (size < sizeof(size) || size > kStructBytesMax || size % kMemberBytes != 0)
    {
        throw Error(ErrorCode::Usage, std::string(name) + " has no struct_size, but " + std::to_string(size) +
                                          ": begin with ZVO_..._INIT");
    }
    return size;
}

/// A copy of a host's struct, with defaults for members that the host does not know. Throws Error{Usage} for null, for
/// a size that is not valid, and for members that must be 0 and are not: reserved ones, and those that this version
/// does not know.
template <typename Struct> Struct readStruct(const Struct* given, const char* name)
{
    const std::size_t size = sizeOf(given, name);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
    for (std::size_t i = sizeof(Struct); i < size; ++i)
    {
        if (bytes[i] != 0)
        {
            throw Error(ErrorCode::Usage, std::string(name) + " has members that this library, version " +
                                              std::to_string(ZVO_VERSION) + ", does not know");
        }
    }
    Struct result = initial<Struct>();
    std::memcpy(&result, given, std::min(size, sizeof(Struct)));
    result.struct_size = sizeof(Struct);
    if constexpr (requires { result.reserved; })
    {
        if (result.reserved != 0)
        {
            throw Error(ErrorCode::Usage, std::string(name) + " has a reserved member that is not 0");
        }
    }
    return result;
}

/// The elements of a host's array.
template <typename Struct> std::vector<Struct> readStructs(const Struct* given, std::size_t count, const char* name)
{
    std::vector<Struct> result;
    const std::size_t stride = count == 0 ? 0 : sizeOf(given, name);
    if (stride != 0 && count > PTRDIFF_MAX / stride)
    {
        throw Error(ErrorCode::Usage,
                    std::string(name) + " has more elements than any memory: " + std::to_string(count));
    }
    for (std::size_t i = 0; i < count; ++i)
    {
        const auto* const element =
            reinterpret_cast<const Struct*>(reinterpret_cast<const unsigned char*>(given) + i * stride);
        if (sizeOf(element, name) != stride)
        {
            throw Error(ErrorCode::Usage, std::string(name) + " has elements of several sizes");
        }
        result.push_back(readStruct(element, name));
    }
    return result;
}

/// Fills as much of a host's struct as the host knows. Throws as sizeOf().
template <typename Struct> void writeStruct(Struct* out, const char* name, const Struct& value)
{
    const std::size_t size = sizeOf(out, name);
    auto* const bytes = reinterpret_cast<unsigned char*>(out);
    const std::size_t known = std::min(size, sizeof(Struct));
    std::memcpy(bytes + sizeof(size), reinterpret_cast<const unsigned char*>(&value) + sizeof(size),
                known - sizeof(size));
    std::memset(bytes + known, 0, size - known);
}

} // namespace zvo
