// SPDX-License-Identifier: MIT
// PSNR, SSIM and FLIP against values that follow from their definitions.
#include "bench/picture_quality.h"

#include "bench/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace zvo::cli
{
namespace
{

HdrImage evenPicture(float radiance)
{
    return {8, 6, std::vector(48, glm::vec3(radiance))};
}

// The sRGB code in [0, 1] of radiance that the exposure makes `grey` (apps/bench/picture_quality.cpp).
double codeOf(double grey)
{
    const double x = 0.6 * grey;
    const double mapped = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    return 1.055 * std::pow(mapped, 1 / 2.4) - 0.055;
}

TEST(PictureQuality, OfEqualPictures)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> radiance(0.0F, 4.0F);
    HdrImage picture = evenPicture(0.0F);
    for (glm::vec3& texel : picture.texels)
    {
        texel = {radiance(random), radiance(random), radiance(random)};
    }
    const PictureQuality quality = compareTo(picture, picture);
    EXPECT_GE(quality.psnr_db, 119.0);
    EXPECT_NEAR(quality.ssim, 1.0, 1e-9);
    EXPECT_EQ(quality.flip, 0.0);
}

// Even pictures have no variance: SSIM is what the means give, at borders, too.
TEST(PictureQuality, OfEvenPictures)
{
    const PictureQuality quality = compareTo(evenPicture(3.0F), evenPicture(6.0F));
    const double a = codeOf(0.2); // the reference becomes middle grey
    const double b = codeOf(0.4);
    EXPECT_NEAR(quality.psnr_db, -20 * std::log10(b - a), 1e-3);
    EXPECT_NEAR(quality.ssim, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-6);
    const std::vector<glm::dvec3> codes_a(48, glm::dvec3(a));
    const std::vector<glm::dvec3> codes_b(48, glm::dvec3(b));
    EXPECT_NEAR(quality.flip, flipOf(codes_a, codes_b, 8, 6).front(), 1e-4) << "of what is shown";
}

// Noise of the same mean lowers the structural similarity, more of it by more.
TEST(PictureQuality, FallsWithNoise)
{
    HdrImage reference = evenPicture(1.0F);
    HdrImage little = reference;
    HdrImage much = reference;
    for (std::size_t i = 0; i < reference.texels.size(); ++i)
    {
        const float side = i % 2 == 0 ? 1.0F : -1.0F;
        reference.texels[i] = glm::vec3(1.0F + 0.2F * static_cast<float>(i % 3));
        little.texels[i] = reference.texels[i] + 0.1F * side;
        much.texels[i] = reference.texels[i] + 0.4F * side;
    }
    const PictureQuality of_little = compareTo(reference, little);
    const PictureQuality of_much = compareTo(reference, much);
    EXPECT_GT(of_little.psnr_db, of_much.psnr_db + 6);
    EXPECT_GT(of_little.ssim, of_much.ssim);
    EXPECT_LT(of_little.flip, of_much.flip);
    EXPECT_LT(of_little.ssim, 0.999);
}

} // namespace
} // namespace zvo::cli
