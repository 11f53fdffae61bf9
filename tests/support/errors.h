// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/error.h"

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace zvo::test
{

/// Returns the message of the Error that action throws. The test fails unless its code is expected and the message has
/// one line.
std::string messageOf(const std::function<void()>& action, ErrorCode expected);

/// The bytes that the message of an Error{Memory} names; the test fails if it names none.
std::uint64_t bytesNeeded(const std::string& message);
/// Calls load. Returns whether it succeeds; if not, the test fails unless the Error is Error{Input} of one line.
bool loadsOrIsRefused(const std::function<void()>& load);

/// The test fails for each part that is missing from text.
void expectParts(const std::string& text, std::initializer_list<std::string> parts);

/// The test fails unless there is one line, such as a warning, with these parts.
void expectOneLine(const std::vector<std::string>& lines, std::initializer_list<std::string> parts);

} // namespace zvo::test
