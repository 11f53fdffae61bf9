// SPDX-License-Identifier: MIT
#include "baseline/slides_builder.h"
#include "baseline/slides_trace.h"
#include "bench/baseline_comparisons.h"
#include "common/report.h"
#include "runtime/run_job.h"

#include <utility>

namespace zvo::cli
{

void compareSlides(BaselineSubject& subject, BaselineRows& rows)
{
    using namespace baseline;
    vk::HeadlessDevice& device = subject.device();
    const BenchBaselinesOptions& options = subject.options();
    const auto buildNodes = [&](bool is_dag, bool attributes, SlidesTree& tree)
    {
        tree = {};
        SlidesResult result =
            runJob(device, SlidesBuilder(device.device(), subject.uploaded(), subject.grid(),
                                         {.coverage = options.coverage,
                                          .attributes = attributes,
                                          .dag = is_dag,
                                          .nodes = attributes ? SlidesNodes::WithSums : SlidesNodes::Plain}));
        tree = std::move(result.tree);
        return result.ms();
    };
    const auto build = [&](bool is_dag, SlidesTree& tree) { return buildNodes(is_dag, options.attributes, tree); };
    SlidesTree octree;
    SlidesTree dag;
    subject.measure(rows, {"slides", "voxelize and build", [&] { return build(false, octree); },
                           [&] { return subject.buildMs(true, true); }});
    subject.measure(
        rows, {"slides", "voxelize and build, DAG", [&] { return build(true, dag); }, [&] { return subject.dagMs(); }});
    subject.addSize(rows, options.attributes ? "slides octree, 68-byte nodes" : "slides octree, 36-byte nodes",
                    octree.node_count, octree.geometryBytes());
    subject.addSize(rows, options.attributes ? "slides DAG, 68-byte nodes" : "slides DAG, 36-byte nodes",
                    dag.node_count, dag.geometryBytes());

    SlidesTraceBuffers hits(device.device(), kBaselineWidth, kBaselineHeight);
    const auto measureRays = [&](const char* name, const SlidesTraceOptions& form)
    {
        subject.measure(rows, {"slides", name,
                               [&] {
                                   return sumMs(device.run(
                                       [&](auto& graph) { slidesTrace(graph, octree, subject.camera(), form, hits); }));
                               },
                               subject.rays()});
    };
    if (options.attributes)
    {
        measureRays("rays, state saved, 68-byte nodes", {});
        buildNodes(false, false, octree);
    }
    measureRays("rays, state saved", {});
    measureRays("rays, state saved, without tips", {.stop_at_far_side = false, .skip_behind = false});
    measureRays("rays, children pushed", {.push_children = true});
    measureRays("rays, children pushed, without tips",
                {.push_children = true, .stop_at_far_side = false, .skip_behind = false});
}

} // namespace zvo::cli
