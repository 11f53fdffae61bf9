// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace zvo
{

/// Whether a file lies in folder or below, after all symbolic links. A file that does not exist counts as lying where
/// it would be.
bool liesBelow(const std::filesystem::path& folder, const std::filesystem::path& file);

} // namespace zvo
