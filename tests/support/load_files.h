// SPDX-License-Identifier: MIT
// Scenes of files that a test writes.
#pragma once

#include "io/scene/load_scene.h"
#include "support/temp_dir.h"

#include <filesystem>
#include <span>
#include <string>

namespace zvo::test
{

inline Scene loadIn(const TempDir& dir, const std::string& name, const LoadOptions& options = {})
{
    const std::filesystem::path path = dir.path() / name;
    return loadScene(std::span(&path, 1), options);
}

inline Scene loadText(const std::string& name, const std::string& content)
{
    const TempDir dir;
    dir.write(name, std::string_view(content));
    return loadIn(dir, name);
}

} // namespace zvo::test
