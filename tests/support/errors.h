// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/error.h"

#include <functional>
#include <initializer_list>
#include <string>

namespace zvo::test
{

/// Returns the message of the Error that action throws. The test fails unless its code is expected and the message has
/// one line.
std::string messageOf(const std::function<void()>& action, ErrorCode expected);

/// The test fails for each part that is missing from text.
void expectParts(const std::string& text, std::initializer_list<const char*> parts);

} // namespace zvo::test
