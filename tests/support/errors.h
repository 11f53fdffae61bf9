// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/error.h"

#include <functional>
#include <initializer_list>
#include <string>

namespace zvo::test
{

/// What the Error says that action throws; the test fails unless it throws one of this kind, of one line.
std::string messageOf(const std::function<void()>& action, ErrorCode expected);

/// The test fails for each part that text does not hold.
void expectParts(const std::string& text, std::initializer_list<const char*> parts);

} // namespace zvo::test
