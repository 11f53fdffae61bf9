// SPDX-License-Identifier: MIT
#include "fuzz/gltf_mutator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

namespace zvo::test
{

namespace
{

using nlohmann::json;

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::string_view kMagic = "glTF";
constexpr std::string_view kJsonChunk = "JSON";
constexpr std::string_view kBinChunk{"BIN\0", 4};
constexpr int kDepthMax = 100; // the JSON library writes recursively

constexpr auto kWholeNumbers = std::to_array<std::uint64_t>(
    {0,     1,     2,     3,     4,     5,         6,    7,           12,          16,          127,
     128,   255,   256,   5120,  5121,  5122,      5123, 5124,        5125,        5126,        9728,
     10497, 33071, 33648, 65535, 65536, 1U << 31U, ~0U,  1ULL << 32U, 1ULL << 60U, 1ULL << 63U, ~0ULL});
constexpr auto kNumbers = std::to_array<double>({-1.0, 0.5, -0.0, 1e-45, 1e-38, 1e-300, 1e10, 3.4028235e38, 3.5e38,
                                                 -3.4028235e38, 1e300, -1e300, 1e-10, 16777217.0, 1.5707963});
constexpr auto kTexts = std::to_array<std::string_view>({"SCALAR",
                                                         "VEC2",
                                                         "VEC3",
                                                         "VEC4",
                                                         "MAT4",
                                                         "OPAQUE",
                                                         "MASK",
                                                         "BLEND",
                                                         "perspective",
                                                         "orthographic",
                                                         "POSITION",
                                                         "NORMAL",
                                                         "TEXCOORD_0",
                                                         "TEXCOORD_1",
                                                         "COLOR_0",
                                                         "side.bin",
                                                         "side.png",
                                                         "../side.bin",
                                                         "%2e%2e/side.bin",
                                                         "/dev/zero",
                                                         ".",
                                                         "",
                                                         "data:,a%20b",
                                                         "data:;base64,AAAA",
                                                         "2.0",
                                                         "KHR_texture_transform",
                                                         "KHR_mesh_quantization",
                                                         "KHR_materials_emissive_strength",
                                                         "KHR_materials_pbrSpecularGlossiness",
                                                         "KHR_draco_mesh_compression",
                                                         "EXT_meshopt_compression",
                                                         "EXT_texture_webp",
                                                         "image/webp",
                                                         "JOINTS_0",
                                                         "JOINTS_1",
                                                         "WEIGHTS_0",
                                                         "translation",
                                                         "rotation",
                                                         "scale",
                                                         "weights",
                                                         "matrix",
                                                         "STEP",
                                                         "LINEAR",
                                                         "CUBICSPLINE",
                                                         "pointer",
                                                         "sparse",
                                                         "fallback",
                                                         "byteStride",
                                                         "filter",
                                                         "ATTRIBUTES",
                                                         "TRIANGLES",
                                                         "INDICES",
                                                         "NONE",
                                                         "OCTAHEDRAL",
                                                         "QUATERNION",
                                                         "EXPONENTIAL"});

/// Bits of numbers in single precision, and indices.
const auto kWords = std::to_array<std::uint32_t>(
    {0, 1, 2, 65535, 65536, ~0U, 1U << 31U, std::bit_cast<std::uint32_t>(1.0F), std::bit_cast<std::uint32_t>(-1.0F),
     std::bit_cast<std::uint32_t>(1e-45F), std::bit_cast<std::uint32_t>(1e-30F), std::bit_cast<std::uint32_t>(1e30F),
     std::bit_cast<std::uint32_t>(3.4e38F), std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()),
     std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN())});

std::uint32_t readU32(std::span<const std::uint8_t> bytes)
{
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data(), sizeof(value));
    return value;
}

void appendU32(std::vector<std::uint8_t>& bytes, std::size_t value)
{
    const auto narrow = static_cast<std::uint32_t>(value);
    bytes.resize(bytes.size() + sizeof(narrow));
    std::memcpy(bytes.data() + bytes.size() - sizeof(narrow), &narrow, sizeof(narrow));
}

template <typename List> auto pick(const List& list, std::mt19937& random)
{
    return list[random() % std::size(list)];
}

json parse(const std::string& text)
{
    const auto limit = [](int depth, json::parse_event_t, json&) { return depth <= kDepthMax; };
    return json::parse(text, limit, false);
}

struct Place
{
    json* value;
    json* parent; // null: the document
};

void listPlaces(json& value, json* parent, std::vector<Place>& places)
{
    places.push_back({&value, parent});
    if (value.is_structured())
    {
        for (json& item : value)
        {
            listPlaces(item, &value, places);
        }
    }
}

std::vector<Place> listPlaces(json& document)
{
    std::vector<Place> places;
    listPlaces(document, nullptr, places);
    return places;
}

json otherNumber(const json& number, std::mt19937& random)
{
    switch (random() % 4)
    {
    case 0:
        return number.is_number_integer() ? json(number.get<std::int64_t>() / 2) : json(-number.get<double>());
    case 1:
        if (number.is_number_integer())
        {
            const auto step = static_cast<std::uint64_t>(random() % 2 == 0 ? 1 : -1);
            return json(number.get<std::uint64_t>() + step);
        }
        return json(number.get<double>() * 2);
    case 2:
        return json(pick(kNumbers, random));
    default:
        return json(pick(kWholeNumbers, random));
    }
}

