// SPDX-License-Identifier: MIT
// Invalid arguments give Error{Usage} before anything is recorded.
#include "api_scene.h"
#include "expect_usage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

namespace
{

using test::expectUsage;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kOddNumbers[] = {-1.0F, kInf, -kInf, kNan}; // invalid for values that must be finite and not negative

// An enumeration's value as a host may get it, by a cast or from a file.
template <typename Enum> Enum numbered(int value)
{
    return static_cast<Enum>(value);
}

class ApiArguments : public testing::Test
{
protected:
    ApiArguments() : m_scene(test::boxScene(glm::vec3(2), glm::vec3(6))), m_description(m_scene) {}

    ModelInfo modelInfo() { return m_description.info(); }
    Model model() { return m_host.upload(modelInfo()); }

    // Transforms that are each wrong in one number.
    static std::vector<Mat4> wrongTransforms()
    {
        std::vector<Mat4> result;
        for (std::size_t i = 0; i < 16; ++i)
        {
            for (const float value : {kNan, kInf})
            {
                result.push_back(kIdentity);
                result.back()[i] = value;
            }
        }
        for (const std::size_t i : {3U, 7U, 11U, 15U})
        {
            result.push_back(kIdentity);
            result.back()[i] = 0.5F;
        }
        return result;
    }

    Scene m_scene;
    test::HostModel m_description;
    test::EmbeddingHost m_host;
};

TEST_F(ApiArguments, GridsAreFiniteWithVoxelsOfASize)
{
    const Model model = this->model();
    const auto refused = [&](const GridInfo& grid, const std::string& word)
    {
        expectUsage([&] { TreeBuild(m_host.context, model, {.grid = grid}); }, word);
        expectUsage([&] { (void)cameraRays(test::apiCamera(), grid, 100, 100); }, word);
    };
    for (const float size : {0.0F, -0.0F, -1.0F, kInf, -kInf, kNan, std::numeric_limits<float>::denorm_min()})
    {
        refused({{0, 0, 0}, size, 4}, "finite and above 0");
    }
    for (const float corner : {kInf, -kInf, kNan})
    {
        refused({{corner, 0, 0}, 1, 4}, "corners");
        refused({{0, corner, 0}, 1, 4}, "corners");
        refused({{0, 0, corner}, 1, 4}, "corners");
    }
    refused({{0, 0, 0}, 1e38F, 4}, "corners");
    for (const std::uint32_t depth : {0U, 18U, 40U, UINT32_MAX})
    {
        refused({{0, 0, 0}, 1, depth}, "depth " + std::to_string(depth));
    }
    EXPECT_NO_THROW((void)cameraRays(test::apiCamera(), {{-1e6F, 0, 1e6F}, 1e-3F, 17}, 100, 100));
}

// The machine's Vulkan without queue families that draw.
PFN_vkGetPhysicalDeviceQueueFamilyProperties g_queue_families = nullptr;
PFN_vkGetInstanceProcAddr g_instance_proc_addr = nullptr;

VKAPI_ATTR void VKAPI_CALL familiesThatOnlyCompute(VkPhysicalDevice physical, std::uint32_t* count,
                                                   VkQueueFamilyProperties* families)
{
    g_queue_families(physical, count, families);
    for (std::uint32_t i = 0; families != nullptr && i < *count; ++i)
    {
        families[i].queueFlags &= ~VkQueueFlags{VK_QUEUE_GRAPHICS_BIT};
    }
}

PFN_vkVoidFunction computeOnlyProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = g_instance_proc_addr(instance, name);
    if (std::strcmp(name, "vkGetPhysicalDeviceQueueFamilyProperties") != 0)
    {
        return function;
    }
    g_queue_families = reinterpret_cast<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(familiesThatOnlyCompute);
}

