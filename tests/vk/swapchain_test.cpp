// SPDX-License-Identifier: MIT
// Images of a window when it is resized, late or lost.
#include "vk/swapchain.h"

#include "support/fake_surfaces.h"
#include "vk/kernels.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace
{

using namespace zvo;
using test::FakeSurfaces;

constexpr VkExtent2D kExtent = {64, 48};
constexpr std::uint32_t kFramesInFlight = 2;

vk::HeadlessOptions windowOptions()
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.get_instance_proc_addr = test::vulkanWithFakeSurfaces();
    options.window = test::fakeWindow();
    options.submissions_in_flight = kFramesInFlight;
    return options;
}

/// A swapchain on a fake surface, and frames that are shown with it.
class SwapchainTest : public testing::Test
{
protected:
    void SetUp() override { make({}); }

    void TearDown() override
    {
        m_flights.clear();
        swapchain.reset();
        EXPECT_EQ(fake.swapchains_alive, 0);
        EXPECT_EQ(fake.surfaces_alive, 0);
    }

    void make(vk::PresentMode mode)
    {
        swapchain.reset();
        swapchain =
            std::make_unique<vk::Swapchain>(device, test::makeFakeSurface, vk::SwapchainOptions{mode, kFramesInFlight});
    }

    /// Shows a frame as a program does. Returns whether there was an image for it.
    bool show(VkExtent2D framebuffer = kExtent)
    {
        while (m_flights.size() >= kFramesInFlight)
        {
            const std::uint64_t frame = m_flights.front().frame;
            m_flights.pop_front(); // waits
            swapchain->frameDone(frame);
        }
        const std::optional<vk::SwapchainImage> image = swapchain->acquire(framebuffer, m_frame);
        if (image)
        {
            m_flights.push_back(
                {m_frame, device.submit([](vk::FrameGraph&) {},
                                        {image->available, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, image->presentable})});
            swapchain->present(*image);
            last = *image;
        }
        ++m_frame;
        return image.has_value();
    }

    struct Flight
    {
        std::uint64_t frame;
        vk::Submission submission;
    };

    FakeSurfaces& fake = test::resetFakeSurfaces();
    vk::HeadlessDevice device{windowOptions(), testKernels()};
    std::unique_ptr<vk::Swapchain> swapchain;
    vk::SwapchainImage last;

private:
    std::deque<Flight> m_flights;
    std::uint64_t m_frame = 0;
};

TEST_F(SwapchainTest, EveryFrameHasAnImage)
{
    for (int i = 0; i < 12; ++i)
    {
        ASSERT_TRUE(show());
    }
    EXPECT_EQ(fake.presented, 12);
    EXPECT_EQ(fake.swapchains_made, 1);
    EXPECT_EQ(swapchain->generation(), 1U);
    EXPECT_EQ(fake.last.minImageCount, kFramesInFlight + 1);
    EXPECT_EQ(last.extent.width, kExtent.width);
    EXPECT_EQ(last.extent.height, kExtent.height);
}

TEST_F(SwapchainTest, AnotherSizeMakesOtherImagesAndOldOnesGoWhenTheirFramesAreDone)
{
    ASSERT_TRUE(show());
    ASSERT_TRUE(show({80, 50}));
    EXPECT_EQ(last.extent.width, 80U);
    EXPECT_EQ(fake.swapchains_alive, 2) << "the first frame may be under way";
    for (int i = 0; i < 2; ++i)
    {
        ASSERT_TRUE(show({80, 50}));
    }
    EXPECT_EQ(fake.swapchains_alive, 1);
    for (std::uint32_t i = 1; i < 20; ++i)
    {
        ASSERT_TRUE(show({80 + i, 50}));
        EXPECT_LE(fake.swapchains_alive, 4) << "they do not pile up";
    }
}

TEST_F(SwapchainTest, TheSurfaceHasTheLastWordOnTheSize)
{
    fake.extent = {70, 40};
    ASSERT_TRUE(show());
    EXPECT_EQ(last.extent.width, 70U);
    ASSERT_TRUE(show());
    EXPECT_EQ(fake.swapchains_made, 1) << "it was made for this window all the same";
    fake.extent = {UINT32_MAX, UINT32_MAX};
    ASSERT_TRUE(show({5000, 20}));
    EXPECT_EQ(last.extent.width, 1000U) << "the most that it takes";
}

