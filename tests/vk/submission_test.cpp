// SPDX-License-Identifier: MIT
// Submissions that are not waited for at once.
#include "vk/kernels.h"

#include "support/failing_vulkan.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>

namespace
{

using namespace zvo;
using test::device;
using test::iota;
using test::scale;
using test::Words;

constexpr gpu::uint kCount = 2049;

std::vector<gpu::uint> multiples(gpu::uint factor)
{
    std::vector<gpu::uint> values(kCount);
    for (gpu::uint i = 0; i < kCount; ++i)
    {
        values[i] = i * factor;
    }
    return values;
}

std::vector<std::string> names(const std::vector<vk::PassTime>& times)
{
    std::vector<std::string> result;
    for (const vk::PassTime& time : times)
    {
        result.push_back(time.name);
    }
    return result;
}

/// A frame with its own memory, so that its picture is read without another submission.
struct Frame
{
    explicit Frame(vk::HeadlessDevice& device)
        : values(device.device(), "values", kCount), scaled(device.device(), "scaled", kCount),
          shown(device.device(), "shown", kCount, vk::MemoryKind::Readback)
    {
    }

    void record(vk::FrameGraph& graph, gpu::uint factor)
    {
        iota(graph, values);
        scale(graph, values, scaled, factor);
        graph.copy(scaled, 0, shown, 0, shown.bytes());
        graph.releaseToHost();
    }

    [[nodiscard]] std::vector<gpu::uint> result() const { return {shown.mappedData(), shown.mappedData() + kCount}; }

    Words values;
    Words scaled;
    Words shown;
    vk::Submission submission; // last, because it waits before the buffers are destroyed
};

vk::Submission submitFrame(vk::HeadlessDevice& device, Frame& frame, gpu::uint factor)
{
    return device.submit([&](vk::FrameGraph& graph) { frame.record(graph, factor); });
}

/// A device whose calls are counted and can fail.
vk::HeadlessOptions shimmedOptions(std::uint32_t in_flight)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.get_instance_proc_addr = test::failingVulkan();
    options.submissions_in_flight = in_flight;
    return options;
}

std::uint64_t waitCount()
{
    return test::callCount("vkWaitForFences");
}

TEST(Submission, EveryOneOfSeveralInFlightHasItsOwnResults)
{
    std::deque<Frame> frames;
    for (gpu::uint i = 0; i < 10; ++i) // more than may be in flight
    {
        frames.emplace_back(device());
        frames.back().submission = submitFrame(device(), frames.back(), i + 3);
    }
    for (const std::size_t i : {9U, 0U, 5U, 4U, 3U, 8U, 1U, 2U, 6U, 7U}) // in any order
    {
        const std::vector<vk::PassTime> times = frames[i].submission.wait();
        EXPECT_TRUE(frames[i].submission.done());
        EXPECT_EQ(frames[i].result(), multiples(static_cast<gpu::uint>(i) + 3)) << i;
        if (device().device().report().timestamp_period_ns != 0)
        {
            EXPECT_EQ(names(times), (std::vector<std::string>{"test/iota", "test/scale", "copy scaled to shown"}));
        }
    }
}

TEST(Submission, PassTimesAreThoseOfItsOwnPassesHoweverOftenTheyAreAskedFor)
{
    if (device().device().report().timestamp_period_ns == 0)
    {
        GTEST_SKIP() << "a device without timestamps";
    }
    Words small(device().device(), "small", 64);
    Words big(device().device(), "big", 1 << 22);
    vk::Submission nothing = device().submit([](vk::FrameGraph&) {});
    vk::Submission one = device().submit([&](vk::FrameGraph& graph) { iota(graph, small); });
    vk::Submission two = device().submit(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(big, 1);
            iota(graph, big);
        });
    const std::vector<vk::PassTime> times = two.wait();
    EXPECT_EQ(names(times), (std::vector<std::string>{"fill big", "test/iota"}));
    EXPECT_EQ(names(one.wait()), std::vector<std::string>{"test/iota"});
    EXPECT_TRUE(nothing.wait().empty());
    EXPECT_GT(times.at(1).ms, one.wait().at(0).ms) << "65,536 times as much work";
    for (int i = 0; i < 4; ++i) // later submissions use its timers
    {
        device().submit([&](vk::FrameGraph& graph) { graph.fill(small, 1); }).wait();
    }
    const std::vector<vk::PassTime> again = two.wait();
    ASSERT_EQ(names(again), names(times));
    EXPECT_EQ(again.at(1).ms, times.at(1).ms);
}

