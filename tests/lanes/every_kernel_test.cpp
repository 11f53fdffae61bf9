// SPDX-License-Identifier: MIT
// Runs every kernel of the library once. The work is so small that it can be watched by tools that slow programs down a
// hundredfold: valgrind, instrumented kernels, poisoned memory.
#include "core/base/grid.h"
#include "core/base/kernels.h"
#include "core/deform/deform_mesh.h"
#include "core/denoise/denoiser.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/headless/attribute_packer.h"
#include "core/headless/compress.h"
#include "core/headless/pipeline.h"
#include "core/headless/svdag_forest.h"
#include "core/octree/octree_build.h"
#include "core/path/path_tracer.h"
#include "core/present/present.h"
#include "core/radiance/radiance_tracer.h"
#include "core/scene/animation.h"
#include "core/trace/trace.h"
#include "core/trace/trace_depth.h"
#include "core/tree/device_tree.h"
#include "oracle/voxelizer.h"
#include "support/dag_compare.h"
#include "support/dags.h"
#include "support/edit_model.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>

namespace zvo
{

namespace
{

// The path to a voxel's rank in a DAG goes below the table of ranks, through every kind of list.
constexpr std::uint32_t kDepthOfRankSums = 11;

using test::device;

// Names of the kernels that have run.
using Names = std::set<std::string>;

void addNames(Names& names, const std::vector<vk::PassTime>& passes)
{
    for (const vk::PassTime& pass : passes)
    {
        names.insert(pass.name);
    }
}

// A few triangles in three materials, which use every property of a material: plain, textured and emissive, blended.
Scene smallScene()
{
    Scene scene = test::randomTriangles(3, 12, 16.0F);
    Primitive& plain = scene.primitives[0];
    Primitive textured = plain;
    for (const glm::vec3& position : plain.positions)
    {
        textured.uvs.emplace_back(position.x * 0.1F, position.y * 0.1F);
        textured.normals.emplace_back(0.0F, 1.0F, 0.0F);
        textured.colors.emplace_back(0.5F, 1.0F, 0.25F, 0.75F);
    }
    scene.images.push_back({"checker", 2, 2, {255, 0, 0, 255, 0, 255, 0, 90, 0, 0, 255, 255, 255, 255, 255, 160}});
    scene.textures.push_back({0, WrapMode::Repeat, WrapMode::MirroredRepeat});
    Material emissive;
    emissive.base_color_texture = 0;
    emissive.emission = glm::vec3(2.0F, 1.0F, 0.5F);
    emissive.emission_texture = 0;
    Material blended;
    blended.base_color_texture = 0;
    blended.alpha_mode = AlphaMode::Blend;
    scene.materials.push_back(emissive);
    scene.materials.push_back(blended);
    textured.material = 1;
    scene.primitives.push_back(textured);
    textured.material = 2;
    scene.primitives.push_back(textured);
    scene.instances.push_back({1, glm::mat4(0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1)});
    scene.instances.push_back({2, glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 16, 0, 0, 1)});
    return scene;
}

std::vector<std::uint64_t> voxelCodesOf(const std::vector<test::Cell>& cells, const Grid& grid)
{
    std::vector<std::uint64_t> codes;
    for (const test::Cell& cell : cells)
    {
        if (cell.level == grid.nodeLevels())
        {
            codes.push_back(cell.code);
        }
    }
    return codes;
}

// Traces pictures by every path of the tracer.
Names tracePictures(const DeviceTree& tree)
{
    Names names;
    const ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    BeamGrid beam(device().device(), tree.isDag());
    TraceBuffers buffers(device().device(), 17, 9);
    addNames(names, device().run([&](vk::FrameGraph& graph) { buildBeam(graph, tree, beam); }));
    for (const TraceStack stack : {TraceStack::Registers, TraceStack::Private, TraceStack::Shared})
    {
        if (tree.isDag() && stack != TraceStack::Registers)
        {
            continue; // lists and stacks are independent, and compiling each variant takes time
        }
        for (const View shown : {View::Color, View::Iterations})
        {
            TraceOptions options;
            options.view = shown;
            options.stack = stack;
            options.occlusion_rays = 2;
            options.beam = stack != TraceStack::Private;
            const TraceCamera camera = traceCamera(view, tree.grid, buffers.height);
            addNames(names,
                     device().run([&](vk::FrameGraph& graph) { trace(graph, tree, beam, camera, options, buffers); }));
        }
    }
    TraceOptions coarse;
    coarse.detail_level = 2;
    const TraceCamera camera = traceCamera(view, tree.grid, buffers.height);
    addNames(names, device().run([&](vk::FrameGraph& graph) { trace(graph, tree, beam, camera, coarse, buffers); }));
    vk::BufferOf<gpu::PixelReport> report(device().device(), "report", 1);
    addNames(names, device().run(
                        [&](vk::FrameGraph& graph) {
                            inspectPixel(graph, tree, camera, coarse, buffers, {8, 4}, report);
                        }));
    const gpu::Ray ray = {{1.1F, 1.2F, 1.3F}, 0.0F, {-1.0F, -2.0F, 3.0F}, 4.0F};
    const vk::BufferOf<gpu::Ray> rays = device().makeBuffer<gpu::Ray>("rays", std::vector<gpu::Ray>(3, ray));
    vk::BufferOf<gpu::Hit> hits(device().device(), "hits", rays.count());
    vk::BufferOf<gpu::DispatchArgs> rounds(device().device(), "rounds", gpu::kTraceRoundsMax);
    vk::BufferOf<gpu::TraceStatus> status(device().device(), "status", 1);
    addNames(names, device().run(
                        [&](vk::FrameGraph& graph)
                        {
                            graph.fill(status, 0);
                            traceRays(graph, tree, rays, hits, rounds, status, {});
                        }));
    return names;
}

// Traces paths through a tree with emissive voxels, in both forms, for two pictures that are denoised.
Names tracePaths(const DeviceTree& tree)
{
    DeviceEnvironment sky(device().device());
    PathTracer tracer(device().device());
    Denoiser denoiser(device().device());
    Developer developer(device().device());
    denoiser.resize(9, 10);
    const ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    const TraceCamera camera = traceCamera(view, tree.grid, 10);
    vk::BufferOf<gpu::uint> picture(device().device(), "picture", 90);
    Names names;
    for (const PathForm form : {PathForm::Stages, PathForm::OneKernel})
    {
        tracer.resize(9, 10, form);
        for (const bool features : {false, true, true})
        {
            tracer.forget();
            addNames(names, device().run(
                                [&](vk::FrameGraph& graph)
                                {
                                    tracer.addSample(graph, tree, sky, camera, {.bounces = 1, .features = features});
                                    if (features)
                                    {
                                        denoiser.denoise(graph, tracer.guided(), 4);
                                    }
                                    developer.develop(graph, tracer.picture(), TexelFormat::Rgba8, {}, picture);
                                }));
        }
    }
    return names;
}

// Keeps light on the voxels of a tree, in pictures of two sizes, of which the second is seen through cones.
Names keepLight(const DeviceTree& tree)
{
    DeviceEnvironment sky(device().device());
    RadianceTracer tracer(device().device());
    const ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    Names names;
    for (const std::uint32_t height : {10U, 11U})
    {
        tracer.resize(9, height);
        const TraceCamera camera = traceCamera(view, tree.grid, height);
        const KeptView kind = height == 10 ? KeptView::Faces : KeptView::Cones;
        for (std::uint32_t frame = 0; frame < 2; ++frame)
        {
            addNames(names, device().run([&](vk::FrameGraph& graph)
                                         { tracer.addFrame(graph, tree, sky, camera, {.faces = 100}, kind); }));
        }
    }
    return names;
}

// Deforms 70 vertices with all that a deforming mesh can have, in two instances; the second one has no skin.
Names deformVertices()
{
    Scene scene;
    Primitive& primitive = scene.primitives.emplace_back();
    for (std::uint32_t i = 0; i < 70; ++i)
    {
        const auto place = static_cast<float>(i);
        primitive.positions.emplace_back(place, 1.0F, 2.0F);
        primitive.normals.emplace_back(0.0F, 1.0F, 0.0F);
        primitive.joints.emplace_back(i % 3, 1, 2, 0);
        primitive.weights.emplace_back(0.5F, 0.25F, 0.25F, 0.0F);
    }
    primitive.morph_targets = {{primitive.normals, {}}, {primitive.positions, primitive.normals}};
    scene.skins.push_back({{0, 0, 0}, std::vector<glm::mat4>(3, glm::mat4(1.0F))});
    scene.instances.push_back({0, glm::mat4(1.0F), kNone, 0});
    scene.instances.push_back({0, glm::mat4(1.0F), kNone, kNone});
    Pose pose;
    pose.transforms.assign(2, glm::mat4(1.0F));
    pose.joint_matrices = {std::vector<glm::mat4>(3, glm::mat4(2.0F)), {}};
    pose.morph_weights = {{0.5F, 0.25F}, {1.0F, 0.0F}};
    const DeformMesh mesh = uploadDeformMesh(device(), scene);
    PoseBuffers buffers(device().device(), mesh);
    vk::BufferOf<gpu::vec3> positions(device().device(), "positions", mesh.position_count);
    vk::BufferOf<gpu::vec3> normals(device().device(), "normals", mesh.normal_count);
    Names names;
    addNames(names, device().run(
                        [&](vk::FrameGraph& graph)
                        {
                            updatePose(graph, mesh, pose, buffers);
                            deform(graph, mesh, buffers, positions, normals);
                        }));
    const std::vector<gpu::vec3> moved = device().download(positions);
    EXPECT_EQ(moved.at(69), gpu::vec3(172.5F, 3.5F, 5.0F)); // (69, 1, 2) * 1.25 and (0, 0.5, 0), doubled
    EXPECT_EQ(moved.at(139), gpu::vec3(69.0F, 2.0F, 2.0F)); // 1 added to y
    return names;
}

// Averages the nodes of an octree in which voxels are some way apart.
Names averageNodesOf(const GpuScene& scene, std::uint32_t depth, std::uint64_t voxel_count, std::uint64_t distance)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
    std::vector<test::Cell> voxels;
    for (std::uint64_t i = 0; i < voxel_count; ++i)
    {
        const auto noise = static_cast<gpu::uint>(i * 0x9E3779B97F4A7C15U >> 32);
        voxels.push_back({grid.nodeLevels(), i * distance, {noise & 0xFFFFFF, noise * 0x85EBCA6B}});
    }
    const std::vector<test::Cell> expected = test::EditModel(grid, voxels, true).cells();
    std::vector<test::Cell> cells = expected;
    for (test::Cell& cell : cells)
    {
        cell.attribute = cell.level < grid.nodeLevels() ? gpu::Attribute{} : cell.attribute;
    }
    DeviceTree octree = test::octreeOf(device(), cells, grid, 1.0F);
    Names names;
    addNames(names, device().run([&](vk::FrameGraph& graph) { averageNodes(graph, scene, octree); }));
    EXPECT_EQ(test::difference(test::cellsOf(device(), octree), expected), "");
    return names;
}

