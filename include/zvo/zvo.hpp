// SPDX-License-Identifier: MIT
// All of zvo for C++ programs. docs/embedding.md walks through it.
#pragma once

#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) <= 201703L
#error "zvo needs C++20: give the compiler -std=c++20, or CMake target_compile_features(... cxx_std_20). zvo/zvo.h is for C"
#endif

#include "zvo/context.h"
#include "zvo/device.h"
#include "zvo/dynamic_tree.h"
#include "zvo/error.h"
#include "zvo/image_target.h"
#include "zvo/kernel_list.h"
#include "zvo/light.h"
#include "zvo/log.h"
#include "zvo/memory.h"
#include "zvo/model.h"
#include "zvo/query.h"
#include "zvo/radiance_cache.h"
#include "zvo/tracer.h"
#include "zvo/tree.h"
#include "zvo/types.h"
#include "zvo/version.h"
