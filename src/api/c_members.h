// SPDX-License-Identifier: MIT
// The structs of the C interface: their defaults, their members, and what these are called in C++.
#pragma once

#include "zvo/zvo.h"
#include "zvo/zvo.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

namespace zvo
{

/// What the library knows of a struct of the C interface.
template <typename Struct> struct CStruct;

/// The bytes of all members that the table below has of a struct, with its size and what is reserved.
template <typename Struct> constexpr std::size_t bytesOfMembers()
{
    Struct it = CStruct<Struct>::initial();
    std::size_t bytes = std::apply([](const auto&... member) { return (std::size_t{0} + ... + sizeof(member)); },
                                   std::tuple_cat(CStruct<Struct>::sharedOf(it), CStruct<Struct>::ownOf(it)));
    if constexpr (requires { it.struct_size; })
    {
        static_assert(offsetof(Struct, struct_size) == 0 && std::is_standard_layout_v<Struct>);
        bytes += sizeof(it.struct_size);
    }
    if constexpr (requires { it.reserved; })
    {
        bytes += sizeof(it.reserved);
    }
    return bytes;
}

// Cpp: the type of the C++ interface with the same contents. shared: the members that both have under one name. own:
// the others of the struct in C. A table that lacks a member does not compile, nor does a struct with gaps: what is
// added at the end would else lie in what older hosts never wrote.
#define ZVO_C_STRUCT(Struct, Cpp, init, shared, own)                                                                   \
    template <> struct CStruct<Struct>                                                                                 \
    {                                                                                                                  \
        using InCpp = Cpp;                                                                                             \
        static constexpr Struct initial() { return init; }                                                             \
        static constexpr auto sharedOf([[maybe_unused]] auto& it) { return std::tie shared; }                          \
        static constexpr auto ownOf([[maybe_unused]] auto& it) { return std::tie own; }                                \
    };                                                                                                                 \
    static_assert(bytesOfMembers<Struct>() == sizeof(Struct))

using DroppedTriangles = std::map<std::string, std::uint64_t>;

ZVO_C_STRUCT(ZvoGrid, GridInfo, ZVO_GRID_INIT, (it.origin, it.voxel_size, it.depth), ());
ZVO_C_STRUCT(ZvoCameraRays, CameraRays, {}, (it.origin, it.forward, it.half_pixel_x, it.half_pixel_y), ());
ZVO_C_STRUCT(ZvoOptionalFeatures, OptionalFeatures, ZVO_OPTIONAL_FEATURES_INIT,
             (it.pass_times, it.subgroup_sizes, it.int64_atomics), ());
ZVO_C_STRUCT(ZvoDeviceInfo, DeviceReport, ZVO_DEVICE_INFO_INIT,
             (it.physical_device, it.name, it.driver, it.type, it.api_version, it.memory_bytes, it.max_buffer_bytes,
              it.subgroup_size, it.min_subgroup_size, it.max_subgroup_size, it.queue_family, it.timestamp_period_ns,
              it.timestamp_valid_bits),
             (it.usable));
ZVO_C_STRUCT(ZvoContextInfo, ContextInfo, ZVO_CONTEXT_INFO_INIT,
             (it.get_instance_proc_addr, it.instance, it.physical_device, it.device, it.queue_family,
              it.instance_api_version, it.enabled_features, it.enabled_core_features, it.allocation_callbacks,
              it.pipeline_cache, it.memory, it.memory_budget_bytes, it.timed_passes_per_frame, it.subgroup_size, it.up),
             (it.instance_extensions, it.device_extensions, it.instance_extension_count, it.device_extension_count,
              it.log, it.tuning));
ZVO_C_STRUCT(ZvoMemoryUse, MemoryUse, ZVO_MEMORY_USE_INIT, (it.used, it.held, it.peak_held), ());
ZVO_C_STRUCT(ZvoPassTime, PassTime, ZVO_PASS_TIME_INIT, (it.name, it.ms), ());
ZVO_C_STRUCT(ZvoTextureInfo, TextureInfo, ZVO_TEXTURE_INFO_INIT, (it.width, it.height, it.wrap_u, it.wrap_v),
             (it.rgba, it.rgba_bytes));
ZVO_C_STRUCT(ZvoMaterialInfo, MaterialInfo, ZVO_MATERIAL_INFO_INIT,
             (it.base_color, it.base_color_texture, it.emission, it.emission_texture, it.alpha_mode, it.alpha_cutoff),
             ());
ZVO_C_STRUCT(ZvoMeshInfo, MeshInfo, ZVO_MESH_INFO_INIT, (it.material),
             (it.positions, it.normals, it.uvs, it.colors, it.vertex_count, it.triangles, it.triangle_count));
ZVO_C_STRUCT(ZvoInstanceInfo, InstanceInfo, ZVO_INSTANCE_INFO_INIT, (it.transform, it.mesh), ());
ZVO_C_STRUCT(ZvoModelInfo, ModelInfo, ZVO_MODEL_INFO_INIT, (it.attributes),
             (it.meshes, it.instances, it.materials, it.textures, it.mesh_count, it.instance_count, it.material_count,
              it.texture_count, it.emission_scale));
ZVO_C_STRUCT(ZvoModelStats, Model, ZVO_MODEL_STATS_INIT, (), (it.triangle_count, it.emission_scale));
ZVO_C_STRUCT(ZvoTreeInfo, TreeInfo, ZVO_TREE_INFO_INIT,
             (it.structure, it.format, it.grid, it.emission_scale, it.voxel_count, it.node_count, it.bytes), ());
ZVO_C_STRUCT(ZvoTreeBuildInfo, TreeBuildInfo, ZVO_TREE_BUILD_INFO_INIT,
             (it.grid, it.coverage, it.format, it.keep_sums, it.fill, it.shell), ());
ZVO_C_STRUCT(ZvoTreeAlgebraInfo, TreeAlgebraInfo, ZVO_TREE_ALGEBRA_INFO_INIT,
             (it.operation, it.corners, it.voxels, it.largest, it.least_voxels), ());
ZVO_C_STRUCT(ZvoDroppedTriangles, DroppedTriangles, ZVO_DROPPED_TRIANGLES_INIT, (),
             (it.nonfinite, it.out_of_range, it.outside, it.zero_area));
ZVO_C_STRUCT(ZvoDynamicTreeInfo, DynamicTreeInfo, ZVO_DYNAMIC_TREE_INFO_INIT,
             (it.coverage, it.merge, it.frames_in_flight, it.emission_scale, it.history_entries, it.history_bytes,
              it.strokes, it.edit_bytes),
             ());
ZVO_C_STRUCT(ZvoDynamicObjectInfo, DynamicObjectInfo, ZVO_DYNAMIC_OBJECT_INFO_INIT, (it.carves, it.fill), ());
ZVO_C_STRUCT(ZvoBrushInfo, BrushInfo, ZVO_BRUSH_INFO_INIT,
             (it.shape, it.action, it.center, it.radius, it.color, it.emission), ());
ZVO_C_STRUCT(ZvoUpdateStats, UpdateStats, ZVO_UPDATE_STATS_INIT,
             (it.node_count, it.voxel_count, it.moving_count, it.failed),
             (it.dropped_nonfinite, it.dropped_out_of_range, it.dropped_outside, it.dropped_zero_area));
ZVO_C_STRUCT(ZvoSunInfo, SunInfo, ZVO_SUN_INFO_INIT, (it.direction, it.irradiance), ());
ZVO_C_STRUCT(ZvoEnvironmentMapInfo, EnvironmentMapInfo, ZVO_ENVIRONMENT_MAP_INFO_INIT,
             (it.width, it.height, it.turn, it.strength, it.background_blur), (it.texels));
ZVO_C_STRUCT(ZvoCameraInfo, CameraInfo, ZVO_CAMERA_INFO_INIT,
             (it.position, it.forward, it.up, it.vertical_fov, it.half_height, it.orthographic, it.mirrored, it.aspect,
              it.shift),
             ());
ZVO_C_STRUCT(ZvoTraceInfo, TraceInfo, ZVO_TRACE_INFO_INIT,
             (it.to_sun, it.view, it.shadows, it.sun, it.exposure, it.occlusion_rays, it.occlusion_reach,
              it.detail_pixels, it.shading),
             ());
ZVO_C_STRUCT(ZvoPathInfo, PathInfo, ZVO_PATH_INFO_INIT,
             (it.bounces, it.seed, it.lens_radius, it.focus_distance, it.roulette, it.automatic_exposure, it.exposure,
              it.samples, it.denoise, it.history_max, it.shading),
             ());
ZVO_C_STRUCT(ZvoImageTarget, ImageTarget, ZVO_IMAGE_TARGET_INIT,
             (it.image, it.format, it.layout, it.offset, it.mip_level, it.array_layer, it.extent), ());
ZVO_C_STRUCT(ZvoDepthTarget, DepthTarget, ZVO_DEPTH_TARGET_INIT, (it.view_projection, it.miss), (it.image));
ZVO_C_STRUCT(ZvoRadianceCacheInfo, RadianceCacheInfo, ZVO_RADIANCE_CACHE_INFO_INIT, (it.faces, it.width, it.height),
             ());
ZVO_C_STRUCT(ZvoCachedFrameInfo, CachedFrameInfo, ZVO_CACHED_FRAME_INFO_INIT, (it.rays, it.seed), ());
ZVO_C_STRUCT(ZvoCachedPictureInfo, CachedPictureInfo, ZVO_CACHED_PICTURE_INFO_INIT,
             (it.automatic_exposure, it.exposure, it.shading), ());
ZVO_C_STRUCT(ZvoRadianceCacheStats, RadianceCacheStats, ZVO_RADIANCE_CACHE_STATS_INIT,
             (it.faces, it.refused, it.room, it.is_crowded), ());

#undef ZVO_C_STRUCT

/// Calls visit with each member that two structs share: the first one's, and the second one's. Struct: the one of the C
/// interface.
template <typename Struct, typename First, typename Second, typename Visit>
void eachShared(First& first, Second& second, const Visit& visit)
{
    const auto firsts = CStruct<Struct>::sharedOf(first);
    const auto seconds = CStruct<Struct>::sharedOf(second);
    [&]<std::size_t... kIndices>(std::index_sequence<kIndices...>)
    {
        (visit(std::get<kIndices>(firsts), std::get<kIndices>(seconds)), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(firsts)>>());
}

} // namespace zvo
