// SPDX-License-Identifier: MIT
#include "support/command.h"

#include "support/properties.h"

#include <array>
#include <cstddef>

namespace zvo::test
{

namespace
{

constexpr std::array kActionNames = {"dab",    "end of stroke", "add",           "place", "bend",
                                     "remove", "update",        "slice",         "undo",  "redo",
                                     "submit", "lose",          "lose what ran", "wait",  "settle"};
constexpr std::array kBrushNames = {"carve", "fill", "paint"};

} // namespace

std::ostream& operator<<(std::ostream& out, const Command& command)
{
    using Action = Command::Action;
    out << kActionNames.at(static_cast<std::size_t>(command.action));
    switch (command.action)
    {
    case Action::Dab:
        return out << ' ' << kBrushNames.at(static_cast<std::size_t>(command.brush.action))
                   << (command.brush.shape == BrushShape::Box ? " box " : " sphere ") << command.brush.radius << " at "
                   << command.brush.center.x << ' ' << command.brush.center.y << ' ' << command.brush.center.z << " to "
                   << command.brush.span.x << ' ' << command.brush.span.y << ' ' << command.brush.span.z
                   << (command.brush.part ? ", a part" : "") << (command.brush.stamp != nullptr ? ", a stamp" : "");
    case Action::Add:
        return out << " mesh " << command.item.mesh << ' ' << command.item.placement << " bend " << command.item.bend;
    case Action::Move:
        return out << " dynamic object " << command.object << ' ' << command.item.placement << " bend "
                   << command.item.bend;
    case Action::Bend:
        return out << " dynamic object " << command.object << " bend " << command.item.bend;
    case Action::Remove:
        return out << " dynamic object " << command.object;
    default:
        return out;
    }
}

rc::Gen<Item> anyItem()
{
    using Kind = Placement::Kind;
    const rc::Gen<Placement> place = rc::gen::build<Placement>(
        rc::gen::set(&Placement::kind, rc::gen::weightedElement<Kind>({{12, Kind::Inside},
                                                                       {2, Kind::Outside},
                                                                       {1, Kind::Point},
                                                                       {1, Kind::Flat},
                                                                       {3, Kind::Mirrored},
                                                                       {3, Kind::Turned},
                                                                       {1, Kind::Nan},
                                                                       {1, Kind::Huge}})),
        rc::gen::set(&Placement::at, rc::gen::container<std::array<int, 3>>(anyBetween(-1, 4))));
    return rc::gen::build<Item>(rc::gen::set(&Item::mesh, anyBetween<std::uint32_t>(0, DynamicScenery::kMeshCount)),
                                rc::gen::set(&Item::placement, place),
                                rc::gen::set(&Item::bend, anyBetween<std::uint32_t>(0, kBendCount)));
}

} // namespace zvo::test
