// SPDX-License-Identifier: MIT
#pragma once

#include "core/svdag/svdag_builder.h"
#include "vk/headless.h"

namespace zvo
{

/// Makes a DAG of an octree, or of a DAG in which equal nodes stand several times (SvdagBuilder). Waits between its
/// steps. Throws as these.
CompressResult compress(vk::HeadlessDevice& device, Octree octree, const CompressOptions& options = {});
CompressResult compress(vk::HeadlessDevice& device, Svdag dag, const CompressOptions& options = {});

} // namespace zvo