// Merges the scene, as an octree or a DAG, with a copy of itself that is moved by two voxels, traces pictures of it,
// and undoes it.
Names mergeObjects(const Scene& scene, const Grid& grid, Coverage coverage, bool compressed)
{
    Names names;
    const float emission_scale = brightestEmission(scene);
    const GpuScene gpu_scene = uploadScene(device(), scene, true, emission_scale);
    BuildOptions build{coverage};
    build.keep_sums = true;
    BuildResult built = buildOctree(device(), gpu_scene, grid, build);
    DeviceTree fixed;
    if (compressed)
    {
        fixed = test::svdagOf(device(), built.octree);
        fixed.sums = std::move(built.octree.sums);
    }
    else
    {
        fixed = std::move(built.octree);
    }
    DynamicOctree octree(device(), std::move(fixed),
                         {.coverage = coverage, .merge = MergeRule::Average, .emission_scale = emission_scale});
    const std::vector<test::Cell> before = test::cellsOf(device(), octree.tree());

    Scene moved = scene;
    Pose pose;
    for (Instance& instance : moved.instances)
    {
        instance.transform[3].x += 2.0F * grid.voxel_size;
        pose.transforms.push_back(instance.transform);
    }
    octree.add(uploadDynamicMesh(device(), scene, true, emission_scale), pose);
    do
    {
        const std::uint64_t frame = octree.beginFrame();
        addNames(names, device().run([&](vk::FrameGraph& graph) { octree.update(graph); }));
        octree.frameDone(frame);
    } while (octree.needsUpdate());
    Scene both = scene;
    both.append(std::move(moved));
    EXPECT_EQ(voxelCodesOf(test::cellsOf(device(), octree.tree()), grid), oracle::voxelize(both, grid, coverage).codes);

    Names shown = tracePictures(octree.tree());
    for (const char* kernel : {"trace/beam_ranks", "trace/primary_ranks", "trace/ranks"}) // for overlays
    {
        EXPECT_EQ(shown.contains(kernel), compressed) << kernel;
    }
    names.merge(shown);

    addNames(names, device().run([&](vk::FrameGraph& graph) { octree.undo(graph); }));
    EXPECT_EQ(test::difference(test::cellsOf(device(), octree.tree()), before), "");
    return names;
}

