// SPDX-License-Identifier: MIT
// Kernels of a host that trace with zvo/trace.glsl (tests/glsl) give the same results as zvo's own kernels.
#include "core/dynamic/dynamic_octree.h"
#include "core/headless/attribute_packer.h"
#include "core/trace/trace_passes.h"
#include "core/tree/tree_table.h"
#include "glsl/host_device.h"
#include "oracle/morton.h"
#include "oracle/trace.h"
#include "support/dags.h"
#include "support/dynamic_updates.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::deviceOfHosts;

constexpr std::uint32_t kWidth = 53;
constexpr std::uint32_t kHeight = 41;
constexpr double kNear = 0.01; // for cameras with depth

// The struct of tests/glsl/picture.glsl.
struct Frame
{
    gpu::CameraRays camera;
    gpu::uint orthographic = 0;
    gpu::uint width = kWidth;
    gpu::uint height = kHeight;
    glm::mat4 view_projection{1.0F};
    gpu::vec2 detail{0.0F};
};

struct Pixel
{
    gpu::Hit hit;
    gpu::uint albedo;
    gpu::uint normal;
    gpu::vec3 emission;
    gpu::vec3 position;
    gpu::vec3 face_normal;
    gpu::vec3 middle;
    float edge;
    float depth;
    gpu::uint is_voxel;
    gpu::uint is_inside;
    gpu::uint is_dynamic;
};

struct PicturePush
{
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<Frame> frame;
    gpu::Ptr<Pixel> pixels;
};

// The struct of tests/glsl/host/rays.comp.
struct WorldRay
{
    glm::vec3 origin;
    float t_min;
    glm::vec3 direction;
    float t_max;
};

struct Met
{
    gpu::Hit hit;
    gpu::Hit coarse;
    gpu::vec3 position;
    gpu::uint occluded;
};

struct RaysPush
{
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<WorldRay> rays;
    gpu::Ptr<Met> results;
    gpu::uint count;
    float detail;
};

// The struct of tests/glsl/host/steps.comp.
struct Both
{
    std::array<gpu::Hit, 2> hits;
    std::array<gpu::uint, 2> call_counts;
};

struct StepsPush
{
    std::array<gpu::ConstPtr<gpu::TreeTable>, 2> trees;
    gpu::ConstPtr<gpu::Ray> rays;
    gpu::Ptr<Both> results;
    gpu::uint count;
    gpu::uint padding = 0;
};

vk::BufferOf<gpu::TreeTable> tableOf(const DeviceTree& tree)
{
    return deviceOfHosts().makeBuffer<gpu::TreeTable>("tree table", std::vector{treeTable(tree)});
}

// Declares the buffers that the pass reads through the table.
void readTree(vk::AnyPass& pass, const DeviceTree& tree)
{
    pass.read(tree.nodes);
    pass.read(tree.voxel_attributes);
    pass.read(tree.node_attributes);
    pass.read(tree.packed.voxels);
    pass.read(tree.packed.nodes);
    pass.read(tree.emission_words);
    pass.read(tree.emission);
    pass.read(tree.lists.before);
    pass.read(tree.lists.voxels_before_leaf);
    pass.read(tree.overlays.ranks);
}

std::vector<Pixel> hostPicture(const DeviceTree& tree, const char* kernel, const vk::Specialization& constants,
                               const Frame& frame)
{
    const vk::BufferOf<gpu::TreeTable> table = tableOf(tree);
    const vk::BufferOf<Frame> frames = deviceOfHosts().makeBuffer<Frame>("frame", std::vector{frame});
    vk::BufferOf<Pixel> pixels(deviceOfHosts().device(), "pixels", std::uint64_t{kWidth} * kHeight);
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass(kernel, constants);
            readTree(pass, tree);
            const PicturePush push = {pass.read(table), pass.read(frames), pass.write(pixels)};
            pass.dispatch(pixels.count(), push);
        });
    return deviceOfHosts().download(pixels);
}

