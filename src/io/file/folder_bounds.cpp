// SPDX-License-Identifier: MIT
#include "io/file/folder_bounds.h"

#include <algorithm>
#include <system_error>

namespace zvo
{

bool liesBelow(const std::filesystem::path& folder, const std::filesystem::path& file)
{
    std::error_code folder_failure;
    std::error_code file_failure;
    const std::filesystem::path real_folder = std::filesystem::weakly_canonical(folder, folder_failure);
    const std::filesystem::path real_file = std::filesystem::weakly_canonical(file, file_failure);
    return !folder_failure && !file_failure &&
           std::mismatch(real_folder.begin(), real_folder.end(), real_file.begin(), real_file.end()).first ==
               real_folder.end();
}

} // namespace zvo
