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
    ZvoTreeJob* job;
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

// Runs the job, and takes its tree.
static int finishJob(Program* program)
{
    VkBool32 is_done = VK_FALSE;
    while (!is_done)
    {
        VkBool32 has_more = VK_FALSE;
        if (!beginFrame(program) || !isOk(zvoTreeJobRecord(program->job, program->recorder, &has_more)) ||
            !endFrame(program) || !isOk(zvoTreeJobIsDone(program->job, &is_done)))
        {
            return 0;
        }
    }
    const int is_ok = isOk(zvoTreeJobTake(program->job, &program->tree));
    zvoTreeJobDestroy(program->job);
    program->job = NULL;
    return is_ok;
}

static int build(Program* program)
{
    ZvoTreeBuildInfo info = ZVO_TREE_BUILD_INFO_INIT;
    info.grid.origin[0] = info.grid.origin[1] = info.grid.origin[2] = -2;
    info.grid.voxel_size = 0.5F;
    info.grid.depth = 5;
    return isOk(zvoTreeBuildCreate(program->host->context, program->model, &info, &program->job)) && finishJob(program);
}

static int compress(Program* program)
{
    if (!isOk(zvoTreeCompressionCreate(program->host->context, program->tree, &program->job)))
    {
        return 0;
    }
    program->tree = NULL; // it was taken over
    return finishJob(program);
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
    program->tree = NULL; // it was taken over
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

static int lookAtBox(ZvoCameraInfo* camera)
{
    const double eye[3] = {22, 17, 25};
    const double target[3] = {5, 5, 5};
    return isOk(zvoCameraLookAt(eye, target, 0.6, camera));
}

static int beginPicture(Program* program)
{
    const int is_ok = beginFrame(program);
    program->host->beginCopies(program->host->user, program->commands);
    return is_ok;
}

static int endPicture(Program* program, ZvoResult result)
{
    program->host->endCopies(program->host->user, program->commands);
    return isOk(result) && endFrame(program);
}

static int keepPicture(Program* program)
{
    program->host->keep(program->host->user);
    ++program->picture_count;
    return 1;
}

static int show(Program* program)
{
    const ZvoImageTarget* image = &program->host->image;
    ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
    ZvoTraceInfo info = ZVO_TRACE_INFO_INIT;
    if (!lookAtBox(&camera) || !beginPicture(program))
    {
        return 0;
    }
    const ZvoResult result =
        program->dynamic != NULL
            ? zvoTracerTraceDynamic(program->tracer, program->recorder, program->dynamic, &camera, &info, image, NULL)
            : zvoTracerTrace(program->tracer, program->recorder, program->tree, &camera, &info, image, NULL);
    return endPicture(program, result) && keepPicture(program);
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
    const ZvoImageTarget* image = &program->host->image;
    ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
    ZvoPathInfo info = ZVO_PATH_INFO_INIT;
    info.bounces = 1;
    uint32_t count = 1;
    if (!lookAtBox(&camera) || !makeEnvironment(program) || !isOk(zvoTracerForgetSamples(program->tracer)) ||
        !isOk(zvoTracerSampleCount(program->tracer, &count)))
    {
        return 0;
    }
    while (count < 2)
    {
        if (!beginPicture(program))
        {
            return 0;
        }
        const ZvoResult result = program->dynamic != NULL
                                     ? zvoTracerTracePathsDynamic(program->tracer, program->recorder, program->dynamic,
                                                                  program->environment, &camera, &info, image)
                                     : zvoTracerTracePaths(program->tracer, program->recorder, program->tree,
                                                           program->environment, &camera, &info, image);
        if (!endPicture(program, result) || !isOk(zvoTracerSampleCount(program->tracer, &count)))
        {
            return 0;
        }
    }
    return keepPicture(program);
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
    zvoTreeJobDestroy(program.job);
    zvoTreeDestroy(program.tree);
    zvoModelDestroy(program.model);
    return program.picture_count;
}
