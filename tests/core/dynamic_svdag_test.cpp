// SPDX-License-Identifier: MIT
// Movers merged with a static DAG: everything looks as if the DAG were the octree that it was made of, and as if all
// were voxelized anew.
#include "core/dynamic_octree.h"
#include "core/kernels.h"
#include "oracle/dag.h"
#include "oracle/morton.h"
#include "support/device.h"
#include "support/mover_scenery.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"
#include "zvo/error.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::Cell;
using test::DynamicSetting;
using test::Item;
using test::MoverScenery;
using test::Picture;
using Kind = test::Place::Kind;

constexpr float kBoxPart = 0.6F;                        // of the grid's edge, of the first box
constexpr float kBoxMax = 40.0F;                        // voxels, of a box
constexpr glm::vec3 kBoxCorner = {0.13F, 0.21F, 0.09F}; // in parts of the grid's edge, of the first box

constexpr std::array kViews = {View::Color, View::Albedo, View::Normal, View::Depth, View::Level, View::Iterations};

vk::HeadlessDevice& device()
{
    return test::sharedDevice(zvoKernels());
}

// Updates until everything is shown.
UpdateReport update(DynamicOctree& octree)
{
    for (int attempt = 0; attempt < 64; ++attempt)
    {
        const std::uint64_t frame = octree.beginFrame();
        device().run([&](vk::FrameGraph& graph) { octree.update(graph); });
        const std::vector<UpdateReport> reports = octree.frameDone(frame);
        if (!octree.needsUpdate())
        {
            return reports.empty() ? UpdateReport{} : reports.back();
        }
    }
    throw std::runtime_error("no update succeeded");
}

void undo(DynamicOctree& octree)
{
    const std::uint64_t frame = octree.beginFrame();
    device().run([&](vk::FrameGraph& graph) { EXPECT_TRUE(octree.undo(graph)); });
    octree.frameDone(frame);
}

bool showsAttributes(View view)
{
    return view == View::Color || view == View::Albedo || view == View::Normal;
}

/// The attributes of a tree, by which indices in two trees are compared.
struct Looks
{
    std::vector<gpu::Attribute> voxels;
    std::vector<gpu::Attribute> nodes;
    std::uint32_t levels;

    explicit Looks(const TreeView& tree)
        : voxels(device().download(tree.octree().voxel_attributes)),
          nodes(device().download(tree.octree().node_attributes)), levels(tree.octree().grid.nodeLevels())
    {
    }

    [[nodiscard]] std::uint64_t of(const gpu::Hit& hit) const
    {
        const bool is_voxel = test::unpack(hit)->level == levels;
        const gpu::Attribute& look = (is_voxel ? voxels : nodes).at(hit.index);
        return look.color | std::uint64_t{look.normal} << 32;
    }
};

void expectSameHits(const std::vector<gpu::Hit>& expected, const Looks& expected_looks,
                    const std::vector<gpu::Hit>& hits, const Looks& looks, bool with_looks)
{
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        ASSERT_EQ(hits[i].index == gpu::kHitMiss, expected[i].index == gpu::kHitMiss) << i;
        if (hits[i].index == gpu::kHitMiss)
        {
            continue;
        }
        ASSERT_EQ(std::bit_cast<std::uint32_t>(hits[i].t), std::bit_cast<std::uint32_t>(expected[i].t)) << i;
        ASSERT_EQ(hits[i].where, expected[i].where) << i;
        if (with_looks)
        {
            ASSERT_EQ(looks.of(hits[i]), expected_looks.of(expected[i])) << i;
        }
    }
}

constexpr std::uint32_t kWidth = 53;
constexpr std::uint32_t kHeight = 41;

/// A tree, and what pictures of it take.
struct Subject
{
    explicit Subject(const TreeView& view) : tree(view), looks(view), beam(device().device(), view.hasLists())
    {
        device().run([&](vk::FrameGraph& graph) { buildBeam(graph, tree, beam); });
    }

