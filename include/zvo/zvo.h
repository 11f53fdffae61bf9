// SPDX-License-Identifier: MIT
// The C interface (C11 and C++), for programs in C, in other languages, and in C++ of another compiler than the
// library's. Effects, errors and stages of a function are documented in the C++ headers (zvo/zvo.hpp), at the class of
// the same name. docs/c-interface.md has the rules of this interface and an example.
//
// A struct begins with its size. ZVO_..._INIT sets the size and all defaults; every struct must be initialized by it,
// those that zvo fills, too. A size over 4096 bytes, or no multiple of 4, is ZVO_ERROR_USAGE. If a struct is smaller
// than the library's, as with an older header, missing members have their defaults. If it is larger, as with a newer
// header, the bytes that the library does not know must be 0; in structs that zvo fills it sets them to 0. Members
// called reserved must be 0, else the call is ZVO_ERROR_USAGE. All elements of an array have the size of the first one,
// which is also the distance between two of them.
//
// Functions return ZVO_OK or an error code; zvoLastError() then has the message. Outputs are the last parameters; a
// function that fails does not change them. A pointer may be null only where its description says so, and in functions
// that destroy.
#pragma once

#include "zvo/enums.h"
#include "zvo/export.h"
#include "zvo/memory.h"
#include "zvo/version.h"

#include <vulkan/vulkan_core.h>

#include <stddef.h>
#include <stdint.h>

/// Marks the functions of this interface.
#ifdef __cplusplus
#define ZVO_C_API extern "C" ZVO_API
#else
#define ZVO_C_API ZVO_API
#endif

/// The value of a struct that begins with its size.
#define ZVO_STRUCT_INIT(Struct, ...)                                                                                   \
    {                                                                                                                  \
        sizeof(Struct), __VA_ARGS__                                                                                    \
    }

// Handles. One context's are used by one thread at a time, and destroyed before it.
typedef struct ZvoDeviceReport ZvoDeviceReport;
typedef struct ZvoFeatureStorage ZvoFeatureStorage;
typedef struct ZvoContext ZvoContext;
typedef struct ZvoRecorder ZvoRecorder;
typedef struct ZvoModel ZvoModel;
typedef struct ZvoTree ZvoTree;
typedef struct ZvoTreeJob ZvoTreeJob;
typedef struct ZvoDynamicTree ZvoDynamicTree;
typedef struct ZvoEnvironment ZvoEnvironment;
typedef struct ZvoTracer ZvoTracer;
typedef struct ZvoRadianceCache ZvoRadianceCache;
typedef struct ZvoQueryBatch ZvoQueryBatch;
typedef struct ZvoKernelPreparation ZvoKernelPreparation;

// Structs without a size, which stay as they are.

/// A cube of (1 << depth)^3 voxels. Voxel (x, y, z) is the box from origin + voxel_size * (x, y, z) on.
typedef struct ZvoGrid
{
    float origin[3];  // world position of the minimum corner
    float voxel_size; // world units
    uint32_t depth;   // 1 to 17
} ZvoGrid;

#define ZVO_GRID_INIT                                                                                                  \
    {                                                                                                                  \
        {0, 0, 0}, 1, 8                                                                                                \
    }

/// A camera's rays as zvo/trace.glsl takes them (zvo_CameraRays, scalar layout).
typedef struct ZvoCameraRays
{
    float origin[3];
    float forward[3];
    float half_pixel_x[3]; // to the right
    float half_pixel_y[3]; // down
} ZvoCameraRays;

/// As zvo::LogCallback; null: nowhere. It must not throw, unwind by longjmp, nor call zvo.
typedef struct ZvoLogCallback
{
    void (*function)(void* user, ZvoLogSeverity severity, const char* message);
    void* user;
} ZvoLogCallback;

// Errors and version.

/// What the last call on this thread that failed says: one line, in UTF-8, which lives until the next one fails.
/// Empty: none has. Never null.
ZVO_C_API const char* zvoLastError(void);

/// ZVO_VERSION of the library that runs.
ZVO_C_API int zvoVersion(void);

// The host's device: before it exists, and when it is created.

/// As zvo::DeviceReport. Texts live as long as the ZvoDeviceReport.
typedef struct ZvoDeviceInfo
{
    size_t struct_size;
    VkPhysicalDevice physical_device;
    const char* name;
    const char* driver;
    const char* type;
    const char* api_version;
    uint64_t memory_bytes;
    uint64_t max_buffer_bytes;
    uint32_t subgroup_size;
    uint32_t min_subgroup_size;
    uint32_t max_subgroup_size;
    uint32_t queue_family;
    float timestamp_period_ns;
    uint32_t timestamp_valid_bits;
    VkBool32 usable;
    uint32_t reserved;
} ZvoDeviceInfo;

#define ZVO_DEVICE_INFO_INIT                                                                                           \
    ZVO_STRUCT_INIT(ZvoDeviceInfo, VK_NULL_HANDLE, NULL, NULL, NULL, NULL, 0, 0, 0, 0, 0, 0, 0, 0, VK_FALSE, 0)

