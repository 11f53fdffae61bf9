// SPDX-License-Identifier: MIT
// Small types that all of zvo shares. Vectors and matrices are plain arrays, so that those of any maths library can be
// copied.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace zvo
{

using Vec2 = std::array<float, 2>;
using Vec3 = std::array<float, 3>;
using Vec4 = std::array<float, 4>;
using DVec3 = std::array<double, 3>;

/// An affine transform of columns: element (row, column) is [4 * column + row], the last row is (0, 0, 0, 1).
using Mat4 = std::array<float, 16>;
using DMat4 = std::array<double, 16>;

inline constexpr Mat4 kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Which voxels a triangle covers (docs/voxelization.md).
enum class Coverage
{
    Conservative, ///< every voxel whose closed box has a point in common with the triangle
    Thin          ///< 6-separating: no path along the voxels' faces leads through the surface
};

/// How the nodes of a tree are connected. The values are those in files (docs/file-format.md).
enum class TreeStructure : std::uint32_t
{
    Svo = 1,  ///< each node has children of its own, which stand together
    Svdag = 2 ///< equal subtrees are stored once; children are named in lists
};

/// The format in which trees store the attributes of voxels and nodes (docs/attributes.md). The values are those of
/// shaders.
enum class AttributeFormat : std::uint32_t
{
    None = 0,   ///< no attributes: all voxels look alike
    Bytes4 = 1, ///< colours of 16 bits, normals of 16
    Bytes8 = 2, ///< colours of 24 bits, normals of 30: the format in which attributes are made
    Blocks = 3, ///< 16 voxels in 24 bytes; nodes as Bytes4
};

/// The attributes of a voxel that both a dynamic object and the static tree have.
enum class MergeRule : std::uint32_t
{
    Average = 0,     ///< the mean over the fragments of both, as if they were one scene
    DynamicWins = 1, ///< the mean over the fragments of the dynamic objects
    StaticWins = 2,  ///< those of the static tree
};

/// What a picture shows.
enum class View : std::uint32_t
{
    Color = 0,      ///< lit by sun and sky
    Albedo = 1,     ///< base colour alone
    Normal = 2,     ///< shading normal
    Depth = 3,      ///< near is white, the far end of the grid dark
    Level = 4,      ///< brighter is coarser
    Iterations = 5, ///< heat map of the traversal's loop
    Voxel = 6,      ///< a colour for each voxel
    Bricks = 7,     ///< base colour with the borders of nodes: leaves white, larger ones yellow and red
    Origin = 8,     ///< orange: leaves that a dynamic update has made; only in trees with attributes
};

enum class BrushShape : std::uint32_t
{
    Sphere = 0, ///< voxels whose centres are less than radius + 1/2 voxels away
    Box = 1,    ///< voxels at most radius away along each axis
};

enum class BrushAction : std::uint32_t
{
    Carve = 0, ///< takes voxels away
    Fill = 1,  ///< makes voxels where there are none; they face away from the brush's centre
    Paint = 2, ///< gives voxels another colour, and takes their emission away; nothing without attributes
};

/// How texture coordinates outside of an image are treated.
enum class WrapMode : std::uint32_t
{
    Repeat,
    MirroredRepeat,
    ClampToEdge
};

enum class AlphaMode : std::uint32_t
{
    Opaque, ///< alpha is ignored
    Mask,   ///< a fragment whose alpha is below the cutoff does not exist
    Blend   ///< a fragment exists in proportion to its alpha, by ordered dither on the voxel's coordinates
};

/// A cube of (1 << depth)^3 voxels. Voxel (x, y, z) is the box of edge voxel_size whose minimum corner is origin +
/// voxel_size * (x, y, z).
struct GridInfo
{
    Vec3 origin{};           // world position of the minimum corner
    float voxel_size = 1.0F; // world units
    std::uint32_t depth = 8; // 1 to 17
};

/// The device's time of one pass.
struct PassTime
{
    std::string name; // "operation/kernel", or "fill", "copy" and so on with a buffer's name
    double ms = 0;
};

} // namespace zvo