// A matrix with reversed depth for the camera of view: 1 at kNear, 0 at infinity.
glm::mat4 reversedDepth(const ViewCamera& view)
{
    glm::mat4 projection(0.0F);
    projection[0][0] = 1.0F;
    projection[1][1] = -1.0F;
    projection[2][3] = -1.0F;
    projection[3][2] = static_cast<float>(kNear);
    return projection * glm::mat4(glm::lookAt(view.position, view.position + view.forward, view.up));
}

// Emission of voxels, read on the host.
class Emission
{
public:
    explicit Emission(const DeviceTree& octree)
        : m_words(deviceOfHosts().download(octree.emission_words)), m_values(deviceOfHosts().download(octree.emission)),
          m_scale(octree.emission_scale)
    {
    }

    [[nodiscard]] glm::dvec3 of(std::uint32_t voxel) const
    {
        if (m_words.empty() || (m_words.at(voxel / 32).x >> voxel % 32 & 1U) == 0)
        {
            return glm::dvec3(0.0);
        }
        const gpu::uvec2 word = m_words.at(voxel / 32);
        const gpu::uint value =
            m_values.at(word.y + static_cast<std::uint32_t>(std::popcount(word.x & ((1U << voxel % 32) - 1))));
        const glm::dvec3 mantissa(value & 511U, value >> 9 & 511U, value >> 18 & 511U);
        return static_cast<double>(m_scale) * std::ldexp(1.0, static_cast<int>(value >> 27) - 24) * mantissa;
    }

private:
    std::vector<gpu::uvec2> m_words;
    std::vector<gpu::uint> m_values;
    float m_scale;
};

// Compares the pixel's point with the ray in double precision and the cell's box.
void expectPosition(const Pixel& pixel, const Grid& grid, const TraceCamera& camera, std::size_t i)
{
    const test::DeviceHit hit = *test::unpack(pixel.hit);
    const double edge = static_cast<double>(grid.voxel_size) * std::ldexp(1.0, 2 * int(grid.nodeLevels() - hit.level));
    const glm::dvec3 low = glm::dvec3(grid.origin) + edge * glm::dvec3(hit.cell);
    const glm::dvec2 n(2.0 * static_cast<double>(i % kWidth) + 1.0 - kWidth,
                       2.0 * static_cast<double>(i / kWidth) + 1.0 - kHeight);
    const glm::dvec3 offset = n.x * glm::dvec3(camera.rays.half_pixel_x) + n.y * glm::dvec3(camera.rays.half_pixel_y);
    const glm::dvec3 direction = glm::dvec3(camera.rays.forward) + (camera.orthographic ? glm::dvec3(0.0) : offset);
    const glm::dvec3 from = glm::dvec3(camera.rays.origin) + (camera.orthographic ? offset : glm::dvec3(0.0));
    const double unit = static_cast<double>(grid.voxel_size) * grid.rootResolution();
    const glm::dvec3 point = glm::dvec3(grid.origin) + unit * (from - 1.0 + static_cast<double>(hit.t) * direction);
    const double far = glm::length(from) + std::abs(static_cast<double>(hit.t)) * glm::length(direction);
    const double margin = 4e-7 * unit * (1.0 + far);
    const glm::dvec3 position(pixel.position);
    for (int axis = 0; axis < 3; ++axis)
    {
        ASSERT_GE(position[axis], low[axis] - 1e-6 * unit) << i;
        ASSERT_LE(position[axis], low[axis] + edge + 1e-6 * unit) << i;
        ASSERT_NEAR(position[axis], point[axis], margin) << i;
        ASSERT_NEAR(static_cast<double>(pixel.middle[axis]), low[axis] + 0.5 * edge, 1e-6 * unit) << i;
        ASSERT_EQ(pixel.face_normal[axis] != 0.0F,
                  hit.face == gpu::kFaceInside ? direction[axis] != 0.0 : int(hit.face) == axis)
            << i;
        if (int(hit.face) == axis)
        {
            const double face = low[axis] + (direction[axis] > 0.0 ? 0.0 : edge);
            ASSERT_NEAR(position[axis], face, 1e-7 * unit) << i;
            ASSERT_EQ(pixel.face_normal[axis], direction[axis] > 0.0 ? -1.0F : 1.0F) << i;
        }
    }
    ASSERT_NEAR(static_cast<double>(pixel.edge), edge, 1e-6 * edge) << i;
}

