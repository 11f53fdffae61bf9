// SPDX-License-Identifier: MIT
#include "fuzz/tree_mutator.h"

#include "support/tree_samples.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace zvo::test
{

namespace
{

// Another number: a near one, a far one, or one at a limit.
template <typename T> T changedNumber(T value, std::mt19937& random)
{
    constexpr T kMax = static_cast<T>(~T{0});
    switch (random() % 8)
    {
    case 0:
        return value + 1;
    case 1:
        return value - 1;
    case 2:
        return value ^ static_cast<T>(T{1} << (random() % (8 * sizeof(T))));
    case 3:
        return value + static_cast<T>(random() % 64);
    case 4:
        return kMax - static_cast<T>(random() % 3);
    case 5:
        return static_cast<T>(kMax / 2 + random() % 3);
    case 6:
        return static_cast<T>(random() % 256);
    default:
        return static_cast<T>((std::uint64_t{random()} << 32) | random());
    }
}

template <typename T> void changeWord(std::span<std::byte> bytes, std::mt19937& random)
{
    if (bytes.size() < sizeof(T))
    {
        return;
    }
    std::byte* const word = bytes.data() + random() % (bytes.size() / sizeof(T)) * sizeof(T);
    const std::byte* const other = bytes.data() + random() % (bytes.size() / sizeof(T)) * sizeof(T);
    T value{};
    std::memcpy(&value, random() % 4 == 0 ? other : word, sizeof(T)); // sometimes two words become equal
    value = random() % 4 == 0 ? value : changedNumber(value, random);
    std::memcpy(word, &value, sizeof(T));
}

void changeWords(std::span<std::byte> bytes, std::mt19937& random)
{
    for (std::size_t rest = 1 + random() % 3; rest != 0; --rest)
    {
        random() % 3 == 0 ? changeWord<std::uint64_t>(bytes, random) : changeWord<std::uint32_t>(bytes, random);
    }
}

TreeData soundTree(std::mt19937& random)
{
    const std::uint32_t depth = 1 + random() % 7;
    std::vector<std::uint64_t> codes(random() % 200);
    const std::uint64_t repeat = random() % 2 == 0 ? 0 : 0777; // sometimes with equal parts
    std::generate(codes.begin(), codes.end(),
                  [&]
                  {
                      const std::uint64_t code = (std::uint64_t{random()} << 32 | random()) & ~repeat;
                      return (code | (random() % 5 & repeat)) & ((std::uint64_t{1} << (3 * depth)) - 1);
                  });
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    TreeData tree = octreeOf(codes, depth);
    if (!codes.empty() && random() % 2 == 0)
    {
        addAttributes(tree);
    }
    tree = random() % 2 == 0 ? tree : dagOf(tree);
    if (!tree.hasAttributes() || random() % 2 == 0)
    {
        return tree;
    }
    return packedTree(tree, random() % 2 == 0 ? AttributeFormat::Bytes4 : AttributeFormat::Blocks);
}

void changeSections(ZvoParts& parts, std::mt19937& random)
{
    if (parts.sections.empty())
    {
        return;
    }
    const std::size_t at = random() % parts.sections.size();
    const std::size_t other = random() % parts.sections.size();
    switch (random() % 4)
    {
    case 0:
        parts.sections.erase(parts.sections.begin() + static_cast<std::ptrdiff_t>(at));
        break;
    case 1:
        parts.sections.insert(parts.sections.begin() + static_cast<std::ptrdiff_t>(at), parts.sections[other]);
        break;
    case 2:
        std::swap(parts.sections[at], parts.sections[other]);
        break;
    default:
        parts.sections[at].content = parts.sections[other].content;
    }
}

// Changes the bytes of a section. Its count fits them if it did before.
void changeContent(ZvoParts::Section& section, const MutateBytes& mutate)
{
    const std::size_t size = section.content.size();
    const std::uint64_t width = section.entry.count == 0 ? 1 : std::max<std::uint64_t>(size / section.entry.count, 1);
    section.content.resize(size + size / 4 + 16);
    section.content.resize(
        mutate(reinterpret_cast<std::uint8_t*>(section.content.data()), size, section.content.size()));
    section.content.resize(section.content.size() / width * width);
    section.entry.count = section.content.size() / width;
}

} // namespace

Bytes mutateTree(std::span<const std::byte> file, std::mt19937& random, const MutateBytes& mutate)
{
    std::optional<ZvoParts> parts = ZvoParts::split(file);
    const std::uint32_t choice = random() % 16;
    if (!parts || choice == 0)
    {
        return zvoBytes(soundTree(random));
    }
    if (choice == 1)
    {
        Bytes bytes(file.begin(), file.end());
        changeWords(std::span(bytes).first(std::min<std::size_t>(bytes.size(), 600)), random);
        fixChecksums(bytes);
        return bytes;
    }
    if (choice < 4 || parts->sections.empty())
    {
        const std::span<std::byte> header = std::as_writable_bytes(std::span(&parts->header, 1));
        changeWords(header.subspan(offsetof(ZvoHeader, structure)), random);
        return parts->join();
    }
    ZvoParts::Section& section = parts->sections[random() % parts->sections.size()];
    if (choice == 4)
    {
        changeSections(*parts, random);
    }
    else if (choice == 5)
    {
        changeWords(std::as_writable_bytes(std::span(&section.entry, 1)), random);
    }
    else if (choice < 8)
    {
        changeContent(section, mutate);
    }
    else
    {
        changeWords(section.content, random);
    }
    return parts->join();
}

} // namespace zvo::test
