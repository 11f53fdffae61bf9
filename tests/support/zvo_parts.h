// SPDX-License-Identifier: MIT
// A `.zvo` file taken apart, to be changed and put together with right sizes, offsets and checksums: what is wrong with
// it then is what was changed.
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
        ZvoSection entry; // offset, bytes and checksum are made anew by join()
        Bytes content;
    };

    ZvoHeader header;
    std::vector<Section> sections;

    /// Nothing where the bytes are too few for what they announce.
    static std::optional<ZvoParts> split(std::span<const std::byte> file);

    /// Leaves counts of elements, ids and everything else as they are.
    [[nodiscard]] Bytes join() const;

    /// The section of that id, or null.
    Section* find(ZvoSectionId id);
};

/// Puts right the checksums of a file's table and header, whatever its sections are; the table is as long as the header
/// says and the file has room for.
void fixHeadChecksums(Bytes& file);

/// Puts right the checksums of a file whose table and sections lie where the header says; what lies outside of the file
/// is left out.
void fixChecksums(Bytes& file);

/// What writeZvo writes, and its SHA-256.
Bytes zvoBytes(const TreeData& tree);
std::string zvoSha256(const TreeData& tree);

} // namespace zvo::test
