// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace zvo::cli
{

/// The exit status of a program that does what `program` does: 0, or that of the error that it throws, which is told in
/// one line.
int runProgram(const std::function<void()>& program);

} // namespace zvo::cli