typedef uint32_t ZvoReportList; // of zvo::DeviceReport
enum
{
    ZVO_REPORT_PRESENT = 0,
    ZVO_REPORT_MISSING = 1,
    ZVO_REPORT_REASONS = 2
};

/// zvo::query(): ZVO_OK for devices that will not do, too.
ZVO_C_API ZvoResult zvoQuery(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                             VkPhysicalDevice physical_device, uint32_t instance_api_version, ZvoDeviceReport** report);
ZVO_C_API void zvoDeviceReportDestroy(ZvoDeviceReport* report); // not that of a context
ZVO_C_API ZvoResult zvoDeviceReportInfo(const ZvoDeviceReport* report, ZvoDeviceInfo* info);

/// A line of a list, which lives as long as the report; null behind the last one.
ZVO_C_API ZvoResult zvoDeviceReportText(const ZvoDeviceReport* report, ZvoReportList list, uint32_t index,
                                        const char** text);

typedef struct ZvoOptionalFeatures
{
    size_t struct_size;
    VkBool32 pass_times;
    VkBool32 subgroup_sizes;
    VkBool32 int64_atomics;
    uint32_t reserved;
} ZvoOptionalFeatures;

#define ZVO_OPTIONAL_FEATURES_INIT ZVO_STRUCT_INIT(ZvoOptionalFeatures, VK_FALSE, VK_FALSE, VK_FALSE, 0)

/// The storage lives for as long as the VkDeviceCreateInfo that it serves is used.
ZVO_C_API ZvoResult zvoFeatureStorageCreate(ZvoFeatureStorage** storage);
ZVO_C_API void zvoFeatureStorageDestroy(ZvoFeatureStorage* storage);

/// zvo::patchFeatures(). optional: null: none.
ZVO_C_API ZvoResult zvoPatchFeatures(VkDeviceCreateInfo* info, ZvoFeatureStorage* storage,
                                     const ZvoOptionalFeatures* optional);

/// zvo::patchFeatures() of a chain. core, optional: null: none.
ZVO_C_API ZvoResult zvoPatchFeatureChain(const void** chain, ZvoFeatureStorage* storage, VkPhysicalDeviceFeatures* core,
                                         const ZvoOptionalFeatures* optional);

// zvo::Context.

/// As zvo::ContextInfo.
typedef struct ZvoContextInfo
{
    size_t struct_size;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    uint32_t queue_family;
    uint32_t instance_api_version;
    const char* const* instance_extensions; // [instance_extension_count]
    const char* const* device_extensions;   // [device_extension_count]
    uint32_t instance_extension_count;
    uint32_t device_extension_count;
    const void* enabled_features;
    const VkPhysicalDeviceFeatures* enabled_core_features;
    const VkAllocationCallbacks* allocation_callbacks;
    VkPipelineCache pipeline_cache;
    ZvoMemoryCallbacks memory;
    uint64_t memory_budget_bytes;
    ZvoLogCallback log;
    uint32_t timed_passes_per_frame;
    uint32_t subgroup_size;
    const char* tuning; // may be null
    double up[3];
} ZvoContextInfo;

#define ZVO_CONTEXT_INFO_INIT                                                                                          \
    ZVO_STRUCT_INIT(ZvoContextInfo, NULL, VK_NULL_HANDLE, VK_NULL_HANDLE, VK_NULL_HANDLE, 0, 0, NULL, NULL, 0, 0,      \
                    NULL, NULL, NULL, VK_NULL_HANDLE, {NULL, NULL, NULL}, UINT64_MAX, {NULL, NULL}, 0, 0, NULL,        \
                    {0, 1, 0})

typedef struct ZvoMemoryUse
{
    size_t struct_size;
    uint64_t used; // bytes, as the others
    uint64_t held;
    uint64_t peak_held;
} ZvoMemoryUse;

#define ZVO_MEMORY_USE_INIT ZVO_STRUCT_INIT(ZvoMemoryUse, 0, 0, 0)

typedef struct ZvoPassTime
{
    size_t struct_size;
    const char* name; // lives until the next zvoContextFrameDone()
    double ms;
} ZvoPassTime;

#define ZVO_PASS_TIME_INIT ZVO_STRUCT_INIT(ZvoPassTime, NULL, 0)

ZVO_C_API ZvoResult zvoContextCreate(const ZvoContextInfo* info, ZvoContext** context);
ZVO_C_API void zvoContextDestroy(ZvoContext* context);
ZVO_C_API ZvoResult zvoContextFrameDone(ZvoContext* context, uint64_t frame);
ZVO_C_API ZvoResult zvoContextFrameLost(ZvoContext* context, uint64_t frame);
ZVO_C_API ZvoResult zvoContextMemory(const ZvoContext* context, ZvoMemoryUse* use);
ZVO_C_API ZvoResult zvoContextPassTimeCount(const ZvoContext* context, uint32_t* count);
ZVO_C_API ZvoResult zvoContextPassTime(const ZvoContext* context, uint32_t index, ZvoPassTime* time);
ZVO_C_API ZvoResult zvoContextReport(const ZvoContext* context, const ZvoDeviceReport** report); // the context's own