TEST_F(SwapchainTest, WithoutAnExtentThereIsNoImage)
{
    EXPECT_FALSE(show({0, 48}));
    EXPECT_FALSE(show({64, 0}));
    EXPECT_EQ(fake.swapchains_made, 0);
    ASSERT_TRUE(show());
    fake.extent = {0, 0};
    EXPECT_FALSE(show({65, 48})) << "minimised, and nobody said so";
    fake.extent = kExtent;
    EXPECT_TRUE(show());
}

TEST_F(SwapchainTest, WhatIsOutOfDateIsMadeAnewForTheSameFrame)
{
    ASSERT_TRUE(show());
    fake.acquire = {VK_ERROR_OUT_OF_DATE_KHR};
    EXPECT_TRUE(show());
    EXPECT_EQ(fake.swapchains_made, 2);
    fake.create = {VK_ERROR_OUT_OF_DATE_KHR};
    EXPECT_TRUE(show({50, 50}));
    fake.present = {VK_ERROR_OUT_OF_DATE_KHR};
    EXPECT_TRUE(show({50, 50}));
    const int made = fake.swapchains_made;
    EXPECT_TRUE(show({50, 50}));
    EXPECT_EQ(fake.swapchains_made, made + 1);
}

TEST_F(SwapchainTest, WhatIsNotOptimalIsShownOnceMore)
{
    ASSERT_TRUE(show());
    fake.acquire = {VK_SUBOPTIMAL_KHR};
    EXPECT_TRUE(show());
    EXPECT_EQ(fake.swapchains_made, 1);
    EXPECT_EQ(fake.presented, 2);
    EXPECT_TRUE(show());
    EXPECT_EQ(fake.swapchains_made, 2);
    fake.present = {VK_SUBOPTIMAL_KHR};
    EXPECT_TRUE(show());
    EXPECT_TRUE(show());
    EXPECT_EQ(fake.swapchains_made, 3);
}

TEST_F(SwapchainTest, ALostSurfaceIsMadeAnewWhereverThatIsTold)
{
    ASSERT_TRUE(show());
    int made = 1;
    for (std::deque<VkResult>* results : {&fake.acquire, &fake.present, &fake.capabilities, &fake.create})
    {
        *results = {VK_ERROR_SURFACE_LOST_KHR};
        EXPECT_TRUE(show({60 + static_cast<std::uint32_t>(made), 48}));
        EXPECT_TRUE(show({60 + static_cast<std::uint32_t>(made), 48}));
        EXPECT_EQ(fake.surfaces_made, ++made);
        EXPECT_EQ(fake.surfaces_alive, 1);
    }
}

TEST_F(SwapchainTest, AWindowThatIsAlwaysOutOfDateShowsNothingAndDoesNotHang)
{
    fake.acquire = std::deque<VkResult>(100, VK_ERROR_OUT_OF_DATE_KHR);
    EXPECT_FALSE(show());
    fake.acquire = std::deque<VkResult>(100, VK_ERROR_SURFACE_LOST_KHR);
    EXPECT_FALSE(show());
    fake.acquire.clear();
    EXPECT_TRUE(show());
}

TEST_F(SwapchainTest, AFrameForWhichNoImageComesInTimeIsNotShown)
{
    for (const VkResult result : {VK_TIMEOUT, VK_NOT_READY})
    {
        fake.acquire = {result};
        EXPECT_FALSE(show());
        EXPECT_TRUE(show());
    }
    EXPECT_EQ(fake.swapchains_made, 1);
}

TEST_F(SwapchainTest, ALostDeviceIsAnError)
{
    fake.acquire = {VK_ERROR_DEVICE_LOST};
    EXPECT_THROW(show(), Error);
    fake.create = {VK_ERROR_DEVICE_LOST};
    EXPECT_THROW(show({10, 10}), Error);
}

TEST_F(SwapchainTest, ModesAreThoseOfTheSurface)
{
    make(vk::PresentMode::Mailbox);
    ASSERT_TRUE(show());
    EXPECT_EQ(swapchain->mode(), vk::PresentMode::Fifo);
    EXPECT_EQ(fake.last.presentMode, VK_PRESENT_MODE_FIFO_KHR);
    fake.modes.push_back(VK_PRESENT_MODE_IMMEDIATE_KHR);
    swapchain->setMode(vk::PresentMode::Immediate);
    ASSERT_TRUE(show());
    EXPECT_EQ(swapchain->mode(), vk::PresentMode::Immediate);
    EXPECT_EQ(fake.last.presentMode, VK_PRESENT_MODE_IMMEDIATE_KHR);
    const int made = fake.swapchains_made;
    swapchain->setMode(vk::PresentMode::Immediate);
    ASSERT_TRUE(show());
    EXPECT_EQ(fake.swapchains_made, made) << "nothing changed";
}

