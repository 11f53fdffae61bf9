// SPDX-License-Identifier: MIT
// Follows the JSON schema of the glTF 2.0 specification (Khronos Group, 2021), for the parts that the loader reads.
#include "io/gltf/gltf_schema.h"

#include "io/gltf/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
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
    Stride,     // whole number that distances between elements may have
    Type,       // of an accessor's elements, as text
    Component,  // type of an accessor's components
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
    const char* stand_in = nullptr; // for what fails, as JSON: an item of Objects, or an Object, "" for none
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

/// An array of objects that the scene may do without. stand_in: takes the place of one that fails, as JSON.
constexpr Rule optionalObjects(std::string_view name, std::span<const Rule> members, const char* stand_in)
{
    return {.name = name, .kind = Kind::Objects, .members = members, .stand_in = stand_in};
}

/// An object that the scene may do without. One that fails is removed.
constexpr Rule optionalObject(std::string_view name, std::span<const Rule> members)
{
    return {.name = name, .kind = Kind::Object, .members = members, .stand_in = ""};
}

constexpr bool kRequired = true;

constexpr Rule kScene[] = {{"nodes", Kind::Indices, false, "nodes"}};
constexpr Rule kInstancing[] = {{"attributes", Kind::IndexMap, kRequired, "accessors"}};
constexpr Rule kVisibility[] = {{"visible", Kind::Flag}};
constexpr Rule kNodeExtensions[] = {optionalObject("EXT_mesh_gpu_instancing", kInstancing),
                                    optionalObject("KHR_node_visibility", kVisibility)};
constexpr Rule kNode[] = {index("mesh", "meshes"),
                          index("camera", "cameras"),
                          {"children", Kind::Indices, false, "nodes"},
                          numbers("matrix", 16),
                          numbers("translation", 3),
                          numbers("rotation", 4),
                          numbers("scale", 3),
                          {"name", Kind::Text},
                          index("skin", "skins"),
                          numbers("weights", 0),
                          optionalObject("extensions", kNodeExtensions)};
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
    index("bufferView", "bufferViews"), {"byteOffset", Kind::Whole},     {"componentType", Kind::Component, kRequired},
    {"count", Kind::Whole, kRequired},  {"type", Kind::Type, kRequired}, {"normalized", Kind::Flag},
    object("sparse", kSparse)};
constexpr Rule kMeshoptView[] = {index("buffer", "buffers", kRequired),
                                 {"byteOffset", Kind::Whole},
                                 {"byteLength", Kind::Whole, kRequired},
                                 {"byteStride", Kind::Whole, kRequired},
                                 {"count", Kind::Whole, kRequired},
                                 {"mode", Kind::Text, kRequired},
                                 {"filter", Kind::Text}};
constexpr Rule kViewExtensions[] = {object("EXT_meshopt_compression", kMeshoptView),
                                    object("KHR_meshopt_compression", kMeshoptView)};
constexpr Rule kBufferView[] = {index("buffer", "buffers", kRequired),
                                {"byteOffset", Kind::Whole},
                                {"byteLength", Kind::Whole, kRequired},
                                {"byteStride", Kind::Stride},
                                object("extensions", kViewExtensions)};
constexpr Rule kMeshoptBuffer[] = {{"fallback", Kind::Flag}};
constexpr Rule kBufferExtensions[] = {object("EXT_meshopt_compression", kMeshoptBuffer),
                                      object("KHR_meshopt_compression", kMeshoptBuffer)};
constexpr Rule kBuffer[] = {
    {"byteLength", Kind::Whole, kRequired}, {"uri", Kind::Text}, object("extensions", kBufferExtensions)};
constexpr Rule kImage[] = {{"uri", Kind::Text}, index("bufferView", "bufferViews"), {"name", Kind::Text}};
constexpr Rule kSampler[] = {{"wrapS", Kind::Enumerator}, {"wrapT", Kind::Enumerator}};
constexpr Rule kTextureSource[] = {index("source", "images")};
constexpr Rule kImageExtensions[] = {object("EXT_texture_webp", kTextureSource), optionalObject("EXT_texture_avif", {}),
                                     optionalObject("KHR_texture_basisu", {}), optionalObject("MSFT_texture_dds", {})};
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
constexpr Rule kMaterialExtensions[] = {optionalObject("KHR_materials_emissive_strength", kEmissiveStrength),
                                        object("KHR_materials_pbrSpecularGlossiness", kSpecularGlossiness)};