    TreeView tree;
    Looks looks;
    BeamGrid beam;
};

/// Two trees that have to look alike.
class Comparison
{
public:
    Comparison(const TreeView& expected, const TreeView& tree)
        : m_expected(expected), m_subject(tree), m_buffers(device().device(), kWidth, kHeight)
    {
    }

    // By every view and many levels of detail, from everywhere and from where the first box is near.
    void pictures()
    {
        const Grid& grid = m_subject.tree.octree().grid;
        const std::vector<ViewCamera> views = test::manyCameras(grid);
        const double edge = grid.resolution();
        const double size = std::min(kBoxPart * edge, double{kBoxMax});
        const glm::dvec3 corner = edge * glm::dvec3(kBoxCorner);
        const ViewCamera close =
            ViewCamera::lookAt(corner + size * glm::dvec3(1.9, 1.5, 2.3), corner + 0.5 * size, 0.9);
        TraceOptions options;
        options.occlusion_rays = 2;
        for (const View shown : kViews)
        {
            options.view = shown;
            picture(views.front(), options);
            picture(close, options);
        }
        options = {};
        for (std::size_t i = 1; i < views.size(); i += 3)
        {
            options.stack = i % 2 == 0 ? TraceStack::Private : TraceStack::Registers;
            options.beam = i % 4 != 1;
            picture(views[i], options);
        }
        for (const std::uint32_t level : {1U, 2U, 3U, 4U, UINT32_MAX})
        {
            TraceOptions coarse;
            coarse.detail_level = level;
            coarse.detail_pixels = level == UINT32_MAX ? 6.0F : 0.0F;
            picture(views.front(), coarse);
            picture(close, coarse);
        }
    }

    void rays(const test::Codes& codes) const
    {
        const std::uint32_t resolution = m_subject.tree.octree().grid.rootResolution();
        std::mt19937 random(resolution);
        std::vector<gpu::Ray> rays;
        for (int i = 0; i < 1001; ++i)
        {
            rays.push_back(test::deviceRay(test::pickRay(random, resolution, codes)));
        }
        for (const std::uint32_t level : {UINT32_MAX, 1U, 2U, 3U})
        {
            TraceOptions options;
            options.detail_level = level;
            expectSameHits(test::traceOnDevice(device(), m_expected.tree, rays, options), m_expected.looks,
                           test::traceOnDevice(device(), m_subject.tree, rays, options), m_subject.looks,
                           m_subject.tree.octree().hasAttributes());
        }
    }

private:
    [[nodiscard]] Picture take(const Subject& subject, const TraceCamera& camera, const TraceOptions& options)
    {
        device().run(
            [&](vk::FrameGraph& graph)
            {
                graph.fill(m_buffers.hits, gpu::kHitMiss);
                graph.fill(m_buffers.light, 0);
                trace(graph, subject.tree, subject.beam, camera, options, m_buffers);
            });
        const gpu::TraceStatus status = device().download(m_buffers.status).front();
        return {device().download(m_buffers.image), device().download(m_buffers.hits),
                device().download(m_buffers.light), status.live_tiles, status.capped_rays};
    }

    void picture(const ViewCamera& view, const TraceOptions& options)
    {
        const Grid& grid = m_subject.tree.octree().grid;
        const TraceCamera camera = traceCamera(view, grid, kHeight);
        const Picture expected = take(m_expected, camera, options);
        const Picture picture = take(m_subject, camera, options);
        EXPECT_EQ(picture.image, expected.image);
        EXPECT_EQ(picture.light, expected.light);
        EXPECT_EQ(picture.live_tiles, expected.live_tiles);
        EXPECT_EQ(picture.capped_rays, expected.capped_rays);
        const bool with_looks = m_subject.tree.octree().hasAttributes() && showsAttributes(options.view);
        ASSERT_NO_FATAL_FAILURE(
            expectSameHits(expected.hits, m_expected.looks, picture.hits, m_subject.looks, with_looks));
    }

    Subject m_expected;
    Subject m_subject;
    TraceBuffers m_buffers;
};

