// SPDX-License-Identifier: MIT
// Follows the JSON schema of the glTF 2.0 specification (Khronos Group, 2021), for the parts that the loader reads.
#include "io/gltf/gltf_schema.h"

#include "io/gltf/gltf_document.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace zvo
{

namespace
{

using nlohmann::json;

enum class Kind
{
    Index,      // into the document's array `target`
    Indices,    // array of them
    IndexMap,   // object of them
    IndexMaps,  // array of objects of them
    Numbering,  // object of small whole numbers
    Whole,      // whole number from 0 on
    Enumerator, // whole number that fits a signed 32-bit one
    Number,
    Numbers, // array of `count` numbers, or of any number of them if that is 0
    Text,
    Texts, // array of strings
    Flag,
    Object, // with `members`
    Objects // array of objects with `members`
};

struct Rule
{
    std::string_view name;
    Kind kind;
    bool required = false;
    std::string_view target = {};
    std::size_t count = 0;
    std::span<const Rule> members = {};
};

constexpr Rule index(std::string_view name, std::string_view target, bool required = false)
{
    return {.name = name, .kind = Kind::Index, .required = required, .target = target};
}

constexpr Rule numbers(std::string_view name, std::size_t count)
{
    return {.name = name, .kind = Kind::Numbers, .count = count};
}

constexpr Rule object(std::string_view name, std::span<const Rule> members, bool required = false)
{
    return {.name = name, .kind = Kind::Object, .required = required, .members = members};
}

constexpr Rule objects(std::string_view name, std::span<const Rule> members, bool required = false)
{
    return {.name = name, .kind = Kind::Objects, .required = required, .members = members};
}

constexpr bool kRequired = true;

constexpr Rule kScene[] = {{"nodes", Kind::Indices, false, "nodes"}};
constexpr Rule kNode[] = {
    index("mesh", "meshes"), index("camera", "cameras"), {"children", Kind::Indices, false, "nodes"},
    numbers("matrix", 16),   numbers("translation", 3),  numbers("rotation", 4),
    numbers("scale", 3),     {"name", Kind::Text},       index("skin", "skins"),
    numbers("weights", 0)};
constexpr Rule kDraco[] = {index("bufferView", "bufferViews", kRequired), {"attributes", Kind::Numbering, kRequired}};
constexpr Rule kPrimitiveExtensions[] = {object("KHR_draco_mesh_compression", kDraco)};
constexpr Rule kPrimitive[] = {{"attributes", Kind::IndexMap, kRequired, "accessors"},
                               index("indices", "accessors"),
                               index("material", "materials"),
                               {"mode", Kind::Enumerator},
                               {"targets", Kind::IndexMaps, false, "accessors"},
                               object("extensions", kPrimitiveExtensions)};
constexpr Rule kMesh[] = {objects("primitives", kPrimitive, kRequired), numbers("weights", 0)};
constexpr Rule kSparseIndices[] = {index("bufferView", "bufferViews", kRequired),
                                   {"byteOffset", Kind::Enumerator},
                                   {"componentType", Kind::Enumerator, kRequired}};
constexpr Rule kSparseValues[] = {index("bufferView", "bufferViews", kRequired), {"byteOffset", Kind::Enumerator}};
constexpr Rule kSparse[] = {{"count", Kind::Enumerator, kRequired},
                            object("indices", kSparseIndices, kRequired),
                            object("values", kSparseValues, kRequired)};
constexpr Rule kAccessor[] = {
    index("bufferView", "bufferViews"), {"byteOffset", Kind::Whole},     {"componentType", Kind::Enumerator, kRequired},
    {"count", Kind::Whole, kRequired},  {"type", Kind::Text, kRequired}, {"normalized", Kind::Flag},
    object("sparse", kSparse)};
constexpr Rule kMeshoptView[] = {index("buffer", "buffers", kRequired),
                                 {"byteOffset", Kind::Whole},
                                 {"byteLength", Kind::Whole, kRequired},
                                 {"byteStride", Kind::Whole, kRequired},
                                 {"count", Kind::Whole, kRequired},
                                 {"mode", Kind::Text, kRequired},
                                 {"filter", Kind::Text}};
constexpr Rule kViewExtensions[] = {object("EXT_meshopt_compression", kMeshoptView)};
constexpr Rule kBufferView[] = {index("buffer", "buffers", kRequired),
                                {"byteOffset", Kind::Whole},
                                {"byteLength", Kind::Whole, kRequired},
                                {"byteStride", Kind::Whole},
                                object("extensions", kViewExtensions)};
constexpr Rule kMeshoptBuffer[] = {{"fallback", Kind::Flag}};
constexpr Rule kBufferExtensions[] = {object("EXT_meshopt_compression", kMeshoptBuffer)};
constexpr Rule kBuffer[] = {
    {"byteLength", Kind::Whole, kRequired}, {"uri", Kind::Text}, object("extensions", kBufferExtensions)};
constexpr Rule kImage[] = {{"uri", Kind::Text}, index("bufferView", "bufferViews"), {"name", Kind::Text}};
constexpr Rule kSampler[] = {{"wrapS", Kind::Enumerator}, {"wrapT", Kind::Enumerator}};
constexpr Rule kTextureSource[] = {index("source", "images")};
constexpr Rule kImageExtensions[] = {object("EXT_texture_webp", kTextureSource)};
constexpr Rule kTexture[] = {index("source", "images"), index("sampler", "samplers"),
                             object("extensions", kImageExtensions)};
constexpr Rule kTextureTransform[] = {
    numbers("offset", 2), {"rotation", Kind::Number}, numbers("scale", 2), {"texCoord", Kind::Enumerator}};
constexpr Rule kTextureExtensions[] = {object("KHR_texture_transform", kTextureTransform)};
constexpr Rule kTextureInfo[] = {
    index("index", "textures", kRequired), {"texCoord", Kind::Enumerator}, object("extensions", kTextureExtensions)};
constexpr Rule kPbr[] = {numbers("baseColorFactor", 4), object("baseColorTexture", kTextureInfo)};
constexpr Rule kEmissiveStrength[] = {{"emissiveStrength", Kind::Number}};
constexpr Rule kSpecularGlossiness[] = {numbers("diffuseFactor", 4), object("diffuseTexture", kTextureInfo)};
constexpr Rule kMaterialExtensions[] = {object("KHR_materials_emissive_strength", kEmissiveStrength),
                                        object("KHR_materials_pbrSpecularGlossiness", kSpecularGlossiness)};
constexpr Rule kMaterial[] = {object("pbrMetallicRoughness", kPbr),
                              numbers("emissiveFactor", 3),
                              object("emissiveTexture", kTextureInfo),
                              {"alphaMode", Kind::Text},
                              {"alphaCutoff", Kind::Number},
                              {"name", Kind::Text},
                              object("extensions", kMaterialExtensions)};
constexpr Rule kPerspective[] = {{"yfov", Kind::Number, kRequired}};
constexpr Rule kOrthographic[] = {{"ymag", Kind::Number, kRequired}};
constexpr Rule kCamera[] = {{"type", Kind::Text, kRequired},
                            object("perspective", kPerspective),
                            object("orthographic", kOrthographic),
                            {"name", Kind::Text}};
constexpr Rule kSkin[] = {index("inverseBindMatrices", "accessors"), {"joints", Kind::Indices, kRequired, "nodes"}};
constexpr Rule kChannelTarget[] = {index("node", "nodes"), {"path", Kind::Text, kRequired}};
constexpr Rule kChannel[] = {{"sampler", Kind::Whole, kRequired}, object("target", kChannelTarget, kRequired)};
constexpr Rule kAnimationSampler[] = {
    index("input", "accessors", kRequired), index("output", "accessors", kRequired), {"interpolation", Kind::Text}};
constexpr Rule kAnimation[] = {
    objects("channels", kChannel, kRequired), objects("samplers", kAnimationSampler, kRequired), {"name", Kind::Text}};
constexpr Rule kDocument[] = {index("scene", "scenes"),
                              {"extensionsUsed", Kind::Texts},
                              {"extensionsRequired", Kind::Texts},
                              objects("scenes", kScene),
                              objects("nodes", kNode),
                              objects("meshes", kMesh),
                              objects("accessors", kAccessor),
                              objects("bufferViews", kBufferView),
                              objects("buffers", kBuffer),
                              objects("images", kImage),
                              objects("samplers", kSampler),
                              objects("textures", kTexture),
                              objects("materials", kMaterial),
                              objects("cameras", kCamera),
                              objects("skins", kSkin),
                              objects("animations", kAnimation)};

class Checker
{
public:
    Checker(const json& document, const std::filesystem::path& path) : m_document(document), m_path(path) {}

    void checkObject(const json& value, std::span<const Rule> members, const std::string& where) const
    {
        require(value.is_object(), where, "an object");
        const std::string prefix = where.empty() ? where : where + '.';
        for (const Rule& rule : members)
        {
            const auto member = value.find(rule.name);
            if (member != value.end())
            {
                checkValue(*member, rule, prefix + std::string(rule.name));
            }
            else if (rule.required)
            {
                throw gltfError(m_path, fmt::format("{} has no {}; {}", where, rule.name, kExportAgain));
            }
        }
    }

private:
    void checkValue(const json& value, const Rule& rule, const std::string& where) const
    {
        switch (rule.kind)
        {
        case Kind::Index:
            return checkIndex(value, rule, where);
        case Kind::Indices:
            return checkEach(value, where,
                             [&](const json& item, const std::string& property) { checkIndex(item, rule, property); });
        case Kind::IndexMap:
            return checkIndexMap(value, rule, where);
        case Kind::IndexMaps:
            return checkEach(value, where,
                             [&](const json& item, const std::string& property)
                             { checkIndexMap(item, rule, property); });
        case Kind::Numbering:
            require(value.is_object(), where, "an object");
            for (const auto& [key, item] : value.items())
            {
                checkValue(item, {key, Kind::Enumerator}, where + '.' + key);
            }
            return;
        case Kind::Whole:
            return require(value.is_number_unsigned(), where, "a whole number from 0 on");
        case Kind::Enumerator:
            return require(value.is_number_unsigned() && value.get<std::uint64_t>() <= kEnumeratorMax, where,
                           "a small whole number");
        case Kind::Number:
            return require(value.is_number(), where, "a number");
        case Kind::Numbers:
            return require(
                value.is_array() && (rule.count == 0 || value.size() == rule.count) &&
                    std::all_of(value.begin(), value.end(), [](const json& item) { return item.is_number(); }),
                where, rule.count == 0 ? "an array of numbers" : fmt::format("an array of {} numbers", rule.count));
        case Kind::Text:
            return require(value.is_string(), where, "a string");
        case Kind::Texts:
            return checkEach(value, where,
                             [&](const json& item, const std::string& property)
                             { require(item.is_string(), property, "a string"); });
        case Kind::Flag:
            return require(value.is_boolean(), where, "true or false");
        case Kind::Object:
            return checkObject(value, rule.members, where);
        case Kind::Objects:
            return checkEach(value, where,
                             [&](const json& item, const std::string& property)
                             { checkObject(item, rule.members, property); });
        }
    }

    template <typename Check> void checkEach(const json& array, const std::string& where, const Check& check) const
    {
        require(array.is_array(), where, "an array");
        for (std::size_t i = 0; i < array.size(); ++i)
        {
            check(array[i], fmt::format("{}[{}]", where, i));
        }
    }

    void checkIndexMap(const json& value, const Rule& rule, const std::string& where) const
    {
        require(value.is_object(), where, "an object");
        for (const auto& [key, item] : value.items())
        {
            checkIndex(item, rule, where + '.' + key);
        }
    }

    void checkIndex(const json& value, const Rule& rule, const std::string& where) const
    {
        require(value.is_number_unsigned(), where, "a whole number from 0 on");
        const auto target = m_document.find(rule.target);
        const std::size_t count = target == m_document.end() || !target->is_array() ? 0 : target->size();
        const auto wanted = value.get<std::uint64_t>();
        if (wanted >= count)
        {
            throw gltfError(m_path, fmt::format("{} is {}, but the file has {} {}; {}", where, wanted, count,
                                                rule.target, kExportAgain));
        }
    }

    void require(bool condition, const std::string& where, std::string_view wanted) const
    {
        if (!condition)
        {
            throw gltfError(
                m_path, fmt::format("{} is not {}; {}", where.empty() ? "the document" : where, wanted, kExportAgain));
        }
    }

    static constexpr std::uint64_t kEnumeratorMax = std::numeric_limits<std::int32_t>::max();

    const json& m_document;
    const std::filesystem::path& m_path;
};

} // namespace

void checkGltfSchema(const json& document, const std::filesystem::path& path)
{
    Checker(document, path).checkObject(document, kDocument, "");
}

const json& gltfItems(const json& document, const char* array)
{
    static const json none = json::array();
    const auto items = document.find(array);
    return items != document.end() ? *items : none;
}

} // namespace zvo
