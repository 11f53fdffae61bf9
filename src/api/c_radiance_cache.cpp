// SPDX-License-Identifier: MIT
// The C interface: the radiance cache.
#include "api/c_convert.h"
#include "api/c_handles.h"

namespace zvo
{

namespace
{

template <typename TreeHandle>
ZvoResult update(const char* function, ZvoRadianceCache* light, ZvoRecorder* recorder, TreeHandle* tree,
                 ZvoEnvironment* environment, const ZvoCameraInfo* camera, const ZvoCachedFrameInfo* info)
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
ZvoResult traceCached(const char* function, ZvoTracer* tracer, ZvoRecorder* recorder, TreeHandle* tree,
                      ZvoEnvironment* environment, ZvoRadianceCache* light, const ZvoCameraInfo* camera,
                      const ZvoCachedPictureInfo* info, const ZvoImageTarget* color)
{
    return guarded(function,
                   [&]
                   {
                       objectOf(tracer, "tracer")
                           .traceCached(objectOf(recorder, "recorder"), objectOf(tree, "tree"),
                                        objectOf(environment, "environment"), objectOf(light, "light"),
                                        read(camera, "camera"), read(info, "info"), read(color, "color"));
                   });
}

} // namespace

} // namespace zvo

using namespace zvo;

ZvoResult zvoRadianceCacheCreate(ZvoContext* context, const ZvoRadianceCacheInfo* info, ZvoRadianceCache** light)
{
    return guarded(__func__,
                   [&]
                   {
                       Context& object = objectOf(context, "context");
                       const RadianceCacheInfo description = read(info, "info");
                       give(light, "light", [&] { return RadianceCache(object, description); });
                   });
}

ZvoResult zvoRadianceCacheUpdate(ZvoRadianceCache* light, ZvoRecorder* recorder, const ZvoTree* tree,
                                 ZvoEnvironment* environment, const ZvoCameraInfo* camera,
                                 const ZvoCachedFrameInfo* info)
{
    return update(__func__, light, recorder, tree, environment, camera, info);
}

ZvoResult zvoRadianceCacheUpdateDynamic(ZvoRadianceCache* light, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                        ZvoEnvironment* environment, const ZvoCameraInfo* camera,
                                        const ZvoCachedFrameInfo* info)
{
    return update(__func__, light, recorder, tree, environment, camera, info);
}

ZvoResult zvoRadianceCacheAddress(const ZvoRadianceCache* light, uint64_t* address)
{
    return guarded(__func__, [&] { at(address, "address") = objectOf(light, "light").address(); });
}

ZvoResult zvoRadianceCacheForget(ZvoRadianceCache* light)
{
    return guarded(__func__, [&] { objectOf(light, "light").forget(); });
}

ZvoResult zvoRadianceCacheStats(ZvoRadianceCache* light, ZvoRadianceCacheStats* stats)
{
    return guarded(__func__, [&] { write(stats, "stats", objectOf(light, "light").stats()); });
}

ZvoResult zvoRadianceCacheBytes(const ZvoRadianceCache* light, uint64_t* bytes)
{
    return guarded(__func__, [&] { at(bytes, "bytes") = objectOf(light, "light").bytes(); });
}

ZvoResult zvoTracerTraceCached(ZvoTracer* tracer, ZvoRecorder* recorder, const ZvoTree* tree,
                               ZvoEnvironment* environment, ZvoRadianceCache* light, const ZvoCameraInfo* camera,
                               const ZvoCachedPictureInfo* info, const ZvoImageTarget* color)
{
    return traceCached(__func__, tracer, recorder, tree, environment, light, camera, info, color);
}

ZvoResult zvoTracerTraceCachedDynamic(ZvoTracer* tracer, ZvoRecorder* recorder, ZvoDynamicTree* tree,
                                      ZvoEnvironment* environment, ZvoRadianceCache* light, const ZvoCameraInfo* camera,
                                      const ZvoCachedPictureInfo* info, const ZvoImageTarget* color)
{
    return traceCached(__func__, tracer, recorder, tree, environment, light, camera, info, color);
}