/// Boxes that move in an octree, and in the DAG that is made of it.
class Pair
{
public:
    // Voxels with arbitrary attributes that tell them apart.
    Pair(const test::Codes& codes, std::uint32_t depth, MergeRule merge, bool attributes)
        : m_attributes(attributes), m_edge(static_cast<float>(1U << depth))
    {
        DynamicOptions options;
        options.merge = merge;
        options.attributes = attributes;
        options.history = {16, UINT64_MAX};
        options.emission_scale = 1.0F;
        options.minimal_capacities = depth % 2 == 0;
        BuildResult built;
        built.octree = fixed(codes, depth);
        m_octree = std::make_unique<DynamicOctree>(device(), std::move(built), options);
        m_dag = std::make_unique<DynamicOctree>(device(), StaticTree(compress(device(), fixed(codes, depth)).dag, {}),
                                                options);
    }

    [[nodiscard]] const DynamicOctree& octree() const { return *m_octree; }
    [[nodiscard]] const DynamicOctree& dag() const { return *m_dag; }

    // A box of this part of the grid, but not of more than kBoxMax voxels.
    void add(float part, const glm::vec3& color)
    {
        Scene box = test::boxScene(glm::vec3(0.0F), glm::vec3(std::min(part * m_edge, kBoxMax)));
        box.materials[0].base_color = {color, 1.0F};
        const std::shared_ptr<const MoverMesh> mesh = uploadMover(device(), box, m_attributes, 1.0F);
        m_movers.emplace_back(m_octree->add(mesh, poseAt({})), m_dag->add(mesh, poseAt({})));
    }

    // Puts the corner of a box at these parts of the grid.
    void place(std::size_t mover, const glm::vec3& corner)
    {
        m_octree->place(m_movers.at(mover).first, poseAt(corner));
        m_dag->place(m_movers.at(mover).second, poseAt(corner));
    }

    void remove(std::size_t mover)
    {
        m_octree->remove(m_movers.at(mover).first);
        m_dag->remove(m_movers.at(mover).second);
    }

    void update()
    {
        const UpdateReport expected = zvo::update(*m_octree);
        const UpdateReport report = zvo::update(*m_dag);
        EXPECT_EQ(report.failed, 0U);
        EXPECT_EQ(report.node_count, expected.node_count);
        EXPECT_EQ(report.voxel_count, expected.voxel_count);
        EXPECT_EQ(report.dynamic_count, expected.dynamic_count);
    }

    void undo()
    {
        zvo::undo(*m_octree);
        zvo::undo(*m_dag);
    }

    void expectSameCells() const
    {
        EXPECT_EQ(test::difference(test::cellsOf(device(), m_dag->tree()), test::cellsOf(device(), m_octree->tree())),
                  "");
    }

    [[nodiscard]] Comparison comparison() const { return {m_octree->tree(), m_dag->tree()}; }

private:
    [[nodiscard]] Octree fixed(const test::Codes& codes, std::uint32_t depth) const
    {
        Octree octree = test::octreeOf(device(), codes, depth);
        if (m_attributes)
        {
            test::addAttributes(device(), octree);
        }
        return octree;
    }

    [[nodiscard]] Pose poseAt(const glm::vec3& corner) const
    {
        return {{glm::translate(glm::mat4(1.0F), m_edge * corner)}, {}, {}};
    }

    bool m_attributes;
    float m_edge;
    std::unique_ptr<DynamicOctree> m_octree;
    std::unique_ptr<DynamicOctree> m_dag;
    std::vector<std::pair<MoverId, MoverId>> m_movers; // in octree and DAG
};

