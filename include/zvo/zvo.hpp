// SPDX-License-Identifier: MIT
// All of zvo for C++ programs. docs/embedding.md walks through it.
#pragma once

#include "zvo/context.h"
#include "zvo/device.h"
#include "zvo/dynamic_tree.h"
#include "zvo/error.h"
#include "zvo/image_target.h"
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
