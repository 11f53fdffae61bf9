// SPDX-License-Identifier: MIT
#include "support/errors.h"

#include <gtest/gtest.h>

#include <regex>

namespace zvo::test
{

namespace
{

/// The message of an error, which must have that code and one line.
std::string checkedMessage(const Error& error, ErrorCode expected)
{
    const std::string message = error.what();
    EXPECT_EQ(error.code(), expected) << message;
    EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << message;
    return message;
}

} // namespace

std::string messageOf(const std::function<void()>& action, ErrorCode expected)
{
    try
    {
        action();
    }
    catch (const Error& error)
    {
        return checkedMessage(error, expected);
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

bool loadsOrIsRefused(const std::function<void()>& load)
{
    try
    {
        load();
        return true;
    }
    catch (const Error& error)
    {
        checkedMessage(error, ErrorCode::Input);
        return false;
    }
}

void expectParts(const std::string& text, std::initializer_list<std::string> parts)
{
    for (const std::string& part : parts)
    {
        EXPECT_NE(text.find(part), std::string::npos) << '"' << part << "\" is not in: " << text;
    }
}

void expectOneLine(const std::vector<std::string>& lines, std::initializer_list<std::string> parts)
{
    EXPECT_EQ(lines.size(), 1U) << testing::PrintToString(lines);
    expectParts(lines.empty() ? "" : lines.front(), parts);
}

} // namespace zvo::test
