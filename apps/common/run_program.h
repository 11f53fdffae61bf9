// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace zvo::cli
{

/// Runs `program` and returns the exit status: 0, or that of the error that it throws, which is written to standard
/// error in one line.
int runProgram(const std::function<void()>& program);

} // namespace zvo::cli