struct HostVariant
{
    const char* kernel;
    bool by_levels = false; // specialized for the number of levels of one tree
};

constexpr HostVariant kAnyTree = {"host/picture"};
constexpr std::array kVariants = {kAnyTree, HostVariant{"host/picture_group"},
                                  HostVariant{"host/picture_levels", true}};

// The pictures of a tree by zvo's own kernels, to which the host's are compared.
class ZvoPicture
{
public:
    ZvoPicture(const DeviceTree& tree, const ViewCamera& view, TraceOptions options = {})
        : m_tree(tree), m_view(view), m_camera(traceCamera(view, tree.grid, kHeight)),
          m_albedo(take(options, View::Albedo)), m_normals(take(options, View::Normal)),
          m_origins(take(options, View::Origin)), m_emission(tree)
    {
        m_frame.camera = m_camera.rays;
        m_frame.orthographic = m_camera.orthographic ? 1 : 0;
        m_frame.view_projection = reversedDepth(view);
        m_frame.detail = detailOf(options, &m_camera);
    }

    [[nodiscard]] std::uint32_t hitCount() const { return test::hitCount(m_albedo); }

    // Expects that the host's picture is the same at every pixel.
    void expectSame(const HostVariant& variant) const
    {
        SCOPED_TRACE(variant.kernel);
        const vk::Specialization constants = variant.by_levels
                                                 ? vk::Specialization{m_tree.grid.nodeLevels(), m_tree.entriesPerWord()}
                                                 : vk::Specialization{};
        const std::vector<Pixel> pixels = hostPicture(m_tree, variant.kernel, constants, m_frame);
        for (std::size_t i = 0; i < pixels.size(); ++i)
        {
            ASSERT_NO_FATAL_FAILURE(expectSamePixel(pixels[i], i));
        }
    }

private:
    [[nodiscard]] test::Picture take(TraceOptions options, View view) const
    {
        options.view = view;
        return test::takePicture(deviceOfHosts(), m_tree, m_camera, kWidth, kHeight, options);
    }

    void expectSamePixel(const Pixel& pixel, std::size_t i) const
    {
        const gpu::Hit& hit = m_albedo.hits[i];
        ASSERT_EQ(pixel.hit.index == gpu::kHitMiss, hit.index == gpu::kHitMiss) << i;
        if (hit.index == gpu::kHitMiss)
        {
            return;
        }
        ASSERT_EQ(std::bit_cast<std::uint32_t>(pixel.hit.t), std::bit_cast<std::uint32_t>(hit.t)) << i;
        ASSERT_EQ(pixel.hit.where, hit.where) << i;
        if (m_tree.hasAttributes() || !m_tree.isDag())
        {
            ASSERT_EQ(pixel.hit.index, hit.index) << i;
        }
        ASSERT_EQ(pixel.albedo, m_albedo.image[i]) << i;
        ASSERT_EQ(pixel.normal, m_normals.image[i]) << i;
        const test::DeviceHit met = *test::unpack(hit);
        ASSERT_EQ(pixel.is_voxel != 0, met.level == m_tree.grid.nodeLevels()) << i;
        ASSERT_EQ(pixel.is_inside != 0, met.face == gpu::kFaceInside) << i;
        const bool is_gray = (m_origins.image[i] & 255U) == (m_origins.image[i] >> 16 & 255U);
        ASSERT_EQ(pixel.is_dynamic != 0, !is_gray) << i;
        const bool may_emit = m_tree.hasAttributes() && pixel.is_voxel != 0;
        const glm::dvec3 radiance = may_emit ? m_emission.of(hit.index) : glm::dvec3(0.0);
        for (int channel = 0; channel < 3; ++channel)
        {
            ASSERT_NEAR(static_cast<double>(pixel.emission[channel]), radiance[channel], 1e-4 * radiance[channel]) << i;
        }
        ASSERT_NO_FATAL_FAILURE(expectPosition(pixel, m_tree.grid, m_camera, i));
        const double distance = glm::dot(glm::dvec3(pixel.position) - m_view.position, m_view.forward);
        const double reach = glm::length(m_view.position) + distance; // single precision rounds these lengths
        if (distance > 1e-4 * reach)
        {
            const double depth = kNear / distance;
            ASSERT_NEAR(static_cast<double>(pixel.depth), depth, depth * 1e-6 * (4.0 + reach / distance)) << i;
        }
    }