/// zvo::madeKernels(). text: lives until the next call for this context, or until the context is destroyed.
ZVO_C_API ZvoResult zvoContextMadeKernels(ZvoContext* context, const char** text);

// zvo::KernelPreparation.

ZVO_C_API ZvoResult zvoKernelPreparationCreate(ZvoContext* context, const char* kernels,
                                               ZvoKernelPreparation** preparation);
ZVO_C_API void zvoKernelPreparationDestroy(ZvoKernelPreparation* preparation);
ZVO_C_API ZvoResult zvoKernelPreparationSize(const ZvoKernelPreparation* preparation, size_t* size);
ZVO_C_API ZvoResult zvoKernelPreparationMake(ZvoKernelPreparation* preparation, size_t index); // on any thread
ZVO_C_API ZvoResult zvoKernelPreparationFinish(ZvoKernelPreparation* preparation);

// zvo::Recorder. Ended before the host ends or submits the command buffer.

ZVO_C_API ZvoResult zvoRecorderBegin(ZvoContext* context, VkCommandBuffer commands, uint64_t frame,
                                     VkPipelineStageFlags2 readers, ZvoRecorder** recorder);
ZVO_C_API void zvoRecorderEnd(ZvoRecorder* recorder); // the handle goes
ZVO_C_API ZvoResult zvoRecorderMakeVisible(ZvoRecorder* recorder, VkPipelineStageFlags2 stages);

// zvo::Model.

/// As zvo::TextureInfo.
typedef struct ZvoTextureInfo
{
    size_t struct_size;
    const uint8_t* rgba; // [rgba_bytes], width * height * 4
    size_t rgba_bytes;
    uint32_t width;
    uint32_t height;
    ZvoWrapMode wrap_u;
    ZvoWrapMode wrap_v;
} ZvoTextureInfo;

#define ZVO_TEXTURE_INFO_INIT ZVO_STRUCT_INIT(ZvoTextureInfo, NULL, 0, 0, 0, ZVO_WRAP_MODE_REPEAT, ZVO_WRAP_MODE_REPEAT)

/// As zvo::MaterialInfo.
typedef struct ZvoMaterialInfo
{
    size_t struct_size;
    float base_color[4];
    uint32_t base_color_texture;
    float emission[3];
    uint32_t emission_texture;
    ZvoAlphaMode alpha_mode;
    float alpha_cutoff;
    uint32_t reserved;
} ZvoMaterialInfo;

#define ZVO_MATERIAL_INFO_INIT                                                                                         \
    ZVO_STRUCT_INIT(ZvoMaterialInfo, {1, 1, 1, 1}, ZVO_NO_TEXTURE, {0, 0, 0}, ZVO_NO_TEXTURE, ZVO_ALPHA_MODE_OPAQUE,   \
                    0.5F, 0)

/// As zvo::MeshInfo.
typedef struct ZvoMeshInfo
{
    size_t struct_size;
    const float* positions; // [3 * vertex_count]
    const float* normals;   // [3 * vertex_count] or null
    const float* uvs;       // [2 * vertex_count] or null
    const float* colors;    // [4 * vertex_count] or null
    size_t vertex_count;
    const uint32_t* triangles; // [3 * triangle_count] vertices
    size_t triangle_count;
    uint32_t material;
    uint32_t reserved;
} ZvoMeshInfo;

#define ZVO_MESH_INFO_INIT ZVO_STRUCT_INIT(ZvoMeshInfo, NULL, NULL, NULL, NULL, 0, NULL, 0, 0, 0)

/// As zvo::InstanceInfo.
typedef struct ZvoInstanceInfo
{
    size_t struct_size;
    float transform[16]; // of columns
    uint32_t mesh;
    uint32_t reserved;
} ZvoInstanceInfo;

#define ZVO_INSTANCE_INFO_INIT ZVO_STRUCT_INIT(ZvoInstanceInfo, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 0, 0)

/// As zvo::ModelInfo.
typedef struct ZvoModelInfo
{
    size_t struct_size;
    const ZvoMeshInfo* meshes;        // [mesh_count]
    const ZvoInstanceInfo* instances; // [instance_count]; none: each mesh once, as it is
    const ZvoMaterialInfo* materials; // [material_count]; none: a white one
    const ZvoTextureInfo* textures;   // [texture_count]
    size_t mesh_count;
    size_t instance_count;
    size_t material_count;
    size_t texture_count;
    VkBool32 attributes;
    float emission_scale; // negative: that of the brightest material
} ZvoModelInfo;

