// SPDX-License-Identifier: MIT
#include "api/c_convert.h"

#include "api/c_struct.h"
#include "api/checked.h"

#include <algorithm>
#include <array>

namespace zvo
{

namespace
{

#define ZVO_SAME(constant, value) static_assert(static_cast<int>(constant) == static_cast<int>(value))
ZVO_SAME(ZVO_ERROR_OTHER, ErrorCode::Other);
ZVO_SAME(ZVO_ERROR_USAGE, ErrorCode::Usage);
ZVO_SAME(ZVO_ERROR_INPUT, ErrorCode::Input);
ZVO_SAME(ZVO_ERROR_OUTPUT, ErrorCode::Output);
ZVO_SAME(ZVO_ERROR_DEVICE, ErrorCode::Device);
ZVO_SAME(ZVO_ERROR_MEMORY, ErrorCode::Memory);
ZVO_SAME(ZVO_LOG_DEBUG, LogSeverity::Debug);
ZVO_SAME(ZVO_LOG_INFO, LogSeverity::Info);
ZVO_SAME(ZVO_LOG_WARNING, LogSeverity::Warning);
ZVO_SAME(ZVO_COVERAGE_CONSERVATIVE, Coverage::Conservative);
ZVO_SAME(ZVO_COVERAGE_THIN, Coverage::Thin);
ZVO_SAME(ZVO_TREE_STRUCTURE_SVO, TreeStructure::Svo);
ZVO_SAME(ZVO_TREE_STRUCTURE_SVDAG, TreeStructure::Svdag);
ZVO_SAME(ZVO_ATTRIBUTE_FORMAT_NONE, AttributeFormat::None);
ZVO_SAME(ZVO_ATTRIBUTE_FORMAT_BYTES4, AttributeFormat::Bytes4);
ZVO_SAME(ZVO_ATTRIBUTE_FORMAT_BYTES8, AttributeFormat::Bytes8);
ZVO_SAME(ZVO_ATTRIBUTE_FORMAT_BLOCKS, AttributeFormat::Blocks);
ZVO_SAME(ZVO_MERGE_RULE_AVERAGE, MergeRule::Average);
ZVO_SAME(ZVO_MERGE_RULE_DYNAMIC_WINS, MergeRule::DynamicWins);
ZVO_SAME(ZVO_MERGE_RULE_STATIC_WINS, MergeRule::StaticWins);
ZVO_SAME(ZVO_VIEW_COLOR, View::Color);
ZVO_SAME(ZVO_VIEW_ALBEDO, View::Albedo);
ZVO_SAME(ZVO_VIEW_NORMAL, View::Normal);
ZVO_SAME(ZVO_VIEW_DEPTH, View::Depth);
ZVO_SAME(ZVO_VIEW_LEVEL, View::Level);
ZVO_SAME(ZVO_VIEW_ITERATIONS, View::Iterations);
ZVO_SAME(ZVO_VIEW_VOXEL, View::Voxel);
ZVO_SAME(ZVO_VIEW_BRICKS, View::Bricks);
ZVO_SAME(ZVO_VIEW_ORIGIN, View::Origin);
ZVO_SAME(ZVO_BRUSH_SHAPE_SPHERE, BrushShape::Sphere);
ZVO_SAME(ZVO_BRUSH_SHAPE_BOX, BrushShape::Box);
ZVO_SAME(ZVO_BRUSH_ACTION_CARVE, BrushAction::Carve);
ZVO_SAME(ZVO_BRUSH_ACTION_FILL, BrushAction::Fill);
ZVO_SAME(ZVO_BRUSH_ACTION_PAINT, BrushAction::Paint);
ZVO_SAME(ZVO_WRAP_MODE_REPEAT, WrapMode::Repeat);
ZVO_SAME(ZVO_WRAP_MODE_MIRRORED_REPEAT, WrapMode::MirroredRepeat);
ZVO_SAME(ZVO_WRAP_MODE_CLAMP_TO_EDGE, WrapMode::ClampToEdge);
ZVO_SAME(ZVO_ALPHA_MODE_OPAQUE, AlphaMode::Opaque);
ZVO_SAME(ZVO_ALPHA_MODE_MASK, AlphaMode::Mask);
ZVO_SAME(ZVO_ALPHA_MODE_BLEND, AlphaMode::Blend);
#undef ZVO_SAME
static_assert(ZVO_NO_TEXTURE == kNoTexture);

// A span of To over an array of From; each To consists of a few From.
template <typename To, typename From> std::span<const To> spanOf(const From* first, std::size_t count, const char* name)
{
    static_assert(sizeof(To) % sizeof(From) == 0 && alignof(To) == alignof(From));
    if (count == 0)
    {
        return {};
    }
    if (count > PTRDIFF_MAX / sizeof(To))
    {
        throw Error(ErrorCode::Usage,
                    std::string(name) + " has more elements than any memory: " + std::to_string(count));
    }
    return {reinterpret_cast<const To*>(&at(first, name)), count};
}

template <typename To, typename From>
std::span<const To> optionalSpanOf(const From* first, std::size_t count, const char* name)
{
    return first == nullptr ? std::span<const To>() : spanOf<To>(first, count, name);
}

template <typename T, std::size_t kCount> std::array<T, kCount> arrayOf(const T (&values)[kCount])
{
    std::array<T, kCount> result{};
    std::copy_n(values, kCount, result.begin());
    return result;
}

template <typename T, std::size_t kCount> void copyTo(T (&out)[kCount], const std::array<T, kCount>& values)
{
    std::copy_n(values.begin(), kCount, out);
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

} // namespace

ContextInfo ofC(const ZvoContextInfo& info)
{
    ContextInfo result;
    result.get_instance_proc_addr = info.get_instance_proc_addr;
    result.instance = info.instance;
    result.physical_device = info.physical_device;
    result.device = info.device;
    result.queue_family = info.queue_family;
    result.instance_api_version = info.instance_api_version;
    result.instance_extensions = spanOf<const char*>(info.instance_extensions, info.instance_extension_count,
                                                     "ZvoContextInfo::instance_extensions");
    result.device_extensions =
        spanOf<const char*>(info.device_extensions, info.device_extension_count, "ZvoContextInfo::device_extensions");
    result.enabled_features = info.enabled_features;
    result.enabled_core_features = info.enabled_core_features;
    result.allocation_callbacks = info.allocation_callbacks;
    result.pipeline_cache = info.pipeline_cache;
    result.memory_budget_bytes = info.memory_budget_bytes;
    result.timed_passes_per_frame = info.timed_passes_per_frame;
    result.subgroup_size = info.subgroup_size;
    result.tuning = info.tuning != nullptr ? info.tuning : "";
    return result;
}

OptionalFeatures ofC(const ZvoOptionalFeatures& features)
{
    return {.pass_times = features.pass_times != VK_FALSE,
            .subgroup_sizes = features.subgroup_sizes != VK_FALSE,
            .int64_atomics = features.int64_atomics != VK_FALSE};
}

TextureInfo ofC(const ZvoTextureInfo& info)
{
    TextureInfo result;
    result.width = info.width;
    result.height = info.height;
    result.rgba = spanOf<std::uint8_t>(info.rgba, info.rgba_bytes, "ZvoTextureInfo::rgba");
    result.wrap_u = checkedEnum(info.wrap_u, WrapMode::ClampToEdge, "ZvoTextureInfo::wrap_u");
    result.wrap_v = checkedEnum(info.wrap_v, WrapMode::ClampToEdge, "ZvoTextureInfo::wrap_v");
    return result;
}

MaterialInfo ofC(const ZvoMaterialInfo& info)
{
    MaterialInfo result;
    result.base_color = arrayOf(info.base_color);
    result.base_color_texture = info.base_color_texture;
    result.emission = arrayOf(info.emission);
    result.emission_texture = info.emission_texture;
    result.alpha_mode = checkedEnum(info.alpha_mode, AlphaMode::Blend, "ZvoMaterialInfo::alpha_mode");
    result.alpha_cutoff = info.alpha_cutoff;
    return result;
}

MeshInfo ofC(const ZvoMeshInfo& info)
{
    MeshInfo result;
    result.positions = spanOf<Vec3>(info.positions, info.vertex_count, "ZvoMeshInfo::positions");
    result.normals = optionalSpanOf<Vec3>(info.normals, info.vertex_count, "ZvoMeshInfo::normals");
    result.uvs = optionalSpanOf<Vec2>(info.uvs, info.vertex_count, "ZvoMeshInfo::uvs");
    result.colors = optionalSpanOf<Vec4>(info.colors, info.vertex_count, "ZvoMeshInfo::colors");
    result.triangles =
        spanOf<std::array<std::uint32_t, 3>>(info.triangles, info.triangle_count, "ZvoMeshInfo::triangles");
    result.material = info.material;
    return result;
}

InstanceInfo ofC(const ZvoInstanceInfo& info)
{
    return {info.mesh, arrayOf(info.transform)};
}

ModelOfC::ModelOfC(const ZvoModelInfo& info)
    : m_meshes(eachOfC<MeshInfo>(info.meshes, info.mesh_count, "ZvoModelInfo::meshes")),
      m_instances(eachOfC<InstanceInfo>(info.instances, info.instance_count, "ZvoModelInfo::instances")),
      m_materials(eachOfC<MaterialInfo>(info.materials, info.material_count, "ZvoModelInfo::materials")),
      m_textures(eachOfC<TextureInfo>(info.textures, info.texture_count, "ZvoModelInfo::textures"))
{
    m_info.meshes = m_meshes;
    m_info.instances = m_instances;
    m_info.materials = m_materials;
    m_info.textures = m_textures;
    m_info.attributes = info.attributes != VK_FALSE;
    if (!(info.emission_scale < 0))
    {
        m_info.emission_scale = info.emission_scale;
    }
}

GridInfo ofC(const ZvoGrid& grid)
{
    return {arrayOf(grid.origin), grid.voxel_size, grid.depth};
}

TreeBuildInfo ofC(const ZvoTreeBuildInfo& info)
{
    TreeBuildInfo result;
    result.grid = ofC(info.grid);
    result.coverage = checkedEnum(info.coverage, Coverage::Thin, "ZvoTreeBuildInfo::coverage");
    result.format = checkedEnum(info.format, AttributeFormat::Blocks, "ZvoTreeBuildInfo::format");
    result.keep_sums = info.keep_sums != VK_FALSE;
    return result;
}

DynamicTreeInfo ofC(const ZvoDynamicTreeInfo& info)
{
    DynamicTreeInfo result;
    result.coverage = checkedEnum(info.coverage, Coverage::Thin, "ZvoDynamicTreeInfo::coverage");
    result.merge = checkedEnum(info.merge, MergeRule::StaticWins, "ZvoDynamicTreeInfo::merge");
    result.frames_in_flight = info.frames_in_flight;
    result.history_entries = info.history_entries;
    result.history_bytes = info.history_bytes;
    result.strokes = info.strokes;
    result.edit_bytes = info.edit_bytes;
    result.emission_scale = info.emission_scale;
    return result;
}

BrushInfo ofC(const ZvoBrushInfo& info)
{
    BrushInfo result;
    result.shape = checkedEnum(info.shape, BrushShape::Box, "ZvoBrushInfo::shape");
    result.action = checkedEnum(info.action, BrushAction::Paint, "ZvoBrushInfo::action");
    result.center = arrayOf(info.center);
    result.radius = info.radius;
    result.color = info.color;
    return result;
}

SunInfo ofC(const ZvoSunInfo& info)
{
    return {arrayOf(info.direction), arrayOf(info.irradiance)};
}

EnvironmentMapInfo ofC(const ZvoEnvironmentMapInfo& map)
{
    EnvironmentMapInfo result;
    result.width = map.width;
    result.height = map.height;
    result.texels = spanOf<Vec3>(map.texels, std::size_t{map.width} * map.height, "ZvoEnvironmentMapInfo::texels");
    result.turn = map.turn;
    result.strength = map.strength;
    return result;
}

CameraInfo ofC(const ZvoCameraInfo& info)
{
    CameraInfo result;
    result.position = arrayOf(info.position);
    result.forward = arrayOf(info.forward);
    result.up = arrayOf(info.up);
    result.orthographic = info.orthographic != VK_FALSE;
    result.vertical_fov = info.vertical_fov;
    result.half_height = info.half_height;
    return result;
}

TraceInfo ofC(const ZvoTraceInfo& info)
{
    TraceInfo result;
    result.view = checkedEnum(info.view, View::Origin, "ZvoTraceInfo::view");
    result.shadows = info.shadows != VK_FALSE;
    result.to_sun = arrayOf(info.to_sun);
    result.sun = info.sun;
    result.exposure = info.exposure;
    result.occlusion_rays = info.occlusion_rays;
    result.occlusion_reach = info.occlusion_reach;
    result.detail_pixels = info.detail_pixels;
    return result;
}

PathInfo ofC(const ZvoPathInfo& info)
{
    PathInfo result;
    result.bounces = info.bounces;
    result.seed = info.seed;
    result.lens_radius = info.lens_radius;
    result.focus_distance = info.focus_distance;
    result.roulette = info.roulette != VK_FALSE;
    result.automatic_exposure = info.automatic_exposure != VK_FALSE;
    result.exposure = info.exposure;
    result.samples = info.samples;
    result.denoise = info.denoise != VK_FALSE;
    result.history_max = info.history_max;
    return result;
}

ImageTarget ofC(const ZvoImageTarget& target)
{
    ImageTarget result;
    result.image = target.image;
    result.format = target.format;
    result.layout = target.layout;
    result.offset = target.offset;
    result.mip_level = target.mip_level;
    result.array_layer = target.array_layer;
    result.extent = target.extent;
    return result;
}

DepthTarget ofC(const ZvoDepthTarget& target)
{
    return {ofC(readStruct(target.image, "ZvoDepthTarget::image")), arrayOf(target.view_projection), target.miss};
}

KeptLightInfo ofC(const ZvoKeptLightInfo& info)
{
    return {info.width, info.height, info.faces};
}

KeptFrameInfo ofC(const ZvoKeptFrameInfo& info)
{
    return {info.rays, info.seed};
}

KeptPictureInfo ofC(const ZvoKeptPictureInfo& info)
{
    return {info.automatic_exposure != VK_FALSE, info.exposure};
}

ZvoDeviceInfo toC(const DeviceReport& report)
{
    auto result = initial<ZvoDeviceInfo>();
    result.physical_device = report.physical_device;
    result.name = report.name.c_str();
    result.driver = report.driver.c_str();
    result.type = report.type.c_str();
    result.api_version = report.api_version.c_str();
    result.memory_bytes = report.memory_bytes;
    result.max_buffer_bytes = report.max_buffer_bytes;
    result.subgroup_size = report.subgroup_size;
    result.min_subgroup_size = report.min_subgroup_size;
    result.max_subgroup_size = report.max_subgroup_size;
    result.queue_family = report.queue_family;
    result.timestamp_period_ns = report.timestamp_period_ns;
    result.timestamp_valid_bits = report.timestamp_valid_bits;
    result.usable = report.usable() ? VK_TRUE : VK_FALSE;
    return result;
}

ZvoMemoryUse toC(const MemoryUse& use)
{
    return {sizeof(ZvoMemoryUse), use.used, use.held, use.peak_held};
}

ZvoPassTime toC(const PassTime& time)
{
    return {sizeof(ZvoPassTime), time.name.c_str(), time.ms};
}

ZvoGrid toC(const GridInfo& grid)
{
    ZvoGrid result = ZVO_GRID_INIT;
    copyTo(result.origin, grid.origin);
    result.voxel_size = grid.voxel_size;
    result.depth = grid.depth;
    return result;
}

ZvoTreeInfo toC(const TreeInfo& info)
{
    auto result = initial<ZvoTreeInfo>();
    result.structure = static_cast<ZvoTreeStructure>(info.structure);
    result.format = static_cast<ZvoAttributeFormat>(info.format);
    result.grid = toC(info.grid);
    result.emission_scale = info.emission_scale;
    result.voxel_count = info.voxel_count;
    result.node_count = info.node_count;
    result.bytes = info.bytes;
    return result;
}

ZvoDroppedTriangles toC(const std::map<std::string, std::uint64_t>& dropped)
{
    const auto countOf = [&](const char* reason)
    {
        const auto found = dropped.find(reason);
        return found == dropped.end() ? 0 : found->second;
    };
    auto result = initial<ZvoDroppedTriangles>();
    result.nonfinite = countOf("nonfinite");
    result.out_of_range = countOf("out_of_range");
    result.outside = countOf("outside");
    result.zero_area = countOf("zero_area");
    return result;
}

ZvoUpdateStats toC(const UpdateStats& info)
{
    const ZvoDroppedTriangles dropped = toC(info.dropped);
    auto result = initial<ZvoUpdateStats>();
    result.node_count = info.node_count;
    result.voxel_count = info.voxel_count;
    result.moving_count = info.moving_count;
    result.dropped_nonfinite = dropped.nonfinite;
    result.dropped_out_of_range = dropped.out_of_range;
    result.dropped_outside = dropped.outside;
    result.dropped_zero_area = dropped.zero_area;
    result.failed = info.failed ? VK_TRUE : VK_FALSE;
    return result;
}

ZvoCameraInfo toC(const CameraInfo& info)
{
    auto result = initial<ZvoCameraInfo>();
    copyTo(result.position, info.position);
    copyTo(result.forward, info.forward);
    copyTo(result.up, info.up);
    result.vertical_fov = info.vertical_fov;
    result.half_height = info.half_height;
    result.orthographic = info.orthographic ? VK_TRUE : VK_FALSE;
    return result;
}

ZvoCameraRays toC(const CameraRays& rays)
{
    ZvoCameraRays result{};
    copyTo(result.origin, rays.origin);
    copyTo(result.forward, rays.forward);
    copyTo(result.half_pixel_x, rays.half_pixel_x);
    copyTo(result.half_pixel_y, rays.half_pixel_y);
    return result;
}

ZvoKeptLightStats toC(const KeptLightStats& stats)
{
    return {sizeof(ZvoKeptLightStats), stats.faces, stats.refused};
}

} // namespace zvo
