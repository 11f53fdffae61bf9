// SPDX-License-Identifier: MIT
// What random sequences do to a DynamicOctree.
#pragma once

#include "core/edit/brush.h"
#include "support/dynamic_scenery.h"

#include <rapidcheck.h>

#include <cstdint>
#include <ostream>

namespace zvo::test
{

struct Command
{
    enum class Action
    {
        Dab,
        EndStroke,
        Add,
        Move,
        Bend,
        Remove,
        Update,
        Slice, // a slice of an update, under a budget that is far too small
        Undo,  // of updates or of strokes, as the machine says
        Redo,
        Submit,  // submits the recorded commands as a frame, without waiting
        Lose,    // records the frame like Submit, but then it fails and is lost
        LoseRun, // the frame is lost after the device has run it
        Wait,    // waits for all frames, then compares what is shown
        Settle   // waits, and updates until all dynamic objects show their last poses, then compares
    };

    Action action = Action::Settle;
    Brush brush = {};         // Dab
    std::uint32_t object = 0; // Move, Bend, Remove: number of the object among those present
    Item item = {};           // Add; Move takes only its placement and bend, Bend only its bend
};

std::ostream& operator<<(std::ostream& out, const Command& command);

/// A dab that fills or paints in blue.
inline Command dab(BrushAction action, const gpu::ivec3& center, std::uint32_t radius,
                   BrushShape shape = BrushShape::Sphere)
{
    constexpr std::uint32_t kBlue = 0xFF0000;
    return {.action = Command::Action::Dab, .brush = {shape, action, center, radius, kBlue}};
}

/// Any item; most are inside. Bends are less than kBendCount.
inline constexpr std::uint32_t kBendCount = 5;
rc::Gen<Item> anyItem();

} // namespace zvo::test
