// SPDX-License-Identifier: MIT
// Small pictures by all of the kernels that make some. All functions note the kernels that run.
#pragma once

#include "core/tree/device_tree.h"
#include "lanes/kernel_names.h"
#include "runtime/trees.h"

namespace zvo::test
{

/// Traces pictures by every path of the tracer.
void tracePictures(const DeviceTree& tree);

/// Traces paths through a tree with emissive voxels, in both forms, for two pictures that are denoised.
void tracePaths(const DeviceTree& tree);

/// Caches light on the voxels of a tree, in pictures of two sizes, of which the second is seen through cones.
void keepLight(const DeviceTree& tree);

/// Traces pictures of the octree with packed attributes. Pictures of all formats are traced.
void tracePacked(BuildResult built, AttributeFormat format);

/// Traces pictures in the texel formats of hosts' images, lit and unlit, with depth.
void traceForHosts(const DeviceTree& tree);

/// Asks a tree with attributes of all kinds of questions.
void askQuestions(const DeviceTree& tree);

/// Scales a picture of 3 x 2 pixels to twice and to a third of its width.
void scalePictures();

} // namespace zvo::test
