// SPDX-License-Identifier: MIT
#include "support/held_picture.h"

#include "core/base/read_file.h"
#include "io/image/image_io.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

namespace zvo::test
{

namespace
{

constexpr double kMeanMax = 0.5;    // codes
constexpr int kCodesMax = 12;       // of a channel,
constexpr double kPixelsMax = 0.01; // but for so many pixels
constexpr int kFactor = 8;          // of the picture of differences

void writePng(const std::filesystem::path& file, const Image& picture)
{
    const std::vector<std::uint8_t> png = encodePng(picture.width, picture.height, picture.rgba);
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    EXPECT_TRUE(out.good()) << file;
}

} // namespace

void expectHeldPicture(const std::string& name, const Image& picture)
{
    const std::filesystem::path file = placeOf(ZVO_PICTURES_DIR, "tests/pictures") / (name + ".png");
    const char* record = std::getenv("ZVO_TEST_RECORD");
    if (record != nullptr && std::string_view(record) == "1")
    {
        writePng(file, picture);
        return;
    }
    const Image held = decodeImage(readFile(file), name, file.string());
    ASSERT_EQ(held.width, picture.width);
    ASSERT_EQ(held.height, picture.height);
    Image differences = picture;
    double sum = 0.0;
    std::size_t far = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    {
        int largest = 0;
        for (std::size_t k = i; k < i + 3; ++k)
        {
            const int difference = std::abs(int{picture.rgba[k]} - int{held.rgba[k]});
            differences.rgba[k] = static_cast<std::uint8_t>(std::min(kFactor * difference, 255));
            largest = std::max(largest, difference);
            sum += difference;
        }
        far += largest > kCodesMax ? 1 : 0;
    }
    const auto pixels = static_cast<double>(picture.rgba.size() / 4);
    const double mean = sum / (3.0 * pixels);
    if (mean <= kMeanMax && static_cast<double>(far) <= kPixelsMax * pixels)
    {
        return;
    }
    const std::filesystem::path folder = testing::TempDir();
    writePng(folder / (name + ".png"), picture);
    writePng(folder / (name + "_difference.png"), differences);
    ADD_FAILURE() << name << " differs from " << file << " by " << mean << " codes on average, and by more than "
                  << kCodesMax << " in " << far << " pixels: see " << folder / (name + "_difference.png")
                  << "; if it is what it should be now, record it: docs/testing.md, Pictures";
}

} // namespace zvo::test