TEST_F(SwapchainTest, NoMoreImagesThanTheSurfaceHas)
{
    fake.max_image_count = 2;
    for (int i = 0; i < 5; ++i)
    {
        ASSERT_TRUE(show());
    }
    EXPECT_EQ(fake.last.minImageCount, 2U);
}

TEST_F(SwapchainTest, WindowsThatCannotBeShownToAreRefused)
{
    const auto codeOf = [&]
    {
        try
        {
            make({});
            show();
            return ErrorCode::Other;
        }
        catch (const Error& error)
        {
            return error.code();
        }
    };
    fake.supported = false;
    EXPECT_EQ(codeOf(), ErrorCode::Device);
    fake.supported = true;
    fake.formats = {{VK_FORMAT_BC7_UNORM_BLOCK, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR}};
    EXPECT_EQ(codeOf(), ErrorCode::Device);
    fake.formats = {{VK_FORMAT_R8G8B8A8_SRGB, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR}};
    fake.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    EXPECT_EQ(codeOf(), ErrorCode::Device);
    fake.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    make({});
    EXPECT_TRUE(show());
    EXPECT_EQ(swapchain->format(), VK_FORMAT_R8G8B8A8_SRGB);
}

TEST(SurfaceFormat, KeepsCodesWhereItCan)
{
    constexpr VkColorSpaceKHR kUsual = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    const auto choose = [](std::vector<VkSurfaceFormatKHR> formats)
    {
        const auto chosen =
            vk::chooseSurfaceFormat(formats, [](VkFormat format) { return format != VK_FORMAT_R8G8B8_UNORM; });
        return chosen ? chosen->format : VK_FORMAT_UNDEFINED;
    };
    EXPECT_EQ(choose({{VK_FORMAT_B8G8R8A8_SRGB, kUsual}, {VK_FORMAT_B8G8R8A8_UNORM, kUsual}}),
              VK_FORMAT_B8G8R8A8_UNORM);
    EXPECT_EQ(choose({{VK_FORMAT_B8G8R8A8_SRGB, kUsual}, {VK_FORMAT_A2B10G10R10_UNORM_PACK32, kUsual}}),
              VK_FORMAT_A2B10G10R10_UNORM_PACK32);
    EXPECT_EQ(choose({{VK_FORMAT_B8G8R8A8_UNORM, VK_COLOR_SPACE_HDR10_ST2084_EXT}, {VK_FORMAT_B8G8R8A8_SRGB, kUsual}}),
              VK_FORMAT_B8G8R8A8_SRGB);
    EXPECT_EQ(choose({{VK_FORMAT_R8G8B8_UNORM, kUsual}, {VK_FORMAT_B8G8R8A8_SRGB, kUsual}}), VK_FORMAT_B8G8R8A8_SRGB);
    EXPECT_EQ(choose({{VK_FORMAT_UNDEFINED, kUsual}}), VK_FORMAT_B8G8R8A8_UNORM) << "any will do";
    EXPECT_EQ(choose({{VK_FORMAT_R8G8B8_UNORM, kUsual}}), VK_FORMAT_UNDEFINED);
    EXPECT_EQ(choose({}), VK_FORMAT_UNDEFINED);
    EXPECT_TRUE(vk::encodesSrgb(VK_FORMAT_B8G8R8A8_SRGB));
    EXPECT_FALSE(vk::encodesSrgb(VK_FORMAT_B8G8R8A8_UNORM));
}

TEST(WindowSupport, ADeviceThatCannotPresentIsRefusedWithAReason)
{
    vk::HeadlessOptions options = windowOptions();
    options.window->can_present = [](VkInstance, VkPhysicalDevice, std::uint32_t) { return false; };
    try
    {
        const vk::HeadlessDevice own(options, testKernels());
        ADD_FAILURE();
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Device);
        EXPECT_NE(std::string(error.what()).find("has no queue that computes, draws and presents to the window"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
