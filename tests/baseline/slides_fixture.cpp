// SPDX-License-Identifier: MIT
#include "baseline/slides_fixture.h"

#include "baseline/baseline_kernels.h"
#include "support/device.h"

namespace zvo::test
{

vk::HeadlessDevice& slidesDevice()
{
    return sharedDevice(baseline::allKernels());
}

} // namespace zvo::test
