// SPDX-License-Identifier: MIT
// The radiance cache: pictures against those of path tracing, bytes, bricks, budgets and tables.
#include "core/radiance/device_radiance_cache.h"

#include "core/scene/camera.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/radiance_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace zvo
{
namespace
{

using test::constantSky;
using test::device;
using test::FaceLight;
using test::FaceName;
using test::facesOf;
using test::LitVoxel;
using test::PathPicture;
using test::pictureOf;
using test::runFrames;
using test::settledPicture;
using test::whiteVoxel;

LitVoxel grey()
{
    return {{}, glm::uvec3(188), glm::vec3(0.0F)};
}

LitVoxel lamp()
{
    return {{}, glm::uvec3(0), glm::vec3(1.5F, 1.0F, 0.5F)};
}

// The faces, and the bricks of each level.
std::vector<std::map<FaceName, FaceLight>> levelsOf(DeviceRadianceCache& cache)
{
    std::vector<std::map<FaceName, FaceLight>> levels;
    for (std::uint32_t level = 0; level <= gpu::kBrickLevels; ++level)
    {
        levels.push_back(facesOf(cache, level));
    }
    return levels;
}

// A hall with a lamp and walls of two colours, from inside.
struct Hall
{
    Hall()
    {
        std::vector<LitVoxel> voxels = test::roomOf(grey(), 32);
        for (LitVoxel& voxel : voxels)
        {
            voxel.color = voxel.cell.x == 0 ? glm::uvec3(200, 60, 60) : voxel.color;
        }
        std::erase_if(voxels,
                      [](const LitVoxel& v) {
                          return v.cell.y == 31 &&
                                 glm::all(glm::lessThan(glm::abs(glm::ivec2(v.cell.x, v.cell.z) - 16), glm::ivec2(4)));
                      });
        test::addBox(voxels, {13, 31, 13}, {20, 32, 20}, lamp());
        test::addBox(voxels, {6, 1, 8}, {14, 16, 16}, grey());
        tree = test::litTree(device(), voxels, 5);
    }

    DeviceTree tree;
    DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
    ViewCamera view = ViewCamera::lookAt({27.0, 20.0, 27.0}, {10.0, 8.0, 10.0}, 1.1);
};

// Mean of the pixels' relative errors, of luminance.
double relativeError(const PathPicture& picture, const PathPicture& truth)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    {
        const double expected = test::luminanceOf(truth.pixels[i]);
        sum += std::abs(test::luminanceOf(picture.pixels[i]) - expected) / std::max(expected, 0.001);
    }
    return sum / static_cast<double>(truth.pixels.size());
}

TEST(RadiancePictures, AreThoseOfPathTracing)
{
    Hall hall;
    const PathPicture truth = pictureOf(hall.tree, hall.dark, hall.view, 40, 512, {.bounces = 10});
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, hall.tree, hall.dark, hall.view, 40, 256, 64);
    EXPECT_NEAR(picture.luminance, truth.luminance, 0.01 * truth.luminance);
    EXPECT_LT(relativeError(picture, truth), 0.02);
}

// A floor under a black plate, which hides half of the sky: samples of a face are bright or dark. After few frames,
// when faces have a few of them, the light of bricks keeps the noise down.
TEST(RadiancePictures, AreSmoothAfterFewFrames)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {32, 1, 32}, whiteVoxel());
    test::addBox(voxels, {8, 14, 8}, {24, 15, 24}, {{}, glm::uvec3(0), glm::vec3(0.0F)});
    const DeviceTree tree = test::litTree(device(), voxels, 5);
    DeviceEnvironment sky = constantSky(glm::vec3(1.0F));
    const ViewCamera view = ViewCamera::lookAt({16.0, 9.0, 50.0}, {16.0, 1.0, 14.0}, 0.6);
    const PathPicture truth = pictureOf(tree, sky, view, 40, 512, {.bounces = 10});
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, tree, sky, view, 40, 5, 1, {.faces = 600});
    EXPECT_LT(relativeError(picture, truth), 0.04);
}

// Light that many bounces bring is there after few frames, in which most faces have had no sample yet.
TEST(RadiancePictures, AreNotDarkAtFirst)
{
    Hall hall;
    const PathPicture truth = pictureOf(hall.tree, hall.dark, hall.view, 40, 512, {.bounces = 10});
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, hall.tree, hall.dark, hall.view, 40, 4, 4, {.faces = 400});
    EXPECT_NEAR(picture.luminance, truth.luminance, 0.2 * truth.luminance);
}

