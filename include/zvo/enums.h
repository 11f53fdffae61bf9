// SPDX-License-Identifier: MIT
// The enumerations of both interfaces. In C they are integers of a fixed size, so that every value is one that can be
// refused; in C++ each is an enum class with the same values.
#pragma once

#include <stdint.h>

/// Whether a function of the C interface succeeded, and if not, why. The errors are the exit codes of the command line
/// program.
typedef int32_t ZvoResult;
enum
{
    ZVO_OK = 0,
    ZVO_ERROR_OTHER = 1,  ///< a failure that is none of the below, such as a lost device
    ZVO_ERROR_USAGE = 2,  ///< the caller asked for something that does not exist or contradicts itself
    ZVO_ERROR_INPUT = 3,  ///< a file that is missing, broken or not supported
    ZVO_ERROR_OUTPUT = 4, ///< a file that could not be written
    ZVO_ERROR_DEVICE = 5, ///< no Vulkan device that will do
    ZVO_ERROR_MEMORY = 6  ///< the memory limit, or the memory of device or host, does not suffice
};

/// What a message is about. Failures are no messages: functions return them in C, and throw them in C++.
typedef uint32_t ZvoLogSeverity;
enum
{
    ZVO_LOG_DEBUG = 0,  ///< what zvo does: kernels compiled, memory taken and returned
    ZVO_LOG_INFO = 1,   ///< what it does without, as the device has it not
    ZVO_LOG_WARNING = 2 ///< what is refused, and what may be wrong
};

/// Which voxels a triangle covers (docs/voxelization.md).
typedef uint32_t ZvoCoverage;
enum
{
    ZVO_COVERAGE_CONSERVATIVE = 0, ///< every voxel whose closed box has a point in common with the triangle
    ZVO_COVERAGE_THIN = 1          ///< 6-separating: no path along the voxels' faces leads through the surface
};

/// Which voxels of the surface there are where voxels are filled (docs/voxelization.md#filling).
typedef uint32_t ZvoShell;
enum
{
    ZVO_SHELL_SURFACE = 0, ///< all that triangles cover
    ZVO_SHELL_NONE = 1     ///< those that are inside by their centres, as all others are
};

/// Which voxels count as inside the triangles, by the winding number of their centres (docs/voxelization.md#filling).
typedef uint32_t ZvoFill;
enum
{
    ZVO_FILL_NONE = 0,   ///< no voxel: the surface is all there is
    ZVO_FILL_SOLID = 1,  ///< those whose winding number is not 0
    ZVO_FILL_PARITY = 2, ///< those whose winding number is odd
    ZVO_FILL_ROBUST = 3  ///< as solid, by what most rays and neighbours say: for surfaces that are not closed
};

/// Operations that make a tree of one or two others (docs/algebra.md).
typedef uint32_t ZvoTreeOperation;
enum
{
    ZVO_TREE_OPERATION_UNITE = 0,     ///< voxels of either tree
    ZVO_TREE_OPERATION_INTERSECT = 1, ///< voxels of both trees
    ZVO_TREE_OPERATION_SUBTRACT = 2,  ///< voxels that the other tree does not have
    ZVO_TREE_OPERATION_KEEP = 3,      ///< connected components that are large
    ZVO_TREE_OPERATION_ENCLOSE = 4,   ///< also what no way across faces of empty cells leads to from outside the grid
    ZVO_TREE_OPERATION_DILATE = 5,    ///< also the neighbours of voxels
    ZVO_TREE_OPERATION_ERODE = 6      ///< voxels all of whose neighbours in the grid are voxels
};

/// How the nodes of a tree are connected. The values are those in files (docs/file-format.md).
typedef uint32_t ZvoTreeStructure;
enum
{
    ZVO_TREE_STRUCTURE_SVO = 1,  ///< each node has children of its own, which stand together
    ZVO_TREE_STRUCTURE_SVDAG = 2 ///< equal subtrees are stored once; children are named in lists
};

/// The format in which trees store the attributes of voxels and nodes (docs/attributes.md). The values are those of
/// shaders.
typedef uint32_t ZvoAttributeFormat;
enum
{
    ZVO_ATTRIBUTE_FORMAT_NONE = 0,   ///< no attributes: all voxels look alike
    ZVO_ATTRIBUTE_FORMAT_BYTES4 = 1, ///< colours of 16 bits, normals of 16
    ZVO_ATTRIBUTE_FORMAT_BYTES8 = 2, ///< colours of 24 bits, normals of 30: the format in which attributes are made
    ZVO_ATTRIBUTE_FORMAT_BLOCKS = 3  ///< 16 voxels in 24 bytes; nodes as BYTES4
};

