// SPDX-License-Identifier: MIT
// Whatever is done to movers, in whatever order: what is shown is what voxelizing everything anew gives, undo and redo
// show what was shown, and the static octree stays what it was. scripts/check-dynamic runs thousands of sequences.
#include "core/kernels.h"
#include "support/device.h"
#include "support/dynamic_machine.h"
#include "support/properties.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace zvo
{
namespace
{

using test::Command;
using test::DynamicSetting;
using test::Item;
using test::Place;
using test::Shot;

vk::HeadlessDevice& device()
{
    return test::sharedDevice(zvoKernels());
}

rc::Gen<Place> anyPlace()
{
    using Kind = Place::Kind;
    return rc::gen::build<Place>(
        rc::gen::set(&Place::kind, rc::gen::weightedElement<Kind>({{12, Kind::Inside},
                                                                   {2, Kind::Outside},
                                                                   {1, Kind::Point},
                                                                   {1, Kind::Flat},
                                                                   {3, Kind::Mirrored},
                                                                   {3, Kind::Turned},
                                                                   {1, Kind::Nan},
                                                                   {1, Kind::Huge}})),
        rc::gen::set(&Place::at, rc::gen::container<std::array<int, 3>>(rc::gen::inRange(-1, 4))));
}

rc::Gen<Command> anyCommand()
{
    using Action = Command::Action;
    return rc::gen::build<Command>(
        rc::gen::set(&Command::action, rc::gen::weightedElement<Action>({{4, Action::Settle},
                                                                         {4, Action::Add},
                                                                         {6, Action::Place},
                                                                         {1, Action::Remove},
                                                                         {4, Action::Update},
                                                                         {6, Action::Slice},
                                                                         {3, Action::Undo},
                                                                         {3, Action::Redo},
                                                                         {4, Action::Submit},
                                                                         {2, Action::Wait}})),
        rc::gen::set(&Command::mover, rc::gen::inRange<std::uint32_t>(0, test::DynamicMachine::kMoversMax)),
        rc::gen::set(&Command::item,
                     rc::gen::build<Item>(
                         rc::gen::set(&Item::mesh, rc::gen::inRange<std::uint32_t>(0, test::MoverScenery::kMeshCount)),
                         rc::gen::set(&Item::place, anyPlace()))));
}

rc::Gen<Shot> anyShot()
{
    const auto places = [](int low, int high)
    { return rc::gen::container<std::array<int, 3>>(rc::gen::inRange(low, high)); };
    const auto inside = places(0, 4);
    return rc::gen::build<Shot>(
        rc::gen::set(&Shot::eye, rc::gen::weightedOneOf<std::array<int, 3>>({{2, places(-8, 13)}, {1, inside}})),
        rc::gen::set(&Shot::target, places(0, 5)),
        rc::gen::set(&Shot::orthographic, rc::gen::weightedElement<bool>({{3, false}, {1, true}})),
        rc::gen::set(&Shot::beam, rc::gen::weightedElement<bool>({{15, false}, {1, true}})),
        rc::gen::set(&Shot::lit, rc::gen::arbitrary<bool>()),
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
        set(&DynamicSetting::has_static, mostly(true)),
        set(&DynamicSetting::minimal_capacities, rc::gen::arbitrary<bool>()),
        set(&DynamicSetting::frames_in_flight, rc::gen::inRange<std::uint32_t>(1, 4)),
        set(&DynamicSetting::steps_max, rc::gen::element<std::uint32_t>(1, 2, 16)),
        set(&DynamicSetting::shot, anyShot()));
}

TEST(DynamicSequences, ShowWhatARebuildShows)
{
    std::array sceneries = {test::MoverScenery(device(), false), test::MoverScenery(device(), true)};
    const auto any_commands = rc::gen::scale(0.4, rc::gen::container<std::vector<Command>>(anyCommand()));
    test::checkProperty(150,
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

} // namespace
} // namespace zvo
