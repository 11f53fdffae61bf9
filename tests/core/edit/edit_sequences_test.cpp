// SPDX-License-Identifier: MIT
// Random commands of brushes with different amounts of room. What is shown equals a model that edits voxel by voxel,
// and undo and redo show earlier results.
#include "support/edit_machine.h"
#include "support/engine_device.h"
#include "support/properties.h"
#include "support/sweep.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace zvo
{
namespace
{

using test::DynamicScenery;
using test::DynamicSetting;
using test::EditCommand;
using test::Placement;

using Action = EditCommand::Action;
using Kind = Placement::Kind;
using test::device;

template <typename T> rc::Gen<T> anyBetween(T low, T high)
{
    return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high));
}

rc::Gen<Brush> anyBrush(const Grid& grid)
{
    const auto edge = static_cast<int>(grid.resolution());
    const rc::Gen<int> coordinate = anyBetween(edge - std::min(edge, 64) - 5, edge + 5); // where the scene is
    return rc::gen::build<Brush>(
        rc::gen::set(&Brush::shape, rc::gen::element(BrushShape::Sphere, BrushShape::Box)),
        rc::gen::set(&Brush::action, rc::gen::element(BrushAction::Carve, BrushAction::Fill, BrushAction::Paint)),
        rc::gen::set(&Brush::center,
                     rc::gen::map(rc::gen::tuple(coordinate, coordinate, coordinate), [](const auto& c)
                                  { return gpu::ivec3(std::get<0>(c), std::get<1>(c), std::get<2>(c)); })),
        rc::gen::set(&Brush::radius, rc::gen::oneOf(anyBetween<std::uint32_t>(0, 4), anyBetween<std::uint32_t>(4, 20))),
        rc::gen::set(&Brush::color, anyBetween<std::uint32_t>(0, 1U << 24)));
}

rc::Gen<EditCommand> anyStroke(const Grid& grid)
{
    return rc::gen::build<EditCommand>(
        rc::gen::set(&EditCommand::action, rc::gen::weightedElement<Action>({{12, Action::Dab},
                                                                             {4, Action::EndStroke},
                                                                             {4, Action::Undo},
                                                                             {3, Action::Redo},
                                                                             {3, Action::Submit},
                                                                             {1, Action::Lose},
                                                                             {1, Action::LoseRun},
                                                                             {1, Action::Compare}})),
        rc::gen::set(&EditCommand::brush, anyBrush(grid)));
}

rc::Gen<EditCommand> anyMove()
{
    const rc::Gen<Placement> place = rc::gen::build<Placement>(
        rc::gen::set(&Placement::kind, rc::gen::weightedElement<Kind>({{12, Kind::Inside},
                                                                       {1, Kind::Outside},
                                                                       {1, Kind::Flat},
                                                                       {3, Kind::Mirrored},
                                                                       {3, Kind::Turned},
                                                                       {1, Kind::Nan}})),
        rc::gen::set(&Placement::at, rc::gen::container<std::array<int, 3>>(anyBetween(-1, 4))));
    return rc::gen::build<EditCommand>(
        rc::gen::set(
            &EditCommand::action,
            rc::gen::weightedElement<Action>(
                {{3, Action::Add}, {3, Action::Move}, {1, Action::Remove}, {4, Action::Update}, {6, Action::Slice}})),
        rc::gen::set(&EditCommand::object, anyBetween<std::uint32_t>(0, test::EditMachine::kObjectsMax)),
        rc::gen::set(&EditCommand::item,
                     rc::gen::build<test::Item>(
                         rc::gen::set(&test::Item::mesh, anyBetween<std::uint32_t>(0, DynamicScenery::kMeshCount)),
                         rc::gen::set(&test::Item::placement, place),
                         rc::gen::set(&test::Item::bend, anyBetween<std::uint32_t>(0, 4)))));
}

rc::Gen<EditCommand> anyCommand(const Grid& grid, bool objects)
{
    return objects ? rc::gen::weightedOneOf<EditCommand>({{2, anyStroke(grid)}, {1, anyMove()}}) : anyStroke(grid);
}

DynamicSetting anySetting()
{
    DynamicSetting setting;
    setting.depth = *rc::gen::element<std::uint32_t>(1, 2, 3, 5, 6, DynamicSetting::kWideDepth);
    setting.attributes = *rc::gen::weightedElement<bool>({{4, true}, {1, false}});
    setting.emits = setting.attributes && *rc::gen::arbitrary<bool>();
    setting.has_static = *rc::gen::weightedElement<bool>({{5, true}, {1, false}});
    setting.compressed = setting.has_static && *rc::gen::arbitrary<bool>();
    setting.coverage = *rc::gen::element(Coverage::Thin, Coverage::Conservative);
    setting.merge =
        *rc::gen::element(MergeRule::Average, MergeRule::Average, MergeRule::DynamicWins, MergeRule::StaticWins);
    setting.minimal_capacities = *rc::gen::arbitrary<bool>();
    setting.frames_in_flight = *anyBetween<std::uint32_t>(1, 4);
    return setting;
}

// With little room, states move often, and entries are dropped.
void play(bool objects, int cases)
{
    DynamicScenery dark(device(), false);
    DynamicScenery bright(device(), true);
    test::checkProperty(
        cases,
        [&]
        {
            const DynamicSetting setting = anySetting();
            const EditBounds bounds = {*anyBetween<std::size_t>(1, 6),
                                       *rc::gen::element<std::uint64_t>(0, 100'000, 400'000, 2'000'000, UINT64_MAX)};
            const auto commands = *rc::gen::container<std::vector<EditCommand>>(anyCommand(setting.grid(), objects));
            test::EditMachine machine(device(), setting, bounds, setting.emits ? bright : dark);
            for (const EditCommand& command : commands)
            {
                machine.run(command);
            }
            machine.finish();
        });
}

TEST(EditSequences, ShowWhatAModelHas)
{
    play(false, test::isFull() ? 50 : 20);
}

// Dynamic objects are anywhere, and a brush may come after any slice of an update.
TEST(EditSequences, WithDynamicObjectsShowWhatAModelHas)
{
    play(true, test::isFull() ? 40 : 2);
}

} // namespace
} // namespace zvo
