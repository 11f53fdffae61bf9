// SPDX-License-Identifier: MIT
#include "io/scene/place.h"

#include "core/scene/motion.h"

#include <array>

namespace zvo
{

glm::dmat4 Place::transform(UpAxis up) const
{
    glm::dmat4 result(linear * glm::dmat3(rotationToY(up)));
    result[3] = glm::dvec4(translation, 1.0);
    return result;
}

Rotation readRotation(const JsonCursor& rotation)
{
    rotation.allowKeys({"axis", "degrees"});
    return {rotation.at("axis").direction(), rotation.at("degrees").number() / kDegreesOfTurn};
}

glm::dvec3 readScale(const JsonCursor& scale)
{
    if (scale.isNumber())
    {
        return glm::dvec3(scale.number());
    }
    try
    {
        return scale.vector();
    }
    catch (const Error&)
    {
        throw scale.mismatch("a number, or three numbers [x, y, z]");
    }
}

Place readPlace(const JsonCursor& json)
{
    json.allowKeys({"translation", "rotation", "scale"});
    Place result;
    result.translation = json.valueOr("translation", &JsonCursor::vector, result.translation);
    if (const auto rotation = json.find("rotation"))
    {
        const Rotation turn = readRotation(*rotation);
        result.linear = rotationAbout(turn.axis, turn.turns);
    }
    const auto factors = json.valueOr("scale", readScale, glm::dvec3(1.0));
    for (int column = 0; column < 3; ++column)
    {
        result.linear[column] *= factors[column];
    }
    return result;
}

UpAxis readUpAxis(const JsonCursor& up)
{
    constexpr std::array kAxes = {UpAxis::X, UpAxis::Y, UpAxis::Z, UpAxis::MinusX, UpAxis::MinusY, UpAxis::MinusZ};
    return kAxes.at(up.oneOf({"x", "y", "z", "-x", "-y", "-z"}));
}

} // namespace zvo