TEST(Submission, WorkSeesWhatWasSubmittedBefore)
{
    Words a(device().device(), "a", kCount);
    Words b(device().device(), "b", kCount);
    std::vector<gpu::uint> expected = multiples(1);
    std::deque<vk::Submission> submissions;
    submissions.push_back(device().submit([&](vk::FrameGraph& graph) { iota(graph, a); }));
    for (gpu::uint i = 0; i < 200; ++i)
    {
        const gpu::uint factor = 2 * i + 3; // odd, so that the first values lose no bits
        std::for_each(expected.begin(), expected.end(), [&](gpu::uint& value) { value *= factor; });
        const auto record = [&](vk::FrameGraph& graph)
        { scale(graph, i % 2 == 0 ? a : b, i % 2 == 0 ? b : a, factor); };
        if (i % 7 == 3)
        {
            device().run(record);
        }
        else
        {
            submissions.push_back(device().submit(record));
        }
        if (i % 50 == 49)
        {
            EXPECT_EQ(device().download(a), expected) << i; // without waiting for them
        }
    }
    const std::vector<gpu::uint> ones(kCount, 1);
    device().upload(a, std::span(ones));
    vk::Submission last = device().submit([&](vk::FrameGraph& graph) { scale(graph, a, b, 5); });
    last.wait();
    EXPECT_EQ(device().download(b), std::vector<gpu::uint>(kCount, 5));
}

TEST(Submission, SmallDataTravelsWithEachFrame)
{
    std::deque<Frame> frames;
    for (gpu::uint i = 0; i < 8; ++i)
    {
        Frame& frame = frames.emplace_back(device());
        std::vector<gpu::uint> values(kCount, i);
        frame.submission = device().submit(
            [&](vk::FrameGraph& graph)
            {
                graph.update(frame.values, 0, values);
                graph.copy(frame.values, 0, frame.shown, 0, frame.shown.bytes());
                graph.releaseToHost();
            });
        std::fill(values.begin(), values.end(), 77);
    }
    for (gpu::uint i = 0; i < 8; ++i)
    {
        frames[i].submission.wait();
        EXPECT_EQ(frames[i].result(), std::vector<gpu::uint>(kCount, i));
    }
}

TEST(Submission, NothingWaitsUntilAsManyAreInFlightAsMayBe)
{
    for (const std::uint32_t in_flight : {0U, 1U, 2U, 5U})
    {
        vk::HeadlessDevice shimmed(shimmedOptions(in_flight), testKernels());
        const std::uint32_t most = std::max(in_flight, 1U);
        std::vector<Words> values;
        for (std::uint32_t i = 0; i < most + 3; ++i)
        {
            values.emplace_back(shimmed.device(), "values", kCount);
        }
        test::failCall(UINT64_MAX);
        std::vector<vk::Submission> submissions;
        for (std::uint32_t i = 0; i < most + 3; ++i)
        {
            submissions.push_back(shimmed.submit([&](vk::FrameGraph& graph) { iota(graph, values[i]); }));
            EXPECT_EQ(waitCount(), i < most ? 0 : i + 1 - most) << "submission " << i << " of " << in_flight;
        }
        EXPECT_EQ(test::callCount("vkQueueSubmit2"), most + 3);
        EXPECT_EQ(test::callCount("vkDeviceWaitIdle"), 0U);
        submissions[2].wait(); // this waits for the oldest ones, too
        const std::uint64_t waits = waitCount();
        submissions[0].wait();
        submissions[1].wait();
        EXPECT_TRUE(submissions[2].done());
        EXPECT_EQ(waitCount(), waits);
    }
    EXPECT_TRUE(test::liveObjects().empty());
}

TEST(Submission, DoneSaysWhetherItIsStillUnderWay)
{
    EXPECT_TRUE(vk::Submission().done());
    EXPECT_TRUE(vk::Submission().wait().empty());
    Words values(device().device(), "values", 1 << 24);
    bool seen_under_way = false;
    for (int i = 0; i < 100 && !seen_under_way; ++i) // the device may be done before the host checks
    {
        vk::Submission submission = device().submit(
            [&](vk::FrameGraph& graph)
            {
                for (int pass = 0; pass < 4; ++pass)
                {
                    iota(graph, values);
                }
            });
        seen_under_way = !submission.done();
        while (!submission.done())
        {
        }
        EXPECT_TRUE(submission.done());
        submission.wait();
        EXPECT_TRUE(submission.done());
    }
    EXPECT_TRUE(seen_under_way);
}