    const DeviceTree& m_tree;
    ViewCamera m_view;
    TraceCamera m_camera;
    Frame m_frame;
    test::Picture m_albedo;
    test::Picture m_normals;
    test::Picture m_origins;
    Emission m_emission;
};

struct CodeSet
{
    std::uint32_t depth;
    test::Codes codes;
};

// Sets of voxels that share much or little, with one or many levels of nodes.
std::vector<CodeSet> codeSets()
{
    std::mt19937 random(71);
    const auto everywhere = [](const glm::uvec3&) { return true; };
    const auto checkered = [](const glm::uvec3& voxel) { return (voxel.x + voxel.y + voxel.z) % 2 == 0; };
    return {
        {1, {0, 5}},
        {2, test::randomCodes(2, 20, random)},
        {3, test::codesWhere(3, everywhere)},
        {4, test::codesWhere(4, checkered)},
        {5, test::sphereShell(5, 12.0)},
        {6, test::spongeCodes(6)},
        {8, test::randomCodes(8, 3000, random)},
    };
}

// Views in perspective from outside and from inside, and an orthographic one.
std::array<ViewCamera, 3> threeViews(const Grid& grid)
{
    const std::vector<ViewCamera> views = test::manyCameras(grid);
    return {views[0], views[1], views[12]};
}

constexpr std::array kFormats = {AttributeFormat::None, AttributeFormat::Bytes4, AttributeFormat::Bytes8,
                                 AttributeFormat::Blocks};

DeviceTree octreeWith(const CodeSet& set, AttributeFormat format)
{
    DeviceTree octree = test::octreeOf(deviceOfHosts(), set.codes, set.depth);
    if (format != AttributeFormat::None)
    {
        test::addAttributes(deviceOfHosts(), octree);
        octree.emission_scale = 3.5F;
        packTree(deviceOfHosts(), format, octree);
    }
    return octree;
}

DeviceTree dagWith(const CodeSet& set, AttributeFormat format, std::uint32_t entries_per_word = 0)
{
    const DeviceTree octree =
        octreeWith(set, format == AttributeFormat::None ? AttributeFormat::None : AttributeFormat::Bytes8);
    DeviceTree dag = test::svdagOf(deviceOfHosts(), octree, entries_per_word);
    packTree(deviceOfHosts(), format, dag);
    return dag;
}

TEST(HostGlsl, PicturesOfOctreesAndDagsAreZvos)
{
    std::size_t number = 0;
    for (const CodeSet& set : codeSets())
    {
        for (const AttributeFormat format : kFormats)
        {
            const DeviceTree octree = octreeWith(set, format);
            const DeviceTree dag = dagWith(set, format);
            const std::array<ViewCamera, 3> views = threeViews(octree.grid);
            for (const DeviceTree* shown : std::array<const DeviceTree*, 2>{&octree, &dag})
            {
                const DeviceTree& tree = *shown;
                SCOPED_TRACE("depth " + std::to_string(set.depth) + ", format " + formatName(format) + ", lists " +
                             std::to_string(tree.entriesPerWord()));
                const ZvoPicture outside(tree, views[0]);
                EXPECT_GT(outside.hitCount(), 0U);
                ASSERT_NO_FATAL_FAILURE(outside.expectSame(kVariants.at(number % 3)));
                ASSERT_NO_FATAL_FAILURE(
                    ZvoPicture(tree, views.at(1 + number % 2)).expectSame(kVariants.at(number % 3)));
                ++number;
            }
        }
    }
}

TEST(HostGlsl, EveryCameraSeesTheSame)
{
    const CodeSet set = {6, test::sphereShell(6, 24.0)};
    const DeviceTree octree = octreeWith(set, AttributeFormat::Bytes8);
    const DeviceTree dag = dagWith(set, AttributeFormat::Bytes8);
    std::size_t number = 0;
    for (const ViewCamera& view : test::manyCameras(octree.grid))
    {
        SCOPED_TRACE("camera " + std::to_string(number));
        ASSERT_NO_FATAL_FAILURE(ZvoPicture(octree, view).expectSame(kVariants.at(number % 3)));
        ASSERT_NO_FATAL_FAILURE(ZvoPicture(dag, view).expectSame(kVariants.at((number + 1) % 3)));
        ++number;
    }
}

