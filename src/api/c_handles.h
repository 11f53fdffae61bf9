// SPDX-License-Identifier: MIT
// The objects behind the handles of the C interface.
#pragma once

#include "api/c_guard.h"
#include "zvo/zvo.h"
#include "zvo/zvo.hpp"

#include <deque>
#include <string>

#define ZVO_HANDLE(Handle, Object)                                                                                     \
    struct Handle                                                                                                      \
    {                                                                                                                  \
        zvo::Object object;                                                                                            \
    }

ZVO_HANDLE(ZvoDeviceReport, DeviceReport);
ZVO_HANDLE(ZvoFeatureStorage, FeatureStorage);
ZVO_HANDLE(ZvoRecorder, Recorder);
ZVO_HANDLE(ZvoModel, Model);
ZVO_HANDLE(ZvoTree, Tree);
ZVO_HANDLE(ZvoTreeJob, TreeJob);
ZVO_HANDLE(ZvoEnvironment, Environment);
ZVO_HANDLE(ZvoTracer, Tracer);
ZVO_HANDLE(ZvoRadianceCache, RadianceCache);
ZVO_HANDLE(ZvoQueryBatch, QueryBatch);
ZVO_HANDLE(ZvoKernelPreparation, KernelPreparation);

#undef ZVO_HANDLE

/// The host's C function stands in front of the Context, so that it outlives it.
struct ZvoContext
{
    explicit ZvoContext(const ZvoContextInfo& info);
    ZvoContext(const ZvoContext&) = delete;
    ZvoContext& operator=(const ZvoContext&) = delete;

    ZvoLogCallback log;
    zvo::Context object;
    ZvoDeviceReport report;
    std::string made_kernels = {}; // as the host was told last
};

struct ZvoDynamicTree
{
    zvo::DynamicTree object;
    std::deque<zvo::UpdateStats> updates = {}; // that the host has not taken
};

namespace zvo
{

/// The object of a handle. Throws Error{Usage} for null.
template <typename Handle> auto& objectOf(Handle* handle, const char* name)
{
    return at(handle, name).object;
}

} // namespace zvo
