// SPDX-License-Identifier: MIT
#pragma once

#include <rapidcheck.h>

#include <utility>

namespace zvo::test
{

/// Part of checkProperty().
void checkPropertyOf(int cases, const rc::detail::Property& property);

/// Runs property with this many random inputs. property draws its inputs from RapidCheck (*gen) and asserts by
/// RC_ASSERT. If it fails, the current test fails with the smallest inputs found. The inputs are the same on every run;
/// the environment variable RC_PARAMS sets another number and seed, for example "seed=7 max_success=100000".
template <typename Testable> void checkProperty(int cases, Testable&& property)
{
    checkPropertyOf(cases, rc::detail::toProperty(std::forward<Testable>(property)));
}

} // namespace zvo::test
