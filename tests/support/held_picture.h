// SPDX-License-Identifier: MIT
// Pictures that are held in tests/pictures: what zvo made when they were last recorded.
#pragma once

#include "core/scene/scene.h"

#include <string>

namespace zvo::test
{

/// Expects that picture looks like tests/pictures/NAME.png: codes differ by at most 0.5 on average, and by more than 12
/// in at most one of a hundred pixels. Rounding of another device stays far below; light that is 3 % brighter does not.
/// Otherwise the picture, and how much each pixel differs (8 times), are written into a folder that the failure names.
/// With ZVO_TEST_RECORD=1 picture is recorded instead.
void expectHeldPicture(const std::string& name, const Image& picture);

} // namespace zvo::test