TEST(Submission, DestroyingOneWaits)
{
    vk::HeadlessDevice shimmed(shimmedOptions(3), testKernels());
    Frame frame(shimmed);
    test::failCall(UINT64_MAX);
    {
        const vk::Submission dropped = submitFrame(shimmed, frame, 7);
        EXPECT_EQ(waitCount(), 0U);
    }
    EXPECT_EQ(waitCount(), 1U);
    EXPECT_EQ(frame.result(), multiples(7));
    frame.submission = submitFrame(shimmed, frame, 9);
    EXPECT_EQ(waitCount(), 1U);
    frame.submission = vk::Submission(); // replacing it waits, too
    EXPECT_EQ(waitCount(), 2U);
    EXPECT_EQ(frame.result(), multiples(9));
    vk::Submission moved = submitFrame(shimmed, frame, 11);
    frame.submission = std::move(moved);
    EXPECT_EQ(waitCount(), 2U) << "moving does not";
    frame.submission.wait();
    EXPECT_EQ(frame.result(), multiples(11));
}

TEST(Submission, DestroyingTheDeviceWaitsForAllThatAreInFlight)
{
    std::vector<vk::Submission> submissions;
    {
        vk::HeadlessDevice shimmed(shimmedOptions(3), testKernels());
        test::failCall(UINT64_MAX);
        for (int i = 0; i < 3; ++i)
        {
            submissions.push_back(shimmed.submit(
                [](vk::FrameGraph& graph)
                {
                    for (int pass = 0; pass < 20; ++pass)
                    {
                        graph.addPass(gpu::test::Iota{}).dispatch(1 << 20, gpu::FillParams{}); // writes nothing
                    }
                }));
        }
        EXPECT_EQ(waitCount(), 0U);
    }
    EXPECT_EQ(waitCount(), 3U);
    EXPECT_TRUE(test::liveObjects().empty());
    for (vk::Submission& submission : submissions)
    {
        EXPECT_TRUE(submission.done());
        EXPECT_EQ(submission.wait().size(), device().device().report().timestamp_period_ns != 0 ? 20U : 0U);
    }
}

TEST(Submission, RecordingThatThrowsLeavesNothingInFlight)
{
    vk::HeadlessDevice shimmed(shimmedOptions(2), testKernels());
    Frame first(shimmed);
    Frame second(shimmed);
    Frame third(shimmed);
    first.submission = submitFrame(shimmed, first, 3);
    test::failCall(UINT64_MAX);
    for (int i = 0; i < 5; ++i)
    {
        EXPECT_THROW((void)shimmed.submit(
                         [&](vk::FrameGraph& graph)
                         {
                             iota(graph, second.values);
                             throw Error(ErrorCode::Input, "while recording");
                         }),
                     Error);
    }
    second.submission = submitFrame(shimmed, second, 5);
    EXPECT_EQ(waitCount(), 0U) << "the second of two";
    third.submission = submitFrame(shimmed, third, 7);
    EXPECT_EQ(waitCount(), 1U);
    first.submission.wait();
    second.submission.wait();
    third.submission.wait();
    EXPECT_EQ(first.result(), multiples(3));
    EXPECT_EQ(second.result(), multiples(5));
    EXPECT_EQ(third.result(), multiples(7));
}

// The error's code, or nothing if call does not throw.
template <typename Call> std::optional<ErrorCode> errorOf(const Call& call)
{
    try
    {
        call();
    }
    catch (const Error& error)
    {
        return error.code();
    }
    return std::nullopt;
}

TEST(Submission, OfALostDeviceAllThatAreInFlightSaySo)
{
    {
        vk::HeadlessDevice shimmed(shimmedOptions(2), testKernels());
        std::deque<Frame> frames;
        for (int i = 0; i < 3; ++i)
        {
            frames.emplace_back(shimmed);
        }
        frames[0].submission = submitFrame(shimmed, frames[0], 3);
        frames[1].submission = submitFrame(shimmed, frames[1], 5);
        test::failAllFrom(0, VK_ERROR_DEVICE_LOST);
        EXPECT_TRUE(frames[0].submission.done()) << "nobody has to wait for it";
        EXPECT_EQ(errorOf([&] { frames[2].submission = submitFrame(shimmed, frames[2], 7); }), ErrorCode::Other);
        EXPECT_EQ(errorOf([&] { frames[0].submission.wait(); }), ErrorCode::Other);
        EXPECT_EQ(errorOf([&] { frames[0].submission.wait(); }), ErrorCode::Other) << "as often as it is asked";
        EXPECT_EQ(errorOf([&] { frames[1].submission.wait(); }), ErrorCode::Other);
        EXPECT_EQ(errorOf([&] { frames[2].submission.wait(); }), std::nullopt) << "it was never submitted";
        try
        {
            frames[0].submission.wait();
        }
        catch (const Error& error)
        {
            EXPECT_NE(std::string(error.what()).find("VK_ERROR_DEVICE_LOST"), std::string::npos) << error.what();
        }
    }
    test::failCall(UINT64_MAX);
    EXPECT_TRUE(test::liveObjects().empty()) << test::liveObjects().front();
}

