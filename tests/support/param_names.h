// SPDX-License-Identifier: MIT
// What parameters of tests are called, in the tests' names and wherever a runner shows their values.
#pragma once

#include "zvo/types.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace zvo
{

/// GoogleTest calls it; without, it prints bytes.
inline void PrintTo(Coverage coverage, std::ostream* out)
{
    *out << (coverage == Coverage::Thin ? "thin" : "conservative");
}

} // namespace zvo

namespace zvo::test
{

inline std::string nameOf(Coverage coverage)
{
    return coverage == Coverage::Thin ? "Thin" : "Conservative";
}

/// A file's name up to its first dot.
inline std::string nameOf(const std::string& file)
{
    return file.substr(0, file.find('.'));
}

/// Names a test after its parameter: for INSTANTIATE_TEST_SUITE_P.
template <typename T> std::string paramName(const testing::TestParamInfo<T>& info)
{
    return nameOf(info.param);
}

} // namespace zvo::test
