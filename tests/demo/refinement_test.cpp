// SPDX-License-Identifier: MIT
#include "demo/world/refinement.h"
#include "demo/world/resolution_ladder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <set>

namespace zvo::test
{
namespace
{

using demo::PictureState;
using demo::Refinement;
using demo::ResolutionLadder;
using demo::scaledSize;

TEST(Refinement, BeginsOnceNothingHasChangedForAWhile)
{
    Refinement refinement;
    PictureState state;
    refinement.show(state, false, 10.0);
    EXPECT_FALSE(refinement.isStill()) << "the first picture is another one than none";
    refinement.show(state, false, 0.2);
    EXPECT_FALSE(refinement.isStill());
    refinement.noteInput(false);
    refinement.show(state, false, 0.2);
    EXPECT_FALSE(refinement.isStill()) << "the user has done something";
    refinement.show(state, false, 0.2);
    EXPECT_TRUE(refinement.isStill());
    refinement.noteInput(false);
    EXPECT_TRUE(refinement.isStill()) << "a still picture ends with another picture, not with any input";
    refinement.noteInput(true);
    EXPECT_FALSE(refinement.isStill());
    refinement.show(state, false, 1.0);
    EXPECT_TRUE(refinement.isStill());
    refinement.show(state, true, 1.0);
    EXPECT_FALSE(refinement.isStill());
    refinement.show(state, false, 1.0);
    refinement.refuse();
    EXPECT_FALSE(refinement.isStill());
    refinement.show(state, false, 1.0);
    EXPECT_FALSE(refinement.isStill()) << "there was no memory for it";
    state.camera.position.x += 1.0;
    EXPECT_TRUE(refinement.differs(state));
    refinement.show(state, false, 1.0);
    refinement.show(state, false, 1.0);
    EXPECT_TRUE(refinement.isStill());
}

TEST(Refinement, ShowsPathsOnceTheyAreNoNoisierThanBefore)
{
    EXPECT_EQ(Refinement::samplesLike(0, 0.25), 1U);
    EXPECT_EQ(Refinement::samplesLike(100, 0.25), 7U);
    EXPECT_EQ(Refinement::samplesLike(100, 1.0), 100U);
}

TEST(Refinement, ViewsWithoutLightHaveOneSample)
{
    FrameOptions options;
    EXPECT_EQ(Refinement::samplesOf(options), 1U);
    options.antialias = true;
    EXPECT_EQ(Refinement::samplesOf(options), Refinement::kPrimarySamples);
    options.trace.view = View::Normal;
    options.integrator = Integrator::Path;
    EXPECT_EQ(Refinement::samplesOf(options), 1U);
}

// What no lower resolution makes shorter does not lower it.
TEST(ResolutionLadder, GoesDownWhereFramesTakeTooLongAndNoFurtherThanTheLastStep)
{
    ResolutionLadder ladder(0);
    EXPECT_EQ(ladder.scale(), 1.0);
    ladder.add(200);
    EXPECT_EQ(ladder.scale(), 1.0) << "one long frame is an accident";
    ladder.add(10);
    ladder.add(200);
    EXPECT_EQ(ladder.scale(), 1.0);
    ladder.add(200);
    EXPECT_EQ(ladder.scale(), 0.75);
    for (int i = 0; i < 100; ++i)
    {
        ladder.add(200);
    }
    EXPECT_EQ(ladder.scale(), ResolutionLadder::kScales.back());
}

TEST(ResolutionLadder, GoesUpWhereTheNextStepFitsAndStaysThere)
{
    // On this device a frame takes 300 ms at the window's size, and time grows with the pixels.
    const auto timeAt = [](double scale) { return 300 * scale * scale; };
    for (const std::size_t first : {std::size_t{0}, ResolutionLadder::kScales.size() - 1})
    {
        ResolutionLadder ladder(first);
        std::set<double> late;
        for (int i = 0; i < 1000; ++i)
        {
            ladder.add(timeAt(ladder.scale()));
            if (i >= 200)
            {
                late.insert(ladder.scale());
            }
        }
        EXPECT_EQ(late.size(), 1U) << "it does not go up and down";
        EXPECT_LE(timeAt(*late.begin()), ResolutionLadder::kTooLongMs);
        EXPECT_GE(*late.begin(), 0.375);
    }
}

TEST(ResolutionLadder, SizesHaveAPixelAtLeast)
{
    EXPECT_EQ(scaledSize({1280, 720}, 0.5), (PictureSize{640, 360}));
    EXPECT_EQ(scaledSize({1281, 3}, 0.125), (PictureSize{160, 1}));
    EXPECT_EQ(scaledSize({1, 1}, 0.125), (PictureSize{1, 1}));
    EXPECT_EQ(scaledSize({7, 9}, 1.0), (PictureSize{7, 9}));
}

TEST(ResolutionLadder, IsToldOfPassesThatScale)
{
    const std::array<vk::PassTime, 6> passes = {{{"radiance/update", 53},
                                                 {"voxelize/bin", 106},
                                                 {"trace/node_paths", 5},
                                                 {"trace/primary", 20},
                                                 {"radiance/view", 10},
                                                 {"present/scale", 8}}};
    EXPECT_DOUBLE_EQ(demo::scalingMs(passes), 30.0);
}

} // namespace
} // namespace zvo::test
