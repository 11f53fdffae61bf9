// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo inspect`: checks a .zvo file and tells on standard output what is in it. Throws Error{Input}.
void inspect(const InspectOptions& options);

/// `zvo validate`: checks a .zvo file, and that a DAG's nodes differ; tells of a sound one on standard output. Throws
/// Error{Input}.
void validate(const ValidateOptions& options);

} // namespace zvo::cli