// Carves, fills and paints with so little room that states have to move, and undoes a step.
Names editVoxels(DeviceTree fixed, bool attributes, float emission_scale)
{
    Names names;
    DynamicOptions options;
    options.merge = MergeRule::Average;
    options.emission_scale = emission_scale;
    options.attributes = attributes;
    options.edits = {.entries_max = 4, .bytes_max = 0};
    DynamicOctree octree(device(), std::move(fixed), options);
    const auto cells = [&] { return test::cellsOf(device(), octree.tree()); };
    test::EditModel model(octree.tree().grid, cells(), attributes);
    std::vector<test::Cell> before;
    for (std::uint32_t i = 0; i < 4; ++i)
    {
        const auto action = static_cast<BrushAction>(i % 3);
        const Brush brush = {BrushShape::Sphere, action, gpu::ivec3(30 + 3 * i, 32, 34), 2 + 2 * i, 0x2060C0};
        before = model.cells();
        model.apply(brush);
        for (bool is_done = false; !is_done;)
        {
            const std::uint64_t frame = octree.beginFrame();
            addNames(names, device().run([&](vk::FrameGraph& graph) { is_done = octree.edit(graph, brush); }));
            octree.frameDone(frame);
        }
        octree.endStroke();
    }
    EXPECT_EQ(test::difference(cells(), model.cells()), "");
    if (octree.edits().undoCount() != 0)
    {
        addNames(names, device().run([&](vk::FrameGraph& graph) { octree.undoEdit(graph); }));
        EXPECT_EQ(test::difference(cells(), before), "");
    }
    return names;
}

