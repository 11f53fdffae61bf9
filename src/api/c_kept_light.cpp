// SPDX-License-Identifier: MIT
// The C interface: light that is kept on voxels.
#include "api/c_convert.h"
#include "api/c_handles.h"
#include "api/c_struct.h"

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
                       at(light, "light")
                           .object.update(at(recorder, "recorder").object, at(tree, "tree").object,
                                          at(environment, "environment").object, ofC(readStruct(camera, "camera")),
                                          ofC(readStruct(info, "info")));
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
                       at(tracer, "tracer")
                           .object.traceKept(at(recorder, "recorder").object, at(tree, "tree").object,
                                             at(environment, "environment").object, at(light, "light").object,
                                             ofC(readStruct(camera, "camera")), ofC(readStruct(info, "info")),
                                             ofC(readStruct(color, "color")));
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
                       Context& object = at(context, "context").object;
                       const KeptLightInfo description = ofC(readStruct(info, "info"));
                       give(light, "light", [&] { return KeptLight(object, description); });
                   });
}

void zvoKeptLightDestroy(ZvoKeptLight* light)
{
    delete light;
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
    return guarded(__func__, [&] { at(address, "address") = at(light, "light").object.address(); });
}

ZvoResult zvoKeptLightForget(ZvoKeptLight* light)
{
    return guarded(__func__, [&] { at(light, "light").object.forget(); });
}

ZvoResult zvoKeptLightStats(ZvoKeptLight* light, ZvoKeptLightStats* stats)
{
    return guarded(__func__, [&] { writeStruct(stats, "stats", toC(at(light, "light").object.stats())); });
}

ZvoResult zvoKeptLightBytes(const ZvoKeptLight* light, uint64_t* bytes)
{
    return guarded(__func__, [&] { at(bytes, "bytes") = at(light, "light").object.bytes(); });
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
