// SPDX-License-Identifier: MIT
#include "support/zvo_parts.h"

#include "io/file/sha256.h"

#include "core/base/crc64.h"

#include <algorithm>
#include <cstring>

namespace zvo::test
{

namespace
{

template <typename T> void append(Bytes& bytes, const T& value)
{
    const auto more = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), more.begin(), more.end());
}

void pad(Bytes& bytes)
{
    bytes.resize((bytes.size() + kZvoAlignment - 1) / kZvoAlignment * kZvoAlignment);
}

// The part of the section table that the file holds.
std::span<std::byte> tableBytes(Bytes& file, const ZvoHeader& header)
{
    const std::uint64_t room = (file.size() - sizeof(header)) / sizeof(ZvoSection);
    const std::uint64_t count = std::min<std::uint64_t>(header.section_count, room);
    return std::span(file).subspan(sizeof(header), count * sizeof(ZvoSection));
}

} // namespace

std::optional<ZvoParts> ZvoParts::split(std::span<const std::byte> file)
{
    ZvoParts parts;
    if (file.size() < sizeof(ZvoHeader))
    {
        return std::nullopt;
    }
    std::memcpy(&parts.header, file.data(), sizeof(ZvoHeader));
    if (parts.header.section_count > (file.size() - sizeof(ZvoHeader)) / sizeof(ZvoSection))
    {
        return std::nullopt;
    }
    for (std::uint32_t i = 0; i < parts.header.section_count; ++i)
    {
        Section section;
        std::memcpy(&section.entry, file.data() + sizeof(ZvoHeader) + i * sizeof(ZvoSection), sizeof(ZvoSection));
        if (section.entry.offset > file.size() || section.entry.bytes > file.size() - section.entry.offset)
        {
            return std::nullopt;
        }
        const auto content = file.subspan(section.entry.offset, section.entry.bytes);
        section.content.assign(content.begin(), content.end());
        parts.sections.push_back(std::move(section));
    }
    return parts;
}

Bytes ZvoParts::join() const
{
    std::vector<ZvoSection> table;
    Bytes body(sizeof(ZvoHeader) + sections.size() * sizeof(ZvoSection));
    for (const Section& section : sections)
    {
        pad(body);
        ZvoSection& entry = table.emplace_back(section.entry);
        entry.offset = body.size();
        entry.bytes = section.content.size();
        entry.checksum = crc64(section.content);
        body.insert(body.end(), section.content.begin(), section.content.end());
    }
    ZvoHeader joined = header;
    joined.section_count = static_cast<std::uint32_t>(table.size());
    joined.file_bytes = body.size();
    joined.table_checksum = crc64(std::as_bytes(std::span(table)));
    joined.header_checksum = headerChecksum(joined);
    Bytes start;
    append(start, joined);
    for (const ZvoSection& entry : table)
    {
        append(start, entry);
    }
    std::copy(start.begin(), start.end(), body.begin());
    return body;
}

ZvoParts::Section* ZvoParts::find(ZvoSectionId id)
{
    const auto found =
        std::find_if(sections.begin(), sections.end(),
                     [id](const Section& section) { return section.entry.id == static_cast<std::uint32_t>(id); });
    return found == sections.end() ? nullptr : &*found;
}

void fixHeadChecksums(Bytes& file)
{
    if (file.size() < sizeof(ZvoHeader))
    {
        return;
    }
    ZvoHeader header;
    std::memcpy(&header, file.data(), sizeof(header));
    header.table_checksum = crc64(tableBytes(file, header));
    header.header_checksum = headerChecksum(header);
    std::memcpy(file.data(), &header, sizeof(header));
}

void fixChecksums(Bytes& file)
{
    if (file.size() < sizeof(ZvoHeader))
    {
        return;
    }
    ZvoHeader header;
    std::memcpy(&header, file.data(), sizeof(header));
    const std::span<std::byte> table = tableBytes(file, header);
    for (std::size_t at = 0; at < table.size(); at += sizeof(ZvoSection))
    {
        ZvoSection entry;
        std::memcpy(&entry, table.data() + at, sizeof(entry));
        if (entry.offset <= file.size() && entry.bytes <= file.size() - entry.offset)
        {
            entry.checksum = crc64(std::span(file).subspan(entry.offset, entry.bytes));
        }
        std::memcpy(table.data() + at, &entry, sizeof(entry));
    }
    fixHeadChecksums(file);
}

Bytes zvoBytes(const TreeData& tree)
{
    Bytes bytes;
    writeZvo(tree, [&bytes](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    return bytes;
}

std::string zvoSha256(const TreeData& tree)
{
    return sha256Hex(zvoBytes(tree));
}

} // namespace zvo::test
