// SPDX-License-Identifier: MIT
// Kernels that a host has made before they are recorded, on threads of its own.
#include "api_scene.h"
#include "c_host.h"
#include "expect_usage.h"
#include "zvo/zvo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace zvo
{

namespace
{

using test::expectUsage;

// A host that counts the kernels which its calls make.
struct CountingHost
{
    int made = 0;
    test::EmbeddingHost host{{},
                             [this](ContextInfo& info)
                             {
                                 info.log.user = this;
                                 info.log.function = [](void* user, LogSeverity, const char* message)
                                 {
                                     const bool is_kernel =
                                         std::string(message).find(": compiled in ") != std::string::npos;
                                     static_cast<CountingHost*>(user)->made += is_kernel ? 1 : 0;
                                 };
                             }};

    // Builds a tree, and traces a picture.
    std::vector<std::uint32_t> run()
    {
        const test::HostModel description(test::apiScene());
        const Model model = host.upload(description.info());
        const Tree tree = host.build(model, {.grid = test::apiGrid(4)});
        return host.picture(tree, test::apiCamera());
    }
};

// Makes all kernels, on four threads.
void makeAll(KernelPreparation& preparation)
{
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
    {
        threads.emplace_back(
            [&]
            {
                for (std::size_t number = next++; number < preparation.size(); number = next++)
                {
                    preparation.make(number);
                }
            });
    }
    for (std::thread& thread : threads)
    {
        thread.join();
    }
}

TEST(KernelList, PreparedKernelsAreNotMadeAgain)
{
    std::string list;
    std::vector<std::uint32_t> expected;
    {
        CountingHost first;
        expected = first.run();
        EXPECT_GT(first.made, 15);
        list = madeKernels(first.host.context);
        EXPECT_EQ(std::ranges::count(list, '\n'), first.made + 1);
        KernelPreparation nothing(first.host.context, list); // all have been made
        EXPECT_EQ(nothing.size(), 0U);
    }
    CountingHost second;
    {
        const KernelPreparation dropped(second.host.context, list);
        EXPECT_EQ(dropped.size(), static_cast<std::size_t>(std::ranges::count(list, '\n')) - 1);
    }
    std::optional<KernelPreparation> preparation(std::in_place, second.host.context, list + list);
    const std::size_t count = preparation->size();
    makeAll(*preparation);
    expectUsage([&] { preparation->make(count); }, "no kernel");
    preparation->finish();
    EXPECT_EQ(preparation->size(), 0U);
    preparation.reset();
    EXPECT_EQ(second.made, static_cast<int>(count)); // told when they are kept
    EXPECT_EQ(second.run(), expected);
    EXPECT_EQ(second.made, static_cast<int>(count));

    CountingHost third; // whose calls make kernels while others are made beforehand
    preparation.emplace(third.host.context, list);
    std::thread others([&] { makeAll(*preparation); });
    EXPECT_EQ(third.run(), expected);
    others.join();
    const int made_by_calls = third.made;
    EXPECT_EQ(made_by_calls, static_cast<int>(count));
    preparation->finish();
    EXPECT_EQ(third.made, made_by_calls);
    EXPECT_EQ(third.run(), expected);
}

TEST(KernelList, LinesOfOtherVersionsAndDevicesAreLeftOut)
{
    CountingHost counting;
    const std::string nonsense =
        "zvo " ZVO_VERSION_TEXT "\nvoxelize/nothing addressed 1 2\n\ntrace/primary\ntrace/primary elsewhere 1\n"
        "trace/primary addressed 1\ntrace/primary addressed x y z\n"
        "update/insert addressed 99999999999999999999\n\xff\xfe no text";
    const KernelPreparation preparation(counting.host.context, nonsense);
    EXPECT_EQ(preparation.size(), 0U);
    (void)counting.run();
    std::string old = madeKernels(counting.host.context);
    CountingHost other;
    EXPECT_GT(KernelPreparation(other.host.context, old).size(), 0U);
    old.replace(0, old.find('\n'), "zvo 0.1.9");
    EXPECT_EQ(KernelPreparation(other.host.context, old).size(), 0U);
}

TEST(KernelList, TheCInterfaceTakesTheSameLists)
{
    test::CEmbeddingHost host;
    ZvoModel* const model = host.uploadBox();
    ZvoTreeBuildInfo info = ZVO_TREE_BUILD_INFO_INIT;
    info.grid = {{-2, -2, -2}, 1, 4};
    zvoTreeDestroy(host.build(model, info));
    zvoModelDestroy(model);
    const char* text = nullptr;
    ASSERT_EQ(zvoContextMadeKernels(host.context, &text), ZVO_OK);
    EXPECT_NE(std::string(text).find("voxelize/bin "), std::string::npos) << text;
    test::CEmbeddingHost other;
    ZvoKernelPreparation* preparation = nullptr;
    ASSERT_EQ(zvoKernelPreparationCreate(other.context, text, &preparation), ZVO_OK);
    std::size_t size = 0;
    ASSERT_EQ(zvoKernelPreparationSize(preparation, &size), ZVO_OK);
    EXPECT_EQ(size, static_cast<std::size_t>(std::ranges::count(std::string(text), '\n')) - 1);
    EXPECT_EQ(zvoKernelPreparationMake(preparation, size), ZVO_ERROR_USAGE);
    EXPECT_EQ(zvoKernelPreparationMake(preparation, 0), ZVO_OK);
    EXPECT_EQ(zvoKernelPreparationFinish(preparation), ZVO_OK);
    ASSERT_EQ(zvoKernelPreparationSize(preparation, &size), ZVO_OK);
    EXPECT_EQ(size, 0U);
    zvoKernelPreparationDestroy(preparation);
    const char* made = nullptr;
    ASSERT_EQ(zvoContextMadeKernels(other.context, &made), ZVO_OK);
    const std::string list = text;
    EXPECT_EQ(std::string(made), list.substr(0, list.find('\n', list.find('\n') + 1) + 1)); // version, first kernel
}

} // namespace
} // namespace zvo
