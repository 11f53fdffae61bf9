// SPDX-License-Identifier: MIT
// Cameras of hosts with other conventions than zvo's: the picture of voxels at a pixel is what the host's matrices say.
#include "core/file/zvo_file.h"
#include "core/scene/sky.h"
#include "expect_usage.h"
#include "support/embedding_host.h"
#include "support/tree_samples.h"
#include "zvo/zvo.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::EmbeddingHost;
using test::expectUsage;

constexpr double kNear = 0.5;
constexpr double kFar = 60.0;
constexpr glm::dvec3 kEye(9.0, 5.5, 7.0);
constexpr glm::dvec3 kTarget(1.9, 2.2, 2.1);
constexpr std::array<std::uint64_t, 12> kCodes = {0, 3, 5, 10, 17, 22, 28, 33, 41, 47, 52, 63}; // in a grid of 4^3

// Morton code to cell, for 4^3.
glm::dvec3 cellOf(std::uint64_t code)
{
    const auto bit = [code](int place) { return static_cast<double>((code >> place) & 1); };
    return {bit(0) + 2 * bit(3), bit(1) + 2 * bit(4), bit(2) + 2 * bit(5)};
}

Tree voxels(EmbeddingHost& host)
{
    std::vector<std::byte> bytes;
    writeZvo(test::octreeOf(kCodes, 2),
             [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    return host.make<Tree>(std::span<const std::byte>(bytes));
}

// A host's convention.
struct Convention
{
    bool left_handed = false; // of its world and view space
    bool y_up = false;        // its viewport has a negative height
    bool z_up = false;        // of its world
};

enum class Lens
{
    Centered,
    OffCenter, // infinite, depth reversed
    Mirrored,
    Orthographic,
    OrthographicReversed
};

DMat4 arrayOf(const glm::dmat4& matrix)
{
    DMat4 result;
    std::copy_n(glm::value_ptr(matrix), 16, result.begin());
    return result;
}

// Rows in place of columns.
glm::dmat4 rowsOf(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& w)
{
    return glm::transpose(glm::dmat4(x, y, z, w));
}

glm::dmat4 viewMatrix(const Convention& convention)
{
    const glm::dvec3 up = convention.z_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 forward = glm::normalize(kTarget - kEye);
    const double side = convention.left_handed ? -1.0 : 1.0;
    const glm::dvec3 right = side * glm::normalize(glm::cross(forward, up));
    const glm::dvec3 upward = side * glm::cross(right, forward);
    const glm::dvec3 z = -side * forward;
    return rowsOf({right, -glm::dot(right, kEye)}, {upward, -glm::dot(upward, kEye)}, {z, -glm::dot(z, kEye)},
                  {0, 0, 0, 1});
}

glm::dmat4 projectionMatrix(const Convention& convention, Lens lens)
{
    const double deep = convention.left_handed ? 1.0 : -1.0; // along z of view space
    const double down = convention.y_up ? 1.0 : -1.0;
    switch (lens)
    {
    case Lens::Centered:
        return rowsOf({1.9, 0, 0, 0}, {0, down * 2.8, 0, 0},
                      {0, 0, deep * kFar / (kFar - kNear), -kNear * kFar / (kFar - kNear)}, {0, 0, deep, 0});
    case Lens::OffCenter: // by much, and by a jitter of less than a pixel
        return rowsOf({1.6, 0, deep * 0.31, 0}, {0, down * 2.1, deep * (0.17 + 0.004), 0}, {0, 0, 0, kNear},
                      {0, 0, deep, 0});
    case Lens::Mirrored:
        return rowsOf({-1.3, 0, 0, 0}, {0, down * 2.8, 0, 0},
                      {0, 0, deep * kFar / (kFar - kNear), -kNear * kFar / (kFar - kNear)}, {0, 0, deep, 0});
    case Lens::Orthographic:
        return rowsOf({0.25, 0, 0, 0.1}, {0, down * 0.3, 0, 0.05},
                      {0, 0, deep / (kFar - kNear), -kNear / (kFar - kNear)}, {0, 0, 0, 1});
    case Lens::OrthographicReversed:
        return rowsOf({0.2, 0, 0, 0}, {0, down * 0.35, 0, -0.1}, {0, 0, -deep / (kFar - kNear), kFar / (kFar - kNear)},
                      {0, 0, 0, 1});
    }
    return {};
}

bool isReversed(Lens lens)
{
    return lens == Lens::OffCenter || lens == Lens::OrthographicReversed;
}

struct Seen
{
    std::size_t voxel = kCodes.size(); // none
    int axis = 0;                      // across its face
    double depth = 0;                  // of clip space
};

// What a rasterizer shows at a point of the picture, in pixels from the top left: the nearest box on the line of points
// that the matrix takes there. back: its inverse.
Seen seenAt(const glm::dmat4& view_projection, const glm::dmat4& back, const glm::dvec2& at, bool y_up, bool reversed)
{
    const double x = 2 * at.x / EmbeddingHost::kWidth - 1;
    const double y = (2 * at.y / EmbeddingHost::kHeight - 1) * (y_up ? -1 : 1);
    const auto place = [&](double depth)
    {
        const glm::dvec4 point = back * glm::dvec4(x, y, depth, 1);
        return glm::dvec3(point) / point.w;
    };
    const glm::dvec3 from = place(reversed ? 1.0 : 0.0);
    const glm::dvec3 along = place(0.5) - from;
    Seen seen;
    double nearest = INFINITY;
    for (std::size_t i = 0; i < kCodes.size(); ++i)
    {
        const glm::dvec3 low = (cellOf(kCodes[i]) - from) / along;
        const glm::dvec3 high = (cellOf(kCodes[i]) + 1.0 - from) / along;
        const glm::dvec3 entries = glm::min(low, high);
        const glm::dvec3 exits = glm::max(low, high);
        const double entry = std::max({entries.x, entries.y, entries.z});
        const double exit = std::min({exits.x, exits.y, exits.z});
        if (entry < exit && entry > 0 && entry < nearest)
        {
            nearest = entry;
            const glm::dvec4 clip = view_projection * glm::dvec4(from + entry * along, 1);
            seen = {i, entry == entries.x ? 0 : entry == entries.y ? 1 : 2, clip.z / clip.w};
        }
    }
    return seen;
}

// Compares pictures with what rasterizers show.
class Conventions : public testing::Test
{
protected:
    void compare(const Convention& convention, Lens lens)
    {
        const glm::dmat4 view = viewMatrix(convention);
        const glm::dmat4 projection = projectionMatrix(convention, lens);
        const glm::dmat4 both = projection * view;
        const bool reversed = isReversed(lens);
        const CameraInfo camera = CameraInfo::ofMatrices(arrayOf(view), arrayOf(projection),
                                                         {.y_up = convention.y_up, .reversed_depth = reversed});
        m_host.frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                m_image.beginCopies(commands);
                m_depth.beginCopies(commands);
                const DepthTarget depth = {m_depth.target(), arrayOf(both), reversed ? 0.0F : 1.0F};
                m_tracer.trace(recorder, m_tree, camera, {.view = View::Voxel}, m_image.target(), &depth);
                m_image.read(commands);
                m_depth.read(commands);
            });
        const std::vector<std::uint32_t> colors = m_image.words();
        const std::vector<std::uint32_t> depths = m_depth.words();

        const glm::dmat4 back = glm::inverse(both);
        std::size_t compared = 0;
        for (std::uint32_t i = 0; i < colors.size(); ++i)
        {
            const glm::dvec2 pixel(i % EmbeddingHost::kWidth, i / EmbeddingHost::kWidth);
            const auto seen = [&](double x, double y)
            { return seenAt(both, back, pixel + glm::dvec2(x, y), convention.y_up, reversed); };
            const Seen middle = seen(0.5, 0.5);
            bool is_edge = false; // where rounding may decide
            for (const double side : {0.48, 0.52})
            {
                is_edge = is_edge || seen(side, 0.5).voxel != middle.voxel || seen(0.5, side).voxel != middle.voxel;
            }
            if (is_edge)
            {
                continue;
            }
            const float depth = std::bit_cast<float>(depths[i]);
            const bool is_hit = middle.voxel != kCodes.size();
            ASSERT_EQ(depth != (reversed ? 0.0F : 1.0F), is_hit) << pixel.x << ' ' << pixel.y;
            if (is_hit)
            {
                ++compared;
                ASSERT_NEAR(depth, middle.depth, 2e-5) << pixel.x << ' ' << pixel.y;
                ASSERT_EQ(colors[i], m_colors.try_emplace({middle.voxel, middle.axis}, colors[i]).first->second)
                    << pixel.x << ' ' << pixel.y;
            }
        }
        EXPECT_GT(compared, 400U);
    }

    EmbeddingHost m_host;
    Tree m_tree = voxels(m_host);
    Tracer m_tracer{m_host.context, EmbeddingHost::kWidth, EmbeddingHost::kHeight, VK_FORMAT_R8G8B8A8_UNORM};
    test::TargetImage m_image{m_host.device, VK_FORMAT_R8G8B8A8_UNORM, EmbeddingHost::kWidth, EmbeddingHost::kHeight};
    test::TargetImage m_depth{m_host.device, VK_FORMAT_R32_SFLOAT, EmbeddingHost::kWidth, EmbeddingHost::kHeight};
    std::map<std::pair<std::size_t, int>, std::uint32_t> m_colors; // of voxels' faces, in all pictures
};

