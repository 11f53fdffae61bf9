// SPDX-License-Identifier: MIT
// Names of test parameters, in the names of tests and in a runner's output.
#pragma once

#include "zvo/types.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace zvo
{

/// GoogleTest prints parameters with it; otherwise it would print bytes.
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

/// The name of a file up to its first dot.
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