// Edits the scene as an octree, as a DAG, and without attributes; compiling more variants would take too long.
Names editTrees(const Scene& scene, const Grid& grid)
{
    Names names;
    const float emission_scale = brightestEmission(scene);
    for (const bool attributes : {true, false})
    {
        const float scale = attributes ? emission_scale : 0;
        const GpuScene gpu_scene = uploadScene(device(), scene, attributes, scale);
        BuildOptions build;
        build.attributes = attributes;
        build.keep_sums = attributes;
        if (attributes)
        {
            names.merge(editVoxels(buildOctree(device(), gpu_scene, grid, build).octree, attributes, scale));
        }
        BuildResult built = buildOctree(device(), gpu_scene, grid, build);
        names.merge(editVoxels(compress(device(), std::move(built.octree)).dag, attributes, scale));
    }
    return names;
}

// Compresses the octree to a DAG, and that DAG again, in which nothing more can be shared.
Names compressOctree(DeviceTree octree, const CompressOptions& options)
{
    Names names;
    const DeviceTree expected = test::svdagOf(device(), octree);
    CompressResult once = compress(device(), std::move(octree), options);
    addNames(names, once.passes);
    EXPECT_EQ(once.retry_count != 0, options.table_slots != 0);
    EXPECT_EQ(test::difference(device(), once.dag, expected), "");
    const CompressResult twice = compress(device(), std::move(once.dag));
    addNames(names, twice.passes);
    EXPECT_EQ(test::difference(device(), twice.dag, expected), "");
    return names;
}

// Traces pictures of the octree with packed attributes. Pictures of all formats are traced.
Names tracePacked(BuildResult built, AttributeFormat format)
{
    Names names;
    addNames(names, packTree(device(), format, built.octree));
    EXPECT_EQ(built.octree.attributeFormat(), format);
    names.merge(tracePictures(built.octree));
    return names;
}

// Makes the same DAG, joined of eight tiles.
Names joinTiles(const GpuScene& scene, const Grid& grid, Coverage coverage, const DeviceTree& octree)
{
    const std::uint32_t tile_depth = grid.depth - 1;
    SvdagForest forest(device(), grid, tile_depth);
    for (std::uint32_t code = 0; code < 8; ++code)
    {
        const GridTile tile(grid, tile_depth, {code & 1, code >> 1 & 1, code >> 2});
        BuildResult built = buildOctree(device(), scene, tile, {coverage, false, {}});
        if (built.octree.node_count != 0)
        {
            forest.add(code, std::move(compress(device(), std::move(built.octree)).dag));
        }
    }
    const std::vector<gpu::Node> pool = device().download(forest.finish(true).nodes);
    const std::vector<gpu::Node> expected = device().download(test::svdagOf(device(), octree).nodes);
    EXPECT_EQ(pool.size(), expected.size());
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(pool)), std::as_bytes(std::span(expected))));
    Names names;
    addNames(names, forest.passes());
    return names;
}