TEST_F(Conventions, PicturesAreThoseOfTheHostsRasterizer)
{
    constexpr std::array kLenses = {Lens::Centered, Lens::OffCenter, Lens::Mirrored, Lens::Orthographic,
                                    Lens::OrthographicReversed};
    for (unsigned number = 0; number < 8; ++number)
    {
        const Convention convention = {(number & 1) != 0, (number & 2) != 0, (number & 4) != 0};
        for (const Lens lens : {kLenses.at(number % 5), kLenses.at((number + 2) % 5)})
        {
            SCOPED_TRACE(std::to_string(number) + ", lens " + std::to_string(static_cast<int>(lens)));
            ASSERT_NO_FATAL_FAILURE(compare(convention, lens));
        }
    }
    std::set<std::uint32_t> different;
    for (const auto& [face, color] : m_colors)
    {
        different.insert(color);
    }
    EXPECT_GE(m_colors.size(), 20U);
    EXPECT_EQ(different.size(), m_colors.size());
}

TEST(HostCamera, MatricesThatMakeNoPictureAreRefused)
{
    const DMat4 view = arrayOf(viewMatrix({}));
    const auto refused = [&](const glm::dmat4& projection, const std::string& word)
    { expectUsage([&] { (void)CameraInfo::ofMatrices(view, arrayOf(projection)); }, word); };
    const glm::dmat4 good = projectionMatrix({}, Lens::Centered);
    EXPECT_NO_THROW((void)CameraInfo::ofMatrices(view, arrayOf(good)));
    refused(glm::dmat4(0), "inverted");
    glm::dmat4 flat = good;
    flat[0][0] = 0;
    refused(flat, "inverted");
    glm::dmat4 unknown = good;
    unknown[1][1] = NAN;
    refused(unknown, "inverted");
    glm::dmat4 sheared = good;
    sheared[1][0] = 0.5;
    refused(sheared, "shear");
    glm::dmat4 oblique = projectionMatrix({}, Lens::Orthographic);
    oblique[2][0] = 0.01;
    refused(oblique, "depth");
}

