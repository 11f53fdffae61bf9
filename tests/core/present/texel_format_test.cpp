// SPDX-License-Identifier: MIT
// The same picture in all texel formats, as exactly as each format can hold it.
#include "core/trace/trace.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/trace_octrees.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace zvo
{
namespace
{

using Words = std::vector<gpu::uint>;

constexpr std::uint32_t kTexelsWide = 83; // no multiples of a tile
constexpr std::uint32_t kTexelsHigh = 61;
constexpr View kTexelViews[] = {View::Color,      View::Albedo, View::Normal, View::Depth, View::Level,
                                View::Iterations, View::Voxel,  View::Bricks, View::Origin};
// Relative error of a half float: half a step, or a whole one on devices that round down; and some single precision.
constexpr double kHalfError = 1.0 / 1024 + 1e-5;

using test::device;

struct Shown
{
    Words image;
    std::vector<gpu::Hit> hits;
};

Shown show(const DeviceTree& octree, const ViewCamera& view, TexelFormat format, const TraceOptions& options)
{
    NodePaths paths(device().device());
    TraceBuffers buffers(device().device(), kTexelsWide, kTexelsHigh, format);
    const TraceCamera camera = traceCamera(view, octree.grid, kTexelsHigh);
    test::Picture picture = test::takePicture(device(), octree, paths, camera, buffers, options);
    return {std::move(picture.image), std::move(picture.hits)};
}

glm::dvec4 codesOf(TexelFormat format, const Words& image, std::size_t pixel)
{
    const gpu::uint word = image.at(pixel);
    const glm::dvec3 low(word & 255U, word >> 8 & 255U, word >> 16 & 255U);
    switch (format)
    {
    case TexelFormat::Rgba8:
        return glm::dvec4(low, word >> 24) / 255.0;
    case TexelFormat::Bgra8:
        return glm::dvec4(low.z, low.y, low.x, word >> 24) / 255.0;
    case TexelFormat::Rgb10:
        return glm::dvec4(glm::dvec3(word & 1023U, word >> 10 & 1023U, word >> 20 & 1023U) / 1023.0,
                          (word >> 30) / 3.0);
    case TexelFormat::Half:
        break;
    }
    ADD_FAILURE();
    return {};
}

glm::dvec4 halfsOf(const Words& image, std::size_t pixel)
{
    const glm::vec2 red_green = glm::unpackHalf2x16(image.at(2 * pixel));
    const glm::vec2 blue_alpha = glm::unpackHalf2x16(image.at(2 * pixel + 1));
    return {red_green.x, red_green.y, blue_alpha.x, blue_alpha.y};
}

double encodeSrgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// AgX with more contrast and saturation, after B. Wrensch, Minimal AgX Implementation, 2023, in double precision.
glm::dvec3 toneMap(const glm::dvec3& radiance)
{
    const glm::dmat3 inset(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992,
                           0.878468636469772, 0.0784336, 0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const glm::dmat3 outset(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368,
                            1.15190312990417, -0.0980434501171241, -0.0990297440797205, -0.0989611768448433,
                            1.15107367264116);
    glm::dvec3 look(0.0);
    const glm::dvec3 light = inset * (0.95 * radiance);
    for (int c = 0; c < 3; ++c)
    {
        const double x = (std::log2(std::clamp(light[c], 1.757e-4, 16.292)) + 12.47393) / 16.5;
        const double x2 = x * x;
        const double x4 = x2 * x2;
        const double curve =
            15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
        look[c] = std::pow(std::max(curve, 0.0), 1.2);
    }
    const double luma = 0.2126 * look.r + 0.7152 * look.g + 0.0722 * look.b;
    return glm::clamp(outset * (luma + 1.25 * (look - luma)), 0.0, 1.0);
}

// A shell with all attributes, lit from the side, and sky around it.
DeviceTree coloredSphere()
{
    DeviceTree octree = test::octreeOf(device(), test::sphereShell(6, 25.0), 6);
    test::addAttributes(device(), octree);
    return octree;
}

ViewCamera sphereView()
{
    return ViewCamera::lookAt({80.0, 60.0, 90.0}, {32.0, 32.0, 32.0}, 0.8);
}

TEST(TexelFormat, BlueFirstIsTheSamePictureWithItsBytesSwapped)
{
    const DeviceTree octree = coloredSphere();
    for (const View view : kTexelViews)
    {
        TraceOptions options;
        options.view = view;
        Words expected = show(octree, sphereView(), TexelFormat::Rgba8, options).image;
        for (gpu::uint& word : expected)
        {
            word = (word & 0xFF00FF00U) | (word & 255U) << 16 | (word >> 16 & 255U);
        }
        EXPECT_EQ(show(octree, sphereView(), TexelFormat::Bgra8, options).image, expected);
    }
}

TEST(TexelFormat, TenBitsShowWhatEightDo)
{
    const DeviceTree octree = coloredSphere();
    for (const View view : kTexelViews)
    {
        SCOPED_TRACE(static_cast<int>(view));
        TraceOptions options;
        options.view = view;
        const Words eight = show(octree, sphereView(), TexelFormat::Rgba8, options).image;
        const Words ten = show(octree, sphereView(), TexelFormat::Rgb10, options).image;
        // Rounding changes a value by half a code; dither changes lit ones by up to half a code more.
        const double codes = view == View::Color ? 1.0 : 0.5;
        std::size_t finer_count = 0;
        for (std::size_t i = 0; i < eight.size(); ++i)
        {
            const glm::dvec4 coarse = codesOf(TexelFormat::Rgba8, eight, i);
            const glm::dvec4 fine = codesOf(TexelFormat::Rgb10, ten, i);
            ASSERT_EQ(fine.w, 1.0);
            for (int c = 0; c < 3; ++c)
            {
                ASSERT_NEAR(fine[c], coarse[c], codes / 255.0 + codes / 1023.0 + 1e-6) << "pixel " << i;
                finer_count += std::abs(fine[c] - coarse[c]) > 0.25 / 255.0 ? 1 : 0;
            }
        }
        if (view == View::Color)
        {
            EXPECT_GT(finer_count, eight.size() / 10) << "no bits more than eight";
        }
    }
}

TEST(TexelFormat, HalfFloatsToneMappedAreTheCodesOfThePicture)
{
    const DeviceTree octree = coloredSphere();
    TraceOptions options;
    options.exposure = 1.7F;
    options.occlusion_rays = 3;
    const Words codes = show(octree, sphereView(), TexelFormat::Rgba8, options).image;
    const Words halfs = show(octree, sphereView(), TexelFormat::Half, options).image;
    ASSERT_EQ(halfs.size(), 2 * codes.size());
    double brightest = 0.0;
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        const glm::dvec4 code = codesOf(TexelFormat::Rgba8, codes, i);
        const glm::dvec4 half = halfsOf(halfs, i);
        ASSERT_EQ(half.w, 1.0);
        const glm::dvec3 mapped = toneMap(glm::dvec3(half));
        for (int c = 0; c < 3; ++c)
        {
            // A code is the nearest one to the value plus up to half a code of dither; that of the half's error is
            // a quarter of a code.
            ASSERT_NEAR(code[c], mapped[c], 1.25 / 255.0) << "pixel " << i;
            brightest = std::max(brightest, half[c]);
        }
    }
    EXPECT_GT(brightest, 1.5) << "not radiance but what a screen shows";
}

TEST(TexelFormat, HalfFloatsOfOtherViewsAreTheLinearValuesOfTheCodes)
{
    const DeviceTree octree = coloredSphere();
    for (const View view : kTexelViews)
    {
        if (view == View::Color)
        {
            continue;
        }
        SCOPED_TRACE(static_cast<int>(view));
        TraceOptions options;
        options.view = view;
        const Words codes = show(octree, sphereView(), TexelFormat::Rgba8, options).image;
        const Shown halfs = show(octree, sphereView(), TexelFormat::Half, options);
        std::size_t miss_count = 0;
        for (std::size_t i = 0; i < codes.size(); ++i)
        {
            const glm::dvec4 code = codesOf(TexelFormat::Rgba8, codes, i);
            const glm::dvec4 half = halfsOf(halfs.image, i);
            ASSERT_EQ(half.w, 1.0);
            for (int c = 0; c < 3; ++c)
            {
                // Rounding changes a value by half a code; steps of half floats are finer than 1 / 3 of a code
                // everywhere.
                ASSERT_NEAR(encodeSrgb(half[c]), code[c], (0.5 + 1.0 / 3.0) / 255.0) << "pixel " << i;
            }
            if (halfs.hits[i].index == gpu::kHitMiss && view != View::Iterations)
            {
                ASSERT_EQ(half, glm::dvec4(0.0, 0.0, 0.0, 1.0));
                ++miss_count;
            }
        }
        EXPECT_TRUE(miss_count > 500 || view == View::Iterations);
    }
}

// The sky of a high sun, as core/scene/sky.h and shaders/lib/sky.glsl have it.
const glm::dvec3 kSunColor(1.0, 0.93, 0.82);
const glm::dvec3 kHorizon(0.72, 0.80, 0.90);
const glm::dvec3 kZenith(0.16, 0.34, 0.70);

// Towards the side, below a sun of that height: half of what is above, and half of what is below.
glm::dvec3 skyAmbient(double sun_height)
{
    const glm::dvec3 sky = 0.5 * (kHorizon + kZenith);
    const glm::dvec3 ground = glm::dvec3(0.145, 0.138, 0.13) * (2.2 * sun_height * kSunColor + sky);
    return 0.5 * (glm::dvec3(0.40, 0.48, 0.62) + 0.57 * ground);
}

// Around the sun, by Henyey and Greenstein; at a height of 1 - away.
glm::dvec3 glow(double cosine, double away)
{
    const double haze = std::pow(0.09 / (1.49 - 1.4 * cosine), 1.5);
    return haze * glm::mix(0.2, 1.0, std::pow(away, 4.0)) * glm::dvec3(0.55, 0.52, 0.46);
}

void expectNear(const glm::dvec4& half, const glm::dvec3& expected)
{
    for (int c = 0; c < 3; ++c)
    {
        EXPECT_NEAR(half[c], expected[c], kHalfError * expected[c]);
    }
    EXPECT_EQ(half.w, 1.0);
}

// The picture shows a wall from the front, of one colour, all of it emissive.
TEST(TexelFormat, HalfFloatsAreExposedRadiance)
{
    const test::Codes codes = test::codesWhere(4, [](const glm::uvec3& voxel) { return voxel.z == 3; });
    DeviceTree octree = test::octreeOf(device(), codes, 4);
    const gpu::uint color = 200U | 100U << 8 | 50U << 16 | gpu::kAttributeEmissive << 24;
    const std::vector<gpu::Attribute> attributes(codes.size(), {color, 0U}); // normal +z
    octree.voxel_attributes = device().makeBuffer<gpu::Attribute>("attributes", attributes);
    const ViewCamera front = ViewCamera::lookAt({8, 8, 24}, {8, 8, 0}, 0.2);
    const std::size_t middle = kTexelsHigh / 2 * kTexelsWide + kTexelsWide / 2;
    TraceOptions options;
    options.to_sun = {0.0, 4.0, 3.0};
    options.sun = 5.0F;
    options.exposure = 1.7F;
    options.shadows = false;
    const auto decode = [](double code) { return std::pow((code / 255.0 + 0.055) / 1.055, 2.4); };
    const glm::dvec3 albedo(decode(200.0), decode(100.0), decode(50.0));
    const glm::dvec3 arrives = 5.0 * 0.6 * kSunColor + skyAmbient(0.8);
    expectNear(halfsOf(show(octree, front, TexelFormat::Half, options).image, middle), 1.7 * albedo * arrives);

    // Emission of (256, 128, 1) / 512 in RGB9E5, times a scale.
    std::vector<gpu::uvec2> words;
    for (std::size_t i = 0; i < (codes.size() + 31) / 32; ++i)
    {
        words.emplace_back(~0U, static_cast<gpu::uint>(32 * i));
    }
    const std::vector<gpu::uint> emission(codes.size(), 256U | 128U << 9 | 1U << 18 | 15U << 27);
    octree.emission_words = device().makeBuffer<gpu::uvec2>("emission words", words);
    octree.emission = device().makeBuffer<gpu::uint>("emission", emission);
    octree.emission_scale = 100.0F;
    const glm::dvec3 emitted(0.5, 0.25, 1.0 / 512.0);
    expectNear(halfsOf(show(octree, front, TexelFormat::Half, options).image, middle),
               1.7 * (albedo * arrives + 100.0 * emitted));

    octree.emission_scale = 1e6F;
    const glm::dvec4 clamped = halfsOf(show(octree, front, TexelFormat::Half, options).image, middle);
    EXPECT_EQ(clamped.x, 65504.0);
    EXPECT_EQ(clamped.y, 65504.0);
    EXPECT_NEAR(clamped.z, 1.7e6 / 512.0, 1e6 * kHalfError);
}

TEST(TexelFormat, HalfFloatsOfTheSkyAreExposedRadiance)
{
    const DeviceTree octree = test::octreeOf(device(), {}, 4);
    // Sizes are odd: this ray goes straight forward.
    const std::size_t middle = kTexelsHigh / 2 * kTexelsWide + kTexelsWide / 2;
    TraceOptions options;
    options.exposure = 0.5F;
    options.to_sun = {-0.6, 0.8, 0.0};
    const auto towards = [&](const glm::dvec3& direction)
    {
        const ViewCamera view = ViewCamera::lookAt(glm::dvec3(0.0), direction, 0.9);
        return halfsOf(show(octree, view, TexelFormat::Half, options).image, middle);
    };
    const glm::dvec3 sky = glm::mix(kZenith, kHorizon, 0.2 * 0.2); // at 0.8 up
    expectNear(towards({0.0, 0.8, 0.6}), 0.5 * (sky + glow(0.64, 0.2)));
    options.to_sun = {0.0, 0.8, 0.6}; // the middle of the sun's disc
    options.sun = 30.0F;
    expectNear(towards({0.0, 0.8, 0.6}), 0.5 * (sky + glow(1.0, 0.2) + 4.0 * 30.0 * kSunColor));
}

TEST(TexelFormat, ViewsWithoutSkyOfAnEmptyOctreeAreBlackInEveryFormat)
{
    const DeviceTree octree = test::octreeOf(device(), {}, 5);
    const std::size_t pixels = std::size_t{kTexelsWide} * kTexelsHigh;
    for (const View view : kTexelViews)
    {
        TraceOptions options;
        options.view = view;
        if (view != View::Color)
        {
            EXPECT_EQ(show(octree, sphereView(), TexelFormat::Rgba8, options).image, Words(pixels, 255U << 24));
            EXPECT_EQ(show(octree, sphereView(), TexelFormat::Bgra8, options).image, Words(pixels, 255U << 24));
            EXPECT_EQ(show(octree, sphereView(), TexelFormat::Rgb10, options).image, Words(pixels, 3U << 30));
            const Words halfs = show(octree, sphereView(), TexelFormat::Half, options).image;
            for (std::size_t i = 0; i < pixels; ++i)
            {
                ASSERT_EQ(halfs.at(2 * i), 0U);
                ASSERT_EQ(halfs.at(2 * i + 1), 0x3C000000U);
            }
        }
    }
}

} // namespace
} // namespace zvo