TEST(Submission, AFailureIsToldByTheOneThatFailed)
{
    vk::HeadlessDevice shimmed(shimmedOptions(1), testKernels());
    Frame first(shimmed);
    Frame second(shimmed);
    submitFrame(shimmed, first, 3).wait();
    first.submission = submitFrame(shimmed, first, 5);
    test::failCall(0, VK_ERROR_OUT_OF_HOST_MEMORY); // the wait for the first one fails
    second.submission = submitFrame(shimmed, second, 7);
    EXPECT_EQ(test::failedFunction(), "vkWaitForFences");
    second.submission.wait();
    EXPECT_EQ(second.result(), multiples(7));
    EXPECT_EQ(errorOf([&] { first.submission.wait(); }), ErrorCode::Memory);
}

TEST(Submission, EveryCallThatFailsIsAnErrorAndLeavesADeviceThatGoesOn)
{
    {
        vk::HeadlessDevice shimmed(shimmedOptions(2), testKernels());
        // Returns whether the three frames were made. If so, they must be right.
        const auto work = [&]
        {
            std::deque<Frame> frames;
            for (gpu::uint i = 0; i < 3; ++i)
            {
                frames.emplace_back(shimmed);
                frames.back().submission = submitFrame(shimmed, frames.back(), i + 3);
            }
            for (gpu::uint i = 0; i < 3; ++i)
            {
                frames[i].submission.wait();
                EXPECT_EQ(frames[i].result(), multiples(i + 3)) << "in spite of " << test::failedFunction();
            }
        };
        work(); // makes kernels and flights
        test::failCall(UINT64_MAX);
        work();
        const std::uint64_t call_count = test::fallibleCallCount();
        ASSERT_GT(call_count, 3U * 5U);
        std::uint64_t error_count = 0;
        for (std::uint64_t number = 0; number < call_count; ++number)
        {
            for (const VkResult result : {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_DEVICE_LOST})
            {
                test::failCall(number, result);
                const std::optional<ErrorCode> code = errorOf(work);
                const std::string function = test::failedFunction();
                if (code)
                {
                    EXPECT_EQ(*code, result == VK_ERROR_DEVICE_LOST ? ErrorCode::Other : ErrorCode::Memory) << function;
                    ++error_count;
                }
                else
                {
                    EXPECT_TRUE(function == "vkSetDebugUtilsObjectNameEXT" || function == "vkAllocateMemory")
                        << function;
                }
                test::failCall(UINT64_MAX);
                work();
            }
        }
        EXPECT_GT(error_count, 3U * 5U);
    }
    EXPECT_TRUE(test::liveObjects().empty()) << test::liveObjects().front();
}

TEST(Submission, EveryCallOfANewDeviceThatFailsLeavesNothing)
{
    const auto work = []
    {
        vk::HeadlessDevice shimmed(shimmedOptions(2), testKernels());
        Frame first(shimmed);
        Frame second(shimmed);
        first.submission = submitFrame(shimmed, first, 3);
        second.submission = submitFrame(shimmed, second, 5);
        first.submission.wait();
        EXPECT_EQ(first.result(), multiples(3));
    };
    test::failCall(UINT64_MAX);
    work();
    const std::uint64_t call_count = test::fallibleCallCount();
    for (std::uint64_t number = 0; number < call_count; ++number)
    {
        test::failAllFrom(number, VK_ERROR_DEVICE_LOST);
        EXPECT_TRUE(errorOf(work).has_value() || number + 6 > call_count) << number;
        ASSERT_TRUE(test::liveObjects().empty()) << test::liveObjects().front() << " after call " << number;
    }
    test::failCall(UINT64_MAX);
}

TEST(Submission, WaitsForSemaphoresAndSignalsThem)
{
    vk::HeadlessDevice own(test::deviceOptions(), testKernels());
    const vk::Device& d = own.device();
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    ASSERT_EQ(d.fn().vkCreateSemaphore(d.handle(), &info, nullptr, &semaphore), VK_SUCCESS);
    {
        Frame first(own);
        Frame second(own);
        // The validation layers would report waits for a binary semaphore without a signal, and double signals.
        for (gpu::uint turn = 1; turn <= 3; ++turn)
        {
            const vk::Submission one =
                own.submit([&](vk::FrameGraph& graph) { first.record(graph, turn); }, {.signal = semaphore});
            vk::Submission two =
                own.submit([&](vk::FrameGraph& graph) { second.record(graph, 10 * turn); }, {.wait = semaphore});
            two.wait();
            EXPECT_TRUE(one.done());
            EXPECT_EQ(first.result(), multiples(turn));
            EXPECT_EQ(second.result(), multiples(10 * turn));
        }
    }
    d.fn().vkDestroySemaphore(d.handle(), semaphore, nullptr);
}

} // namespace
