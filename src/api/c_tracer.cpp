// SPDX-License-Identifier: MIT
// The C interface: pictures and cameras.
#include "api/c_convert.h"
#include "api/c_handles.h"

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
                           depth_target = read(depth, "depth");
                       }
                       objectOf(tracer, "tracer")
                           .trace(objectOf(recorder, "recorder"), objectOf(tree, "tree"), read(camera, "camera"),
                                  read(info, "info"), read(color, "color"), depth_target ? &*depth_target : nullptr);
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
                       objectOf(tracer, "tracer")
                           .tracePaths(objectOf(recorder, "recorder"), objectOf(tree, "tree"),
                                       objectOf(environment, "environment"), read(camera, "camera"), read(info, "info"),
                                       read(color, "color"));
                   });
}

} // namespace

} // namespace zvo

using namespace zvo;

ZvoResult zvoTracerCreate(ZvoContext* context, uint32_t width, uint32_t height, VkFormat format, ZvoTracer** tracer)
{
    return guarded(__func__,
                   [&]
                   {
                       Context& object = objectOf(context, "context");
                       give(tracer, "tracer", [&] { return Tracer(object, width, height, format); });
                   });
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
    return guarded(__func__, [&] { at(count, "count") = objectOf(tracer, "tracer").sampleCount(); });
}

ZvoResult zvoTracerForgetSamples(ZvoTracer* tracer)
{
    return guarded(__func__, [&] { objectOf(tracer, "tracer").forgetSamples(); });
}

ZvoResult zvoCameraLookAt(const double eye[3], const double target[3], double vertical_fov, ZvoCameraInfo* camera)
{
    return guarded(__func__,
                   [&]
                   {
                       const CameraInfo info =
                           CameraInfo::lookAt(arrayOf<3>(eye, "eye"), arrayOf<3>(target, "target"), vertical_fov);
                       write(camera, "camera", info);
                   });
}

ZvoResult zvoCameraOfMatrices(const double view[16], const double projection[16], VkBool32 y_up,
                              VkBool32 reversed_depth, ZvoCameraInfo* camera)
{
    return guarded(
        __func__,
        [&]
        {
            static_cast<void>(at(camera, "camera")); // before it is known whether the matrices are a camera's
            const ClipSpace clip = {.y_up = y_up != VK_FALSE, .reversed_depth = reversed_depth != VK_FALSE};
            write(camera, "camera",
                  CameraInfo::ofMatrices(arrayOf<16>(view, "view"), arrayOf<16>(projection, "projection"), clip));
        });
}

ZvoResult zvoCameraRays(const ZvoCameraInfo* camera, const ZvoGrid* grid, uint32_t width, uint32_t height,
                        ZvoCameraRays* rays)
{
    return guarded(__func__,
                   [&]
                   {
                       const CameraRays result =
                           cameraRays(read(camera, "camera"), ofC(at(grid, "grid")), width, height);
                       at(rays, "rays") = toC<ZvoCameraRays>(result);
                   });
}