#define ZVO_MODEL_INFO_INIT ZVO_STRUCT_INIT(ZvoModelInfo, NULL, NULL, NULL, NULL, 0, 0, 0, 0, VK_TRUE, -1)

typedef struct ZvoModelStats
{
    size_t struct_size;
    uint64_t triangle_count; // with instances counted each time
    float emission_scale;    // 0: nothing emits light
    uint32_t reserved;
} ZvoModelStats;

#define ZVO_MODEL_STATS_INIT ZVO_STRUCT_INIT(ZvoModelStats, 0, 0, 0)

ZVO_C_API ZvoResult zvoModelCreate(ZvoRecorder* recorder, const ZvoModelInfo* info, ZvoModel** model);
ZVO_C_API void zvoModelDestroy(ZvoModel* model); // what was made of it may go on using it
ZVO_C_API ZvoResult zvoModelStats(const ZvoModel* model, ZvoModelStats* stats);
ZVO_C_API ZvoResult zvoModelGridAround(const ZvoModel* model, uint32_t depth, ZvoGrid* grid);

// zvo::Tree.

/// As zvo::TreeInfo.
typedef struct ZvoTreeInfo
{
    size_t struct_size;
    ZvoTreeStructure structure;
    ZvoAttributeFormat format;
    ZvoGrid grid;
    float emission_scale;
    uint64_t voxel_count;
    uint64_t node_count;
    uint64_t bytes;
} ZvoTreeInfo;

#define ZVO_TREE_INFO_INIT                                                                                             \
    ZVO_STRUCT_INIT(ZvoTreeInfo, ZVO_TREE_STRUCTURE_SVO, ZVO_ATTRIBUTE_FORMAT_NONE, ZVO_GRID_INIT, 0, 0, 0, 0)

/// path: in UTF-8.
ZVO_C_API ZvoResult zvoTreeFromFile(ZvoRecorder* recorder, const char* path, ZvoTree** tree);
ZVO_C_API ZvoResult zvoTreeFromMemory(ZvoRecorder* recorder, const void* file, size_t file_bytes, ZvoTree** tree);
ZVO_C_API void zvoTreeDestroy(ZvoTree* tree);
ZVO_C_API ZvoResult zvoTreeInfo(const ZvoTree* tree, ZvoTreeInfo* info);
ZVO_C_API ZvoResult zvoTreeAddress(const ZvoTree* tree, uint64_t* address);

// zvo::TreeJob: a zvo::TreeBuild, a zvo::TreeAlgebra or a zvo::TreeCompression.

/// As zvo::TreeBuildInfo.
typedef struct ZvoTreeBuildInfo
{
    size_t struct_size;
    ZvoGrid grid;
    ZvoCoverage coverage;
    ZvoAttributeFormat format;
    VkBool32 keep_sums;
    ZvoFill fill;
    ZvoShell shell;
} ZvoTreeBuildInfo;

#define ZVO_TREE_BUILD_INFO_INIT                                                                                       \
    ZVO_STRUCT_INIT(ZvoTreeBuildInfo, ZVO_GRID_INIT, ZVO_COVERAGE_THIN, ZVO_ATTRIBUTE_FORMAT_BYTES8, VK_FALSE,         \
                    ZVO_FILL_NONE, ZVO_SHELL_SURFACE)

/// Triangles that were left out, by reason.
typedef struct ZvoDroppedTriangles
{
    size_t struct_size;
    uint64_t nonfinite;
    uint64_t out_of_range;
    uint64_t outside;
    uint64_t zero_area;
} ZvoDroppedTriangles;

#define ZVO_DROPPED_TRIANGLES_INIT ZVO_STRUCT_INIT(ZvoDroppedTriangles, 0, 0, 0, 0)

ZVO_C_API ZvoResult zvoTreeBuildCreate(ZvoContext* context, const ZvoModel* model, const ZvoTreeBuildInfo* info,
                                       ZvoTreeJob** build);

/// As zvo::TreeAlgebraInfo.
typedef struct ZvoTreeAlgebraInfo
{
    size_t struct_size;
    ZvoTreeOperation operation;
    VkBool32 corners;
    uint32_t voxels;
    uint32_t largest;
    uint64_t least_voxels;
} ZvoTreeAlgebraInfo;

#define ZVO_TREE_ALGEBRA_INFO_INIT ZVO_STRUCT_INIT(ZvoTreeAlgebraInfo, ZVO_TREE_OPERATION_UNITE, VK_FALSE, 1, 0, 1)

/// other: of UNITE, INTERSECT and SUBTRACT; else null. Both trees outlive the job, and are not given to another object
/// until it is done.
ZVO_C_API ZvoResult zvoTreeAlgebraCreate(ZvoRecorder* recorder, const ZvoTree* tree, const ZvoTree* other,
                                         const ZvoTreeAlgebraInfo* info, ZvoTreeJob** algebra);

