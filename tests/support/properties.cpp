// SPDX-License-Identifier: MIT
#include "support/properties.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace zvo::test
{

void checkPropertyOf(int cases, const rc::detail::Property& property)
{
    static const bool chosen = std::getenv("RC_PARAMS") != nullptr;
    if (!chosen)
    {
        setenv("RC_PARAMS", "seed=1", 0); // RapidCheck reads it once; without it, the seed is random
    }
    rc::detail::TestParams params = rc::detail::configuration().testParams;
    if (!chosen)
    {
        params.maxSuccess = cases;
    }
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    const std::string name = std::string(test.test_suite_name()) + "." + test.name();
    const rc::detail::TestResult result = rc::detail::checkProperty(property, {name, name}, params);
    if (!result.is<rc::detail::SuccessResult>())
    {
        std::ostringstream message;
        printResultMessage(result, message);
        FAIL() << message.str();
    }
}

} // namespace zvo::test