TEST(HostCamera, TheCInterfaceSaysTheSame)
{
    const Convention convention = {.left_handed = true, .y_up = true};
    for (const Lens lens : {Lens::OffCenter, Lens::OrthographicReversed})
    {
        const DMat4 view = arrayOf(viewMatrix(convention));
        const DMat4 projection = arrayOf(projectionMatrix(convention, lens));
        const CameraInfo expected = CameraInfo::ofMatrices(view, projection, {.y_up = true, .reversed_depth = true});
        ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
        ASSERT_EQ(zvoCameraOfMatrices(view.data(), projection.data(), VK_TRUE, VK_TRUE, &camera), ZVO_OK);
        EXPECT_EQ(std::to_array(camera.position), expected.position);
        EXPECT_EQ(std::to_array(camera.forward), expected.forward);
        EXPECT_EQ(std::to_array(camera.up), expected.up);
        EXPECT_EQ(std::to_array(camera.shift), expected.shift);
        EXPECT_EQ(camera.aspect, expected.aspect);
        EXPECT_EQ(camera.mirrored != 0, expected.mirrored);
        EXPECT_EQ(camera.orthographic != 0, expected.orthographic);
    }
}

// A world turned by uprightTurn(), so that another axis is up.
class Upright
{
public:
    explicit Upright(const glm::dvec3& up)
        : m_turn(uprightTurn(up)), m_host({}, [&](ContextInfo& info) { info.up = of(kUp); })
    {
    }

