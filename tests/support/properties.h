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

/// A number from low to high - 1, uniform also in small cases, for which rc::gen::inRange gives only the lowest.
template <typename T> rc::Gen<T> anyBetween(T low, T high)
{
    return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high));
}

} // namespace zvo::test
