// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/normal.h"

namespace zvo::cli
{

using zvo::decodeNormal;

} // namespace zvo::cli
