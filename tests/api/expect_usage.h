// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace zvo::test
{

/// action throws Error{Usage}, and word is in its message.
inline void expectUsage(const std::function<void()>& action, const std::string& word)
{
    try
    {
        action();
        ADD_FAILURE() << "no error, expected one about " << word;
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Usage) << error.what();
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

} // namespace zvo::test