// Scales a picture of 3 x 2 pixels to twice and to a third of its width.
Names scalePictures()
{
    const std::vector<gpu::uint> from = {1, 2, 3, 4, 5, 6};
    const vk::BufferOf<gpu::uint> small = device().makeBuffer<gpu::uint>("picture", from);
    vk::BufferOf<gpu::uint> wide(device().device(), "wide picture", 12);
    vk::BufferOf<gpu::uint> narrow(device().device(), "narrow picture", 2);
    Names names;
    addNames(names, device().run(
                        [&](vk::FrameGraph& graph)
                        {
                            scalePicture(graph, small, {3, 2}, wide, {6, 2});
                            scalePicture(graph, small, {3, 2}, narrow, {1, 2});
                        }));
    EXPECT_EQ(device().download(wide), (std::vector<gpu::uint>{1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6}));
    EXPECT_EQ(device().download(narrow), (std::vector<gpu::uint>{2, 5}));
    return names;
}

// Traces pictures in the texel formats of hosts' images, lit and unlit, with depth.
Names traceForHosts(const DeviceTree& tree)
{
    Names names;
    ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    view.half_height = 12.0;
    const BeamGrid beam(device().device(), tree.isDag()); // not used
    ClipDepth clip;                                       // 1 / (1 + distance)
    clip.z.w = 1.0;
    clip.w = glm::dvec4(view.forward, 1.0 - glm::dot(view.forward, view.position));
    clip.miss = 0.0F;
    for (const TexelFormat format : {TexelFormat::Bgra8, TexelFormat::Rgb10, TexelFormat::Half})
    {
        TraceBuffers buffers(device().device(), 17, 9, format);
        vk::BufferOf<float> depth(device().device(), "depth", buffers.hits.count());
        view.orthographic = format == TexelFormat::Half;
        const TraceCamera camera = traceCamera(view, tree.grid, buffers.height);
        for (const View shown : {View::Color, View::Albedo})
        {
            TraceOptions options;
            options.view = shown;
            options.beam = false;
            options.shadows = false;
            addNames(names, device().run(
                                [&](vk::FrameGraph& graph)
                                {
                                    trace(graph, tree, beam, camera, options, buffers);
                                    traceDepth(graph, tree.grid, camera, clip, buffers, depth);
                                }));
        }
        const std::vector<float> depths = device().download(depth);
        EXPECT_GT(*std::ranges::max_element(depths), 0.0F);
    }
    return names;
}

// Builds the octree of a scene in each form of sums. Only the forms of GPUs get all variants.
Names addInAllForms(const Scene& scene, const Grid& grid, Coverage coverage, bool all)
{
    Names names;
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    const DeviceTree octree = buildOctree(device(), gpu_scene, grid, {coverage}).octree;
    EXPECT_EQ(voxelCodes(device(), octree), oracle::voxelize(scene, grid, coverage).codes);
    const bool has_int64 = SumForm::on(device().device()).int64;
    for (const SumForm form : {SumForm{false, false}, {false, true}, {true, false}, {true, true}})
    {
        if ((form.int64 && !has_int64) || !(all || form == SumForm{has_int64, true}))
        {
            continue;
        }
        BuildOptions options = {coverage};
        options.sum_form = form;
        const BuildResult built = buildOctree(device(), gpu_scene, grid, options);
        addNames(names, built.passes);
        EXPECT_EQ(test::difference(test::cellsOf(device(), built.octree), test::cellsOf(device(), octree)), "");
    }
    return names;
}

// Builds an octree of a scene that emits nothing, with sums of mixed voxels alone and of all voxels.
Names addMixed(const Grid& grid, Coverage coverage)
{
    Names names;
    const GpuScene dark = uploadScene(device(), test::sphereScene(glm::vec3(8.0F), 6.0F, 6), true);
    SumForm form = SumForm::on(device().device());
    std::vector<std::vector<test::Cell>> cells;
    for (const bool mixed : {false, true})
    {
        form.mixed = mixed;
        BuildOptions options = {coverage};
        options.sum_form = form;
        const BuildResult built = buildOctree(device(), dark, grid, options);
        addNames(names, built.passes);
        cells.push_back(test::cellsOf(device(), built.octree));
    }
    EXPECT_EQ(test::difference(cells[0], cells[1]), "");
    return names;
}