/// The attributes of a voxel that both a dynamic object and the static tree have.
typedef uint32_t ZvoMergeRule;
enum
{
    ZVO_MERGE_RULE_AVERAGE = 0,      ///< the mean over the fragments of both, as if they were one scene
    ZVO_MERGE_RULE_DYNAMIC_WINS = 1, ///< the mean over the fragments of the dynamic objects
    ZVO_MERGE_RULE_STATIC_WINS = 2   ///< those of the static tree
};

/// What a picture shows.
typedef uint32_t ZvoView;
enum
{
    ZVO_VIEW_COLOR = 0,      ///< lit by sun and sky
    ZVO_VIEW_ALBEDO = 1,     ///< base colour alone
    ZVO_VIEW_NORMAL = 2,     ///< shading normal
    ZVO_VIEW_DEPTH = 3,      ///< near is white, the far end of the grid dark
    ZVO_VIEW_LEVEL = 4,      ///< brighter is coarser
    ZVO_VIEW_ITERATIONS = 5, ///< heat map of the traversal's loop
    ZVO_VIEW_VOXEL = 6,      ///< a colour for each voxel
    ZVO_VIEW_BRICKS = 7,     ///< base colour with the borders of nodes: leaves white, larger ones yellow and red
    ZVO_VIEW_ORIGIN = 8      ///< orange: leaves that a dynamic update has made; only in trees with attributes
};

/// How the light of a lit picture is shown.
typedef uint32_t ZvoShading;
enum
{
    ZVO_SHADING_SMOOTH = 0, ///< by the normals of voxels: slopes of voxels look like planes
    ZVO_SHADING_FACES = 1   ///< by the faces of voxels; so are those without attributes
};

typedef uint32_t ZvoBrushShape;
enum
{
    ZVO_BRUSH_SHAPE_SPHERE = 0, ///< voxels whose centres are less than radius + 1/2 voxels away
    ZVO_BRUSH_SHAPE_BOX = 1     ///< voxels at most radius away along each axis
};

typedef uint32_t ZvoBrushAction;
enum
{
    ZVO_BRUSH_ACTION_CARVE = 0, ///< takes voxels away
    ZVO_BRUSH_ACTION_FILL = 1,  ///< makes voxels where there are none; they face away from the brush's centre
    ZVO_BRUSH_ACTION_PAINT = 2  ///< gives voxels another colour, and takes their emission away; nothing without
                                ///< attributes
};

/// Questions to a tree (zvo/query.h).
typedef uint32_t ZvoQueryKind;
enum
{
    ZVO_QUERY_KIND_POINT = 0,   ///< the voxel that a point is in
    ZVO_QUERY_KIND_RAY = 1,     ///< the first voxel that a ray hits
    ZVO_QUERY_KIND_BOX = 2,     ///< a voxel in a box
    ZVO_QUERY_KIND_NEAREST = 3, ///< the nearest voxel to a point
    ZVO_QUERY_KIND_SWEEP = 4    ///< the first voxel that a box meets which moves
};

typedef uint32_t ZvoQueryState;
enum
{
    ZVO_QUERY_STATE_NOTHING = 0,  ///< there is no such voxel
    ZVO_QUERY_STATE_FOUND = 1,    ///< there is
    ZVO_QUERY_STATE_UNDECIDED = 2 ///< the walk through the tree took too long (docs/queries.md)
};

/// How texture coordinates outside of an image are treated.
typedef uint32_t ZvoWrapMode;
enum
{
    ZVO_WRAP_MODE_REPEAT = 0,
    ZVO_WRAP_MODE_MIRRORED_REPEAT = 1,
    ZVO_WRAP_MODE_CLAMP_TO_EDGE = 2
};

typedef uint32_t ZvoAlphaMode;
enum
{
    ZVO_ALPHA_MODE_OPAQUE = 0, ///< alpha is ignored
    ZVO_ALPHA_MODE_MASK = 1,   ///< a fragment whose alpha is below the cutoff does not exist
    ZVO_ALPHA_MODE_BLEND = 2   ///< a fragment exists in proportion to its alpha, by ordered dither on the voxel's
                               ///< coordinates
};

/// The number of a texture that a material does not have.
#define ZVO_NO_TEXTURE UINT32_MAX

#ifdef __cplusplus

