// SPDX-License-Identifier: MIT
// Structs of the C interface become those of the C++ interface, and back. Functions throw Error{Usage} for structs that
// are not valid (api/c_struct.h) and for arrays that are null but not empty; what members may be is checked by the C++
// interface.
#pragma once

#include "api/c_members.h"
#include "api/c_struct.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

namespace zvo
{

// Give members that only one interface has what the other's members say.
void assignOwn(ContextInfo& to, const ZvoContextInfo& from); // but the log, whose function has another type
void assignOwn(TextureInfo& to, const ZvoTextureInfo& from);
void assignOwn(MeshInfo& to, const ZvoMeshInfo& from);
void assignOwn(EnvironmentMapInfo& to, const ZvoEnvironmentMapInfo& from);
void assignOwn(DepthTarget& to, const ZvoDepthTarget& from);
void assignOwn(ZvoDeviceInfo& to, const DeviceReport& from); // texts are the report's
void assignOwn(ZvoModelStats& to, const Model& from);
void assignOwn(ZvoDroppedTriangles& to, const DroppedTriangles& from);
void assignOwn(ZvoUpdateStats& to, const UpdateStats& from);

/// Assigns the members that two structs share. Struct: the one of the C interface.
template <typename Struct, typename To, typename From> void assignShared(To& to, const From& from);

/// Assigns a member. Texts stay those of `from`.
template <typename To, typename From> void assignMember(To& to, const From& from)
{
    if constexpr (std::is_same_v<To, From>)
    {
        to = from;
    }
    else if constexpr (std::is_same_v<To, bool>)
    {
        to = from != VK_FALSE;
    }
    else if constexpr (std::is_same_v<From, bool>)
    {
        to = from ? VK_TRUE : VK_FALSE;
    }
    else if constexpr (std::is_same_v<From, std::string>)
    {
        to = from.c_str();
    }
    else if constexpr (requires { std::begin(to); })
    {
        std::copy(std::begin(from), std::end(from), std::begin(to));
    }
    else if constexpr (requires { typename CStruct<From>::InCpp; })
    {
        assignShared<From>(to, from);
    }
    else if constexpr (requires { typename CStruct<To>::InCpp; })
    {
        assignShared<To>(to, from);
    }
    else
    {
        to = static_cast<To>(from); // an enumeration, or an integer of another width
    }
}

template <typename Struct, typename To, typename From> void assignShared(To& to, const From& from)
{
    eachShared<Struct>(to, from, [](auto& into, const auto& of) { assignMember(into, of); });
}

/// The contents of a struct of the C interface, which readStruct() has completed.
template <typename Struct> typename CStruct<Struct>::InCpp ofC(const Struct& from)
{
    typename CStruct<Struct>::InCpp result;
    assignShared<Struct>(result, from);
    if constexpr (requires { assignOwn(result, from); })
    {
        assignOwn(result, from);
    }
    return result;
}

/// A struct of the C interface with these contents.
template <typename Struct> Struct toC(const typename CStruct<Struct>::InCpp& from)
{
    Struct result = CStruct<Struct>::initial();
    assignShared<Struct>(result, from);
    if constexpr (requires { assignOwn(result, from); })
    {
        assignOwn(result, from);
    }
    return result;
}

/// What a host's struct says.
template <typename Struct> typename CStruct<Struct>::InCpp read(const Struct* given, const char* name)
{
    return ofC(readStruct(given, name));
}

/// Fills a host's struct.
template <typename Struct> void write(Struct* out, const char* name, const typename CStruct<Struct>::InCpp& contents)
{
    writeStruct(out, name, toC<Struct>(contents));
}

/// The C++ ModelInfo of a C one, with the arrays that it refers to. Vertices stay the host's.
class ModelOfC
{
public:
    explicit ModelOfC(const ZvoModelInfo& info);
    ModelOfC(const ModelOfC&) = delete;
    ModelOfC& operator=(const ModelOfC&) = delete;

    [[nodiscard]] const ModelInfo& info() const { return m_info; }

private:
    std::vector<MeshInfo> m_meshes;
    std::vector<InstanceInfo> m_instances;
    std::vector<MaterialInfo> m_materials;
    std::vector<TextureInfo> m_textures;
    ModelInfo m_info;
};

/// The numbers of a host's array. Throws Error{Usage} for null.
template <std::size_t count> std::array<double, count> arrayOf(const double* values, const char* name)
{
    std::array<double, count> result{};
    std::copy_n(&at(values, name), result.size(), result.begin());
    return result;
}

} // namespace zvo
