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

/// The properties of a tree.
struct TreeInfo
{
    TreeStructure structure = TreeStructure::Svo;
    AttributeFormat format = AttributeFormat::None;
    GridInfo grid;
    std::uint64_t voxel_count = 0;
    std::uint64_t node_count = 0; // stored nodes
    std::uint64_t bytes = 0;      // of device memory: nodes, leaf groups, lists, attributes, emission, kept sums
    float emission_scale = 0;     // 0: nothing emits light
};

/// An octree or a DAG in device memory, which does not change. Move-only. Like all objects that are made with a
/// Context, it throws Error{Usage} when it is used after it was taken over, moved from, or lost with its frame
/// (Context::frameLost()).
class ZVO_API Tree
{
public:
    /// Records the upload of a .zvo file (docs/file-format.md), in memory or on disk. Until the frame is done, staging
    /// buffers take as much memory again. Throws Error{Input}, one line, for a file that is not valid, and
    /// Error{Memory}. First and last stage: ALL_TRANSFER.
    Tree(Recorder& recorder, std::span<const std::byte> file);
    Tree(Recorder& recorder, const std::filesystem::path& path);
    ~Tree();
    Tree(Tree&& other) noexcept;
    Tree& operator=(Tree&& other) noexcept;

    [[nodiscard]] const TreeInfo& info() const;

    /// Device address of the table through which the host's shaders trace the tree (zvo/trace.glsl). The table lives as
    /// long as the tree. The host's shaders may read it, and the buffers that it names, after Recorder::makeVisible().
    [[nodiscard]] std::uint64_t address() const;

    struct Impl;
    ZVO_LOCAL explicit Tree(std::unique_ptr<Impl> impl);      // only for the library
    [[nodiscard]] Impl* impl() const { return m_impl.get(); } // only for the library; null once taken over
    ZVO_LOCAL std::unique_ptr<Impl> release();                // only for the library

private:
    std::unique_ptr<Impl> m_impl;
};

/// Options of a build.
struct TreeBuildInfo
{
    GridInfo grid;
    Coverage coverage = Coverage::Thin;
    AttributeFormat format = AttributeFormat::Bytes8; // None: no attributes
    bool keep_sums = false;       // for a DynamicTree with MergeRule::Average: 32 bytes a voxel more. Only with Bytes8
    Fill fill = Fill::None;       // also the voxels inside; of a grid of depth 3 or more
    Shell shell = Shell::Surface; // None: only what is inside; with Fill::Solid or Parity
};

/// Work that makes a tree in steps. Between steps zvo reads sizes that only the device knows, and allocates exactly
/// what is needed. Nothing waits: a step is recorded into a frame, and the next step into a frame that begins after
/// Context::frameDone() of the first.
///
///     while (job.record(recorder)) { submit; begin the next frame }
///     Tree tree = job.take();
///
/// The tree has the same bytes on every device, those that `zvo build` writes. First stages: ALL_TRANSFER,
/// COMPUTE_SHADER and DRAW_INDIRECT; last stages: COMPUTE_SHADER and ALL_TRANSFER; on resources of the job and of its
/// source.
class ZVO_API TreeJob
{
public:
    ~TreeJob();
    TreeJob(TreeJob&&) noexcept;
    TreeJob& operator=(TreeJob&&) noexcept;

    /// Records the next step, unless the device has not finished the last one. Returns false when there is no next
    /// step: the tree is complete. Throws Error{Memory} when the budget or the device's memory does not suffice; the
    /// same step can be tried again, unless the error came from the results of the last step (isBroken()). Throws
    /// Error{Usage} when the source was lost with its frame; then the job has failed.
    bool record(Recorder& recorder);

    /// Whether the tree is complete. Like record(), this reads the results of the last step, and throws as record().
    [[nodiscard]] bool isDone();

    /// Whether the job has failed for good.
    [[nodiscard]] bool isBroken() const;

    /// Hands out the tree. Call it once, when isDone() returns true.
    [[nodiscard]] Tree take();

    /// A model's triangles that were left out, by reason: "nonfinite", "out_of_range", "outside", "zero_area".
    [[nodiscard]] const std::map<std::string, std::uint64_t>& dropped() const;

    struct Impl; // only for the library

protected:
    ZVO_LOCAL TreeJob(std::unique_ptr<Impl> impl, const char* name); // only for the library

private:
    std::unique_ptr<Impl> m_impl;
    const char* m_name; // in messages
};

/// Voxelizes a model and builds its octree: about five steps, and two more for each size that was guessed too low.
class ZVO_API TreeBuild : public TreeJob
{
public:
    /// Throws Error{Usage} for a depth out of range, a grid whose corners are not finite, a voxel size that is not
    /// finite and above 0, attributes of a model that was uploaded without them, and a model that was lost.
    TreeBuild(Context& context, const Model& model, const TreeBuildInfo& info);
};

/// Options of algebra.
struct TreeAlgebraInfo
{
    TreeOperation operation = TreeOperation::Unite;
    bool corners = false;           // Keep, Dilate, Erode: neighbours are all 26, else the 6 across faces
    std::uint32_t voxels = 1;       // Dilate, Erode: how many times
    std::uint32_t largest = 0;      // Keep: so many components, the largest; 0: those of least_voxels or more
    std::uint64_t least_voxels = 1; // Keep with largest 0: components of so many voxels or more, at least 1
};

/// Makes an octree of one or two others, which stay as they are (docs/algebra.md): about four steps, more for
/// components, and as many again for each further voxel of a dilation or erosion.
class ZVO_API TreeAlgebra : public TreeJob
{
public:
    /// tree, other: octrees of one grid of depth 3 or more, with attributes of 8 bytes or none, both or neither. They
    /// outlive the job, and are not given to another object until it is done. other: of Unite, Intersect and Subtract;
    /// else null. Voxels have the attributes of tree, or else those of other. Throws Error{Usage} for other trees, and
    /// for two whose emission has different scales. First and last stage of the constructor: ALL_TRANSFER.
    TreeAlgebra(Recorder& recorder, const Tree& tree, const Tree* other, const TreeAlgebraInfo& info);
};

/// Makes a DAG of an octree: about three steps, and one more for each table that was too small.
class ZVO_API TreeCompression : public TreeJob
{
public:
    /// Takes the octree over. Its nodes are freed when the DAG is complete. Throws Error{Usage} for a tree that is a
    /// DAG already.
    TreeCompression(Context& context, Tree&& octree);
};

} // namespace zvo