TEST(HostGlsl, AnyEntriesAWordGiveTheSame)
{
    std::mt19937 random(72);
    const CodeSet set = {9, test::randomCodes(9, 3000, random)};
    for (const std::uint32_t entries : {2U, 3U, 4U})
    {
        const DeviceTree dag = dagWith(set, AttributeFormat::Bytes8, entries);
        const ZvoPicture picture(dag, threeViews(dag.grid)[0]);
        EXPECT_GT(picture.hitCount(), 0U) << entries;
        for (const HostVariant& variant : kVariants)
        {
            ASSERT_NO_FATAL_FAILURE(picture.expectSame(variant)) << entries;
        }
    }
}

TEST(HostGlsl, EveryDepthIsTheSame)
{
    std::mt19937 random(73);
    for (std::uint32_t depth = 1; depth <= Grid::kDepthMax; ++depth)
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        const CodeSet set = {depth, test::randomCodes(depth, 300, random)};
        const AttributeFormat format = kFormats.at(1 + depth % 3);
        const DeviceTree octree = octreeWith(set, format);
        const DeviceTree dag = dagWith(set, format);
        const glm::dvec3 voxel = glm::dvec3(oracle::mortonDecode(set.codes.back())) + 0.5;
        const ViewCamera view = ViewCamera::lookAt(voxel + glm::dvec3(3.0, 4.0, 5.0), voxel, 0.5);
        for (const DeviceTree* shown : std::array<const DeviceTree*, 2>{&octree, &dag})
        {
            const DeviceTree& tree = *shown;
            const ZvoPicture picture(tree, view);
            EXPECT_GT(picture.hitCount(), 0U);
            ASSERT_NO_FATAL_FAILURE(picture.expectSame(kAnyTree));
        }
    }
}

TEST(HostGlsl, LevelsOfDetailStopAtTheSameNodes)
{
    for (const CodeSet& set : codeSets())
    {
        for (const AttributeFormat format : {AttributeFormat::Bytes8, AttributeFormat::Blocks})
        {
            const DeviceTree octree = octreeWith(set, format);
            const DeviceTree dag = dagWith(set, format);
            for (const std::uint32_t level : {0U, 1U, 2U, UINT32_MAX})
            {
                TraceOptions options;
                options.detail_level = level;
                options.detail_pixels = level == UINT32_MAX ? 6.0F : 0.0F;
                const ViewCamera view = test::manyCameras(octree.grid).at(level == 1 ? 12 : 0);
                SCOPED_TRACE("depth " + std::to_string(set.depth) + ", level " + std::to_string(level));
                // The attributes of a DAG's nodes have another order, which pictures do not show.
                for (const DeviceTree* shown : std::array<const DeviceTree*, 2>{&octree, &dag})
                {
                    const DeviceTree& tree = *shown;
                    const ZvoPicture picture(tree, view, options);
                    EXPECT_GT(picture.hitCount(), 0U);
                    ASSERT_NO_FATAL_FAILURE(picture.expectSame({"host/picture_detail"}));
                }
            }
        }
    }
}

struct OverlayCase
{
    std::uint32_t depth;
    bool compressed;
    bool attributes;
};

class HostGlslOverlays : public testing::TestWithParam<OverlayCase>
{
};

INSTANTIATE_TEST_SUITE_P(Trees, HostGlslOverlays,
                         testing::Values(OverlayCase{5, false, true}, OverlayCase{5, true, true},
                                         OverlayCase{8, false, true}, OverlayCase{8, true, true},
                                         OverlayCase{8, false, false}, OverlayCase{8, true, false},
                                         OverlayCase{11, true, true}),
                         [](const auto& test_case)
                         {
                             return std::string(test_case.param.compressed ? "Dag" : "Octree") +
                                    std::to_string(test_case.param.depth) +
                                    (test_case.param.attributes ? "" : "WithoutAttributes");
                         });

