// SPDX-License-Identifier: MIT
// The C interface: light that is kept on voxels.
#include "api/c_convert.h"
#include "api/c_handles.h"

namespace zvo
{

namespace
{

template <typename TreeHandle>
ZvoResult update(const char* function, ZvoKeptLight* light, ZvoRecorder* recorder, TreeHandle* tree,
                 ZvoEnvironment* environment, const ZvoCameraInfo* camera, const ZvoKeptFrameInfo* info)
{
    return guarded(function,
                   [&]
                   {
                       objectOf(light, "light")
                           .update(objectOf(recorder, "recorder"), objectOf(tree, "tree"),
                                   objectOf(environment, "environment"), read(camera, "camera"), read(info, "info"));
                   });
}

template <typename TreeHandle>
ZvoResult traceKept(const char* function, ZvoTracer* tracer, ZvoRecorder* recorder, TreeHandle* tree,
                    ZvoEnvironment* environment, ZvoKeptLight* light, const ZvoCameraInfo* camera,
                    const ZvoKeptPictureInfo* info, const ZvoImageTarget* color)
{
    return guarded(function,
                   [&]
                   {
                       objectOf(tracer, "tracer")
                           .traceKept(objectOf(recorder, "recorder"), objectOf(tree, "tree"),
                                      objectOf(environment, "environment"), objectOf(light, "light"),
                                      read(camera, "camera"), read(info, "info"), read(color, "color"));
                   });
}

} // namespace

} // namespace zvo

using namespace zvo;

ZvoResult zvoKeptLightCreate(ZvoContext* context, const ZvoKeptLightInfo* info, ZvoKeptLight** light)
{
    return guarded(__func__,
                   [&]
                   {
                       Context& object = objectOf(context, "context");
                       const KeptLightInfo description = read(info, "info");
                       give(light, "light", [&] { return KeptLight(object, description); });
                   });
}

ZvoResult zvoKeptLightUpdate(ZvoKeptLight* light, ZvoRecorder* recorder, const ZvoTree* tree,
                             ZvoEnvironment* environment, const ZvoCameraInfo* camera, const ZvoKeptFrameInfo* info)
{
    return update(__func__, light, recorder, tree, environment, camera, info);
}

ZvoResult zvoKeptLightUpdateDynamic(ZvoKeptLight* light, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                    ZvoEnvironment* environment, const ZvoCameraInfo* camera,
                                    const ZvoKeptFrameInfo* info)
{
    return update(__func__, light, recorder, tree, environment, camera, info);
}

ZvoResult zvoKeptLightAddress(const ZvoKeptLight* light, uint64_t* address)
{
    return guarded(__func__, [&] { at(address, "address") = objectOf(light, "light").address(); });
}

ZvoResult zvoKeptLightForget(ZvoKeptLight* light)
{
    return guarded(__func__, [&] { objectOf(light, "light").forget(); });
}

ZvoResult zvoKeptLightStats(ZvoKeptLight* light, ZvoKeptLightStats* stats)
{
    return guarded(__func__, [&] { write(stats, "stats", objectOf(light, "light").stats()); });
}

ZvoResult zvoKeptLightBytes(const ZvoKeptLight* light, uint64_t* bytes)
{
    return guarded(__func__, [&] { at(bytes, "bytes") = objectOf(light, "light").bytes(); });
}

ZvoResult zvoTracerTraceKept(ZvoTracer* tracer, ZvoRecorder* recorder, const ZvoTree* tree, ZvoEnvironment* environment,
                             ZvoKeptLight* light, const ZvoCameraInfo* camera, const ZvoKeptPictureInfo* info,
                             const ZvoImageTarget* color)
{
    return traceKept(__func__, tracer, recorder, tree, environment, light, camera, info, color);
}

ZvoResult zvoTracerTraceKeptDynamic(ZvoTracer* tracer, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                    ZvoEnvironment* environment, ZvoKeptLight* light, const ZvoCameraInfo* camera,
                                    const ZvoKeptPictureInfo* info, const ZvoImageTarget* color)
{
    return traceKept(__func__, tracer, recorder, tree, environment, light, camera, info, color);
}
