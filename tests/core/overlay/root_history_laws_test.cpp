// SPDX-License-Identifier: MIT
// Random operations on a history, which always equals a simpler model.
#include "core/overlay/root_history.h"

#include "support/history_machine.h"
#include "support/properties.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <tuple>
#include <vector>

namespace zvo
{
namespace
{

enum class Act
{
    Update,
    FailingUpdate,
    ShowStatic,
    Undo,
    Redo,
    GiveUp,
    NextFrame,
    LoseFrame,
    FinishFrame,
    EndUpdate
};

std::ostream& operator<<(std::ostream& out, Act act)
{
    static const std::vector<const char*> names{"update",       "failing update", "show static", "undo",
                                                "redo",         "give up",        "next frame",  "lose frame",
                                                "finish frame", "end update"};
    return out << names[static_cast<std::size_t>(act)];
}

TEST(RootHistory, WhatTheDeviceMayUseIsNeverGivenToAnother)
{
    test::checkProperty(
        1000,
        []
        {
            test::HistoryMachine::Setup setup{};
            setup.nodes = *rc::gen::inRange(10u, 120u);
            setup.blocks = *rc::gen::inRange(5u, 60u);
            setup.bounds.entries_max = *rc::gen::inRange<std::size_t>(1, 8);
            setup.bounds.bytes_max = *rc::gen::weightedOneOf<std::uint64_t>(
                {{1, rc::gen::just(UINT64_MAX)}, {1, rc::gen::inRange<std::uint64_t>(0, 400)}});
            // (operation; nodes, voxels, how much of it is used)
            const auto operations = *rc::gen::scale(
                4.0,
                rc::gen::container<std::vector<std::tuple<Act, std::uint32_t, std::uint32_t, std::uint32_t>>>(
                    rc::gen::tuple(rc::gen::weightedElement<Act>({{8, Act::Update},
                                                                  {3, Act::FailingUpdate},
                                                                  {1, Act::ShowStatic},
                                                                  {4, Act::Undo},
                                                                  {3, Act::Redo},
                                                                  {1, Act::GiveUp},
                                                                  {8, Act::NextFrame},
                                                                  {3, Act::LoseFrame},
                                                                  {7, Act::FinishFrame},
                                                                  {9, Act::EndUpdate}}),
                                   rc::gen::inRange(1u, 30u), rc::gen::inRange(0u, 300u), rc::gen::inRange(0u, 99u))));
            test::HistoryMachine machine(setup);
            for (const auto& [act, nodes, voxels, used] : operations)
            {
                switch (act)
                {
                case Act::Update:
                case Act::FailingUpdate:
                    machine.update(nodes, voxels, used, act == Act::Update);
                    break;
                case Act::ShowStatic:
                    machine.showStatic();
                    break;
                case Act::Undo:
                case Act::Redo:
                    machine.move(act == Act::Undo);
                    break;
                case Act::GiveUp:
                    machine.giveUp(nodes, voxels);
                    break;
                case Act::NextFrame:
                    machine.nextFrame();
                    break;
                case Act::LoseFrame:
                    machine.loseFrame();
                    break;
                case Act::FinishFrame:
                    machine.finishFrame();
                    break;
                case Act::EndUpdate:
                    machine.endUpdate();
                    break;
                }
                machine.check();
            }
            machine.checkEnd();
        });
}

} // namespace
} // namespace zvo