// Waves through the first box and around it.
test::Codes waves(std::uint32_t depth)
{
    const auto edge = static_cast<float>(1U << depth);
    test::Codes codes;
    for (std::uint32_t i = 0; i < 64 * 64; ++i)
    {
        const glm::vec3 place(static_cast<float>(i % 64), static_cast<float>(i / 64), 0.0F);
        const float height = 0.4F * kBoxMax + 6.0F * std::sin(0.2F * place.x) + 5.0F * std::cos(0.17F * place.y);
        codes.push_back(
            oracle::mortonEncode(glm::uvec3(edge * kBoxCorner + place + glm::vec3(-12.0F, -12.0F, height))));
    }
    std::ranges::sort(codes);
    return codes;
}

// Much and little to share, from one level of nodes to seven.
std::vector<std::pair<std::uint32_t, test::Codes>> codeSets()
{
    std::mt19937 random(41);
    const auto everywhere = [](const glm::uvec3&) { return true; };
    const auto checkered = [](const glm::uvec3& voxel) { return (voxel.x + voxel.y + voxel.z) % 2 == 0; };
    return {
        {1, {0, 5}},
        {2, test::randomCodes(2, 20, random)},
        {3, test::codesWhere(3, everywhere)},
        {4, {}},
        {5, test::codesWhere(5, everywhere)},
        {6, test::codesWhere(6, checkered)},
        {7, test::sphereShell(7, 50.0)},
        {8, test::spongeCodes(8)},
        {9, waves(9)},
        {11, waves(11)},
        {13, test::randomCodes(13, 3000, random)},
    };
}

// Through all that movers may do. see: what is shown.
template <typename See> void moveBoxes(Pair& pair, const See& see)
{
    see(); // as it was made
    pair.update();
    see(); // without movers
    pair.add(kBoxPart, {0.9F, 0.2F, 0.1F});
    pair.place(0, kBoxCorner); // over subtrees that stand at many places
    pair.update();
    see();
    pair.add(0.3F, {0.1F, 0.8F, 0.3F});
    pair.place(1, {0.33F, 0.41F, 0.29F}); // across the first
    pair.update();
    see();
    pair.place(0, {3.0F, 3.0F, 3.0F});
    pair.place(1, {3.0F, 3.0F, 3.0F}); // nothing is touched
    pair.update();
    see();
    pair.place(0, {0.71F, 0.01F, 0.66F}); // across the grid's border
    pair.remove(1);
    pair.update();
    see();
    pair.undo();
    pair.undo();
    see();
    pair.remove(0);
    pair.update();
    see(); // without movers again
}

TEST(DynamicSvdag, HoldsWhatTheOctreeHolds)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        Pair pair(codes, depth, depth % 2 == 0 ? MergeRule::DynamicWins : MergeRule::StaticWins, true);
        moveBoxes(pair, [&] { pair.expectSameCells(); });
    }
}

TEST(DynamicSvdag, LooksLikeTheOctreeInEveryViewAndLevelOfDetail)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        Pair pair(codes, depth, MergeRule::DynamicWins, true);
        std::uint32_t step = 0;
        moveBoxes(pair,
                  [&]
                  {
                      SCOPED_TRACE("step " + std::to_string(step));
                      if (step == 3 || step == 4) // two movers, and none that covers anything
                      {
                          pair.comparison().pictures();
                      }
                      ++step;
                  });
    }
}

TEST(DynamicSvdag, RaysHitWhatTheyHitInTheOctree)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        Pair pair(codes, depth, MergeRule::StaticWins, true);
        const test::Codes aims = codes.empty() ? test::Codes{0, 7, 100} : codes;
        moveBoxes(pair, [&] { pair.comparison().rays(aims); });
    }
}

TEST(DynamicSvdag, WithoutAttributesItLooksLikeTheOctree)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        const test::Codes targets = codes.empty() ? test::Codes{0, 7, 100} : codes;
        Pair pair(codes, depth, MergeRule::Average, false);
        EXPECT_EQ(pair.dag().tree().overlaid()->ranks.count(), 0U);
        std::uint32_t step = 0;
        moveBoxes(pair,
                  [&]
                  {
                      pair.expectSameCells();
                      if (++step == 4)
                      {
                          pair.comparison().pictures();
                          pair.comparison().rays(targets);
                      }
                  });
    }
}