// What the camera sees for the first time has the light of the bricks around it, though a frame samples one face only.
TEST(RadiancePictures, ShowNewFacesLit)
{
    Hall hall;
    FrameRenderer tracer(device().device());
    tracer.resize(40, 40);
    runFrames(tracer, hall.tree, hall.dark, hall.view, 64, {.faces = 400});
    const ViewCamera near_wall = ViewCamera::lookAt({20.0, 10.0, 20.0}, {31.0, 8.0, 12.0}, 0.9);
    const PathPicture truth = pictureOf(hall.tree, hall.dark, near_wall, 40, 256, {.bounces = 10});
    tracer.beginPicture(test::cachedOptions());
    runFrames(tracer, hall.tree, hall.dark, near_wall, 1, {.faces = 1});
    const PathPicture picture = pictureOf(tracer);
    EXPECT_LT(relativeError(picture, truth), 0.25);
}

// Cones are further from path tracing than the faces that keep the light which they show, but near.
TEST(RadiancePictures, ByConesAreNearThoseOfPathTracing)
{
    Hall hall;
    const PathPicture truth = pictureOf(hall.tree, hall.dark, hall.view, 40, 512, {.bounces = 10});
    std::array<double, 2> errors{};
    for (const CacheView kind : {CacheView::Faces, CacheView::Cones})
    {
        FrameRenderer tracer(device().device());
        const PathPicture picture = settledPicture(tracer, hall.tree, hall.dark, hall.view, 40, 128, 64, {}, kind);
        errors[static_cast<std::size_t>(kind)] = relativeError(picture, truth);
        EXPECT_NEAR(picture.luminance, truth.luminance, 0.06 * truth.luminance);
    }
    EXPECT_LT(errors[1], 0.35);
    EXPECT_LT(errors[0], 0.1 * errors[1]);
}

// Nothing that cones show is their own floor's, or counted twice: a glowing room has the light of all bounces. Some of
// it is lost through walls of one voxel.
TEST(RadiancePictures, ByConesHaveTheLightOfAllBounces)
{
    LitVoxel wall = grey();
    wall.emission = glm::vec3(0.5F);
    const double expected = 0.5 / (1.0 - test::albedoOf(wall).r);
    for (const std::uint32_t thickness : {1U, 4U})
    {
        const DeviceTree tree = test::litTree(device(), test::roomOf(wall, 32, thickness), 5);
        DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
        const ViewCamera inside = ViewCamera::lookAt({16.2, 16.1, 16.3}, {1.0, 2.0, 3.0}, 1.0);
        FrameRenderer tracer(device().device());
        const PathPicture picture = settledPicture(tracer, tree, dark, inside, 40, 128, 16, {}, CacheView::Cones);
        EXPECT_NEAR(picture.luminance, expected, (thickness == 1 ? 0.05 : 0.01) * expected);
    }
}

// The light is a mean over frames: it does not depend on the order of threads.
TEST(RadianceBytes, AreTheSameInEveryRun)
{
    Hall hall;
    std::vector<std::vector<std::map<FaceName, FaceLight>>> runs; // by level
    for (std::uint32_t run = 0; run < 2; ++run)
    {
        FrameRenderer tracer(device().device());
        tracer.resize(48, 40);
        // Tables of other sizes have their faces elsewhere. One grows.
        tracer.cache().setRoom(run == 0 ? 0 : 45678, UINT64_MAX);
        runFrames(tracer, hall.tree, hall.dark, hall.view, 1, {.faces = 500});
        const std::uint64_t room = tracer.cache().room();
        runFrames(tracer, hall.tree, hall.dark, hall.view, 23, {.faces = 500});
        EXPECT_EQ(tracer.cache().room() > room, run == 0) << room << " became " << tracer.cache().room();
        const RadianceCounts counts = tracer.cache().counts();
        EXPECT_EQ(counts.refused, 0U);
        EXPECT_GE(tracer.cache().room(), counts.faces + counts.bricks);
        if (run == 0)
        {
            EXPECT_LT(tracer.cache().room(), 4 * (counts.faces + counts.bricks)) << "memory is for what rays hit";
        }
        runs.push_back(levelsOf(tracer.cache()));
    }
    ASSERT_GT(runs[0][0].size(), 500U);
    for (std::uint32_t level = 0; level <= gpu::kBrickLevels; ++level)
    {
        ASSERT_EQ(runs[0][level].size(), runs[1][level].size());
        for (const auto& [name, face] : runs[0][level])
        {
            EXPECT_EQ(runs[1][level].at(name).words, face.words) << "level " << level;
        }
    }
}

// The brick of a level around a face, or around a brick of the level below.
FaceName around(const FaceName& name)
{
    return {name.cell / 4U, name.normal};
}

