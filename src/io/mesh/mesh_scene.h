// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "core/scene/scene_size.h"
#include "io/image/image_io.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace zvo
{

/// The file that a mesh file names, or another file beside it (named_in): as it is named, below the folder of either,
/// or else by its last component there. Names may have the slashes of Windows. Nothing if there is no such file in the
/// folder of mesh or below, after all links.
std::optional<std::filesystem::path> findBeside(const std::filesystem::path& mesh,
                                                const std::filesystem::path& named_in, std::string name);

/// What a warning says where findBeside() finds nothing.
inline constexpr const char* kNotBeside = "there is no such file in the file's folder or below; put it there";

/// The scene of a mesh file while it is read. path: stays with the caller.
class MeshScene
{
public:
    MeshScene(const std::filesystem::path& path, ImageDecoding decoding) : m_path(path), m_decoding(decoding) {}

    /// Adds a warning about a kind of what is left out of the file, once, with the first of it.
    void warn(const std::string& kind, std::string_view first = "");

    /// Adds a primitive with an instance and a material of its own.
    void add(Primitive primitive, Material material = {}, const std::string& name = "default");

    /// Adds a texture of the picture that is named in the file named_in; returns its index. Nothing for no name, and,
    /// with a warning, for a picture that cannot be used.
    std::optional<std::uint32_t> addTexture(const std::string& name, const std::filesystem::path& named_in,
                                            WrapMode wrap);

    /// The scene. Where it has no triangles its vertices become points; without any there is a warning. Throws
    /// Error{Input} where primitives are too many or too long.
    Scene finish();

private:
    const std::filesystem::path& m_path;
    ImageDecoding m_decoding;
    std::uint64_t m_image_bytes_left = sceneBytesMax();
    std::map<std::filesystem::path, std::optional<std::uint32_t>> m_images;
    std::set<std::string> m_warned; // kinds
    Scene m_scene;
};

} // namespace zvo
