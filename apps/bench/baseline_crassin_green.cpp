// SPDX-License-Identifier: MIT
#include "baseline/crassin_green_build.h"
#include "baseline/thesis_voxelize.h"
#include "bench/baseline_comparisons.h"
#include "common/report.h"

namespace zvo::cli
{

void compareCrassinGreen(BaselineSubject& subject, BaselineRows& rows)
{
    using namespace baseline;
    vk::HeadlessDevice& device = subject.device();
    ThesisTriangles triangles(device.device(), subject.uploaded());
    const FragmentList list =
        listFragments(device, {subject.uploaded(), subject.grid(), subject.options().coverage, triangles});
    CrassinGreenBuffers buffers(device.device());
    subject.measure(
        rows,
        {"Crassin, Green", "build, top-down",
         [&]
         { return sumMs(buildTopDown(device, subject.uploaded(), subject.grid(), list.fragments, buffers).passes); },
         [&] { return subject.buildMs(false, true); }});
}

} // namespace zvo::cli