/// A scenery with a DAG for its static part.
class World
{
public:
    explicit World(const DynamicSetting& setting) : m_setting(setting), m_scenery(device(), true)
    {
        m_setting.compressed = true;
        m_octree = std::make_unique<DynamicOctree>(device(), m_scenery.buildStatic(m_setting),
                                                   m_setting.options(m_scenery.emissionScale()));
    }

    DynamicOctree& octree() { return *m_octree; }

    MoverId add(const Item& item) { return m_octree->add(m_scenery.mover(item.mesh, true), m_scenery.poseOf(item)); }
    void place(MoverId mover, const Item& item) { m_octree->place(mover, m_scenery.poseOf(item)); }

    void expectRebuilt(const std::multiset<Item>& items, bool with_pictures)
    {
        const std::shared_ptr<const test::Rebuilt> rebuilt = m_scenery.rebuilt(m_setting, true, items);
        EXPECT_EQ(test::difference(test::cellsOf(device(), m_octree->tree()), rebuilt->cells), "");
        if (with_pictures)
        {
            Comparison(rebuilt->octree, m_octree->tree()).pictures();
        }
    }

private:
    DynamicSetting m_setting;
    MoverScenery m_scenery;
    std::unique_ptr<DynamicOctree> m_octree;
};

constexpr Item kMiddle = {0, {Kind::Inside, {1, 1, 1}}};
constexpr Item kTurned = {0, {Kind::Turned, {2, 1, 2}}};
constexpr Item kBent = {2, {Kind::Inside, {1, 2, 1}}, 3};

TEST(DynamicSvdag, AveragedMoversGiveWhatARebuildGives)
{
    for (const std::uint32_t depth : {6U, 1U, 2U, 5U, 7U, 13U})
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        const bool with_pictures = depth > 4 && depth < 13;
        World world({.depth = depth, .minimal_capacities = depth % 2 != 0});
        world.expectRebuilt({}, with_pictures);
        const MoverId first = world.add(kMiddle);
        update(world.octree());
        world.expectRebuilt({kMiddle}, false);
        const MoverId second = world.add(kTurned);
        world.add(kBent);
        update(world.octree());
        world.expectRebuilt({kMiddle, kTurned, kBent}, with_pictures);
        world.place(first, {0, {Kind::Mirrored, {0, 2, 1}}});
        world.octree().remove(second);
        update(world.octree());
        world.expectRebuilt({{0, {Kind::Mirrored, {0, 2, 1}}}, kBent}, false);
        undo(world.octree());
        world.expectRebuilt({kMiddle, kTurned, kBent}, false);
        undo(world.octree());
        undo(world.octree());
        world.expectRebuilt({}, with_pictures);
    }
}

// Words of buffer, from element first on.
template <typename T>
void addWords(std::vector<gpu::uint>& words, const vk::BufferOf<T>& buffer, std::uint64_t first, std::uint64_t count)
{
    const std::vector<T> values = device().download(buffer, first, count);
    const auto* begin = reinterpret_cast<const gpu::uint*>(values.data());
    words.insert(words.end(), begin, begin + values.size() * sizeof(T) / sizeof(gpu::uint));
}

