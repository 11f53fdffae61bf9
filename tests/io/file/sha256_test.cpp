// SPDX-License-Identifier: MIT
#include "io/file/sha256.h"

#include <gtest/gtest.h>
#include <string>

namespace zvo
{

namespace
{

// Examples of FIPS 180-4, published by NIST.
constexpr const char* kDigestOfNothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* kDigestOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kDigestOfMillionA = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Sha256, DigestsArePublishedOnes)
{
    EXPECT_EQ(sha256Hex({}), kDigestOfNothing);
    EXPECT_EQ(sha256Hex(std::as_bytes(std::span("abc", 3))), kDigestOfAbc);
}

TEST(Sha256, PiecesGiveTheDigestOfTheWhole)
{
    Sha256 hash;
    const std::string piece(997, 'a');
    std::size_t left = 1000000;
    while (left > 0)
    {
        const std::size_t taken = std::min(left, piece.size());
        hash.update(std::string_view(piece).substr(0, taken));
        left -= taken;
    }
    EXPECT_EQ(hash.hexDigest(), kDigestOfMillionA);
}

TEST(Sha256, DigestMayBeAskedForInBetween)
{
    Sha256 hash;
    EXPECT_EQ(hash.hexDigest(), kDigestOfNothing);
    hash.update("a");
    EXPECT_EQ(hash.hexDigest(), hash.hexDigest());
    hash.update("bc");
    EXPECT_EQ(hash.hexDigest(), kDigestOfAbc);
}

} // namespace

} // namespace zvo