// After the first frame each face has one sample at most, and no brick has had any light to share. So the bricks of
// level 1 keep the mean of the samples in them, and those of the next levels that of the bricks in them.
TEST(RadianceBricks, KeepMeansOfWhatIsInThem)
{
    Hall hall;
    FrameRenderer tracer(device().device());
    tracer.resize(64, 64);
    runFrames(tracer, hall.tree, hall.dark, hall.view, 1, {.faces = 300});
    for (std::uint32_t level = 0; level < gpu::kBrickLevels; ++level)
    {
        struct Sum
        {
            glm::dvec3 light{0.0};
            std::uint32_t count = 0;
        };
        std::map<FaceName, Sum> sums;
        for (const auto& [name, face] : facesOf(tracer.cache(), level))
        {
            if (face.samples != 0)
            {
                Sum& sum = sums[around(name)];
                sum.light += face.radiance;
                ++sum.count;
            }
        }
        const auto bricks = facesOf(tracer.cache(), level + 1);
        ASSERT_EQ(bricks.size(), sums.size());
        bool has_several = false;
        for (const auto& [name, brick] : bricks)
        {
            const Sum& sum = sums.at(name);
            EXPECT_EQ(brick.samples, sum.count);
            has_several = has_several || sum.count > 2;
            for (int channel = 0; channel < 3; ++channel)
            {
                // Steps of the sums and of what is kept, rounded at random.
                EXPECT_NEAR(brick.radiance[channel], sum.light[channel] / sum.count, 1e-4 + 1e-4 * sum.light[channel]);
            }
        }
        EXPECT_TRUE(has_several || level > 0);
    }
}

// A wall stands in a brick, with a lamp on one side: no light comes through on the floor, and it is bright right beside
// the wall.
TEST(RadianceBricks, ShareNoLightThroughWalls)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {16, 1, 16}, whiteVoxel());
    test::addBox(voxels, {6, 1, 0}, {7, 8, 16}, whiteVoxel());
    test::addBox(voxels, {2, 7, 7}, {4, 8, 9}, lamp());
    const DeviceTree tree = test::litTree(device(), voxels, 4);
    DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
    FrameRenderer tracer(device().device());
    tracer.resize(64, 64);
    runFrames(tracer, tree, dark, ViewCamera::lookAt({9.0, 40.0, 9.0}, {8.0, 0.0, 8.0}, 0.5), 64, {});
    std::uint32_t dark_faces = 0;
    std::uint32_t lit_faces = 0;
    for (const auto& [name, face] : facesOf(tracer.cache()))
    {
        if (name.cell.y == 0 && name.cell.x > 6)
        {
            EXPECT_EQ(face.radiance, glm::dvec3(0.0)) << name.cell.x << ' ' << name.cell.z;
            ++dark_faces;
        }
        if (name.cell.y == 0 && name.cell.x == 5 && name.cell.z > 4 && name.cell.z < 12)
        {
            EXPECT_GT(face.radiance.r, 0.01);
            ++lit_faces;
        }
    }
    EXPECT_GT(dark_faces, 100U);
    EXPECT_GT(lit_faces, 4U);
    // Bricks are not walls.
    EXPECT_GT(facesOf(tracer.cache(), 1).at({{1, 0, 2}, 1}).radiance.r, 0.0);
}

// A frame takes as many faces as it may, or all, and each gets its turn.
TEST(RadianceBudget, BoundsTheFacesOfAFrame)
{
    Hall hall;
    for (const std::uint32_t budget : {1U, 100U, 700U, 100000U})
    {
        FrameRenderer tracer(device().device());
        tracer.resize(32, 32);
        std::uint64_t samples_before = 0;
        for (std::uint32_t frame = 0; frame < 8; ++frame)
        {
            runFrames(tracer, hall.tree, hall.dark, hall.view, 1, {.faces = budget});
            std::uint64_t samples = 0;
            for (const auto& [name, face] : facesOf(tracer.cache()))
            {
                samples += face.samples;
            }
            const std::uint64_t taken = samples - samples_before;
            samples_before = samples;
            EXPECT_LE(taken, budget);
            if (budget == 100)
            {
                EXPECT_GE(taken, 85U) << "in frame " << frame;
            }
            if (budget == 100000)
            {
                EXPECT_GT(taken, 200U);
            }
        }
    }
}

// Each pixel sees a face of its own on a wall from which no ray hits anything. As many pixels of each 2x2 list theirs
// as the budget has room for, and all have done so as soon as can be.
TEST(RadianceBudget, GivesEachPixelATurn)
{
    constexpr std::uint32_t kEdge = 32;
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {kEdge, kEdge, 1}, grey());
    const DeviceTree tree = test::litTree(device(), voxels, 5);
    DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
    const double distance = 48.0;
    const double middle = 0.5 * kEdge;
    const ViewCamera view =
        ViewCamera::lookAt({middle, middle, 1.0 + distance}, {middle, middle, 0.0}, 2.0 * std::atan(middle / distance));
    for (const std::uint32_t pixels_of_four : {1U, 2U, 4U})
    {
        FrameRenderer tracer(device().device());
        tracer.resize(kEdge, kEdge);
        for (std::uint32_t pixels = pixels_of_four; pixels <= 4; pixels += pixels_of_four)
        {
            runFrames(tracer, tree, dark, view, 1, {.faces = pixels_of_four * kEdge * kEdge / 4});
            EXPECT_EQ(facesOf(tracer.cache()).size(), pixels * kEdge * kEdge / 4) << pixels_of_four;
        }
    }
}