TEST(DynamicSvdag, NothingOfTheDagIsEverWritten)
{
    const DynamicSetting setting = {.depth = 6, .compressed = true, .minimal_capacities = true};
    MoverScenery scenery(device(), true);
    StaticTree fixed = scenery.buildStatic(setting);
    const std::uint64_t node_end = fixed.dag.tree.nodes.count();
    ASSERT_GT(fixed.dag.entry_count, 100U);
    const auto bytes = [&](const Svdag& dag)
    {
        std::vector<gpu::uint> words;
        addWords(words, dag.tree.nodes, 1, node_end - 1); // behind the slot; lists included
        addWords(words, dag.tree.node_attributes, 1, dag.octree_node_count - 1);
        addWords(words, dag.tree.voxel_attributes, 0, dag.tree.voxel_count);
        addWords(words, dag.before, 0, dag.before.count());
        addWords(words, dag.voxels_before_leaf, 0, dag.voxels_before_leaf.count());
        return words;
    };
    const gpu::Node root = device().download(fixed.dag.tree.nodes, 0, 1).front();
    const std::vector<gpu::uint> before = bytes(fixed.dag);
    DynamicOctree octree(device(), std::move(fixed), setting.options(scenery.emissionScale()));
    EXPECT_EQ(octree.staticRoot(), node_end);
    const auto expectUnchanged = [&]
    {
        EXPECT_TRUE(bytes(*octree.tree().svdag()) == before);
        const gpu::Node shown = device().download(octree.tree().octree().nodes, octree.staticRoot(), 1).front();
        EXPECT_EQ(shown.mask_lo, root.mask_lo);
        EXPECT_EQ(shown.base_lo, root.base_lo);
        EXPECT_EQ(shown.mask_hi, root.mask_hi);
        EXPECT_EQ(shown.base_hi, root.base_hi);
    };
    expectUnchanged();
    for (const Item& item : {kMiddle, kTurned, kBent})
    {
        octree.add(scenery.mover(item.mesh, true), scenery.poseOf(item));
        update(octree);
        expectUnchanged();
    }
    undo(octree);
    expectUnchanged();
}

TEST(DynamicSvdag, UndoGivesTheSameBytes)
{
    World world({.depth = 6});
    const MoverId mover = world.add(kMiddle);
    update(world.octree());
    const auto bytes = [&]
    {
        const Octree& octree = world.octree().tree().octree();
        std::vector<gpu::uint> words;
        addWords(words, octree.nodes, 0, octree.nodes.count());
        addWords(words, octree.node_attributes, 0, octree.node_attributes.count());
        addWords(words, octree.voxel_attributes, 0, octree.voxel_attributes.count());
        return words;
    };
    const std::vector<gpu::uint> before = bytes();
    world.place(mover, kTurned);
    update(world.octree());
    EXPECT_FALSE(bytes() == before);
    undo(world.octree());
    const std::vector<gpu::uint> after = bytes();
    // The overlay that was undone is left behind it, where there was nothing.
    const RootStep step = world.octree().history().current();
    const Octree& octree = world.octree().tree().octree();
    const std::uint64_t words_per_node = sizeof(gpu::Node) / sizeof(gpu::uint);
    const std::uint64_t end = words_per_node * (step.region->first_node + step.region->node_capacity);
    ASSERT_LT(end, octree.nodes.count() * words_per_node);
    EXPECT_TRUE(std::equal(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(end), after.begin()));
}

// The nodes of levels 1 to 3 around each of kPathCells^3 cells, by going down from the root; 0 where there is none.
std::vector<std::array<std::uint32_t, gpu::kPathLevels>> pathsOf(const std::vector<gpu::Node>& nodes,
                                                                 std::uint32_t entries_per_word)
{
    const auto child = [&](const gpu::Node& node, std::uint32_t c) -> std::uint32_t
    {
        const std::uint32_t mask = c < 32 ? node.mask_lo : node.mask_hi;
        if ((mask >> (c % 32) & 1) == 0)
        {
            return 0;
        }
        const std::uint32_t place = (c < 32 ? node.base_lo : node.base_hi) +
                                    static_cast<std::uint32_t>(std::popcount(mask & ((1U << c % 32) - 1)));
        const bool listed = (place & gpu::kChildList) != 0;
        return listed ? oracle::entryAt(nodes, place & ~gpu::kChildList, entries_per_word) : place;
    };
    std::vector<std::array<std::uint32_t, gpu::kPathLevels>> paths(gpu::kRankTableFirst);
    for (std::uint32_t i = 0; i < gpu::kRankTableFirst; ++i)
    {
        const std::uint64_t code = oracle::mortonEncode(
            {i % gpu::kPathCells, i / gpu::kPathCells % gpu::kPathCells, i / gpu::kPathCells / gpu::kPathCells});
        std::uint32_t node = 0;
        for (std::uint32_t level = 0; level < gpu::kPathLevels && (level == 0 || node != 0); ++level)
        {
            node = child(nodes.at(node), code >> (6 * (gpu::kPathLevels - 1 - level)) & 63);
            paths[i].at(level) = node;
        }
    }
    return paths;
}