// Expects that all kernels of brushes have run, or all others, of those that the device can run.
void expectAllRan(const Names& names, bool of_brushes)
{
    for (const vk::EmbeddedKernel& kernel : zvoKernels())
    {
        const std::string name(kernel.name);
        const bool can_run = SumForm::on(device().device()).int64 || !name.ends_with("_int64");
        if (can_run && name.starts_with("edit/") == of_brushes)
        {
            EXPECT_TRUE(names.contains(name)) << name << " did not run";
        }
    }
}

TEST(EveryKernel, OfBrushesRunsOnASmallScene)
{
    expectAllRan(editTrees(smallScene(), {.origin = glm::vec3(0.0F), .voxel_size = 0.25F, .depth = 6}), true);
}

TEST(EveryKernel, RunsOnASmallScene)
{
    const Scene scene = smallScene();
    Scene plain = scene; // has fewer variants of the raster kernels
    plain.instances.resize(1);
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    Names names = deformVertices();
    for (std::uint32_t levels = 1; levels <= gpu::kNodeLevelsMax; ++levels)
    {
        names.merge(averageNodesOf(gpu_scene, 2 * levels - 1, levels == 1 ? 8 : 60, 1));
    }
    names.merge(averageNodesOf(gpu_scene, 2, 64, 1));
    names.merge(averageNodesOf(gpu_scene, 8, 1000, 65));
    names.merge(averageNodesOf(gpu_scene, 8, 200, 83'800)); // the root has 64 children
    struct Case
    {
        Coverage coverage;
        std::uint32_t depth;
        float voxel_size;
        bool pictures;
        std::uint64_t table_slots; // at first, of the table of equal nodes; too few, or an estimate
    };
    // The beam grid has finer cells from depth 7 on, and keys have two words from depth 13 on.
    const Case cases[] = {{Coverage::Conservative, 3, 2.0F, false, 2},
                          {Coverage::Thin, 7, 0.25F, true, 0},
                          {Coverage::Thin, 13, 1.0F, false, 0}};
    for (const Case& c : cases)
    {
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = c.voxel_size, .depth = c.depth};
        // Instrumented kernels search for each access in a list of all buffers, in loops of which lavapipe ends a long
        // sum: a scene is on the device only as long as needed.
        const Scene& built_scene = c.pictures ? scene : plain;
        BuildResult built = buildOctree(device(), uploadScene(device(), built_scene, true), grid, {c.coverage});
        EXPECT_EQ(voxelCodes(device(), built.octree), oracle::voxelize(built_scene, grid, c.coverage).codes);
        addNames(names, built.passes);
        names.merge(addInAllForms(plain, grid, c.coverage, c.pictures));
        names.merge(addMixed(grid, c.coverage));
        if (c.pictures)
        {
            names.merge(mergeObjects(scene, grid, c.coverage, false));
            names.merge(tracePictures(built.octree));
            names.merge(traceForHosts(built.octree));
            names.merge(tracePaths(built.octree));
            names.merge(keepLight(built.octree));
            const DeviceTree dag = test::svdagOf(device(), built.octree);
            names.merge(tracePictures(dag));
            names.merge(keepLight(dag));
            const Grid deep{.origin = grid.origin, .voxel_size = grid.voxel_size, .depth = kDepthOfRankSums};
            names.merge(mergeObjects(scene, deep, c.coverage, true));
            names.merge(
                tracePictures(test::svdagOf(device(), buildOctree(device(), gpu_scene, deep, {c.coverage}).octree)));
            for (const AttributeFormat format : {AttributeFormat::Bytes4, AttributeFormat::Blocks})
            {
                names.merge(tracePacked(buildOctree(device(), gpu_scene, grid, {c.coverage}), format));
            }
        }
        if (c.depth == 7)
        {
            names.merge(joinTiles(gpu_scene, grid, c.coverage, built.octree));
        }
        names.merge(compressOctree(std::move(built.octree), {.table_slots = c.table_slots}));
    }
    names.merge(scalePictures());
    expectAllRan(names, false);
}

} // namespace
} // namespace zvo