/// Takes the octree over: where this succeeds, its handle is gone. Where it fails, the host destroys it, and using
/// it for anything else may be ZVO_ERROR_USAGE: what it held can be gone.
ZVO_C_API ZvoResult zvoTreeCompressionCreate(ZvoContext* context, ZvoTree* octree, ZvoTreeJob** compression);

ZVO_C_API void zvoTreeJobDestroy(ZvoTreeJob* job);
ZVO_C_API ZvoResult zvoTreeJobRecord(ZvoTreeJob* job, ZvoRecorder* recorder, VkBool32* has_more);
ZVO_C_API ZvoResult zvoTreeJobIsDone(ZvoTreeJob* job, VkBool32* is_done);
ZVO_C_API ZvoResult zvoTreeJobIsBroken(const ZvoTreeJob* job, VkBool32* is_broken);
ZVO_C_API ZvoResult zvoTreeJobTake(ZvoTreeJob* job, ZvoTree** tree);
ZVO_C_API ZvoResult zvoTreeJobDropped(const ZvoTreeJob* job, ZvoDroppedTriangles* dropped);

// zvo::DynamicTree.

/// As zvo::DynamicTreeInfo.
typedef struct ZvoDynamicTreeInfo
{
    size_t struct_size;
    ZvoCoverage coverage;
    ZvoMergeRule merge;
    uint32_t frames_in_flight;
    float emission_scale;
    uint64_t history_entries;
    uint64_t history_bytes;
    uint64_t strokes;
    uint64_t edit_bytes;
} ZvoDynamicTreeInfo;

#define ZVO_DYNAMIC_TREE_INFO_INIT                                                                                     \
    ZVO_STRUCT_INIT(ZvoDynamicTreeInfo, ZVO_COVERAGE_THIN, ZVO_MERGE_RULE_DYNAMIC_WINS, 2, 0, 1, UINT64_MAX, 1024,     \
                    268435456)

/// As zvo::BrushInfo.
typedef struct ZvoBrushInfo
{
    size_t struct_size;
    ZvoBrushShape shape;
    ZvoBrushAction action;
    int32_t center[3];
    uint32_t radius;
    uint32_t color;
    float emission[3];
} ZvoBrushInfo;

#define ZVO_BRUSH_INFO_INIT                                                                                            \
    ZVO_STRUCT_INIT(ZvoBrushInfo, ZVO_BRUSH_SHAPE_SPHERE, ZVO_BRUSH_ACTION_CARVE, {0, 0, 0}, 0, 0, {0, 0, 0})

/// As zvo::DynamicObjectInfo.
typedef struct ZvoDynamicObjectInfo
{
    size_t struct_size;
    VkBool32 carves;
    ZvoFill fill;
} ZvoDynamicObjectInfo;

#define ZVO_DYNAMIC_OBJECT_INFO_INIT ZVO_STRUCT_INIT(ZvoDynamicObjectInfo, VK_FALSE, ZVO_FILL_NONE)

/// As zvo::UpdateStats.
typedef struct ZvoUpdateStats
{
    size_t struct_size;
    uint64_t node_count;
    uint64_t voxel_count;
    uint64_t moving_count;
    uint64_t dropped_nonfinite;
    uint64_t dropped_out_of_range;
    uint64_t dropped_outside;
    uint64_t dropped_zero_area;
    VkBool32 failed;
    uint32_t reserved;
} ZvoUpdateStats;

#define ZVO_UPDATE_STATS_INIT ZVO_STRUCT_INIT(ZvoUpdateStats, 0, 0, 0, 0, 0, 0, 0, VK_FALSE, 0)

typedef uint32_t ZvoDynamicObjectId;

/// Takes the static tree over, under the same rule as zvoTreeCompressionCreate().
ZVO_C_API ZvoResult zvoDynamicTreeCreate(ZvoRecorder* recorder, ZvoTree* fixed, const ZvoDynamicTreeInfo* info,
                                         ZvoDynamicTree** tree);
ZVO_C_API void zvoDynamicTreeDestroy(ZvoDynamicTree* tree);
ZVO_C_API ZvoResult zvoDynamicTreeAddObject(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoModel* model,
                                            const float to_world[16], ZvoDynamicObjectId* id);
ZVO_C_API ZvoResult zvoDynamicTreeAddObjectWith(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoModel* model,
                                                const float to_world[16], const ZvoDynamicObjectInfo* info,
                                                ZvoDynamicObjectId* id);
ZVO_C_API ZvoResult zvoDynamicTreeSetTransform(ZvoDynamicTree* tree, ZvoDynamicObjectId id, const float to_world[16]);
ZVO_C_API ZvoResult zvoDynamicTreeRemoveObject(ZvoDynamicTree* tree, ZvoDynamicObjectId id);
ZVO_C_API ZvoResult zvoDynamicTreeUpdate(ZvoDynamicTree* tree, ZvoRecorder* recorder, double budget_ms,
                                         VkBool32* is_complete);
