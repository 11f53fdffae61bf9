// SPDX-License-Identifier: MIT
#include "c_program.h"

#include <stdio.h>

const float kCBoxCorners[24] = {2, 2, 2, 6, 2, 2, 2, 6, 2, 6, 6, 2, 2, 2, 6, 6, 2, 6, 2, 6, 6, 6, 6, 6};

const uint32_t kCBoxTriangles[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

// The objects of a program, null where there is none.
typedef struct Program
{
    const CHost* host;
    uint64_t frame;
    VkCommandBuffer commands;
    ZvoRecorder* recorder;
    ZvoModel* model;
    ZvoTree* tree;
    ZvoTreeBuild* build;
    ZvoTreeCompression* compression;
    ZvoDynamicTree* dynamic;
    ZvoEnvironment* environment;
    ZvoTracer* tracer;
    uint32_t picture_count;
} Program;

static int isOk(ZvoResult result)
{
    if (result != ZVO_OK)
    {
        fprintf(stderr, "c_program: %s (%d)\n", zvoLastError(), (int)result);
    }
    return result == ZVO_OK;
}

static int beginFrame(Program* program)
{
    program->commands = program->host->begin(program->host->user);
    return isOk(zvoRecorderBegin(program->host->context, program->commands, ++program->frame, 0, &program->recorder));
}

static int endFrame(Program* program)
{
    zvoRecorderEnd(program->recorder);
    program->recorder = NULL;
    program->host->finish(program->host->user, program->commands);
    return isOk(zvoContextFrameDone(program->host->context, program->frame));
}

static int upload(Program* program)
{
    ZvoMeshInfo mesh = ZVO_MESH_INFO_INIT;
    mesh.positions = kCBoxCorners;
    mesh.vertex_count = 8;
    mesh.triangles = kCBoxTriangles;
    mesh.triangle_count = 12;
    ZvoMaterialInfo material = ZVO_MATERIAL_INFO_INIT;
    material.base_color[1] = 0.25F;
    ZvoModelInfo info = ZVO_MODEL_INFO_INIT;
    info.meshes = &mesh;
    info.mesh_count = 1;
    info.materials = &material;
    info.material_count = 1;
    ZvoModelStats stats = ZVO_MODEL_STATS_INIT;
    return beginFrame(program) && isOk(zvoModelCreate(program->recorder, &info, &program->model)) &&
           endFrame(program) && isOk(zvoModelStats(program->model, &stats)) && stats.triangle_count == 12;
}

static int build(Program* program)
{
    ZvoTreeBuildInfo info = ZVO_TREE_BUILD_INFO_INIT;
    info.grid.origin[0] = info.grid.origin[1] = info.grid.origin[2] = -2;
    info.grid.voxel_size = 0.5F;
    info.grid.depth = 5;
    VkBool32 is_done = VK_FALSE;
    if (!isOk(zvoTreeBuildCreate(program->host->context, program->model, &info, &program->build)))
    {
        return 0;
    }
    while (!is_done)
    {
        VkBool32 has_more = VK_FALSE;
        if (!beginFrame(program) || !isOk(zvoTreeBuildRecord(program->build, program->recorder, &has_more)) ||
            !endFrame(program) || !isOk(zvoTreeBuildIsDone(program->build, &is_done)))
        {
            return 0;
        }
    }
    const int is_ok = isOk(zvoTreeBuildTake(program->build, &program->tree));
    zvoTreeBuildDestroy(program->build);
    program->build = NULL;
    return is_ok;
}

static int compress(Program* program)
{
    VkBool32 is_done = VK_FALSE;
    if (!isOk(zvoTreeCompressionCreate(program->host->context, program->tree, &program->compression)))
    {
        return 0;
    }
    program->tree = NULL; // it was taken over
    while (!is_done)
    {
        VkBool32 has_more = VK_FALSE;
        if (!beginFrame(program) ||
            !isOk(zvoTreeCompressionRecord(program->compression, program->recorder, &has_more)) || !endFrame(program) ||
            !isOk(zvoTreeCompressionIsDone(program->compression, &is_done)))
        {
            return 0;
        }
    }
    return isOk(zvoTreeCompressionTake(program->compression, &program->tree));
}

static int addObject(Program* program)
{
    const float place[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 2, 1};
    ZvoDynamicTreeInfo info = ZVO_DYNAMIC_TREE_INFO_INIT;
    info.history_entries = 2;
    ZvoDynamicObjectId object = 0;
    if (!beginFrame(program) || !isOk(zvoDynamicTreeCreate(program->recorder, program->tree, &info, &program->dynamic)))
    {
        return 0;
    }
    program->tree = NULL; // likewise
    return isOk(zvoDynamicTreeAddObject(program->dynamic, program->recorder, program->model, place, &object)) &&
           endFrame(program);
}

static int update(Program* program)
{
    VkBool32 needs_update = VK_TRUE;
    while (needs_update)
    {
        VkBool32 is_complete = VK_FALSE;
        if (!beginFrame(program) || !isOk(zvoDynamicTreeUpdate(program->dynamic, program->recorder, 0, &is_complete)) ||
            !endFrame(program) || !isOk(zvoDynamicTreeNeedsUpdate(program->dynamic, &needs_update)))
        {
            return 0;
        }
    }
    ZvoUpdateStats stats = ZVO_UPDATE_STATS_INIT;
    VkBool32 is_taken = VK_FALSE;
    return isOk(zvoDynamicTreeTakeUpdate(program->dynamic, &stats, &is_taken)) && is_taken;
}

static int edit(Program* program)
{
    ZvoBrushInfo brush = ZVO_BRUSH_INFO_INIT;
    brush.action = ZVO_BRUSH_ACTION_FILL;
    brush.center[0] = 24;
    brush.center[1] = 8;
    brush.center[2] = 24;
    brush.radius = 4;
    brush.color = 255;
    VkBool32 is_recorded = VK_FALSE;
    while (!is_recorded)
    {
        if (!beginFrame(program) ||
            !isOk(zvoDynamicTreeEdit(program->dynamic, program->recorder, &brush, &is_recorded)) || !endFrame(program))
        {
            return 0;
        }
    }
    return isOk(zvoDynamicTreeEndStroke(program->dynamic));
}

static int show(Program* program)
{
    const CHost* host = program->host;
    const double eye[3] = {22, 17, 25};
    const double target[3] = {5, 5, 5};
    ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
    ZvoTraceInfo info = ZVO_TRACE_INFO_INIT;
    if (!isOk(zvoCameraLookAt(eye, target, 0.6, &camera)) || !beginFrame(program))
    {
        return 0;
    }
    host->beginCopies(host->user, program->commands);
    const ZvoResult result =
        program->dynamic != NULL
            ? zvoTracerTraceDynamic(program->tracer, program->recorder, program->dynamic, &camera, &info, &host->image,
                                    NULL)
            : zvoTracerTrace(program->tracer, program->recorder, program->tree, &camera, &info, &host->image, NULL);
    host->endCopies(host->user, program->commands);
    if (!isOk(result) || !endFrame(program))
    {
        return 0;
    }
    host->keep(host->user);
    ++program->picture_count;
    return 1;
}

// A map of two colours above a tree that stands, the simple sky above one that moves.
static int makeEnvironment(Program* program)
{
    static const float kTexels[8 * 3] = {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 2, 1, 0, 2, 1, 0, 2, 1, 0, 2, 1, 0};
    ZvoEnvironmentMapInfo map = ZVO_ENVIRONMENT_MAP_INFO_INIT;
    map.texels = kTexels;
    map.width = 4;
    map.height = 2;
    map.strength = 0.5F;
    ZvoSunInfo sun = ZVO_SUN_INFO_INIT;
    sun.direction[0] = 1;
    zvoEnvironmentDestroy(program->environment);
    program->environment = NULL;
    return beginFrame(program) &&
           isOk(zvoEnvironmentCreate(program->recorder, program->dynamic != NULL ? NULL : &map,
                                     &program->environment)) &&
           isOk(zvoEnvironmentSetSun(program->environment, &sun)) && endFrame(program);
}

static int showPaths(Program* program)
{
    const CHost* host = program->host;
    const double eye[3] = {22, 17, 25};
    const double target[3] = {5, 5, 5};
    ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
    ZvoPathInfo info = ZVO_PATH_INFO_INIT;
    info.bounces = 1;
    uint32_t count = 1;
    if (!isOk(zvoCameraLookAt(eye, target, 0.6, &camera)) || !makeEnvironment(program) ||
        !isOk(zvoTracerForgetSamples(program->tracer)) || !isOk(zvoTracerSampleCount(program->tracer, &count)))
    {
        return 0;
    }
    while (count < 2)
    {
        if (!beginFrame(program))
        {
            return 0;
        }
        host->beginCopies(host->user, program->commands);
        const ZvoResult result = program->dynamic != NULL
                                     ? zvoTracerTracePathsDynamic(program->tracer, program->recorder, program->dynamic,
                                                                  program->environment, &camera, &info, &host->image)
                                     : zvoTracerTracePaths(program->tracer, program->recorder, program->tree,
                                                           program->environment, &camera, &info, &host->image);
        host->endCopies(host->user, program->commands);
        if (!isOk(result) || !endFrame(program) || !isOk(zvoTracerSampleCount(program->tracer, &count)))
        {
            return 0;
        }
    }
    host->keep(host->user);
    ++program->picture_count;
    return 1;
}

uint32_t runCProgram(const CHost* host)
{
    Program program = {0};
    program.host = host;
    if (isOk(zvoTracerCreate(host->context, host->width, host->height, VK_FORMAT_R8G8B8A8_UNORM, &program.tracer)) &&
        upload(&program) && build(&program) && show(&program) && compress(&program) && show(&program) &&
        showPaths(&program) && addObject(&program) && update(&program) && show(&program) && edit(&program) &&
        update(&program) && show(&program))
    {
        showPaths(&program);
    }
    zvoRecorderEnd(program.recorder); // null where all went well
    zvoTracerDestroy(program.tracer);
    zvoEnvironmentDestroy(program.environment);
    zvoDynamicTreeDestroy(program.dynamic);
    zvoTreeCompressionDestroy(program.compression);
    zvoTreeBuildDestroy(program.build);
    zvoTreeDestroy(program.tree);
    zvoModelDestroy(program.model);
    return program.picture_count;
}