// A merged box, and a dab of a brush.
TEST_P(HostGlslOverlays, AreSeen)
{
    const auto& [depth, compressed, attributes] = GetParam();
    std::mt19937 random(depth);
    const CodeSet set = {depth, test::randomCodes(depth, 9000, random)};
    const AttributeFormat format = attributes ? AttributeFormat::Bytes8 : AttributeFormat::None;
    DynamicOptions options;
    options.merge = MergeRule::DynamicWins;
    options.attributes = attributes;
    options.emission_scale = 3.5F;
    DynamicOctree octree(deviceOfHosts(), compressed ? dagWith(set, format) : octreeWith(set, format), options);
    const float edge = std::ldexp(1.0F, static_cast<int>(depth));
    const Scene box = test::boxScene(glm::vec3(0.0F), glm::vec3(std::min(0.4F * edge, 30.0F)));
    octree.add(uploadDynamicMesh(deviceOfHosts(), box, attributes, options.emission_scale),
               {{glm::translate(glm::mat4(1.0F), glm::vec3(0.3F * edge))}, {}, {}});
    const glm::ivec3 dab(static_cast<int>(0.7F * edge));
    const Brush brush = {BrushShape::Sphere, BrushAction::Fill, dab, 3, 0x2060C0};
    for (bool is_done = false; !is_done;)
    {
        const std::uint64_t frame = octree.beginFrame();
        deviceOfHosts().run([&](vk::FrameGraph& graph) { is_done = octree.edit(graph, brush); });
        octree.frameDone(frame);
    }
    test::updateAll(deviceOfHosts(), octree);
    ASSERT_TRUE(octree.tree().hasOverlays());
    ASSERT_EQ(octree.tree().isDag(), compressed);
    const glm::dvec3 near = glm::dvec3(dab) + glm::dvec3(12.0, 9.0, 15.0);
    for (const ViewCamera& view :
         {test::manyCameras(octree.tree().grid).front(), ViewCamera::lookAt(near, glm::dvec3(dab), 0.8)})
    {
        const ZvoPicture picture(octree.tree(), view);
        EXPECT_GT(picture.hitCount(), 0U);
        for (const HostVariant& variant : kVariants)
        {
            ASSERT_NO_FATAL_FAILURE(picture.expectSame(variant));
        }
        TraceOptions coarse;
        coarse.detail_level = 2;
        ASSERT_NO_FATAL_FAILURE(ZvoPicture(octree.tree(), view, coarse).expectSame({"host/picture_detail"}));
    }
}

TEST(HostGlsl, AnEmptyTreeIsMissed)
{
    const CodeSet empty = {4, {}};
    const DeviceTree octree = test::octreeOf(deviceOfHosts(), empty.codes, empty.depth);
    const DeviceTree dag = test::svdagOf(deviceOfHosts(), octree);
    for (const DeviceTree* shown : std::array<const DeviceTree*, 2>{&octree, &dag})
    {
        const DeviceTree& tree = *shown;
        const ZvoPicture picture(tree, threeViews(octree.grid)[0]);
        EXPECT_EQ(picture.hitCount(), 0U);
        picture.expectSame(kAnyTree);
    }
}

// Rays in world space, from around the grid to points in voxels or past them.
std::vector<WorldRay> worldRays(const Grid& grid, const test::Codes& codes, std::uint32_t count)
{
    std::mt19937 random(count);
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const float edge = grid.voxel_size * static_cast<float>(grid.resolution());
    std::vector<WorldRay> rays;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        WorldRay ray{};
        const glm::vec3 voxel(oracle::mortonDecode(codes[random() % codes.size()]));
        glm::vec3 target;
        for (int axis = 0; axis < 3; ++axis)
        {
            ray.origin[axis] = grid.origin[axis] + edge * uniform(-1.0F, 2.0F);
            target[axis] = grid.origin[axis] + grid.voxel_size * (voxel[axis] + uniform(0.1F, 0.9F));
        }
        ray.direction = (i % 3 == 0 ? 7.5F : 1.0F) * (target - ray.origin);
        ray.t_min = i % 5 == 0 ? 0.01F : 0.0F;
        ray.t_max = i % 4 == 0 ? uniform(0.0F, 1.2F) : i % 4 == 1 ? std::numeric_limits<float>::infinity() : 2.0F;
        rays.push_back(ray);
    }
    return rays;
}

