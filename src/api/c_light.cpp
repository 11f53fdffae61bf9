// SPDX-License-Identifier: MIT
// The C interface: light from outside of the grid.
#include "api/c_convert.h"
#include "api/c_handles.h"
#include "api/c_struct.h"

using namespace zvo;

ZvoResult zvoEnvironmentCreate(ZvoRecorder* recorder, const ZvoEnvironmentMapInfo* map, ZvoEnvironment** environment)
{
    return guarded(__func__,
                   [&]
                   {
                       Recorder& object = at(recorder, "recorder").object;
                       if (map == nullptr)
                       {
                           give(environment, "environment", [&] { return Environment(object); });
                           return;
                       }
                       const EnvironmentMapInfo description = ofC(readStruct(map, "map"));
                       give(environment, "environment", [&] { return Environment(object, description); });
                   });
}

void zvoEnvironmentDestroy(ZvoEnvironment* environment)
{
    delete environment;
}

ZvoResult zvoEnvironmentSetSun(ZvoEnvironment* environment, const ZvoSunInfo* sun)
{
    return guarded(__func__, [&] { at(environment, "environment").object.setSun(ofC(readStruct(sun, "sun"))); });
}
