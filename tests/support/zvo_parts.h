// SPDX-License-Identifier: MIT
// The parts of a `.zvo` file, to be changed and put together again with correct sizes, offsets and checksums. So the
// only fault of such a file is the change.
#pragma once

#include "core/file/zvo_file.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace zvo::test
{

using Bytes = std::vector<std::byte>;

struct ZvoParts
{
    struct Section
    {
        ZvoSection entry; // join() recomputes offset, bytes and checksum
        Bytes content;
    };

    ZvoHeader header;
    std::vector<Section> sections;

    /// Returns nothing if the file is shorter than its header or table says.
    static std::optional<ZvoParts> split(std::span<const std::byte> file);

    /// Keeps counts of elements, ids and everything else.
    [[nodiscard]] Bytes join() const;

    /// The section with that id, or null.
    Section* find(ZvoSectionId id);
};

/// Corrects the checksums of a file's table and header, whatever its sections are. The table is as long as the header
/// says, but ends with the file.
void fixHeadChecksums(Bytes& file);

/// Corrects all checksums of a file whose table and sections lie where the header says. Parts outside of the file are
/// skipped.
void fixChecksums(Bytes& file);

/// The bytes that writeZvo writes, and their SHA-256.
Bytes zvoBytes(const TreeData& tree);
std::string zvoSha256(const TreeData& tree);

} // namespace zvo::test