constexpr Rule kMaterial[] = {optionalObject("pbrMetallicRoughness", kPbr),
                              numbers("emissiveFactor", 3),
                              optionalObject("emissiveTexture", kTextureInfo),
                              {"alphaMode", Kind::Text},
                              {"alphaCutoff", Kind::Number},
                              {"doubleSided", Kind::Flag},
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
constexpr Rule kAsset[] = {{"version", Kind::Text, kRequired}};
constexpr Rule kDocument[] = {
    object("asset", kAsset, kRequired),
    index("scene", "scenes"),
    {"extensionsUsed", Kind::Texts},
    {"extensionsRequired", Kind::Texts},
    objects("scenes", kScene),
    objects("nodes", kNode),
    optionalObjects("meshes", kMesh, R"({"primitives": []})"),
    optionalObjects("accessors", kAccessor, R"({"componentType": 5126, "count": 0, "type": "SCALAR"})"),
    optionalObjects("bufferViews", kBufferView, R"({"buffer": 0, "byteLength": 0})"),
    objects("buffers", kBuffer),
    optionalObjects("images", kImage, "{}"),
    optionalObjects("samplers", kSampler, "{}"),
    optionalObjects("textures", kTexture, "{}"),
    optionalObjects("materials", kMaterial, "{}"),
    optionalObjects("cameras", kCamera, R"({"type": "orthographic", "orthographic": {"ymag": 1}})"),
    optionalObjects("skins", kSkin, R"({"joints": []})"),
    objects("animations", kAnimation)};

/// Whole numbers up to this one are exact in double precision.
constexpr double kExactMax = 9007199254740992.0;

/// A property that fails: what and where.
class SchemaFault : public std::runtime_error
{
    using std::runtime_error::runtime_error;
};

class Checker
{
public:
    Checker(json& root, GltfDocument& document) : m_root(root), m_document(document) {}

    void check()
    {
        try
        {
            checkObject(m_root, kDocument, "");
        }
        catch (const SchemaFault& fault)
        {
            throw m_document.error(fault.what());
        }
    }

private:
    /// Checks the members that are listed and removes the others.
    void checkObject(json& value, std::span<const Rule> members, const std::string& where)
    {
        require(value.is_object(), where, "an object");
        for (auto member = value.begin(); member != value.end();)
        {
            const bool is_read = std::any_of(members.begin(), members.end(),
                                             [&](const Rule& rule) { return rule.name == member.key(); });
            member = is_read ? std::next(member) : value.erase(member);
        }
        const std::string prefix = where.empty() ? where : where + '.';
        for (const Rule& rule : members)
        {
            const auto member = value.find(rule.name);
            if (member != value.end())
            {
                const std::string property = prefix + std::string(rule.name);
                const bool may_fail = rule.kind == Kind::Object && rule.stand_in != nullptr;
                if (!may_fail)
                {
                    checkValue(*member, rule, property);
                }
                else if (!passes(property, [&] { checkValue(*member, rule, property); }))
                {
                    value.erase(member);
                }
            }
            else if (rule.required)
            {
                throw SchemaFault(fmt::format("{} has no {}; {}", where, rule.name, kExportAgain));
            }
        }
    }

    void checkValue(json& value, const Rule& rule, const std::string& where)
    {
        switch (rule.kind)
        {
        case Kind::Index:
            return checkIndex(value, rule, where);
        case Kind::Indices:
            return checkEach(value, where,
                             [&](json& item, const std::string& property) { checkIndex(item, rule, property); });
        case Kind::IndexMap:
            return checkIndexMap(value, rule, where);
        case Kind::IndexMaps:
            return checkEach(value, where,
                             [&](json& item, const std::string& property) { checkIndexMap(item, rule, property); });
        case Kind::Numbering:
            require(value.is_object(), where, "an object");
            for (const auto& [key, item] : value.items())
            {
                checkValue(item, {key, Kind::Enumerator}, where + '.' + key);
            }
            return;
        case Kind::Whole:
        case Kind::Enumerator:
        case Kind::Stride:
        case Kind::Component:
            return checkWhole(value, rule.kind, where);
        case Kind::Type:
            return checkType(value, where);
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
                             [&](json& item, const std::string& property) { checkItem(item, rule, property); });
        }
    }

    template <typename Check> void checkEach(json& array, const std::string& where, const Check& check)
    {
        require(array.is_array(), where, "an array");
        for (std::size_t i = 0; i < array.size(); ++i)
        {
            check(array[i], fmt::format("{}[{}]", where, i));
        }
    }

    void checkItem(json& item, const Rule& rule, const std::string& where)
    {
        if (rule.stand_in == nullptr)
        {
            checkObject(item, rule.members, where);
        }
        else if (!passes(where, [&] { checkObject(item, rule.members, where); }))
        {
            item = json::parse(rule.stand_in);
        }
    }

    /// Whether a part that the scene may do without passes check. If not, its fault is kept for who needs it.
    template <typename Check> bool passes(const std::string& part, const Check& check)
    {
        try
        {
            check();
            return true;
        }
        catch (const SchemaFault& fault)
        {
            m_document.faults[part] = {fault.what()};
            return false;
        }
    }

    void checkIndexMap(json& value, const Rule& rule, const std::string& where)
    {
        require(value.is_object(), where, "an object");
        for (const auto& [key, item] : value.items())
        {
            checkIndex(item, rule, where + '.' + key);
        }
    }

    void checkIndex(json& value, const Rule& rule, const std::string& where)
    {
        checkWhole(value, Kind::Whole, where);
        const auto target = m_root.find(rule.target);
        const std::size_t count = target == m_root.end() || !target->is_array() ? 0 : target->size();
        const auto wanted = value.get<std::uint64_t>();
        if (wanted >= count)
        {
            throw SchemaFault(
                fmt::format("{} is {}, but the file has {} {}; {}", where, wanted, count, rule.target, kExportAgain));
        }
    }

    /// Checks a whole number. One that is written as 1.0 becomes 1.
    void checkWhole(json& value, Kind kind, const std::string& where)
    {
        const double number = value.is_number_float() ? value.get<double>() : -1.0;
        if (number >= 0.0 && number <= kExactMax && number == std::floor(number))
        {
            value = static_cast<std::uint64_t>(number);
            m_document.warnings.add("numbers with a decimal point taken as whole numbers", where);
        }
        require(value.is_number_unsigned(), where,
                kind == Kind::Enumerator ? "a small whole number" : "a whole number from 0 on");
        const auto whole = value.get<std::uint64_t>();
        if (kind == Kind::Enumerator)
        {
            require(whole <= kEnumeratorMax, where, "a small whole number");
        }
        else if (kind == Kind::Stride)
        {
            require(whole <= kStrideMax && whole % 4 == 0, where, fmt::format("a multiple of 4 up to {}", kStrideMax));
        }
        else if (kind == Kind::Component)
        {
            require(whole >= TINYGLTF_COMPONENT_TYPE_BYTE && whole <= TINYGLTF_COMPONENT_TYPE_DOUBLE, where,
                    "a component type");
        }
    }

    static void checkType(const json& value, const std::string& where)
    {
        constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
        require(value.is_string(), where, "a string");
        const auto type = value.get<std::string>();
        if (std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes))
        {
            throw SchemaFault(fmt::format("{} is \"{}\", which is no type of elements; {}", where, type, kExportAgain));
        }
    }

    static void require(bool condition, const std::string& where, std::string_view wanted)
    {
        if (!condition)
        {
            throw SchemaFault(
                fmt::format("{} is not {}; {}", where.empty() ? "the document" : where, wanted, kExportAgain));
        }
    }

    static constexpr std::uint64_t kEnumeratorMax = std::numeric_limits<std::int32_t>::max();
    static constexpr std::uint64_t kStrideMax = 252; // bytes

    json& m_root;
    GltfDocument& m_document;
};

} // namespace

void checkGltfSchema(json& root, GltfDocument& document)
{
    Checker(root, document).check();
}

const json& gltfItems(const json& document, const char* array)
{
    static const json none = json::array();
    const auto items = document.find(array);
    return items != document.end() ? *items : none;
}

} // namespace zvo
