// SPDX-License-Identifier: MIT
// Random commands to dynamic objects. What is shown equals a full rebuild, undo and redo show earlier results, and the
// static octree does not change. scripts/check-dynamic runs thousands of sequences.
#include "core/base/kernels.h"
#include "core/scene/deform.h"
#include "oracle/deform.h"
#include "support/device.h"
#include "support/dynamic_machine.h"
#include "support/engine_device.h"
#include "support/failing_vulkan.h"
#include "support/properties.h"
#include "support/sweep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace zvo
{
namespace
{

using test::Command;
using test::DynamicScenery;
using test::DynamicSetting;
using test::Placement;
using test::Shot;

using test::anyBetween;
using test::device;

rc::Gen<Command> anyCommand()
{
    using Action = Command::Action;
    return rc::gen::build<Command>(
        rc::gen::set(&Command::action, rc::gen::weightedElement<Action>({{4, Action::Settle},
                                                                         {4, Action::Add},
                                                                         {5, Action::Move},
                                                                         {2, Action::Bend},
                                                                         {1, Action::Remove},
                                                                         {4, Action::Update},
                                                                         {6, Action::Slice},
                                                                         {3, Action::Undo},
                                                                         {3, Action::Redo},
                                                                         {4, Action::Submit},
                                                                         {2, Action::Lose},
                                                                         {2, Action::Wait}})),
        rc::gen::set(&Command::object, anyBetween<std::uint32_t>(0, test::DynamicMachine::kObjectsMax)),
        rc::gen::set(&Command::item, test::anyItem()));
}

rc::Gen<Shot> anyShot()
{
    const auto places = [](int low, int high) { return rc::gen::container<std::array<int, 3>>(anyBetween(low, high)); };
    const auto inside = places(0, 4);
    return rc::gen::build<Shot>(
        rc::gen::set(&Shot::eye, rc::gen::weightedOneOf<std::array<int, 3>>({{2, places(-8, 13)}, {1, inside}})),
        rc::gen::set(&Shot::target, places(0, 5)),
        rc::gen::set(&Shot::orthographic, rc::gen::weightedElement<bool>({{3, false}, {1, true}})),
        rc::gen::set(&Shot::beam, rc::gen::arbitrary<bool>()), rc::gen::set(&Shot::lit, rc::gen::arbitrary<bool>()),
        rc::gen::set(&Shot::coarse, rc::gen::weightedElement<bool>({{4, false}, {1, true}})));
}

rc::Gen<DynamicSetting> anySetting()
{
    using rc::gen::set;
    const auto mostly = [](bool value) { return rc::gen::weightedElement<bool>({{4, value}, {1, !value}}); };
    return rc::gen::build<DynamicSetting>(
        set(&DynamicSetting::depth,
            rc::gen::element<std::uint32_t>(5, 5, 4, 4, 3, 3, 2, 1, 6, 7, DynamicSetting::kWideDepth)),
        set(&DynamicSetting::coverage, rc::gen::element(Coverage::Thin, Coverage::Conservative)),
        set(&DynamicSetting::merge, rc::gen::element(MergeRule::Average, MergeRule::Average, MergeRule::Average,
                                                     MergeRule::DynamicWins, MergeRule::StaticWins)),
        set(&DynamicSetting::attributes, mostly(true)), set(&DynamicSetting::emits, mostly(true)),
        set(&DynamicSetting::has_static, mostly(true)), set(&DynamicSetting::compressed, rc::gen::arbitrary<bool>()),
        set(&DynamicSetting::minimal_capacities, rc::gen::arbitrary<bool>()),
        set(&DynamicSetting::frames_in_flight, anyBetween<std::uint32_t>(1, 4)),
        set(&DynamicSetting::entries_max, rc::gen::element<std::uint32_t>(1, 2, 16)),
        set(&DynamicSetting::shot, anyShot()));
}

// Rebuilds rely on this: the CPU deforms meshes as double precision does, up to rounding.
TEST(DynamicSequences, BendMeshesWithinRoundingsOfDoublePrecision)
{
    const DynamicScenery scenery(device(), true);
    std::size_t vertex_count = 0;
    std::size_t normal_count = 0;
    for (std::uint32_t mesh = DynamicScenery::kRigidCount; mesh < DynamicScenery::kMeshCount; ++mesh)
    {
        const Scene& scene = scenery.mesh(mesh);
        for (std::uint32_t bend = 0; bend < test::kBendCount; ++bend)
        {
            for (const Placement::Kind kind : {Placement::Kind::Inside, Placement::Kind::Flat, Placement::Kind::Turned})
            {
                const Pose pose = scenery.poseOf({mesh, {kind, {1, 2, 3}}, bend});
                const Scene posed = posedScene(scene, pose);
                for (std::size_t i = 0; i < scene.instances.size(); ++i)
                {
                    const Primitive& rest = scene.primitives[scene.instances[i].primitive];
                    const Primitive& bent = posed.primitives[posed.instances[i].primitive];
                    ASSERT_EQ(bent.positions.size(), rest.positions.size());
                    for (std::size_t v = 0; v < bent.positions.size() && isDeformed(rest, scene.instances[i]); ++v)
                    {
                        const oracle::DeformedVertex expected =
                            oracle::deformVertex(rest, v, pose.morph_weights[i], pose.joint_matrices[i]);
                        const glm::dvec3 error = glm::abs(glm::dvec3(bent.positions[v]) - expected.position);
                        EXPECT_TRUE(glm::all(glm::lessThanEqual(error, expected.position_bound)));
                        ++vertex_count;
                        if (!rest.normals.empty() && !std::isinf(expected.normal_bound))
                        {
                            const glm::dvec3 normal = glm::normalize(glm::dvec3(bent.normals[v]));
                            EXPECT_LE(glm::distance(normal, expected.normal), expected.normal_bound);
                            ++normal_count;
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(vertex_count, 1000U);
    EXPECT_GT(normal_count, 300U);
}

TEST(DynamicSequences, ShowWhatARebuildShows)
{
    std::array sceneries = {DynamicScenery(device(), false), DynamicScenery(device(), true)};
    const auto any_commands = rc::gen::scale(0.4, rc::gen::container<std::vector<Command>>(anyCommand()));
    test::checkProperty(test::isFull() ? 75 : 3,
                        [&]
                        {
                            const DynamicSetting setting = *anySetting();
                            test::DynamicMachine machine(device(), setting, sceneries.at(setting.emits ? 1 : 0));
                            for (const Command& command : *any_commands)
                            {
                                machine.run(command);
                            }
                            machine.finish();
                        });
}

// Vulkan calls fail at every position, also with three frames in flight. Those frames are lost.
TEST(DynamicSequences, ResumeWhateverFails)
{
    constexpr std::uint32_t kCallsMax = 50; // in most frames
    vk::HeadlessOptions options = test::deviceOptions();
    options.get_instance_proc_addr = test::failingVulkan();
    test::failCall(UINT64_MAX);
    vk::HeadlessDevice failing(options, zvoKernels());
    std::array sceneries = {DynamicScenery(failing, false), DynamicScenery(failing, true)};
    const auto any_commands = rc::gen::scale(0.4, rc::gen::container<std::vector<Command>>(anyCommand()));
    std::uint64_t failure_count = 0;
    test::checkProperty(8,
                        [&]
                        {
                            const DynamicSetting setting = *anySetting();
                            std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
                            test::DynamicMachine machine(failing, setting, sceneries.at(setting.emits ? 1 : 0));
                            machine.setFailures([&] { test::failCall(random() % kCallsMax * (1 + random() % 3)); },
                                                [] { test::failCall(UINT64_MAX); });
                            for (const Command& command : *any_commands)
                            {
                                machine.run(command);
                            }
                            machine.finish();
                            failure_count += machine.failureCount();
                        });
    EXPECT_GT(failure_count, 50U);
}

} // namespace
} // namespace zvo
