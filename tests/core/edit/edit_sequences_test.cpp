// SPDX-License-Identifier: MIT
// Random commands of brushes with different amounts of room. What is shown equals a model that edits voxel by voxel,
// and undo and redo show earlier results.
#include "core/edit/voxel_clip.h"
#include "support/edit_machine.h"
#include "support/engine_device.h"
#include "support/properties.h"
#include "support/sweep.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace zvo
{
namespace
{

using test::Command;
using test::DynamicScenery;
using test::DynamicSetting;

using Action = Command::Action;
using test::anyBetween;
using test::device;

// Voxels that look like anything, at the brush's centre; a few of them emit.
std::shared_ptr<const Stamp> anyStamp(const Brush& brush, const Grid& grid, bool emits, std::uint32_t seed)
{
    std::minstd_rand random(seed);
    const auto any = [&] { return static_cast<std::uint32_t>(random()); };
    const auto below = [&](std::uint32_t end) { return static_cast<int>(any() % end); };
    VoxelClip clip(glm::ivec3(1 + below(9), 1 + below(9), 1 + below(9)));
    const std::uint32_t share = 1 + any() % 3;
    for (int i = 0; i < clip.size().x * clip.size().y * clip.size().z; ++i)
    {
        const glm::ivec3 cell(i % clip.size().x, i / clip.size().x % clip.size().y,
                              i / (clip.size().x * clip.size().y));
        if (any() % share == 0)
        {
            const bool shines = emits && any() % 4 == 0;
            const gpu::Attribute look = {(any() & 0xFFFFFFU) | (shines ? gpu::kAttributeEmissive << 24 : 0U), 0};
            clip.set(cell, ClipVoxel{look, shines ? any() : 0U});
        }
    }
    return clip.stampAt(brush.center, grid);
}

rc::Gen<Brush> anyDab(const Grid& grid)
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
        rc::gen::set(&Brush::color, anyBetween<std::uint32_t>(0, 1U << 24)),
        rc::gen::set(&Brush::emission, rc::gen::element(gpu::vec3(0.0F), test::EditModel::kEmission)));
}

// Some boxes are longer along one axis than along others, some brushes are cut to a part, and some are stamps.
rc::Gen<Brush> anyBrush(const Grid& grid, bool emits)
{
    const rc::Gen<int> step = anyBetween(-12, 12);
    return rc::gen::map(rc::gen::tuple(anyDab(grid), step, step, step, anyBetween<std::uint32_t>(0, 1U << 30)),
                        [=](const auto& drawn)
                        {
                            Brush brush = std::get<0>(drawn);
                            const gpu::ivec3 steps(std::get<1>(drawn), std::get<2>(drawn), std::get<3>(drawn));
                            const std::uint32_t seed = std::get<4>(drawn);
                            brush.span = brush.shape == BrushShape::Box && seed % 2 == 0 ? steps : gpu::ivec3(0);
                            brush.stamp = seed % 5 == 0 ? anyStamp(brush, grid, emits, seed) : nullptr;
                            if (seed % 7 == 0)
                            {
                                brush.part = VoxelBox{brush.center - glm::abs(steps), brush.center + 3};
                            }
                            return brush;
                        });
}

rc::Gen<Command> anyStroke(const rc::Gen<Brush>& brush)
{
    return rc::gen::build<Command>(
        rc::gen::set(&Command::action, rc::gen::weightedElement<Action>({{12, Action::Dab},
                                                                         {4, Action::EndStroke},
                                                                         {4, Action::Undo},
                                                                         {3, Action::Redo},
                                                                         {3, Action::Submit},
                                                                         {1, Action::Lose},
                                                                         {1, Action::LoseRun},
                                                                         {1, Action::Settle}})),
        rc::gen::set(&Command::brush, brush));
}

rc::Gen<Command> anyMove()
{
    return rc::gen::build<Command>(
        rc::gen::set(
            &Command::action,
            rc::gen::weightedElement<Action>(
                {{3, Action::Add}, {3, Action::Move}, {1, Action::Remove}, {4, Action::Update}, {6, Action::Slice}})),
        rc::gen::set(&Command::object, anyBetween<std::uint32_t>(0, test::EditMachine::kObjectsMax)),
        rc::gen::set(&Command::item, test::anyItem()));
}

rc::Gen<Command> anyCommand(const DynamicSetting& setting, bool objects)
{
    // What kind of brush has changed a leaf does not matter to objects, whose cases take long.
    return objects ? rc::gen::weightedOneOf<Command>({{2, anyStroke(anyDab(setting.grid()))}, {1, anyMove()}})
                   : anyStroke(anyBrush(setting.grid(), setting.emits));
}

DynamicSetting anySetting()
{
    DynamicSetting setting;
    setting.depth = *rc::gen::element<std::uint32_t>(1, 2, 3, 5, 6, DynamicSetting::kWideDepth);
    setting.attributes = *rc::gen::weightedElement<bool>({{4, true}, {1, false}});
    setting.emits = setting.attributes && *rc::gen::arbitrary<bool>();
    setting.has_static = *rc::gen::weightedElement<bool>({{5, true}, {1, false}});
    const auto kind = setting.has_static ? *anyBetween(0, 3) : 0;
    setting.compressed = kind == 1;
    setting.filled = kind == 2 && setting.depth >= 3 && setting.depth <= 6;
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
            const HistoryBounds bounds = {*anyBetween<std::size_t>(1, 6),
                                          *rc::gen::element<std::uint64_t>(0, 100'000, 400'000, 2'000'000, UINT64_MAX)};
            const auto commands = *rc::gen::container<std::vector<Command>>(anyCommand(setting, objects));
            test::EditMachine machine(device(), setting, bounds, setting.emits ? bright : dark);
            for (const Command& command : commands)
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