std::vector<Met> meet(const DeviceTree& tree, const std::vector<WorldRay>& rays, float detail)
{
    const vk::BufferOf<gpu::TreeTable> table = tableOf(tree);
    const vk::BufferOf<WorldRay> ray_buffer = deviceOfHosts().makeBuffer("rays", std::span<const WorldRay>(rays));
    vk::BufferOf<Met> results(deviceOfHosts().device(), "results", rays.size());
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("host/rays");
            readTree(pass, tree);
            const RaysPush push = {pass.read(table), pass.read(ray_buffer), pass.write(results),
                                   static_cast<gpu::uint>(rays.size()), detail};
            pass.dispatch(rays.size(), push);
        });
    return deviceOfHosts().download(results);
}

// The ray in unit space, rounded as in shaders.
oracle::Ray unitRay(const Grid& grid, const WorldRay& ray)
{
    const float edge = grid.voxel_size * static_cast<float>(grid.rootResolution());
    return oracle::makeRay(1.0F + (ray.origin - grid.origin) / edge, ray.direction / edge,
                           std::max(ray.t_min, gpu::kTraceTimeMin));
}

TEST(HostGlsl, WorldRaysHitWhatEveryVoxelAskedOnItsOwnSays)
{
    constexpr std::uint32_t kCount = 3000;
    for (const std::uint32_t depth : {6U, 7U})
    {
        std::mt19937 random(depth);
        const test::Codes codes = depth == 6 ? test::sphereShell(6, 20.0) : test::randomCodes(7, 5000, random);
        test::Codes blocks;
        for (const std::uint64_t code : codes)
        {
            blocks.push_back(code >> 6);
        }
        blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
        DeviceTree octree = test::octreeOf(deviceOfHosts(), codes, depth);
        octree.grid.origin = {-3.7F, 12.25F, 0.3F};
        octree.grid.voxel_size = 0.37F;
        const DeviceTree dag = test::svdagOf(deviceOfHosts(), octree);
        const Grid& grid = octree.grid;
        const oracle::VoxelTracer tracer(codes, depth);
        const oracle::VoxelTracer block_tracer(blocks, depth - 2);
        const std::vector<WorldRay> rays = worldRays(grid, codes, kCount);
        for (const DeviceTree* shown : std::array<const DeviceTree*, 2>{&octree, &dag})
        {
            const DeviceTree& tree = *shown;
            const std::vector<Met> mets = meet(tree, rays, 4.04F * grid.voxel_size);
            const bool is_exact =
                deviceOfHosts().device().report().type == "cpu"; // others need not round quotients correctly
            std::uint32_t hit_count = 0;
            std::uint32_t open_count = 0;
            for (std::uint32_t i = 0; i < kCount; ++i)
            {
                const auto expectSame =
                    [&](const gpu::Hit& met, const oracle::VoxelTracer& reference, std::uint32_t level)
                {
                    std::optional<oracle::Hit> expected = reference.trace(unitRay(grid, rays[i]));
                    if (expected && !(expected->t <= rays[i].t_max))
                    {
                        expected.reset();
                    }
                    const std::optional<test::DeviceHit> hit = test::unpack(met);
                    ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
                    if (hit)
                    {
                        ASSERT_EQ(oracle::mortonEncode(hit->cell), expected->code) << i;
                        ASSERT_NEAR(hit->t, expected->t, is_exact ? 0.0F : 4e-6F) << i;
                        ASSERT_EQ(hit->face, expected->face) << i;
                        ASSERT_EQ(hit->level, level) << i;
                    }
                };
                expectSame(mets[i].hit, tracer, grid.nodeLevels());
                expectSame(mets[i].coarse, block_tracer, grid.nodeLevels() - 1);
                const std::optional<test::DeviceHit> hit = test::unpack(mets[i].hit);
                ASSERT_EQ(mets[i].occluded != 0, hit.has_value()) << i;
                (hit ? hit_count : open_count) += 1;
                if (hit)
                {
                    const glm::dvec3 point =
                        glm::dvec3(rays[i].origin) + static_cast<double>(hit->t) * glm::dvec3(rays[i].direction);
                    ASSERT_LT(glm::length(glm::dvec3(mets[i].position) - point),
                              1e-5 * static_cast<double>(grid.voxel_size) * grid.rootResolution())
                        << i;
                }
            }
            EXPECT_GT(hit_count, kCount / 2);
            EXPECT_GT(open_count, kCount / 10);
        }
    }
}

