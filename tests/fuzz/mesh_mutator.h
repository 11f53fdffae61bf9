// SPDX-License-Identifier: MIT
// Mutations of OBJ, PLY and STL files, most of which still get past the parsers.
#pragma once

#include <random>
#include <string>

namespace zvo::test
{

/// Changes, adds, repeats or removes words and lines, or changes a number of a binary file.
void mutateMesh(std::string& content, std::mt19937& random);

/// Copies lines of another file into content.
void crossMesh(std::string& content, const std::string& other, std::mt19937& random);

} // namespace zvo::test