    [[nodiscard]] DVec3 of(const glm::dvec3& v) const
    {
        const glm::dvec3 turned = m_turn * v;
        return {turned.x, turned.y, turned.z};
    }

    // What is seen of the world without voxels: the simple sky by primary rays, and as paths see it, or a map.
    std::vector<std::uint32_t> outside(bool by_paths, bool has_map)
    {
        const Model model = m_host.upload({});
        const Tree tree = m_host.build(model, {.grid = {{-8, -8, -8}, 1, 4}});
        CameraInfo camera;
        camera.forward = of({0.5, 0.2, -1.0});
        camera.up = of({0, 1, 0});
        camera.vertical_fov = 1.6;
        if (!by_paths)
        {
            return m_host.picture(tree, camera, {.to_sun = of({0.4, 0.5, -0.7})});
        }
        std::vector<Vec3> texels;
        for (int i = 0; i < 32 * 16; ++i)
        {
            texels.push_back({static_cast<float>(i % 32) / 32, static_cast<float>(i) / 512, static_cast<float>(i & 1)});
        }
        const EnvironmentMapInfo map = {.width = 32, .height = 16, .texels = texels, .turn = 0.7};
        std::optional<Environment> environment;
        m_host.frame(
            [&](Recorder& recorder)
            {
                if (has_map)
                {
                    environment.emplace(recorder, map);
                    return;
                }
                environment.emplace(recorder);
                environment->setSun(sunlight(of({0.4, 0.5, -0.7}), of(kUp)));
            });
        Tracer tracer(m_host.context, EmbeddingHost::kWidth, EmbeddingHost::kHeight, VK_FORMAT_R8G8B8A8_UNORM);
        test::TargetImage image(m_host.device, VK_FORMAT_R8G8B8A8_UNORM, EmbeddingHost::kWidth, EmbeddingHost::kHeight);
        return m_host.picture(image, [&](Recorder& recorder, const ImageTarget& target)
                              { tracer.tracePaths(recorder, tree, *environment, camera, {.bounces = 0}, target); });
    }

private:
    glm::dmat3 m_turn;
    EmbeddingHost m_host;
};

TEST(HostUp, SkySunAndMapsStandUpright)
{
    using Pictures = std::array<std::vector<std::uint32_t>, 3>;
    const auto picturesOf = [](const glm::dvec3& up)
    {
        Upright world(up);
        return Pictures{world.outside(false, false), world.outside(true, false), world.outside(true, true)};
    };
    const Pictures expected = picturesOf(kUp);
    EXPECT_EQ(std::set(expected.begin(), expected.end()).size(), expected.size());
    const Pictures turned = picturesOf(glm::normalize(glm::dvec3(1, -2, 2)));
    for (std::size_t kind = 0; kind < expected.size(); ++kind)
    {
        std::size_t off = 0;
        for (std::size_t i = 0; i < expected[kind].size(); ++i)
        {
            for (int shift = 0; shift < 24; shift += 8)
            {
                const auto code = [&](std::uint32_t word) { return static_cast<int>((word >> shift) & 0xFF); };
                off += std::abs(code(expected[kind][i]) - code(turned[kind][i])) > 2 ? 1 : 0;
            }
        }
        EXPECT_LT(off, 30U) << kind; // at the sun's rim
    }
}

TEST(HostUp, TurnsByTheLeastAngle)
{
    for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0),
                                 glm::normalize(glm::dvec3(3, -1, 2))})
    {
        const glm::dmat3 turn = uprightTurn(up);
        EXPECT_NEAR(glm::length(turn * kUp - up), 0, 1e-12);
        EXPECT_NEAR(glm::determinant(turn), 1, 1e-12);
        EXPECT_NEAR((turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2, glm::dot(kUp, up), 1e-12); // the angle's cosine
    }
}

} // namespace
} // namespace zvo
