// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/hdr_image.h"

namespace zvo::cli
{

/// How close a picture is to another one of the same size.
struct PictureQuality
{
    double psnr_db = 0;  // of the sRGB codes
    double ssim = 0;     // of their luma, mean over the picture
    double flip = 0;     // FLIP of them (bench/flip.h), mean over the picture
    double relative = 0; // mean error of linear luminance over the reference's, plus a hundredth of its mean
};

/// Compares what is seen of pictures of linear radiance: both are tone-mapped, with the exposure that the reference
/// gets. SSIM is that of Z. Wang et al., Image Quality Assessment: From Error Visibility to Structural Similarity,
/// 2004: a Gaussian window of 11x11 pixels with a standard deviation of 1.5.
PictureQuality compareTo(const HdrImage& reference, const HdrImage& picture);

} // namespace zvo::cli
