// SPDX-License-Identifier: MIT
#include "zvo/version.h"

namespace zvo
{

int version() noexcept
{
    return ZVO_VERSION;
}

} // namespace zvo
