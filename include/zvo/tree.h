// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/export.h"
#include "zvo/model.h"
#include "zvo/types.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace zvo
{

/// What a tree is like.
struct TreeInfo
{
    TreeStructure structure = TreeStructure::Svo;
    AttributeFormat format = AttributeFormat::None;
    GridInfo grid;
    std::uint64_t voxel_count = 0;
    std::uint64_t node_count = 0; // that are stored
    std::uint64_t bytes = 0;      // of device memory: nodes, lists, attributes, emission, kept sums
    float emission_scale = 0;     // 0: nothing emits light
};

/// An octree or a DAG in device memory, which does not change. Move-only. Using one that was taken over or moved from,
/// or lost with its frame (Context::frameLost()), throws Error{Usage}, as with all that is made of a Context.
class ZVO_API Tree
{
public:
    /// Records the upload of a .zvo file (docs/file-format.md) that is in memory, or of one on disk. Takes as much
    /// memory again for staging until the frame is done. Throws Error{Input}, one line, for a file that is not right,
    /// and Error{Memory}. First and last stage: ALL_TRANSFER.
    Tree(Recorder& recorder, std::span<const std::byte> file);
    Tree(Recorder& recorder, const std::filesystem::path& path);
    ~Tree();
    Tree(Tree&& other) noexcept;
    Tree& operator=(Tree&& other) noexcept;

    [[nodiscard]] const TreeInfo& info() const;

    /// Device address of the table by which the host's shaders trace the tree (zvo/trace.glsl). It lives as long as the
    /// tree. The host's shaders read it, and what it names, behind Recorder::makeVisible().
    [[nodiscard]] std::uint64_t address() const;

    struct Impl;
    ZVO_LOCAL explicit Tree(std::unique_ptr<Impl> impl);      // of the library
    [[nodiscard]] Impl* impl() const { return m_impl.get(); } // of the library; null where another one took it over
    ZVO_LOCAL std::unique_ptr<Impl> release();                // of the library

private:
    std::unique_ptr<Impl> m_impl;
};

/// What is made of a model.
struct TreeBuildInfo
{
    GridInfo grid;
    Coverage coverage = Coverage::Thin;
    AttributeFormat format = AttributeFormat::Bytes8; // None: no attributes
    bool keep_sums = false; // for a DynamicTree with MergeRule::Average: 28 bytes a voxel more. Only with Bytes8
};

/// Voxelizes a model and builds its octree, in steps: sizes that only the device knows are learnt between them, and
/// exactly what is needed is allocated. Nothing waits: a step is recorded into a frame, the next one into a frame that
/// begins after Context::frameDone() of it. About five steps, and two more for each size that was guessed too low.
///
///     while (build.record(recorder)) { submit; begin the next frame }
///     Tree tree = build.take();
///
/// The result is the same bytes on every device, as `zvo build` writes them. First stages: ALL_TRANSFER,
/// COMPUTE_SHADER and DRAW_INDIRECT. Last stages: COMPUTE_SHADER and ALL_TRANSFER. It touches resources of its own and
/// the model.
class ZVO_API TreeBuild
{
public:
    /// Throws Error{Usage} for a depth out of range, a grid whose corners are not finite, voxels of no finite size
    /// above 0, for attributes of a model that was uploaded without, and for one that was lost.
    TreeBuild(Context& context, const Model& model, const TreeBuildInfo& info);
    ~TreeBuild();
    TreeBuild(TreeBuild&&) noexcept;
    TreeBuild& operator=(TreeBuild&&) noexcept;

    /// Records the next step, unless the device is still at work on the last one. False: there is none, the tree is
    /// there. Throws Error{Memory}: the budget, or the device's memory, does not suffice; the same step can be tried
    /// again unless the error came from what the last step found out (isBroken()). Throws Error{Usage} where the model
    /// was lost with its frame: nothing will come of it.
    bool record(Recorder& recorder);

    /// Whether the tree is there. Like record(), learns what the last step came to, and throws.
    [[nodiscard]] bool isDone();

    /// Nothing will come of it.
    [[nodiscard]] bool isBroken() const;

    /// The tree, once; isDone().
    [[nodiscard]] Tree take();

    /// Triangles that were left out, by reason: "nonfinite", "out_of_range", "outside", "zero_area".
    [[nodiscard]] const std::map<std::string, std::uint64_t>& dropped() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/// Makes a DAG of an octree, in steps like TreeBuild's: about three, and one more for each table that was too small.
/// The result is the same bytes on every device.
class ZVO_API TreeCompression
{
public:
    /// Takes the octree over: its nodes go when the DAG is there. Throws Error{Usage} for a tree that is a DAG already.
    TreeCompression(Context& context, Tree&& octree);
    ~TreeCompression();
    TreeCompression(TreeCompression&&) noexcept;
    TreeCompression& operator=(TreeCompression&&) noexcept;

    bool record(Recorder& recorder);     ///< as TreeBuild's
    [[nodiscard]] bool isDone();         ///< likewise
    [[nodiscard]] bool isBroken() const; ///< likewise
    [[nodiscard]] Tree take();           ///< likewise

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
