// SPDX-License-Identifier: MIT
#include "core/attribute_form.h"

#include <cassert>
#include <cstddef>

namespace zvo
{

namespace
{

constexpr std::uint32_t kChannelBits = 8; // of gpu::Attribute::color

// The lowest bits of word, which lose them.
std::uint32_t take(std::uint32_t& word, std::uint32_t bits)
{
    const std::uint32_t taken = word & ((1U << bits) - 1);
    word >>= bits;
    return taken;
}

// c / max as a fraction of 255, rounded.
std::uint32_t widenChannel(std::uint32_t c, std::uint32_t bits)
{
    const std::uint32_t max = (1U << bits) - 1;
    return (c * 255 + max / 2) / max;
}

std::uint32_t unpackColor565(std::uint32_t code)
{
    const std::uint32_t red = widenChannel(take(code, gpu::kRedBits), gpu::kRedBits);
    const std::uint32_t green = widenChannel(take(code, gpu::kGreenBits), gpu::kGreenBits);
    const std::uint32_t blue = widenChannel(take(code, gpu::kBlueBits), gpu::kBlueBits);
    return red | green << kChannelBits | blue << (2 * kChannelBits);
}

// A snorm8 as a snorm16, rounded.
std::uint32_t widenNormal(std::uint32_t byte)
{
    constexpr int kOne16 = 32767;
    const int v = static_cast<std::int8_t>(byte);
    const int size = (std::abs(v) * kOne16 + gpu::kNormalOne4 / 2) / gpu::kNormalOne4;
    return static_cast<std::uint16_t>(v < 0 ? -size : size);
}

gpu::Attribute unpackAttribute4(std::uint32_t word)
{
    const std::uint32_t normal = word >> gpu::kNormalShift4;
    return {unpackColor565(word), widenNormal(normal) | widenNormal(normal >> 8) << 16};
}

} // namespace

const char* formName(AttributeForm form)
{
    switch (form)
    {
    case AttributeForm::Bytes4:
        return "4";
    case AttributeForm::Bytes8:
        return "8";
    default:
        return "none";
    }
}

std::uint64_t packedWords(AttributeForm form, std::uint64_t count)
{
    assert(isPacked(form));
    static_cast<void>(form);
    return count;
}

gpu::Attribute unpackAttribute(AttributeForm form, std::span<const gpu::uint> words, std::uint64_t index)
{
    assert(isPacked(form));
    static_cast<void>(form);
    return unpackAttribute4(words[index]);
}

} // namespace zvo
