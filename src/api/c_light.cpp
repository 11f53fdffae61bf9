// SPDX-License-Identifier: MIT
// The C interface: light from outside of the grid.
#include "api/c_convert.h"
#include "api/c_handles.h"

using namespace zvo;

ZvoResult zvoEnvironmentCreate(ZvoRecorder* recorder, const ZvoEnvironmentMapInfo* map, ZvoEnvironment** environment)
{
    return guarded(__func__,
                   [&]
                   {
                       Recorder& object = objectOf(recorder, "recorder");
                       if (map == nullptr)
                       {
                           give(environment, "environment", [&] { return Environment(object); });
                           return;
                       }
                       const EnvironmentMapInfo description = read(map, "map");
                       give(environment, "environment", [&] { return Environment(object, description); });
                   });
}

ZvoResult zvoSunlight(const double direction[3], const double up[3], ZvoSunInfo* sun)
{
    return guarded(__func__,
                   [&]
                   {
                       static_cast<void>(at(sun, "sun")); // before it is known whether the direction is one
                       const SunInfo made = sunlight(arrayOf<3>(direction, "direction"), arrayOf<3>(up, "up"));
                       write(sun, "sun", made);
                   });
}

ZvoResult zvoEnvironmentSetSun(ZvoEnvironment* environment, const ZvoSunInfo* sun)
{
    return guarded(__func__, [&] { objectOf(environment, "environment").setSun(read(sun, "sun")); });
}
