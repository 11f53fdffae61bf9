// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo inspect`: checks a .zvo file and reports its contents on standard output. Throws Error{Input}.
void inspect(const InspectOptions& options);

/// `zvo validate`: checks a .zvo file, and that the nodes of a DAG differ; reports a sound file on standard output.
/// Throws Error{Input}.
void validate(const ValidateOptions& options);

} // namespace zvo::cli
