// SPDX-License-Identifier: MIT
// Cameras by name, sheets of them, and the kinds of files that pictures are.
#include "cli/cli_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>

namespace zvo::test
{
namespace
{

using Pixel = std::array<std::uint8_t, 3>;

Pixel pixelOf(const Image& image, std::uint32_t x, std::uint32_t y)
{
    const std::uint8_t* const first = image.rgba.data() + (std::size_t{y} * image.width + x) * 4;
    return {first[0], first[1], first[2]};
}

// How far apart two pictures of one size are on average, in codes of a channel.
double meanDifference(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
    {
        sum += std::abs(a.rgba[i] - b.rgba[i]);
    }
    return sum / static_cast<double>(a.rgba.size());
}

std::size_t countOf(const std::string& bytes, const std::string& word)
{
    std::size_t count = 0;
    for (std::size_t at = bytes.find(word); at != std::string::npos; at = bytes.find(word, at + 1))
    {
        ++count;
    }
    return count;
}

class CliPicture : public CliFolder
{
protected:
    [[nodiscard]] Image picture(const std::string& options, const std::string& name = "picture.png") const
    {
        run("render cube.glb -f --resolution 16 --size 64x48 -q -o " + name + " " + options);
        return pixels(name);
    }
};

// Normals are shown as colours: -1 to 1 is 0 to 255.
TEST_F(CliPicture, CamerasByNameSeeTheirSide)
{
    struct Side
    {
        const char* camera;
        std::size_t axis;
        bool upper;
    };
    constexpr Side kSides[] = {
        {"front", 2, true}, {"back", 2, false}, {"left", 0, false}, {"right", 0, true}, {"top", 1, true}};
    for (const Side& side : kSides)
    {
        const Pixel normal = pixelOf(picture(std::string("--view normal --camera ") + side.camera), 32, 24);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const int expected = axis != side.axis ? 128 : side.upper ? 255 : 0;
            EXPECT_NEAR(normal[axis], expected, 2) << side.camera;
        }
    }
}

// From above, x points to the right and z down: the red square is in the corner of both.
TEST_F(CliPicture, TheTopViewHasTheFrontBelow)
{
    m_dir.write("two.mtl", std::string_view("newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n"));
    m_dir.write("two.obj", std::string_view("mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n"
                                            "v 0.6 0.1 0.6\nv 1 0.1 0.6\nv 1 0.1 1\nv 0.6 0.1 1\n"
                                            "usemtl blue\nf 1 4 3 2\nusemtl red\nf 5 8 7 6\n"));
    run("render two.obj -o two.png --resolution 32 --size 64x64 --view albedo --camera top");
    const Image image = pixels("two.png");
    EXPECT_GT(pixelOf(image, 48, 48)[0], 200);
    for (const auto& [x, y] : {std::pair(16U, 16U), std::pair(48U, 16U), std::pair(16U, 48U)})
    {
        EXPECT_GT(pixelOf(image, x, y)[2], 200) << x << ", " << y;
    }
}

TEST_F(CliPicture, IsometricCubesShowThreeFacesOfOneSize)
{
    const Image image = picture("--view normal --camera iso");
    std::array<double, 3> counts{}; // of pixels whose normal is +x, +y, +z
    for (std::uint32_t y = 0; y < image.height; ++y)
    {
        for (std::uint32_t x = 0; x < image.width; ++x)
        {
            const Pixel normal = pixelOf(image, x, y);
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
                const bool is_other = normal[(axis + 1) % 3] > 192 || normal[(axis + 2) % 3] > 192;
                counts[axis] += normal[axis] > 192 && !is_other ? 1 : 0;
            }
        }
    }
    EXPECT_GT(counts[0], 200.0);
    EXPECT_NEAR(counts[1] / counts[0], 1.0, 0.15);
    EXPECT_NEAR(counts[2] / counts[0], 1.0, 0.15);
}

TEST_F(CliPicture, ASheetHasItsViewsSideBySide)
{
    const std::vector<std::string> names = {"front", "right", "top", "iso"};
    const Image sheet = picture("--sheet front,right,top,iso");
    ASSERT_EQ(sheet.width, 64U);
    ASSERT_EQ(sheet.height, 48U);
    for (std::uint32_t i = 0; i < names.size(); ++i)
    {
        run("render cube.glb -f --resolution 16 --size 32x24 -o view.png --camera " + names[i]);
        const Image view = pixels("view.png");
        bool same = true;
        for (std::uint32_t y = 0; y < view.height; ++y)
        {
            for (std::uint32_t x = 0; x < view.width; ++x)
            {
                same = same && pixelOf(view, x, y) == pixelOf(sheet, i % 2 * 32 + x, i / 2 * 24 + y);
            }
        }
        EXPECT_TRUE(same) << names[i];
    }
    run("render cube.glb -o odd.png --resolution 16 --size 63x47 --sheet front,top,iso --integrator path --spp 1");
    const Image odd = pixels("odd.png");
    EXPECT_EQ(odd.width, 63U);
    EXPECT_EQ(odd.height, 47U);
    EXPECT_EQ(pixelOf(odd, 62, 46), (Pixel{48, 48, 48})) << "there is no fourth view";
    EXPECT_NE(pixelOf(odd, 62, 0), (Pixel{48, 48, 48}));
}

TEST_F(CliPicture, JpegAndWebpShowWhatPngDoes)
{
    const Image png = picture("");
    EXPECT_EQ(picture("--quality 100", "a.webp").rgba, png.rgba);
    EXPECT_TRUE(file("a.webp").starts_with("RIFF"));
    EXPECT_LT(meanDifference(picture("", "a.jpg"), png), 4.0);
    EXPECT_TRUE(file("a.jpg").starts_with("\xff\xd8\xff"));
    EXPECT_LT(meanDifference(picture("", "b.webp"), png), 4.0);
    for (const std::string name : {"a.jpg", "b.webp"})
    {
        const std::size_t usual = file(name).size();
        static_cast<void>(picture("--quality 10", name));
        EXPECT_LT(file(name).size(), usual) << name;
    }
}

TEST_F(CliPicture, FramesWithoutNumbersAreAMovingWebp)
{
    run("render cube.glb --resolution 16 --size 64x48 -o turn.webp --turntable 3");
    const std::string webp = file("turn.webp");
    EXPECT_EQ(countOf(webp, "ANIM"), 1U);
    EXPECT_EQ(countOf(webp, "ANMF"), 3U);
    run("render cube.glb --resolution 16 --size 64x48 -o t_#.webp --turntable 3");
    run("render cube.glb --resolution 16 --size 64x48 -o f_#.webp --frames 0..2");
    for (const std::string number : {"0", "1", "2"})
    {
        EXPECT_EQ(file("t_" + number + ".webp"), file("f_" + number + ".webp"));
    }
    EXPECT_NE(file("t_1.webp"), file("t_0.webp"));
}

} // namespace
} // namespace zvo::test