TEST(HostGlsl, RaysThatAreNoneHitNothing)
{
    const DeviceTree octree =
        octreeWith({3, test::codesWhere(3, [](const glm::uvec3&) { return true; })}, AttributeFormat::Bytes8);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const WorldRay good = {glm::vec3(-1.0F), 0.0F, glm::vec3(1.0F), kInfinity};
    std::vector<WorldRay> rays(7, good);
    rays[1].origin.y = kNan;
    rays[2].direction.x = kNan;
    rays[3].origin.z = kInfinity;
    rays[4].direction.z = -kInfinity;
    rays[5].t_max = kNan;
    rays[6].t_min = kInfinity;
    const std::vector<Met> mets = meet(octree, rays, 0.0F);
    EXPECT_EQ(mets[0].hit.index, 0U);
    EXPECT_EQ(mets[0].position, gpu::vec3(0.0F));
    for (std::size_t i = 1; i < rays.size(); ++i)
    {
        EXPECT_EQ(mets[i].hit.index, gpu::kHitMiss) << i;
        EXPECT_EQ(mets[i].occluded, 0U) << i;
    }
}

TEST(HostGlsl, UnfinishedRaysResumeInTwoTreesAtOnce)
{
    constexpr std::uint32_t kSteps = 20;
    std::mt19937 random(74);
    const CodeSet deep = {9, test::randomCodes(9, 20000, random)};
    const CodeSet shallow = {6, test::spongeCodes(6)};
    const DeviceTree octree = octreeWith(shallow, AttributeFormat::Bytes8);
    const DeviceTree dag = dagWith(deep, AttributeFormat::Bytes8);
    const std::array<const DeviceTree*, 2> trees = {&dag, &octree};
    std::vector<gpu::Ray> rays;
    for (std::uint32_t i = 0; i < 2049; ++i)
    {
        rays.push_back(test::deviceRay(test::pickRay(random, dag.grid.rootResolution(), deep.codes)));
    }
    const std::array tables = {tableOf(dag), tableOf(octree)};
    const vk::BufferOf<gpu::Ray> ray_buffer = deviceOfHosts().makeBuffer("rays", std::span<const gpu::Ray>(rays));
    vk::BufferOf<Both> results(deviceOfHosts().device(), "results", rays.size());
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("host/steps", {kSteps});
            readTree(pass, *trees[0]);
            readTree(pass, *trees[1]);
            const StepsPush push = {{pass.read(tables[0]), pass.read(tables[1])},
                                    pass.read(ray_buffer),
                                    pass.write(results),
                                    static_cast<gpu::uint>(rays.size())};
            pass.dispatch(rays.size(), push);
        });
    const std::vector<Both> both = deviceOfHosts().download(results);
    for (std::size_t k = 0; k < 2; ++k)
    {
        const std::vector<gpu::Hit> expected = test::traceOnDevice(deviceOfHosts(), *trees.at(k), rays);
        std::uint32_t calls_max = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
        {
            const gpu::Hit& hit = both[i].hits.at(k);
            ASSERT_EQ(hit.index, expected[i].index) << i;
            if (hit.index != gpu::kHitMiss)
            {
                ASSERT_EQ(std::bit_cast<std::uint32_t>(hit.t), std::bit_cast<std::uint32_t>(expected[i].t)) << i;
                ASSERT_EQ(hit.where, expected[i].where) << i;
            }
            calls_max = std::max(calls_max, both[i].call_counts.at(k));
        }
        EXPECT_GT(calls_max, 2U);
    }
}

} // namespace
} // namespace zvo
