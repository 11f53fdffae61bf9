// SPDX-License-Identifier: MIT
// The C interface: handles are destroyed.
#include "api/c_handles.h"

#define ZVO_DESTROYS(function, Handle)                                                                                 \
    void function(Handle* handle)                                                                                      \
    {                                                                                                                  \
        delete handle;                                                                                                 \
    }

ZVO_DESTROYS(zvoDeviceReportDestroy, ZvoDeviceReport)
ZVO_DESTROYS(zvoFeatureStorageDestroy, ZvoFeatureStorage)
ZVO_DESTROYS(zvoContextDestroy, ZvoContext)
ZVO_DESTROYS(zvoRecorderEnd, ZvoRecorder)
ZVO_DESTROYS(zvoModelDestroy, ZvoModel)
ZVO_DESTROYS(zvoTreeDestroy, ZvoTree)
ZVO_DESTROYS(zvoTreeJobDestroy, ZvoTreeJob)
ZVO_DESTROYS(zvoDynamicTreeDestroy, ZvoDynamicTree)
ZVO_DESTROYS(zvoEnvironmentDestroy, ZvoEnvironment)
ZVO_DESTROYS(zvoTracerDestroy, ZvoTracer)
ZVO_DESTROYS(zvoRadianceCacheDestroy, ZvoRadianceCache)
ZVO_DESTROYS(zvoQueryBatchDestroy, ZvoQueryBatch)
ZVO_DESTROYS(zvoKernelPreparationDestroy, ZvoKernelPreparation)

#undef ZVO_DESTROYS
