// SPDX-License-Identifier: MIT
#pragma once

#include <rapidcheck.h>

#include <utility>

namespace zvo::test
{

/// Part of checkProperty().
void checkPropertyOf(int cases, const rc::detail::Property& property);

/// Runs property, a function that draws its inputs from RapidCheck (*gen) and states by RC_ASSERT what holds for them,
/// with so many random inputs; the current test fails with the smallest inputs found for which it does not hold. The
/// inputs are the same on every run. The environment variable RC_PARAMS replaces their number and the seed, for
/// example "seed=7 max_success=100000".
template <typename Testable> void checkProperty(int cases, Testable&& property)
{
    checkPropertyOf(cases, rc::detail::toProperty(std::forward<Testable>(property)));
}

} // namespace zvo::test
