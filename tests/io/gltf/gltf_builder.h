// SPDX-License-Identifier: MIT
// glTF documents made in memory, for the loader's tests.
#pragma once

#include "io/gltf/gltf_loader.h"
#include "support/errors.h"
#include "support/scene_check.h"
#include "support/temp_dir.h"
#include "zvo/error.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace zvo::test
{

using nlohmann::json;

/// Numbers of the glTF specification.
enum ComponentType
{
    kI8 = 5120,
    kU8 = 5121,
    kI16 = 5122,
    kU16 = 5123,
    kU32 = 5125,
    kF32 = 5126
};

enum Mode
{
    kPoints = 0,
    kLines = 1,
    kTriangles = 4,
    kStrip = 5,
    kFan = 6
};

/// A document and its binary data. The document may be changed at will before it is written.
struct GltfBuilder
{
    json document = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::uint8_t> bin;

    /// Appends bytes as a buffer view of buffer 0, at a multiple of four; the view's index.
    std::size_t addView(const void* data, std::size_t byte_count, std::size_t stride = 0)
    {
        bin.resize((bin.size() + 3) / 4 * 4);
        json view = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", byte_count}};
        if (stride != 0)
        {
            view["byteStride"] = stride;
        }
        const auto* first = static_cast<const std::uint8_t*>(data); // may be null for none
        bin.insert(bin.end(), first, first + byte_count);
        return add("bufferViews", view);
    }

    template <typename T>
    std::size_t addAccessor(const std::string& type, int component_type, std::size_t count,
                            const std::vector<T>& values, bool normalized = false, std::size_t stride = 0)
    {
        json accessor = {{"bufferView", addView(values.data(), values.size() * sizeof(T), stride)},
                         {"componentType", component_type},
                         {"count", count},
                         {"type", type}};
        if (normalized)
        {
            accessor["normalized"] = true;
        }
        return add("accessors", accessor);
    }

    /// An item of one of the document's arrays; its index.
    std::size_t add(const char* array, const json& item)
    {
        document[array].push_back(item);
        return document[array].size() - 1;
    }

    std::size_t addPositions(const std::vector<float>& values)
    {
        return addAccessor("VEC3", kF32, values.size() / 3, values);
    }

    /// A mesh of one primitive, shown by one new node.
    void addMeshNode(const json& primitive)
    {
        const std::size_t mesh = add("meshes", {{"primitives", json::array({primitive})}});
        add("nodes", {{"mesh", mesh}});
    }

    /// The document with buffer 0 as long as the binary data.
    [[nodiscard]] json finished() const
    {
        json whole = document;
        if (!bin.empty() && !whole.contains("buffers"))
        {
            whole["buffers"] = json::array({{{"byteLength", bin.size()}}});
        }
        return whole;
    }

    [[nodiscard]] std::vector<std::uint8_t> glb() const
    {
        std::string text = finished().dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<std::uint8_t> padded_bin = bin;
        padded_bin.resize((bin.size() + 3) / 4 * 4);
        std::vector<std::uint8_t> file;
        const auto append = [&](const void* data, std::size_t byte_count)
        {
            const auto* first = static_cast<const std::uint8_t*>(data);
            file.insert(file.end(), first, first + byte_count);
        };
        const auto appendU32 = [&](std::size_t value)
        {
            const auto narrow = static_cast<std::uint32_t>(value);
            append(&narrow, sizeof(narrow));
        };
        const std::size_t bin_chunk_bytes = padded_bin.empty() ? 0 : 8 + padded_bin.size();
        append("glTF", 4);
        appendU32(2);
        appendU32(12 + 8 + text.size() + bin_chunk_bytes);
        appendU32(text.size());
        append("JSON", 4);
        append(text.data(), text.size());
        if (!padded_bin.empty())
        {
            appendU32(padded_bin.size());
            append("BIN\0", 4);
            append(padded_bin.data(), padded_bin.size());
        }
        return file;
    }

    /// The scene that comes of the document as a .glb.
    [[nodiscard]] Scene load() const
    {
        const TempDir dir;
        return loadGltf(dir.write("scene.glb", glb()));
    }
};

/// A triangle in the plane z = 0, with its right angle at the origin; attributes and indices can be added.
inline json trianglePrimitive(GltfBuilder& builder)
{
    return {{"attributes", {{"POSITION", builder.addPositions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}};
}

inline GltfBuilder triangleDocument()
{
    GltfBuilder builder;
    const json primitive = trianglePrimitive(builder);
    builder.addMeshNode(primitive);
    return builder;
}

inline bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// A change of a document, for tables of what may be wrong.
using Change = std::function<void(GltfBuilder&)>;

/// Sets the value at a JSON pointer, such as "/nodes/0/mesh".
inline Change set(const std::string& pointer, const json& value)
{
    return [=](GltfBuilder& builder) { builder.document[json::json_pointer(pointer)] = value; };
}

/// Removes the member at a JSON pointer.
inline Change without(const std::string& pointer)
{
    return [place = json::json_pointer(pointer)](GltfBuilder& builder)
    { builder.document.at(place.parent_pointer()).erase(place.back()); };
}

/// Sets the value at a JSON pointer to what add returns, such as the index of an accessor that it adds.
inline Change setTo(const std::string& pointer, const std::function<std::size_t(GltfBuilder&)>& add)
{
    return [=](GltfBuilder& builder) { set(pointer, add(builder))(builder); };
}

/// Expects that calling load throws an Error{Input} of one line that has all the parts in it.
template <typename Load> void expectInputError(const Load& load, std::initializer_list<std::string> parts)
{
    expectParts(messageOf([&] { static_cast<void>(load()); }, ErrorCode::Input), parts);
}

/// Expects that builder's file is refused like that.
inline void expectInputError(const GltfBuilder& builder, std::initializer_list<std::string> parts)
{
    expectInputError([&] { return builder.load(); }, parts);
}

/// Expects that builder's file is refused after a change.
inline void expectInputError(GltfBuilder builder, const Change& change, std::initializer_list<std::string> parts)
{
    change(builder);
    expectInputError(builder, parts);
}

/// Expects that a file gives a scene that is whole, or an input error. Returns whether it gives a scene.
inline bool expectSceneOrInputError(const std::filesystem::path& path)
{
    return loadsOrIsRefused([&] { EXPECT_EQ(sceneFault(loadGltf(path)), ""); });
}

/// Expects that every file that is cut short is refused, and one with a bit flipped in any byte gives a scene that is
/// whole, or an input error. Returns how many gave a scene.
inline int loadCutAndFlipped(const GltfBuilder& builder)
{
    const TempDir dir;
    const std::vector<std::uint8_t> whole = builder.glb();
    int loaded_count = 0;
    for (std::size_t at = 0; at < whole.size(); ++at)
    {
        const auto cut = dir.write("cut.glb", std::span(whole).first(at));
        expectInputError([&] { return loadGltf(cut); }, {"cut.glb", at < 4 ? "not a glTF file" : "cut short"});
        std::vector<std::uint8_t> flipped = whole;
        flipped[at] = static_cast<std::uint8_t>(flipped[at] ^ (1U << (at % 8)));
        loaded_count += expectSceneOrInputError(dir.write("flipped.glb", flipped)) ? 1 : 0;
    }
    EXPECT_TRUE(expectSceneOrInputError(dir.write("whole.glb", whole)));
    return loaded_count;
}

/// Loads builder's file count times, each time with up to three bytes of its binary chunk damaged. Each gives a scene
/// that is whole, or an input error. Returns how many gave a scene.
inline int loadDamaged(const GltfBuilder& builder, int count, std::uint32_t seed)
{
    const TempDir dir;
    std::mt19937 random(seed);
    int loaded_count = 0;
    for (int i = 0; i < count; ++i)
    {
        GltfBuilder damaged = builder;
        const std::size_t damage_count = 1 + random() % 3;
        for (std::size_t k = 0; k < damage_count; ++k)
        {
            damaged.bin[random() % damaged.bin.size()] = static_cast<std::uint8_t>(random());
        }
        loaded_count += expectSceneOrInputError(dir.write("damaged.glb", damaged.glb())) ? 1 : 0;
    }
    return loaded_count;
}

} // namespace zvo::test
