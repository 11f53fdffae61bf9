// SPDX-License-Identifier: MIT
#include "support/errors.h"

#include <gtest/gtest.h>

#include <regex>

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

std::uint64_t bytesNeeded(const std::string& message)
{
    std::smatch found;
    const bool matches = std::regex_search(message, found, std::regex("needs ([0-9]+) bytes in all"));
    EXPECT_TRUE(matches) << message;
    return matches ? std::stoull(found[1]) : 0;
}

void expectParts(const std::string& text, std::initializer_list<const char*> parts)
{
    for (const char* part : parts)
    {
        EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
    }
}

} // namespace zvo::test