TEST(RadianceBudget, GivesEachFaceATurn)
{
    Hall hall;
    FrameRenderer tracer(device().device());
    tracer.resize(64, 64);
    runFrames(tracer, hall.tree, hall.dark, hall.view, 160, {.faces = 400});
    std::uint64_t without = 0;
    std::uint64_t sampled = 0;
    for (const auto& [name, face] : facesOf(tracer.cache()))
    {
        ++(face.samples == 0 ? without : sampled);
    }
    EXPECT_GT(sampled, 1000U);
    // Faces that a ray has just met may wait.
    EXPECT_LT(without, 20U);
}

// Another size of the picture, or another budget, leaves the light as it is.
TEST(RadianceTable, KeepsItsLightInPicturesOfOtherSizes)
{
    Hall hall;
    FrameRenderer tracer(device().device());
    tracer.resize(64, 64);
    runFrames(tracer, hall.tree, hall.dark, hall.view, 40, {});
    const auto before = facesOf(tracer.cache());
    const auto levels_before = levelsOf(tracer.cache());
    tracer.resize(40, 30);
    runFrames(tracer, hall.tree, hall.dark, hall.view, 1, {.faces = 1});
    const auto levels_after = levelsOf(tracer.cache());
    for (std::uint32_t level = 0; level <= gpu::kBrickLevels; ++level)
    {
        ASSERT_GE(levels_after[level].size(), levels_before[level].size());
        ASSERT_FALSE(levels_before[level].empty());
        std::size_t others = 0;
        for (const auto& [name, face] : levels_before[level])
        {
            others += levels_after[level].at(name).words == face.words ? 0 : 1;
        }
        EXPECT_LE(others, 1U) << "level " << level;
    }
    // All are listed again.
    runFrames(tracer, hall.tree, hall.dark, hall.view, 8, {});
    std::size_t sampled = 0;
    for (const auto& [name, face] : facesOf(tracer.cache()))
    {
        sampled += before.contains(name) && face.samples > before.at(name).samples ? 1 : 0;
    }
    EXPECT_GT(sampled, before.size() / 10);
}

// Without room for all faces, those that found none are counted, and the picture is darker but stands.
TEST(RadianceTable, CountsFacesWithoutAPlace)
{
    Hall hall;
    FrameRenderer tracer(device().device());
    tracer.resize(64, 64);
    tracer.cache().setRoom(0, 100);
    runFrames(tracer, hall.tree, hall.dark, hall.view, 8, {});
    const gpu::RadianceCounters counters = device().download(tracer.cache().counters()).front();
    EXPECT_GT(counters.refused, 0U);
    EXPECT_EQ(counters.face_count, facesOf(tracer.cache()).size());
    EXPECT_LE(counters.face_count, 152U);
    EXPECT_TRUE(tracer.cache().isCrowded());
}

// Where the table must not grow, faces that no ray hits any more make room for those that the camera sees.
TEST(RadianceTable, KeepsWhatIsSeenWhereThereIsLittleRoom)
{
    Hall hall;
    FrameRenderer tracer(device().device());
    tracer.resize(64, 64);
    tracer.cache().setRoom(0, 3000);
    const RadianceOptions few = {.faces = 64}; // most faces are hit by the camera's rays alone
    runFrames(tracer, hall.tree, hall.dark, hall.view, 100, few);
    EXPECT_TRUE(tracer.cache().isCrowded());
    const auto before = facesOf(tracer.cache());
    const ViewCamera near_wall = ViewCamera::lookAt({20.0, 10.0, 20.0}, {31.0, 8.0, 12.0}, 0.9);
    runFrames(tracer, hall.tree, hall.dark, near_wall, 400, few);
    const std::uint64_t refused = tracer.cache().counts().refused;
    runFrames(tracer, hall.tree, hall.dark, near_wall, 100, few);
    const auto after = facesOf(tracer.cache());
    const auto left = std::ranges::count_if(before, [&](const auto& face) { return !after.contains(face.first); });
    EXPECT_GT(left, 500);
    EXPECT_EQ(tracer.cache().counts().faces, after.size());
    EXPECT_EQ(tracer.cache().counts().refused, refused);
}

} // namespace
} // namespace zvo
