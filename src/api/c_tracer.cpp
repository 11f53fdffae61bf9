// SPDX-License-Identifier: MIT
// The C interface: pictures and cameras.
#include "api/c_convert.h"
#include "api/c_handles.h"
#include "api/c_struct.h"

#include <algorithm>
#include <optional>

namespace zvo
{

namespace
{

template <typename TreeHandle>
ZvoResult trace(const char* function, ZvoTracer* tracer, ZvoRecorder* recorder, TreeHandle* tree,
                const ZvoCameraInfo* camera, const ZvoTraceInfo* info, const ZvoImageTarget* color,
                const ZvoDepthTarget* depth)
{
    return guarded(function,
                   [&]
                   {
                       std::optional<DepthTarget> depth_target;
                       if (depth != nullptr)
                       {
                           depth_target = ofC(readStruct(depth, "depth"));
                       }
                       at(tracer, "tracer")
                           .object.trace(at(recorder, "recorder").object, at(tree, "tree").object,
                                         ofC(readStruct(camera, "camera")), ofC(readStruct(info, "info")),
                                         ofC(readStruct(color, "color")), depth_target ? &*depth_target : nullptr);
                   });
}

template <typename TreeHandle>
ZvoResult tracePaths(const char* function, ZvoTracer* tracer, ZvoRecorder* recorder, TreeHandle* tree,
                     ZvoEnvironment* environment, const ZvoCameraInfo* camera, const ZvoPathInfo* info,
                     const ZvoImageTarget* color)
{
    return guarded(function,
                   [&]
                   {
                       at(tracer, "tracer")
                           .object.tracePaths(at(recorder, "recorder").object, at(tree, "tree").object,
                                              at(environment, "environment").object, ofC(readStruct(camera, "camera")),
                                              ofC(readStruct(info, "info")), ofC(readStruct(color, "color")));
                   });
}

DVec3 vectorOf(const double* values, const char* name)
{
    DVec3 result{};
    std::copy_n(&at(values, name), result.size(), result.begin());
    return result;
}

} // namespace

} // namespace zvo

using namespace zvo;

ZvoResult zvoTracerCreate(ZvoContext* context, uint32_t width, uint32_t height, VkFormat format, ZvoTracer** tracer)
{
    return guarded(__func__,
                   [&]
                   {
                       Context& object = at(context, "context").object;
                       give(tracer, "tracer", [&] { return Tracer(object, width, height, format); });
                   });
}

void zvoTracerDestroy(ZvoTracer* tracer)
{
    delete tracer;
}

ZvoResult zvoTracerTrace(ZvoTracer* tracer, ZvoRecorder* recorder, const ZvoTree* tree, const ZvoCameraInfo* camera,
                         const ZvoTraceInfo* info, const ZvoImageTarget* color, const ZvoDepthTarget* depth)
{
    return trace(__func__, tracer, recorder, tree, camera, info, color, depth);
}

ZvoResult zvoTracerTraceDynamic(ZvoTracer* tracer, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                const ZvoCameraInfo* camera, const ZvoTraceInfo* info, const ZvoImageTarget* color,
                                const ZvoDepthTarget* depth)
{
    return trace(__func__, tracer, recorder, tree, camera, info, color, depth);
}

ZvoResult zvoTracerTracePaths(ZvoTracer* tracer, ZvoRecorder* recorder, const ZvoTree* tree,
                              ZvoEnvironment* environment, const ZvoCameraInfo* camera, const ZvoPathInfo* info,
                              const ZvoImageTarget* color)
{
    return tracePaths(__func__, tracer, recorder, tree, environment, camera, info, color);
}

ZvoResult zvoTracerTracePathsDynamic(ZvoTracer* tracer, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                     ZvoEnvironment* environment, const ZvoCameraInfo* camera, const ZvoPathInfo* info,
                                     const ZvoImageTarget* color)
{
    return tracePaths(__func__, tracer, recorder, tree, environment, camera, info, color);
}

ZvoResult zvoTracerSampleCount(const ZvoTracer* tracer, uint32_t* count)
{
    return guarded(__func__, [&] { at(count, "count") = at(tracer, "tracer").object.sampleCount(); });
}

ZvoResult zvoTracerForgetSamples(ZvoTracer* tracer)
{
    return guarded(__func__, [&] { at(tracer, "tracer").object.forgetSamples(); });
}

ZvoResult zvoCameraLookAt(const double eye[3], const double target[3], double vertical_fov, ZvoCameraInfo* camera)
{
    return guarded(__func__,
                   [&]
                   {
                       const CameraInfo info =
                           CameraInfo::lookAt(vectorOf(eye, "eye"), vectorOf(target, "target"), vertical_fov);
                       writeStruct(camera, "camera", toC(info));
                   });
}

ZvoResult zvoCameraRays(const ZvoCameraInfo* camera, const ZvoGrid* grid, uint32_t height, ZvoCameraRays* rays)
{
    return guarded(__func__,
                   [&]
                   {
                       const CameraInfo info = ofC(readStruct(camera, "camera"));
                       at(rays, "rays") = toC(cameraRays(info, ofC(at(grid, "grid")), height));
                   });
}
