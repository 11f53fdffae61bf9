// SPDX-License-Identifier: MIT
#pragma once

namespace zvo::cli
{

/// Signals that end the program leave no half-written files; closed pipes and full disks become errors of the write.
void installSignalHandlers();

} // namespace zvo::cli
