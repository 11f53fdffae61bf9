// SPDX-License-Identifier: MIT
#include "support/errors.h"

#include <gtest/gtest.h>

namespace zvo::test
{

std::string messageOf(const std::function<void()>& action, ErrorCode expected)
{
    try
    {
        action();
    }
    catch (const Error& error)
    {
        const std::string message = error.what();
        EXPECT_EQ(error.code(), expected) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

void expectParts(const std::string& text, std::initializer_list<const char*> parts)
{
    for (const char* part : parts)
    {
        EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
    }
}

} // namespace zvo::test