ZVO_C_API ZvoResult zvoDynamicTreeNeedsUpdate(ZvoDynamicTree* tree, VkBool32* needs_update);
ZVO_C_API ZvoResult zvoDynamicTreeUndo(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_undone);
ZVO_C_API ZvoResult zvoDynamicTreeRedo(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_redone);
ZVO_C_API ZvoResult zvoDynamicTreeEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoBrushInfo* brush,
                                       VkBool32* is_recorded);
ZVO_C_API ZvoResult zvoDynamicTreeStamp(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoTree* octree,
                                        const int32_t offset[3], ZvoBrushAction action, VkBool32* is_recorded);
ZVO_C_API ZvoResult zvoDynamicTreeEndStroke(ZvoDynamicTree* tree);
ZVO_C_API ZvoResult zvoDynamicTreeUndoEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_undone);
ZVO_C_API ZvoResult zvoDynamicTreeRedoEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_redone);

/// The oldest update that was not taken yet, of those whose frames are done. VK_FALSE, and stats left alone: none.
ZVO_C_API ZvoResult zvoDynamicTreeTakeUpdate(ZvoDynamicTree* tree, ZvoUpdateStats* stats, VkBool32* is_taken);
ZVO_C_API ZvoResult zvoDynamicTreeInfo(const ZvoDynamicTree* tree, ZvoTreeInfo* info);
ZVO_C_API ZvoResult zvoDynamicTreeAddress(const ZvoDynamicTree* tree, uint64_t* address);

// zvo::Environment.

/// As zvo::SunInfo.
typedef struct ZvoSunInfo
{
    size_t struct_size;
    double direction[3];
    double irradiance[3];
} ZvoSunInfo;

#define ZVO_SUN_INFO_INIT ZVO_STRUCT_INIT(ZvoSunInfo, {-0.6, 0.75, 0.45}, {2.2F, 2.2F * 0.93, 2.2F * 0.82})

/// zvo::sunlight(). up: ZvoContextInfo's.
ZVO_C_API ZvoResult zvoSunlight(const double direction[3], const double up[3], ZvoSunInfo* sun);

/// As zvo::EnvironmentMapInfo.
typedef struct ZvoEnvironmentMapInfo
{
    size_t struct_size;
    const float* texels; // [3 * width * height]
    uint32_t width;
    uint32_t height;
    double turn;
    float strength;
    float background_blur;
} ZvoEnvironmentMapInfo;

#define ZVO_ENVIRONMENT_MAP_INFO_INIT ZVO_STRUCT_INIT(ZvoEnvironmentMapInfo, NULL, 0, 0, 0, 1, 0)

/// map: null: the simple sky, with the sun of ZVO_SUN_INFO_INIT. A map has no sun.
ZVO_C_API ZvoResult zvoEnvironmentCreate(ZvoRecorder* recorder, const ZvoEnvironmentMapInfo* map,
                                         ZvoEnvironment** environment);
ZVO_C_API void zvoEnvironmentDestroy(ZvoEnvironment* environment);
ZVO_C_API ZvoResult zvoEnvironmentSetSun(ZvoEnvironment* environment, const ZvoSunInfo* sun);

// zvo::Tracer.

/// As zvo::CameraInfo.
typedef struct ZvoCameraInfo
{
    size_t struct_size;
    double position[3];
    double forward[3];
    double up[3];
    double vertical_fov; // radians
    double half_height;  // world units
    VkBool32 orthographic;
    VkBool32 mirrored;
    double aspect;
    double shift[2];
} ZvoCameraInfo;

