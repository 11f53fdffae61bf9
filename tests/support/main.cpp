// SPDX-License-Identifier: MIT
#include "support/device.h"

#include <gtest/gtest.h>

namespace
{

// Fails a test during which the validation layers wrote messages.
class ValidationListener : public testing::EmptyTestEventListener
{
    void OnTestStart(const testing::TestInfo&) override { m_before = zvo::test::validationMessageCount(); }

    void OnTestEnd(const testing::TestInfo&) override
    {
        EXPECT_EQ(zvo::test::validationMessageCount(), m_before) << "the Vulkan validation layers reported something";
    }

    std::uint32_t m_before = 0;
};

// Destroys the device before the process ends, as drivers may not be called from static destructors. Fails if the
// validation layers then write a message, such as that of a leak.
class DeviceEnvironment : public testing::Environment
{
    void TearDown() override
    {
        const std::uint32_t before = zvo::test::validationMessageCount();
        zvo::test::destroySharedDevice();
        EXPECT_EQ(zvo::test::validationMessageCount(), before)
            << "destroying the device made the layers report something";
    }
};

} // namespace

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    testing::AddGlobalTestEnvironment(new DeviceEnvironment);
    testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);
    return RUN_ALL_TESTS();
}
