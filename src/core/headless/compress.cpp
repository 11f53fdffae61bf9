// SPDX-License-Identifier: MIT
#include "core/headless/compress.h"

#include <utility>

namespace zvo
{

namespace
{

CompressResult waitFor(vk::HeadlessDevice& device, SvdagBuilder&& builder)
{
    while (!builder.isDone())
    {
        builder.stepDone(device.run([&](vk::FrameGraph& graph) { builder.record(graph); }));
    }
    return builder.take();
}

} // namespace

CompressResult compress(vk::HeadlessDevice& device, Octree octree, const CompressOptions& options)
{
    return waitFor(device, SvdagBuilder(device.device(), std::move(octree), options));
}

CompressResult compress(vk::HeadlessDevice& device, Svdag dag, const CompressOptions& options)
{
    return waitFor(device, SvdagBuilder(device.device(), std::move(dag), options));
}

} // namespace zvo
