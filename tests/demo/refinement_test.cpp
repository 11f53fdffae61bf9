// SPDX-License-Identifier: MIT
#include "demo/world/refinement.h"
#include "demo/world/resolution_ladder.h"

#include <gtest/gtest.h>

#include <array>

namespace zvo::test
{
namespace
{

using demo::PictureState;
using demo::Refinement;

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
TEST(ResolutionLadder, IsToldOfPassesThatScale)
{
    const std::array<vk::PassTime, 6> passes = {{{"radiance/update", 53},
                                                 {"voxelize/triangles", 106},
                                                 {"trace/node_paths", 5},
                                                 {"trace/primary", 20},
                                                 {"radiance/view", 10},
                                                 {"present/scale", 8}}};
    EXPECT_DOUBLE_EQ(demo::scalingMs(passes), 30.0);
}

} // namespace
} // namespace zvo::test
