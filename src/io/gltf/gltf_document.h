// SPDX-License-Identifier: MIT
// What the parts of the glTF loader share. Other code uses gltf_loader.h.
#pragma once

#include "core/base/input_error.h"
#include "io/gltf/gltf_rig_source.h"
#include "io/gltf/third_party_tinygltf.h"
#include "zvo/error.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

/// Error{Input}: path and text, on one line (inputError).
Error gltfError(const std::filesystem::path& path, std::string_view text);

/// Collects what is left out of a scene: each kind once, with the number of places and the first of them.
class GltfWarnings
{
public:
    void add(const std::string& kind, const std::string& where);

    /// One line for each kind, in the order in which they came up, beginning with the path.
    [[nodiscard]] std::vector<std::string> lines(const std::filesystem::path& path) const;

private:
    struct Entry
    {
        std::string kind;
        std::string where;
        std::size_t count = 0;
    };

    std::vector<Entry> m_entries;
    std::map<std::string, std::size_t> m_by_kind; // index into m_entries
};

/// A fault in a part of a document that is an error only for who needs that part.
struct GltfFault
{
    std::string text; // "accessors[3] has no count; ..."
    bool is_told = false;
};

/// Faults by the part that has them: "accessors[3]".
using GltfFaults = std::map<std::string, GltfFault>;

/// An image as the document names it: in a file or data URI, or in a buffer view.
struct GltfImageSource
{
    std::string name;
    std::string uri;
    int buffer_view = -1;
};

/// A buffer view whose bytes EXT_meshopt_compression packs.
struct GltfPackedView
{
    std::size_t buffer = 0;         // that has the packed data
    std::uint64_t offset_bytes = 0; // of it
    std::uint64_t length_bytes = 0;
    std::uint64_t count = 0; // elements
    std::uint64_t stride_bytes = 0;
    std::uint64_t unpacked_bytes = 0; // of the view
    std::string mode;
    std::string filter;
};

/// A parsed glTF 2.0 file: types and indices are checked, contents of accessors and images are not yet. Parts with
/// faults are empty; use() tells of them.
struct GltfDocument
{
    std::filesystem::path path;
    tinygltf::Model model; // without buffers, images, skins and animations, which are below
    std::vector<GltfImageSource> images;
    std::vector<GltfSkinSource> skins;
    std::vector<GltfAnimationSource> animations;
    std::vector<std::span<const std::uint8_t>> buffers;              // [buffers], byteLength bytes each
    std::vector<std::vector<std::uint8_t>> storage;                  // what the buffers lie in
    std::map<int, GltfPackedView> packed_views;                      // by buffer view
    mutable std::map<int, std::vector<std::uint8_t>> unpacked_views; // those that bufferView() has been asked for
    mutable std::uint64_t unpacked_bytes = 0;                        // countUnpacked() so far
    mutable GltfFaults faults;
    mutable GltfWarnings warnings;

    /// Throws Error{Input} if that part of the document, such as "accessors[3]", has a fault. Whoever needs the part
    /// calls it first.
    void use(const std::string& part) const;

    /// Warns of faults that nobody came across by use().
    void warnOfUnusedFaults() const;

    /// The bytes of a buffer view, unpacked. Throws Error{Input} where it leaves its buffer, does not
    /// unpack or has a fault.
    [[nodiscard]] std::span<const std::uint8_t> bufferView(int index) const;

    /// The bytes that a URI names: its own data, or a file in the document's folder or below. where: the property with
    /// the URI, for messages. Throws Error{Input}.
    [[nodiscard]] std::vector<std::uint8_t> readUri(const std::string& uri, const std::string& where) const;

    /// The file that a URI names, which lies in the document's folder or below. Throws Error{Input}.
    [[nodiscard]] std::filesystem::path fileOf(const std::string& uri, const std::string& where) const;

    /// The offset in the document's own file at which bytes stand; nothing where they are none of its bytes.
    [[nodiscard]] std::optional<std::uint64_t> offsetInFile(std::span<const std::uint8_t> bytes) const;

    /// Counts bytes that are made of fewer bytes in the file, on the way to the scene: what decoders allocate, unpacked
    /// views, zeros that the file leaves out. checkGltfSize() bounds the scene by the counts that accessors announce;
    /// these bytes come on top, and packed data announces counts of its own. Throws Error{Input} if their sum is out of
    /// proportion to the size of the file, or more than sceneBytesMax().
    void countUnpacked(std::uint64_t bytes, const std::string& where) const;

    [[nodiscard]] Error error(std::string_view text) const { return gltfError(path, text); }

    /// What an error of this document says, without the path.
    [[nodiscard]] std::string reason(const Error& error) const;

    [[nodiscard]] bool uses(std::string_view extension) const;
};

/// Parses a .gltf or .glb file, which are told apart by their content, and reads all its buffers. content: the bytes of
/// path; other files are looked for beside path. Throws Error{Input}.
GltfDocument openGltf(const std::filesystem::path& path, std::vector<std::uint8_t> content);

} // namespace zvo
