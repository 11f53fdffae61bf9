// SPDX-License-Identifier: MIT
// Questions to a tree, in lists of one kind (docs/queries.md).
//
// Positions are integers, on the lattice of 256 units a voxel from the grid's minimum corner on: latticePosition()
// gives them. Voxel c is the cube from 256 * c to 256 * (c + 1). Numbers beyond 2^27 lattice units, which is 2^19
// voxels, and boxes whose high corner is not above the low one on each axis find nothing. Of equals, the first voxel in
// Morton order is the answer.
#pragma once

#include "zvo/context.h"
#include "zvo/dynamic_tree.h"
#include "zvo/export.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <variant>

namespace zvo
{

/// A position on the lattice, in 256ths of a voxel.
using LatticePosition = std::array<std::int32_t, 3>;

/// Edge of a voxel in lattice units.
inline constexpr std::int32_t kLatticeVoxel = 256;

/// Which voxel is the point in: that whose cell is position / 256, rounded down.
struct PointQuery
{
    LatticePosition position{};
};

/// The first voxel that a ray enters, or begins in, at t_min to t_max, in lengths of direction. World space. Those with
/// numbers that are NaN, or infinite but for t_max, find nothing.
struct RayQuery
{
    Vec3 origin{};
    float t_min = 0;
    Vec3 direction = {0, 0, 1}; // any length
    float t_max = std::numeric_limits<float>::infinity();
};

/// The first voxel in Morton order whose inside has a point in common with the inside of a box: what only touches it is
/// outside. None: the box is empty.
struct BoxQuery
{
    LatticePosition low{};
    LatticePosition high{};
};

/// The voxel with the least distance from the point, to its cube with its faces: 0 inside and on faces.
struct NearestQuery
{
    LatticePosition position{};
    std::uint32_t reach = UINT32_MAX; // lattice units: no voxel counts that is farther away; one at this distance does
};

/// The first voxel that a box meets as it moves by `motion` in a line, such as a character in a game: whose inside has
/// a point in common with that of the box at a time below 1. The box may touch voxels, and slide along them; at time 1
/// it may come to touch one. Time is 0 at the start and 1 at the end.
struct SweepQuery
{
    LatticePosition low{};
    LatticePosition high{};
    LatticePosition motion{};
};

/// A list of questions of one kind.
using QueryList = std::variant<std::span<const PointQuery>, std::span<const RayQuery>, std::span<const BoxQuery>,
                               std::span<const NearestQuery>, std::span<const SweepQuery>>;

/// The face of an answer that has none: point, box and nearest; a ray or a sweep that begins inside of the voxel.
inline constexpr std::uint32_t kQueryInside = 3;

/// What a question comes to. Unless a voxel was found, all but the state is 0.
struct QueryAnswer
{
    QueryState state = QueryState::Nothing;
    std::array<std::uint32_t, 3> cell{}; // of the voxel
    std::uint32_t face = 0; // by which a ray or box came: its axis, 0 to 2, the last one of equal times; kQueryInside
    float t = 0;            // ray: as in RayQuery; nearest: distance in world units; sweep: time; rounded
    std::int64_t numerator = 0;   // nearest: squared distance in lattice units; sweep: time is numerator / denominator
    std::int64_t denominator = 0; // sweep: what the box moves along the face's axis, at least 1; others: 1
    std::uint32_t color = 0;      // sRGB red | green << 8 | blue << 16; 0 without attributes, as what follows
    Vec3 normal{};                // length 1; 0 where there is none
    Vec3 emission{};              // linear radiance
    std::uint32_t index = 0;      // of the voxel's attributes: its number among those of the tree
};

/// The lattice position of a point in world space: 256 * (world - origin) / voxel_size in double precision, rounded
/// down. Beyond 2^27, and for NaN, a number that finds nothing.
[[nodiscard]] ZVO_API LatticePosition latticePosition(const GridInfo& grid, const DVec3& world);

/// A list of questions that a frame asks a tree, and their answers, once the frame is done.
class ZVO_API QueryBatch
{
public:
    /// Records the passes that ask queries of a tree, as the recording shows it, and the copy of the answers. queries
    /// are not needed after the call; at most 2^24, and none is allowed. Memory: of each question 28 bytes, and its own
    /// size twice, on the device; once more each until the frame is done. First stages: ALL_TRANSFER, COMPUTE_SHADER
    /// and DRAW_INDIRECT; last stage: COPY, on resources of zvo. Cost: of a point, a load a level of nodes; of others,
    /// their iterations.
    ///
    /// Throws Error{Usage} for more queries, and as Tracer::trace() for trees; Error{Memory}, and what making a kernel
    /// throws; then there is no batch.
    QueryBatch(Recorder& recorder, const Tree& tree, const QueryList& queries);
    QueryBatch(Recorder& recorder, DynamicTree& tree, const QueryList& queries);
    ~QueryBatch();
    QueryBatch(QueryBatch&&) noexcept;
    QueryBatch& operator=(QueryBatch&&) noexcept;

    /// Number of questions.
    [[nodiscard]] std::size_t size() const;

    /// Whether the device is done with the frame (Context::frameDone()): there are answers.
    [[nodiscard]] bool isDone() const;

    /// Of so many questions from one on, the answers, in their order. Does not wait: throws Error{Usage} unless
    /// isDone(), for questions that there are not, and where the frame was lost.
    void answers(std::size_t first, std::span<QueryAnswer> answers) const;

    struct Impl;                                              // only for the library
    [[nodiscard]] Impl* impl() const { return m_impl.get(); } // likewise

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
