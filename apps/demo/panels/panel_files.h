// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace zvo::demo
{

using Files = std::vector<std::filesystem::path>;

/// The user's requests in the files panel.
struct FilesAnswer
{
    bool opens = false;
    bool saves_as = false;
    std::optional<Files> recent; // to be opened again
};

/// Shows buttons to open and save files, and the files of earlier runs.
FilesAnswer filesPanel(const std::vector<Files>& recent);

/// What becomes of strokes that are not in a file.
enum class LossAnswer
{
    Save,
    Discard,
    Cancel
};

/// Asks whether strokes may be lost, over the picture. Nothing until the user answers.
std::optional<LossAnswer> lossQuestion();

} // namespace zvo::demo