json anyValue(std::mt19937& random)
{
    switch (random() % 6)
    {
    case 0:
        return json();
    case 1:
        return json(random() % 2 == 0);
    case 2:
        return json::object();
    case 3:
        return json::array({pick(kWholeNumbers, random)});
    case 4:
        return json(std::string(pick(kTexts, random)));
    default:
        return json(pick(kWholeNumbers, random));
    }
}

void erase(json& parent, const json* child)
{
    for (auto item = parent.begin(); item != parent.end(); ++item)
    {
        if (&*item == child)
        {
            parent.erase(item);
            return;
        }
    }
}

void changePlace(const Place& place, const std::vector<Place>& places, std::mt19937& random)
{
    json& value = *place.value;
    const std::uint32_t choice = random() % 16;
    if (choice == 0 && place.parent != nullptr)
    {
        erase(*place.parent, place.value);
    }
    else if (choice == 1)
    {
        value = anyValue(random);
    }
    else if (choice == 2)
    {
        const json other = *pick(places, random).value; // a copy, because it may contain the place
        value = other;
    }
    else if (choice == 3 && place.parent != nullptr && place.parent->is_array())
    {
        const json again = value;
        place.parent->push_back(again);
    }
    else if (value.is_number())
    {
        value = otherNumber(value, random);
    }
    else if (value.is_string())
    {
        value = std::string(pick(kTexts, random));
    }
    else if (value.is_boolean())
    {
        value = !value.get<bool>();
    }
    else if (value.is_object())
    {
        value[std::string(pick(kTexts, random))] = anyValue(random);
    }
    else if (value.is_array() && !value.empty())
    {
        std::swap(value[random() % value.size()], value[random() % value.size()]);
    }
}

} // namespace

GltfParts GltfParts::split(std::span<const std::uint8_t> file)
{
    const auto text = [](std::span<const std::uint8_t> bytes) { return std::string(bytes.begin(), bytes.end()); };
    GltfParts parts;
    const bool has_magic = file.size() >= kHeaderBytes + kChunkHeaderBytes && text(file.first(4)) == kMagic;
    if (!has_magic || readU32(file.subspan(kHeaderBytes)) > file.size() - kHeaderBytes - kChunkHeaderBytes)
    {
        parts.text = text(file);
        return parts;
    }
    parts.binary = true;
    const std::size_t text_bytes = readU32(file.subspan(kHeaderBytes));
    parts.text = text(file.subspan(kHeaderBytes + kChunkHeaderBytes, text_bytes));
    const auto rest = file.subspan(kHeaderBytes + kChunkHeaderBytes + text_bytes);
    if (rest.size() >= kChunkHeaderBytes)
    {
        const auto bin = rest.subspan(kChunkHeaderBytes);
        parts.bin.assign(bin.begin(), bin.end());
    }
    return parts;
}

std::vector<std::uint8_t> GltfParts::join() const
{
    if (!binary)
    {
        return {text.begin(), text.end()};
    }
    const auto padded = [](std::size_t bytes) { return (bytes + 3) / 4 * 4; };
    const std::size_t bin_chunk_bytes = bin.empty() ? 0 : kChunkHeaderBytes + padded(bin.size());
    std::vector<std::uint8_t> file(kMagic.begin(), kMagic.end());
    appendU32(file, 2);
    appendU32(file, kHeaderBytes + kChunkHeaderBytes + padded(text.size()) + bin_chunk_bytes);
    appendU32(file, padded(text.size()));
    file.insert(file.end(), kJsonChunk.begin(), kJsonChunk.end());
    file.insert(file.end(), text.begin(), text.end());
    file.resize(kHeaderBytes + kChunkHeaderBytes + padded(text.size()), ' ');
    if (!bin.empty())
    {
        appendU32(file, padded(bin.size()));
        file.insert(file.end(), kBinChunk.begin(), kBinChunk.end());
        file.insert(file.end(), bin.begin(), bin.end());
        file.resize((file.size() + 3) / 4 * 4);
    }
    return file;
}

void mutateJson(std::string& text, std::mt19937& random)
{
    json document = parse(text);
    if (!document.is_structured())
    {
        return;
    }
    for (std::uint32_t i = 0; i <= random() % 3; ++i)
    {
        const std::vector<Place> places = listPlaces(document);
        changePlace(pick(places, random), places, random);
    }
    text = document.dump(-1, ' ', false, json::error_handler_t::replace);
}

void mutateBin(std::vector<std::uint8_t>& bin, std::mt19937& random)
{
    const std::size_t bytes = std::size_t{1} << (random() % 3); // a number of 8, 16 or 32 bits
    if (bin.size() < bytes)
    {
        return;
    }
    const std::size_t place = random() % (bin.size() / bytes) * bytes;
    const std::uint32_t word = pick(kWords, random);
    std::memcpy(bin.data() + place, &word, bytes);
}

void crossJson(std::string& text, const std::string& other, std::mt19937& random)
{
    json document = parse(text);
    json source = parse(other);
    if (!document.is_object() || !source.is_structured())
    {
        return;
    }
    if (random() % 2 == 0 && source.is_object() && !source.empty())
    {
        const auto member = std::next(source.begin(), static_cast<std::ptrdiff_t>(random() % source.size()));
        document[member.key()] = member.value();
    }
    else
    {
        *pick(listPlaces(document), random).value = *pick(listPlaces(source), random).value;
    }
    text = document.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace zvo::test
