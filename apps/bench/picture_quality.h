// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/hdr_image.h"

#include <span>
#include <vector>

namespace zvo::cli
{

/// How close a picture is to another one of the same size.
struct PictureQuality
{
    double psnr_db = 0;  // of the sRGB codes
    double ssim = 0;     // of their luma, mean over the picture
    double flip = 0;     // FLIP of them (bench/flip.h), mean over the picture
    double relative = 0; // mean of relativeErrors()
};

/// Compares what is seen of pictures of linear radiance: both are tone-mapped, with the exposure that the reference
/// gets. SSIM is that of Z. Wang et al., Image Quality Assessment: From Error Visibility to Structural Similarity,
/// 2004: a Gaussian window of 11x11 pixels with a standard deviation of 1.5.
PictureQuality compareTo(const HdrImage& reference, const HdrImage& picture);

/// The error of each pixel's linear luminance over the reference's, plus a hundredth of its mean.
std::vector<double> relativeErrors(const HdrImage& reference, const HdrImage& picture);

/// The linear luminance of each pixel.
std::vector<double> luminancesOf(const HdrImage& picture);

/// The mean, 0 of nothing.
double meanOf(std::span<const double> values);

} // namespace zvo::cli
