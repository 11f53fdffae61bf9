// SPDX-License-Identifier: MIT
// The C interface's structs: their sizes, which tell their versions, and the strides of arrays.
#include "api/c_struct.h"
#include "expect_usage.h"
#include "zvo/zvo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace zvo
{

namespace
{

using test::expectUsage;

template <typename Struct> class CStructSize : public testing::Test
{
protected:
    using Bytes = std::vector<unsigned char>;

    static constexpr std::size_t kSize = sizeof(Struct);
    static constexpr std::size_t kSizeBytes = sizeof(std::size_t);

    // A host's struct of this size. Every byte behind the size is value.
    static Bytes given(std::size_t size, unsigned char value)
    {
        Bytes bytes(std::max(size, kSizeBytes), value);
        std::memcpy(bytes.data(), &size, kSizeBytes);
        return bytes;
    }

    // Sets the reserved members that the host's struct has to 0.
    static void clearReserved(Bytes& bytes)
    {
        if constexpr (requires(Struct value) { value.reserved; })
        {
            const auto first = std::min(offsetof(Struct, reserved), bytes.size());
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(first),
                        std::min(sizeof(Struct::reserved), bytes.size() - first), 0);
        }
    }

    static Struct* in(Bytes& bytes) { return reinterpret_cast<Struct*>(bytes.data()); }

    static Bytes bytesOf(const Struct& value)
    {
        Bytes bytes(kSize);
        std::memcpy(bytes.data(), &value, kSize);
        return bytes;
    }
};

using Structs =
    testing::Types<ZvoOptionalFeatures, ZvoDeviceInfo, ZvoContextInfo, ZvoMemoryUse, ZvoPassTime, ZvoTextureInfo,
                   ZvoMaterialInfo, ZvoMeshInfo, ZvoInstanceInfo, ZvoModelInfo, ZvoModelStats, ZvoTreeInfo,
                   ZvoTreeBuildInfo, ZvoTreeAlgebraInfo, ZvoDroppedTriangles, ZvoDynamicTreeInfo, ZvoDynamicObjectInfo,
                   ZvoBrushInfo, ZvoUpdateStats, ZvoSunInfo, ZvoEnvironmentMapInfo, ZvoCameraInfo, ZvoTraceInfo,
                   ZvoPathInfo, ZvoImageTarget, ZvoDepthTarget, ZvoRadianceCacheInfo, ZvoCachedFrameInfo,
                   ZvoRadianceCacheStats, ZvoCachedPictureInfo>;
TYPED_TEST_SUITE(CStructSize, Structs);

TYPED_TEST(CStructSize, MembersThatAnOlderHostDoesNotKnowAreTheDefaults)
{
    const auto defaults = this->bytesOf(CStruct<TypeParam>::initial());
    for (std::size_t size = this->kSizeBytes; size <= this->kSize; size += kMemberBytes)
    {
        auto bytes = this->given(size, 0x5A); // exactly that many, so that sanitizers see reads behind them
        this->clearReserved(bytes);
        const auto read = this->bytesOf(readStruct(this->in(bytes), "it"));
        EXPECT_TRUE(std::equal(bytes.begin() + this->kSizeBytes, bytes.end(), read.begin() + this->kSizeBytes));
        EXPECT_TRUE(std::equal(read.begin() + static_cast<std::ptrdiff_t>(size), read.end(),
                               defaults.begin() + static_cast<std::ptrdiff_t>(size)));
    }
}

TYPED_TEST(CStructSize, MembersOfANewerHostMustBeZero)
{
    auto bytes = this->given(this->kSize + 12, 0);
    EXPECT_NO_THROW(readStruct(this->in(bytes), "it"));
    for (std::size_t i = this->kSize; i < bytes.size(); ++i)
    {
        bytes[i] = 1;
        expectUsage([&] { readStruct(this->in(bytes), "it"); }, "does not know");
        bytes[i] = 0;
    }
}

TYPED_TEST(CStructSize, WhatIsReservedMustBeZero)
{
    if constexpr (requires(TypeParam value) { value.reserved; })
    {
        auto value = CStruct<TypeParam>::initial();
        EXPECT_NO_THROW(readStruct(&value, "it"));
        value.reserved = 1;
        expectUsage([&] { readStruct(&value, "it"); }, "it has a reserved member");
    }
}

TYPED_TEST(CStructSize, NoSizeIsAnError)
{
    std::vector<std::size_t> sizes = {this->kSize + 1, this->kSize - 2, 4100, std::size_t{1} << 40, SIZE_MAX};
    for (std::size_t size = 0; size < this->kSizeBytes; ++size)
    {
        sizes.push_back(size);
    }
    for (const std::size_t size : sizes)
    {
        auto bytes = this->given(this->kSize, 0); // whatever its size says, nothing behind it is read
        std::memcpy(bytes.data(), &size, this->kSizeBytes);
        expectUsage([&] { readStruct(this->in(bytes), "it"); }, "struct_size");
        expectUsage([&] { writeStruct(this->in(bytes), "it", CStruct<TypeParam>::initial()); }, "struct_size");
    }
    expectUsage([] { readStruct<TypeParam>(nullptr, "it"); }, "it is null");
    expectUsage([] { writeStruct<TypeParam>(nullptr, "it", CStruct<TypeParam>::initial()); }, "it is null");
}

TYPED_TEST(CStructSize, AsMuchIsFilledAsTheHostKnowsAndTheRestIsZero)
{
    TypeParam value;
    std::memset(&value, 0x5A, sizeof(value));
    for (std::size_t size = this->kSizeBytes; size < this->kSize + 9; size += kMemberBytes)
    {
        auto bytes = this->given(size, 0xEE);
        writeStruct(this->in(bytes), "it", value);
        std::size_t kept = 0;
        std::memcpy(&kept, bytes.data(), sizeof(kept));
        EXPECT_EQ(kept, size);
        for (std::size_t i = this->kSizeBytes; i < size; ++i)
        {
            ASSERT_EQ(bytes[i], i < this->kSize ? 0x5A : 0) << i << " of " << size;
        }
    }
}

TYPED_TEST(CStructSize, AnArraysFirstSizeIsItsStride)
{
    const std::size_t stride = this->kSize + 16; // of a newer host
    typename TestFixture::Bytes bytes;
    for (unsigned char value = 1; value <= 3; ++value)
    {
        auto element = this->given(stride, 0);
        std::fill(element.begin() + this->kSizeBytes, element.begin() + this->kSize, value);
        this->clearReserved(element);
        bytes.insert(bytes.end(), element.begin(), element.end());
    }
    const std::vector<TypeParam> read = readStructs(this->in(bytes), 3, "it");
    ASSERT_EQ(read.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
    {
        EXPECT_EQ(this->bytesOf(read[i])[this->kSizeBytes], i + 1);
    }
    // The lowest byte of the second one's size, which is below 256.
    bytes[stride] = static_cast<unsigned char>(stride - 8);
    if (stride < 256)
    {
        expectUsage([&] { readStructs(this->in(bytes), 3, "it"); }, "several sizes");
    }
    EXPECT_TRUE(readStructs<TypeParam>(nullptr, 0, "it").empty());
    expectUsage([] { readStructs<TypeParam>(nullptr, 1, "it"); }, "it is null");
}

} // namespace

} // namespace zvo
