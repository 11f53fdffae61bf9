// SPDX-License-Identifier: MIT
#include "support/spirv_structs.h"

#include <spirv/unified1/spirv.hpp11>

#include <stdexcept>

namespace zvo::test
{

namespace
{

constexpr std::size_t kHeaderWords = 5;

// Decodes a string: UTF-8, four bytes a word, first byte lowest, zero-terminated.
std::string text(std::span<const std::uint32_t> words)
{
    std::string result;
    for (const std::uint32_t word : words)
    {
        for (int shift = 0; shift < 32; shift += 8)
        {
            const char letter = static_cast<char>(word >> shift);
            if (letter == '\0')
            {
                return result;
            }
            result += letter;
        }
    }
    return result;
}

} // namespace

std::map<std::string, std::map<std::string, std::uint32_t>> structOffsets(std::span<const std::uint32_t> words)
{
    if (words.size() < kHeaderWords || words[0] != spv::MagicNumber)
    {
        throw std::runtime_error("not a SPIR-V module");
    }
    std::map<std::uint32_t, std::string> names;                                  // struct id
    std::map<std::uint32_t, std::map<std::uint32_t, std::string>> member_names;  // struct id, member index
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> all_offsets; // struct id, member index
    for (std::size_t at = kHeaderWords; at < words.size();)
    {
        const std::uint32_t length = words[at] >> spv::WordCountShift;
        if (length == 0 || length > words.size() - at)
        {
            throw std::runtime_error("a SPIR-V instruction does not fit");
        }
        const auto op = static_cast<spv::Op>(words[at] & spv::OpCodeMask);
        const std::span<const std::uint32_t> operands = words.subspan(at + 1, length - 1);
        if (op == spv::Op::OpName && operands.size() >= 2)
        {
            names[operands[0]] = text(operands.subspan(1));
        }
        else if (op == spv::Op::OpMemberName && operands.size() >= 3)
        {
            member_names[operands[0]][operands[1]] = text(operands.subspan(2));
        }
        else if (op == spv::Op::OpMemberDecorate && operands.size() >= 4 &&
                 static_cast<spv::Decoration>(operands[2]) == spv::Decoration::Offset)
        {
            all_offsets[operands[0]][operands[1]] = operands[3];
        }
        at += length;
    }

    std::map<std::string, std::map<std::string, std::uint32_t>> result;
    for (const auto& [id, offsets] : all_offsets)
    {
        std::map<std::string, std::uint32_t> members;
        for (const auto& [index, offset] : offsets)
        {
            members[member_names[id][index]] = offset;
        }
        const auto [known, is_new] = result.emplace(names[id], members);
        if (!is_new && known->second != members)
        {
            throw std::runtime_error("the struct " + names[id] + " has two layouts in one module");
        }
    }
    return result;
}

} // namespace zvo::test