TEST(DynamicSvdag, RaysBeginAtTheLowestNodesOfOverlaysAndOfTheDagBelow)
{
    std::mt19937 random(42);
    for (const std::uint32_t depth : {7U, 8U, 9U})
    {
        SCOPED_TRACE(depth);
        Pair pair(test::randomCodes(depth, 20000, random), depth, MergeRule::DynamicWins, true);
        std::array<std::uint32_t, 2> level3_counts{}; // in overlays, and in the DAG
        moveBoxes(pair,
                  [&]
                  {
                      const std::vector<gpu::Node> nodes = device().download(pair.dag().tree().octree().nodes);
                      BeamGrid beam(device().device());
                      device().run([&](vk::FrameGraph& graph) { buildBeam(graph, pair.dag().tree(), beam); });
                      const std::vector<std::uint64_t> words = device().download(beam.paths);
                      const bool listed = (nodes[0].base_lo & gpu::kChildList) != 0;
                      const std::uint32_t before = listed ? 0 : nodes[0].base_lo - 1;
                      const auto paths = pathsOf(nodes, pair.dag().tree().entriesPerWord());
                      for (std::size_t i = 0; i < paths.size(); ++i)
                      {
                          const std::uint32_t node1 = words[i] & 255;
                          const std::uint32_t node2 = words[i] >> 8 & 65535;
                          ASSERT_EQ(paths[i][0], node1 != 0 ? before + node1 : 0) << i;
                          ASSERT_EQ(paths[i][1], (words[i] >> 24 & 1) != 0 ? before + node2 : node2) << i;
                          ASSERT_EQ(paths[i][2], words[i] >> 32) << i;
                          level3_counts.at(paths[i][2] > pair.dag().staticRoot() ? 0 : 1) += paths[i][2] != 0 ? 1 : 0;
                      }
                  });
        EXPECT_GT(level3_counts[0], 100U);
        EXPECT_GT(level3_counts[1], 100U);
    }
}

TEST(DynamicSvdag, OverlaysTakeEightBytesANodeMoreThanOnAnOctree)
{
    const DynamicSetting setting = {.depth = 6};
    std::array<std::uint64_t, 2> bytes{};
    std::array<UpdateReport, 2> reports;
    for (const bool compressed : {false, true})
    {
        DynamicSetting with = setting;
        with.compressed = compressed;
        MoverScenery scenery(device(), true);
        DynamicOctree octree(device(), scenery.buildStatic(with), with.options(scenery.emissionScale()));
        octree.add(scenery.mover(0, true), scenery.poseOf(kMiddle));
        reports.at(compressed ? 1 : 0) = update(octree);
        bytes.at(compressed ? 1 : 0) = octree.history().stepBytes();
    }
    EXPECT_EQ(reports[1].node_count, reports[0].node_count);
    EXPECT_EQ(bytes[1], bytes[0] + sizeof(gpu::BeforeChild) * reports[0].node_count);
}

TEST(DynamicSvdag, MoreNodesThanListsCanBeToldFromAreRefused)
{
    const test::Codes codes = {0, 5, 70};
    const auto make = [&](std::uint64_t room)
    {
        Svdag dag = compress(device(), test::octreeOf(device(), codes, 3)).dag;
        return OverlayOctree(device(), StaticTree(std::move(dag), {}), {false, 0.0F}, room);
    };
    EXPECT_GE(make(1).arena().largestFreeNodes(), 1U);
    try
    {
        make(std::uint64_t{1} << 31);
        FAIL() << "no error";
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Memory);
        EXPECT_NE(std::string(error.what()).find("more nodes or voxels than the 2147483648 that can be told apart"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace zvo
