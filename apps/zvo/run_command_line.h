// SPDX-License-Identifier: MIT
#pragma once

namespace zvo::cli
{

/// Does what a command line asks for, as main() does. Returns the exit code; errors are told on standard error.
int runCommandLine(int argc, const char* const* argv);

} // namespace zvo::cli