TEST(ApiTargets, NothingIsRecordedWhereOneOfThemWillNotDo)
{
    g_instance_proc_addr = nullptr;
    const auto compute_only = [](ContextInfo& info)
    {
        g_instance_proc_addr = info.get_instance_proc_addr;
        info.get_instance_proc_addr = computeOnlyProcAddr;
        info.timed_passes_per_frame = 64;
    };
    test::HostOptions options;
    options.optional.pass_times = true;
    test::EmbeddingHost host(options, compute_only);
    const test::HostModel description(test::boxScene(glm::vec3(2), glm::vec3(6)));
    const Tree tree = host.build(host.upload(description.info()), {.grid = test::apiGrid(4)});
    Tracer tracer(host.context, host.kWidth, host.kHeight, VK_FORMAT_R8G8B8A8_UNORM);
    test::TargetImage color(host.device, VK_FORMAT_R8G8B8A8_UNORM, host.kWidth, host.kHeight);
    test::TargetImage depth(host.device, VK_FORMAT_R32_SFLOAT, host.kWidth, host.kHeight);
    DepthTarget usual{depth.target()};
    usual.view_projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, 100, 100};

    const auto tracing = [&](const std::function<void(ImageTarget&, DepthTarget&)>& spoil, const std::string& word)
    {
        ImageTarget color_target = color.target();
        DepthTarget depth_target = usual;
        spoil(color_target, depth_target);
        const auto traced = [&]
        {
            host.frame(
                [&](Recorder& recorder, VkCommandBuffer commands)
                {
                    color.beginCopies(commands);
                    depth.beginCopies(commands);
                    const auto trace = [&]
                    { tracer.trace(recorder, tree, test::apiCamera(), {}, color_target, &depth_target); };
                    if (word.empty())
                    {
                        trace();
                    }
                    else
                    {
                        expectUsage(trace, word);
                    }
                });
        };
        traced();
        return host.context.passTimes().size();
    };
    EXPECT_GT(tracing([](ImageTarget&, DepthTarget&) {}, ""), 2U);
    const auto nothing = [&](const std::function<void(ImageTarget&, DepthTarget&)>& spoil, const std::string& word)
    {
        const std::size_t before = tracing([](ImageTarget&, DepthTarget&) {}, "");
        host.frame([](Recorder&) {});
        EXPECT_EQ(tracing(spoil, word), before) << "passes of an older frame: this one has none; " << word;
    };
    for (const VkFormat format : {VK_FORMAT_D32_SFLOAT, VK_FORMAT_D32_SFLOAT_S8_UINT})
    {
        nothing([&](ImageTarget&, DepthTarget& target) { target.image.format = format; }, "cannot draw");
    }
    const auto unlikely = VK_FORMAT_R8_UNORM;
    nothing([&](ImageTarget&, DepthTarget& target) { target.image.format = unlikely; }, "VkFormat");
    nothing([](ImageTarget&, DepthTarget& target) { target.image.layout = VK_IMAGE_LAYOUT_UNDEFINED; },
            "VkImageLayout");
    nothing([](ImageTarget&, DepthTarget& target) { target.image.offset.y = -1; }, "(0, -1)");
    nothing([](ImageTarget&, DepthTarget& target) { target.image.image = VK_NULL_HANDLE; }, "DepthTarget::image");
    nothing([](ImageTarget&, DepthTarget& target) { target.view_projection = {}; }, "view_projection");
    nothing([](ImageTarget&, DepthTarget& target)
            { target.view_projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}; },
            "view_projection");
    nothing([](ImageTarget&, DepthTarget& target) { target.view_projection[4] = NAN; }, "view_projection");
    nothing([](ImageTarget&, DepthTarget& target) { target.miss = 1.5F; }, "miss");
    nothing([](ImageTarget&, DepthTarget& target) { target.miss = kNan; }, "miss");
    nothing([](ImageTarget& target, DepthTarget&) { target.image = VK_NULL_HANDLE; }, "color");
    nothing([](ImageTarget& target, DepthTarget&) { target.layout = VK_IMAGE_LAYOUT_UNDEFINED; }, "VkImageLayout");
    nothing([](ImageTarget& target, DepthTarget&) { target.offset.x = -3; }, "(-3, 0)");

    // Pictures that fit the image, and others that do not.
    for (const bool of_depth : {false, true})
    {
        const auto placed = [&](VkOffset2D offset, VkExtent2D extent)
        {
            return [of_depth, offset, extent](ImageTarget& color_target, DepthTarget& target)
            {
                ImageTarget& changed = of_depth ? target.image : color_target;
                changed.offset = offset;
                changed.extent = extent;
            };
        };
        nothing(placed({0, 0}, {host.kWidth - 1, host.kHeight}), "does not fit");
        nothing(placed({0, 0}, {host.kWidth, host.kHeight - 1}), "does not fit");
        nothing(placed({0, 1}, {host.kWidth, host.kHeight}), "does not fit");
        nothing(placed({INT32_MAX, 0}, {host.kWidth, host.kHeight}), "does not fit");
        EXPECT_GT(tracing(placed({0, 0}, {host.kWidth, host.kHeight}), ""), 2U);
    }
}