#define ZVO_CAMERA_INFO_INIT                                                                                           \
    ZVO_STRUCT_INIT(ZvoCameraInfo, {0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.7, 1, VK_FALSE, VK_FALSE, 0, {0, 0})

/// As zvo::TraceInfo.
typedef struct ZvoTraceInfo
{
    size_t struct_size;
    double to_sun[3];
    ZvoView view;
    VkBool32 shadows;
    float sun;
    float exposure;
    uint32_t occlusion_rays;
    float occlusion_reach;
    float detail_pixels;
    ZvoShading shading;
} ZvoTraceInfo;

#define ZVO_TRACE_INFO_INIT                                                                                            \
    ZVO_STRUCT_INIT(ZvoTraceInfo, {-0.6, 0.75, 0.45}, ZVO_VIEW_COLOR, VK_TRUE, 2.2F, 1, 0, 0.1F, 0, ZVO_SHADING_SMOOTH)

/// As zvo::PathInfo.
typedef struct ZvoPathInfo
{
    size_t struct_size;
    uint32_t bounces;
    uint32_t seed;
    float lens_radius;
    float focus_distance;
    VkBool32 roulette;
    VkBool32 automatic_exposure;
    float exposure;
    uint32_t samples;
    VkBool32 denoise;
    uint32_t history_max;
    ZvoShading shading;
    uint32_t reserved;
} ZvoPathInfo;

#define ZVO_PATH_INFO_INIT                                                                                             \
    ZVO_STRUCT_INIT(ZvoPathInfo, 8, 0, 0, 1, VK_FALSE, VK_TRUE, 1, 1, VK_FALSE, 16, ZVO_SHADING_SMOOTH, 0)

/// As zvo::ImageTarget.
typedef struct ZvoImageTarget
{
    size_t struct_size;
    VkImage image;
    VkFormat format;
    VkImageLayout layout;
    VkOffset2D offset;
    uint32_t mip_level;
    uint32_t array_layer;
    VkExtent2D extent;
} ZvoImageTarget;

#define ZVO_IMAGE_TARGET_INIT                                                                                          \
    ZVO_STRUCT_INIT(ZvoImageTarget, VK_NULL_HANDLE, VK_FORMAT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, {0, 0}, \
                    0, 0, {0, 0})

/// As zvo::DepthTarget.
typedef struct ZvoDepthTarget
{
    size_t struct_size;
    const ZvoImageTarget* image;
    double view_projection[16];
    float miss;
    uint32_t reserved;
} ZvoDepthTarget;

#define ZVO_DEPTH_TARGET_INIT                                                                                          \
    ZVO_STRUCT_INIT(ZvoDepthTarget, NULL, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 1, 0)

ZVO_C_API ZvoResult zvoTracerCreate(ZvoContext* context, uint32_t width, uint32_t height, VkFormat format,
                                    ZvoTracer** tracer);
ZVO_C_API void zvoTracerDestroy(ZvoTracer* tracer);

/// depth: null: none.
ZVO_C_API ZvoResult zvoTracerTrace(ZvoTracer* tracer, ZvoRecorder* recorder, const ZvoTree* tree,
                                   const ZvoCameraInfo* camera, const ZvoTraceInfo* info, const ZvoImageTarget* color,
                                   const ZvoDepthTarget* depth);
ZVO_C_API ZvoResult zvoTracerTraceDynamic(ZvoTracer* tracer, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                          const ZvoCameraInfo* camera, const ZvoTraceInfo* info,
                                          const ZvoImageTarget* color, const ZvoDepthTarget* depth);

ZVO_C_API ZvoResult zvoTracerTracePaths(ZvoTracer* tracer, ZvoRecorder* recorder, const ZvoTree* tree,
                                        ZvoEnvironment* environment, const ZvoCameraInfo* camera,
                                        const ZvoPathInfo* info, const ZvoImageTarget* color);
ZVO_C_API ZvoResult zvoTracerTracePathsDynamic(ZvoTracer* tracer, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                               ZvoEnvironment* environment, const ZvoCameraInfo* camera,
                                               const ZvoPathInfo* info, const ZvoImageTarget* color);
ZVO_C_API ZvoResult zvoTracerSampleCount(const ZvoTracer* tracer, uint32_t* count);
ZVO_C_API ZvoResult zvoTracerForgetSamples(ZvoTracer* tracer);

/// zvo::CameraInfo::lookAt(). camera: its size is set.
ZVO_C_API ZvoResult zvoCameraLookAt(const double eye[3], const double target[3], double vertical_fov,
                                    ZvoCameraInfo* camera);

/// zvo::CameraInfo::ofMatrices(). view, projection: columns. y_up, reversed_depth: zvo::ClipSpace. camera: its size is
/// set.
ZVO_C_API ZvoResult zvoCameraOfMatrices(const double view[16], const double projection[16], VkBool32 y_up,
                                        VkBool32 reversed_depth, ZvoCameraInfo* camera);
ZVO_C_API ZvoResult zvoCameraRays(const ZvoCameraInfo* camera, const ZvoGrid* grid, uint32_t width, uint32_t height,
                                  ZvoCameraRays* rays);

// zvo::RadianceCache.

/// As zvo::RadianceCacheInfo.
typedef struct ZvoRadianceCacheInfo
{
    size_t struct_size;
    uint64_t faces;
    uint32_t width;
    uint32_t height;
} ZvoRadianceCacheInfo;

#define ZVO_RADIANCE_CACHE_INFO_INIT ZVO_STRUCT_INIT(ZvoRadianceCacheInfo, 0, 160, 90)

/// As zvo::CachedFrameInfo.
typedef struct ZvoCachedFrameInfo
{
    size_t struct_size;
    uint32_t rays;
    uint32_t seed;
} ZvoCachedFrameInfo;

#define ZVO_CACHED_FRAME_INFO_INIT ZVO_STRUCT_INIT(ZvoCachedFrameInfo, 16384, 0)

/// As zvo::RadianceCacheStats.
typedef struct ZvoRadianceCacheStats
{
    size_t struct_size;
    uint64_t faces;
    uint64_t refused;
    uint64_t room;
    VkBool32 is_crowded;
    uint32_t reserved;
} ZvoRadianceCacheStats;

#define ZVO_RADIANCE_CACHE_STATS_INIT ZVO_STRUCT_INIT(ZvoRadianceCacheStats, 0, 0, 0, VK_FALSE, 0)

ZVO_C_API ZvoResult zvoRadianceCacheCreate(ZvoContext* context, const ZvoRadianceCacheInfo* info,
                                           ZvoRadianceCache** light);
ZVO_C_API void zvoRadianceCacheDestroy(ZvoRadianceCache* light);
ZVO_C_API ZvoResult zvoRadianceCacheUpdate(ZvoRadianceCache* light, ZvoRecorder* recorder, const ZvoTree* tree,
                                           ZvoEnvironment* environment, const ZvoCameraInfo* camera,
                                           const ZvoCachedFrameInfo* info);
ZVO_C_API ZvoResult zvoRadianceCacheUpdateDynamic(ZvoRadianceCache* light, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                                  ZvoEnvironment* environment, const ZvoCameraInfo* camera,
                                                  const ZvoCachedFrameInfo* info);
ZVO_C_API ZvoResult zvoRadianceCacheAddress(const ZvoRadianceCache* light, uint64_t* address);
ZVO_C_API ZvoResult zvoRadianceCacheForget(ZvoRadianceCache* light);
ZVO_C_API ZvoResult zvoRadianceCacheStats(ZvoRadianceCache* light, ZvoRadianceCacheStats* stats);
ZVO_C_API ZvoResult zvoRadianceCacheBytes(const ZvoRadianceCache* light, uint64_t* bytes);

/// As zvo::CachedPictureInfo.
typedef struct ZvoCachedPictureInfo
{
    size_t struct_size;
    VkBool32 automatic_exposure;
    float exposure;
    ZvoShading shading;
    uint32_t reserved;
} ZvoCachedPictureInfo;

#define ZVO_CACHED_PICTURE_INFO_INIT ZVO_STRUCT_INIT(ZvoCachedPictureInfo, VK_TRUE, 1, ZVO_SHADING_SMOOTH, 0)

ZVO_C_API ZvoResult zvoTracerTraceCached(ZvoTracer* tracer, ZvoRecorder* recorder, const ZvoTree* tree,
                                         ZvoEnvironment* environment, ZvoRadianceCache* light,
                                         const ZvoCameraInfo* camera, const ZvoCachedPictureInfo* info,
                                         const ZvoImageTarget* color);
ZVO_C_API ZvoResult zvoTracerTraceCachedDynamic(ZvoTracer* tracer, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                                ZvoEnvironment* environment, ZvoRadianceCache* light,
                                                const ZvoCameraInfo* camera, const ZvoCachedPictureInfo* info,
                                                const ZvoImageTarget* color);

// zvo::QueryBatch. Its structs have no size, and stay as they are; positions are in lattice units, 256 of which are a
// voxel.

typedef struct ZvoPointQuery
{
    int32_t position[3];
} ZvoPointQuery;

typedef struct ZvoRayQuery
{
    float origin[3];
    float t_min;
    float direction[3];
    float t_max;
} ZvoRayQuery;

typedef struct ZvoBoxQuery
{
    int32_t low[3];
    int32_t high[3];
} ZvoBoxQuery;

typedef struct ZvoNearestQuery
{
    int32_t position[3];
    uint32_t reach;
} ZvoNearestQuery;

typedef struct ZvoSweepQuery
{
    int32_t low[3];
    int32_t high[3];
    int32_t motion[3];
} ZvoSweepQuery;

/// As zvo::QueryAnswer.
typedef struct ZvoQueryAnswer
{
    ZvoQueryState state;
    uint32_t cell[3];
    uint32_t face;
    float t;
    int64_t numerator;
    int64_t denominator;
    uint32_t color;
    float normal[3];
    float emission[3];
    uint32_t index;
} ZvoQueryAnswer;

/// zvo::latticePosition().
ZVO_C_API ZvoResult zvoLatticePosition(const ZvoGrid* grid, const double world[3], int32_t position[3]);

/// queries: [count] of the struct of that kind; may be null for none.
ZVO_C_API ZvoResult zvoQueryBatchCreate(ZvoRecorder* recorder, const ZvoTree* tree, ZvoQueryKind kind,
                                        const void* queries, size_t count, ZvoQueryBatch** batch);
ZVO_C_API ZvoResult zvoQueryBatchCreateDynamic(ZvoRecorder* recorder, ZvoDynamicTree* tree, ZvoQueryKind kind,
                                               const void* queries, size_t count, ZvoQueryBatch** batch);
ZVO_C_API void zvoQueryBatchDestroy(ZvoQueryBatch* batch);
ZVO_C_API ZvoResult zvoQueryBatchIsDone(const ZvoQueryBatch* batch, VkBool32* done);

/// answers: [count], those to the questions from `first` on.
ZVO_C_API ZvoResult zvoQueryBatchAnswers(const ZvoQueryBatch* batch, size_t first, size_t count,
                                         ZvoQueryAnswer* answers);
