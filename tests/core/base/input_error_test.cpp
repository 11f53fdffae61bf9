// SPDX-License-Identifier: MIT
#include "core/base/input_error.h"

#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

TEST(InputError, ControlCharactersBecomeOneSpace)
{
    EXPECT_EQ(toOneLine("a\r\n\tb"), "a b");
    EXPECT_EQ(toOneLine("a\x1b[31mb\x7f"), "a [31mb ");
    EXPECT_EQ(toOneLine("a\xc2\x9b"
                        "31mb"), // the one-character form of the escape sequence
              "a 31mb");
}

TEST(InputError, TextOfAnyLanguageStaysAsItIs)
{
    const std::string text = "w\xc3\xbcrfel \xe6\xa3\xae \xf0\x9f\x90\xb0 \xc2\xa0";
    EXPECT_EQ(toOneLine(text), text);
}

TEST(InputError, BytesThatAreNotUtf8AreEscaped)
{
    EXPECT_EQ(toOneLine("a\xff"
                        "b"),
              "a\\xffb");
    EXPECT_EQ(toOneLine("\x80"), "\\x80");                                    // a continuation of nothing
    EXPECT_EQ(toOneLine("\xc3"), "\\xc3");                                    // cut short
    EXPECT_EQ(toOneLine("\xc0\xaf"), "\\xc0\\xaf");                           // overlong
    EXPECT_EQ(toOneLine("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");                  // overlong
    EXPECT_EQ(toOneLine("\xed\xa0\x80"), "\\xed\\xa0\\x80");                  // a surrogate
    EXPECT_EQ(toOneLine("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");         // past the last character
    EXPECT_EQ(toOneLine("\xf5\x80\x80\x80x"), "\\xf5\\x80\\x80\\x80x");       // never a first byte
    EXPECT_EQ(toOneLine("\xe6\xa3 \xe6\xa3\xae"), "\\xe6\\xa3 \xe6\xa3\xae"); // goes on with the next character
}

TEST(InputError, LongTextLosesItsMiddleAtWholeCharacters)
{
    std::string text = "start";
    for (int i = 0; i < 1000; ++i)
    {
        text += "\xe6\xa3\xae";
    }
    const std::string line = toOneLine(text + "end");
    EXPECT_LT(line.size(), 700U);
    EXPECT_TRUE(line.starts_with("start\xe6"));
    EXPECT_TRUE(line.ends_with("\xae"
                               "end"));
    EXPECT_EQ(line.find("\\x"), std::string::npos);
}

} // namespace

} // namespace zvo::test