TEST_F(ApiArguments, HandlesAreNotNull)
{
    expectUsage([&] { Recorder(m_host.context, VK_NULL_HANDLE, 1); }, "command buffer");
    const ContextInfo& info = m_host.declaration.info;
    expectUsage([&] { (void)query(nullptr, info.instance, info.physical_device, VK_API_VERSION_1_3); },
                "vkGetInstanceProcAddr");
    expectUsage([&]
                { (void)query(info.get_instance_proc_addr, VK_NULL_HANDLE, info.physical_device, VK_API_VERSION_1_3); },
                "VkInstance");
    expectUsage([&] { (void)query(info.get_instance_proc_addr, info.instance, VK_NULL_HANDLE, VK_API_VERSION_1_3); },
                "VkPhysicalDevice");
    m_host.frame([](Recorder&) {}); // the context still works
}

TEST_F(ApiArguments, ObjectsAndInstancesStandByAffineTransforms)
{
    const Model model = this->model();
    auto tree = m_host.make<DynamicTree>(m_host.build(model, {.grid = test::apiGrid(4)}), DynamicTreeInfo{});
    const DynamicObjectId object = m_host.add(tree, model, kIdentity);
    for (const Mat4& transform : wrongTransforms())
    {
        expectUsage([&] { m_host.add(tree, model, transform); }, "the transform of a dynamic object");
        expectUsage([&] { tree.setTransform(object, transform); }, "the transform of a dynamic object");
        const std::vector<InstanceInfo> instances = {{0, transform}};
        ModelInfo info = modelInfo();
        info.instances = instances;
        expectUsage([&] { m_host.upload(info); }, "the transform of instance 0");
    }
    m_host.frame(
        [&](Recorder& recorder)
        {
            const auto add = [&](const DynamicObjectInfo& info)
            { expectUsage([&] { tree.addObject(recorder, model, kIdentity, info); }, "fill"); };
            add({.fill = Fill::Solid});
            add({.carves = true, .fill = Fill::Robust});
            add({.carves = true, .fill = numbered<Fill>(7)});
        });
    m_host.frame([&](Recorder& recorder) { tree.update(recorder); });
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()).size(), std::size_t{m_host.kWidth} * m_host.kHeight);

    m_host.frame(
        [&](Recorder& recorder)
        {
            for (const double budget : {-1.0, double{kNan}})
            {
                expectUsage([&] { tree.update(recorder, budget); }, "budget_ms");
            }
            for (const int value : {-1, 3, 7})
            {
                expectUsage([&] { tree.edit(recorder, {.shape = numbered<BrushShape>(value)}); }, "BrushInfo::shape");
                expectUsage([&] { tree.edit(recorder, {.action = numbered<BrushAction>(value)}); },
                            "BrushInfo::action");
            }
        });
}

TEST_F(ApiArguments, EnumerationsHaveTheirValues)
{
    const Model model = this->model();
    const GridInfo grid = test::apiGrid(4);
    for (const int value : {-1, 2, 9})
    {
        expectUsage([&] { TreeBuild(m_host.context, model, {.grid = grid, .coverage = numbered<Coverage>(value)}); },
                    "TreeBuildInfo::coverage");
    }
    for (const int value : {-1, 4})
    {
        expectUsage([&]
                    { TreeBuild(m_host.context, model, {.grid = grid, .format = numbered<AttributeFormat>(value)}); },
                    "TreeBuildInfo::format");
        ModelInfo info = modelInfo();
        const std::vector<MaterialInfo> materials(16, {.emission = {}, .alpha_mode = numbered<AlphaMode>(value)});
        info.materials = materials;
        expectUsage([&] { m_host.upload(info); }, "MaterialInfo::alpha_mode");
        const std::vector<std::uint8_t> texel(4);
        TextureInfo texture = {1, 1, texel, numbered<WrapMode>(value), WrapMode::Repeat};
        info = modelInfo();
        info.textures = {&texture, 1};
        expectUsage([&] { m_host.upload(info); }, "TextureInfo::wrap_u");
        std::swap(texture.wrap_u, texture.wrap_v);
        expectUsage([&] { m_host.upload(info); }, "TextureInfo::wrap_v");
    }
}