namespace zvo
{

/// Why an operation failed.
enum class ErrorCode : ZvoResult
{
    Other = ZVO_ERROR_OTHER,
    Usage = ZVO_ERROR_USAGE,
    Input = ZVO_ERROR_INPUT,
    Output = ZVO_ERROR_OUTPUT,
    Device = ZVO_ERROR_DEVICE,
    Memory = ZVO_ERROR_MEMORY,
};

enum class LogSeverity : ZvoLogSeverity
{
    Debug = ZVO_LOG_DEBUG,
    Info = ZVO_LOG_INFO,
    Warning = ZVO_LOG_WARNING,
};

enum class Coverage : ZvoCoverage
{
    Conservative = ZVO_COVERAGE_CONSERVATIVE,
    Thin = ZVO_COVERAGE_THIN,
};

enum class Fill : ZvoFill
{
    None = ZVO_FILL_NONE,
    Solid = ZVO_FILL_SOLID,
    Parity = ZVO_FILL_PARITY,
    Robust = ZVO_FILL_ROBUST,
};

enum class Shell : ZvoShell
{
    Surface = ZVO_SHELL_SURFACE,
    None = ZVO_SHELL_NONE,
};

enum class TreeOperation : ZvoTreeOperation
{
    Unite = ZVO_TREE_OPERATION_UNITE,
    Intersect = ZVO_TREE_OPERATION_INTERSECT,
    Subtract = ZVO_TREE_OPERATION_SUBTRACT,
    Keep = ZVO_TREE_OPERATION_KEEP,
    Enclose = ZVO_TREE_OPERATION_ENCLOSE,
    Dilate = ZVO_TREE_OPERATION_DILATE,
    Erode = ZVO_TREE_OPERATION_ERODE,
};

enum class TreeStructure : ZvoTreeStructure
{
    Svo = ZVO_TREE_STRUCTURE_SVO,
    Svdag = ZVO_TREE_STRUCTURE_SVDAG,
};

enum class AttributeFormat : ZvoAttributeFormat
{
    None = ZVO_ATTRIBUTE_FORMAT_NONE,
    Bytes4 = ZVO_ATTRIBUTE_FORMAT_BYTES4,
    Bytes8 = ZVO_ATTRIBUTE_FORMAT_BYTES8,
    Blocks = ZVO_ATTRIBUTE_FORMAT_BLOCKS,
};

enum class MergeRule : ZvoMergeRule
{
    Average = ZVO_MERGE_RULE_AVERAGE,
    DynamicWins = ZVO_MERGE_RULE_DYNAMIC_WINS,
    StaticWins = ZVO_MERGE_RULE_STATIC_WINS,
};

enum class View : ZvoView
{
    Color = ZVO_VIEW_COLOR,
    Albedo = ZVO_VIEW_ALBEDO,
    Normal = ZVO_VIEW_NORMAL,
    Depth = ZVO_VIEW_DEPTH,
    Level = ZVO_VIEW_LEVEL,
    Iterations = ZVO_VIEW_ITERATIONS,
    Voxel = ZVO_VIEW_VOXEL,
    Bricks = ZVO_VIEW_BRICKS,
    Origin = ZVO_VIEW_ORIGIN,
};

enum class Shading : ZvoShading
{
    Smooth = ZVO_SHADING_SMOOTH,
    Faces = ZVO_SHADING_FACES,
};

enum class BrushShape : ZvoBrushShape
{
    Sphere = ZVO_BRUSH_SHAPE_SPHERE,
    Box = ZVO_BRUSH_SHAPE_BOX,
};

enum class BrushAction : ZvoBrushAction
{
    Carve = ZVO_BRUSH_ACTION_CARVE,
    Fill = ZVO_BRUSH_ACTION_FILL,
    Paint = ZVO_BRUSH_ACTION_PAINT,
};

enum class QueryKind : ZvoQueryKind
{
    Point = ZVO_QUERY_KIND_POINT,
    Ray = ZVO_QUERY_KIND_RAY,
    Box = ZVO_QUERY_KIND_BOX,
    Nearest = ZVO_QUERY_KIND_NEAREST,
    Sweep = ZVO_QUERY_KIND_SWEEP,
};

enum class QueryState : ZvoQueryState
{
    Nothing = ZVO_QUERY_STATE_NOTHING,
    Found = ZVO_QUERY_STATE_FOUND,
    Undecided = ZVO_QUERY_STATE_UNDECIDED,
};

enum class WrapMode : ZvoWrapMode
{
    Repeat = ZVO_WRAP_MODE_REPEAT,
    MirroredRepeat = ZVO_WRAP_MODE_MIRRORED_REPEAT,
    ClampToEdge = ZVO_WRAP_MODE_CLAMP_TO_EDGE,
};

enum class AlphaMode : ZvoAlphaMode
{
    Opaque = ZVO_ALPHA_MODE_OPAQUE,
    Mask = ZVO_ALPHA_MODE_MASK,
    Blend = ZVO_ALPHA_MODE_BLEND,
};

} // namespace zvo

#endif