TEST_F(ApiArguments, WhatAPictureShowsIsFinite)
{
    const Model model = this->model();
    const Tree tree = m_host.build(model, {.grid = test::apiGrid(4)});
    const auto tracing = [&](const TraceInfo& info, const std::string& word)
    { expectUsage([&] { (void)m_host.picture(tree, test::apiCamera(), info); }, word); };
    for (const float value : kOddNumbers)
    {
        tracing({.sun = value}, "TraceInfo::sun");
        tracing({.exposure = value}, "TraceInfo::exposure");
        tracing({.occlusion_reach = value}, "TraceInfo::occlusion_reach");
        tracing({.detail_pixels = value}, "TraceInfo::detail_pixels");
        ModelInfo info = modelInfo();
        info.emission_scale = value;
        expectUsage([&] { m_host.upload(info); }, "emission scale");
    }
    for (const double value : {0.0, double{kNan}, double{kInf}, 1e-300})
    {
        tracing({.to_sun = {0, value, 0}}, "TraceInfo::to_sun");
    }
    EXPECT_NO_THROW((void)m_host.picture(tree, test::apiCamera(), {.view = View::Albedo, .to_sun = {0, 0, 0}}));
    for (const int view : {-1, 9})
    {
        tracing({.view = numbered<View>(view)}, "TraceInfo::view");
    }
    tracing({.shading = numbered<Shading>(2)}, "TraceInfo::shading");
}

TEST_F(ApiArguments, DynamicTreesHaveNumbersThatTheyCanKeep)
{
    Tree fixed = m_host.build(model(), {.grid = test::apiGrid(4)});
    const auto making = [&](const DynamicTreeInfo& info, const std::string& word)
    {
        m_host.frame([&](Recorder& recorder)
                     { expectUsage([&] { DynamicTree(recorder, std::move(fixed), info); }, word); });
    };
    for (const std::uint32_t count : {0U, 17U, 0x40000001U, UINT32_MAX})
    {
        making({.frames_in_flight = count}, "frames_in_flight");
    }
    making({.history_entries = 0}, "history_entries");
    making({.strokes = 0}, "strokes");
    for (const float value : kOddNumbers)
    {
        making({.emission_scale = value}, "emission_scale");
    }
    for (const int value : {-1, 3})
    {
        making({.coverage = numbered<Coverage>(value)}, "DynamicTreeInfo::coverage");
        making({.merge = numbered<MergeRule>(value)}, "DynamicTreeInfo::merge");
    }
    EXPECT_GT(fixed.info().voxel_count, 0U); // the tree stays as it is
    m_host.frame([&](Recorder& recorder) { DynamicTree(recorder, std::move(fixed), {.frames_in_flight = 16}); });
}

TEST(ApiTimes, PassesHaveABound)
{
    test::HostOptions options;
    options.optional.pass_times = true;
    for (const std::uint32_t count : {0x10001U, 0x55555556U, UINT32_MAX})
    {
        expectUsage([&]
                    { test::EmbeddingHost(options, [&](ContextInfo& info) { info.timed_passes_per_frame = count; }); },
                    "timed_passes_per_frame");
    }
    test::EmbeddingHost host(options, [](ContextInfo& info) { info.timed_passes_per_frame = 0x10000; });
    host.frame([](Recorder&) {});
}

TEST(ApiTuning, IsTakenOrRefused)
{
    const auto hostWith = [](std::string_view tuning)
    { return test::EmbeddingHost({}, [&](ContextInfo& info) { info.tuning = tuning; }); };
    expectUsage([&] { hostWith("rows=1"); }, "ContextInfo::tuning rows=1");
    expectUsage([&] { hostWith("block-lanes=3"); }, "ContextInfo::tuning block-lanes=3");
    hostWith("block-lanes=8,path-form=kernel").frame([](Recorder&) {});
}

TEST_F(ApiArguments, TreesAreMadeVisibleToShaders)
{
    m_host.frame(
        [&](Recorder& recorder)
        {
            recorder.makeVisible(0);
            for (const VkPipelineStageFlags2 stages :
                 {VK_PIPELINE_STAGE_2_COPY_BIT, VK_PIPELINE_STAGE_2_HOST_BIT, VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT,
                  VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT})
            {
                expectUsage([&] { recorder.makeVisible(stages); }, "shaders");
            }
            recorder.makeVisible(VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT);
            recorder.makeVisible(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
        });
}

} // namespace

} // namespace zvo
