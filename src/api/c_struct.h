// SPDX-License-Identifier: MIT
// Reading and filling structs of the C interface, whose sizes tell their versions.
#pragma once

#include "api/c_guard.h"
#include "api/c_members.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace zvo
{

/// No struct will ever be larger. A size that a host forgot to set is larger in most cases.
inline constexpr std::size_t kStructBytesMax = 4096;

/// Sizes of structs are multiples of this.
inline constexpr std::size_t kMemberBytes = 4;

/// The size that a host gave a struct. Throws Error{Usage} for null and for a size that no version of the struct can
/// have.
template <typename Struct> std::size_t sizeOf(const Struct* given, const char* name)
{
    std::size_t size = 0;
    std::memcpy(&size, &at(given, name), sizeof(size));
    if (size < sizeof(size) || size > kStructBytesMax || size % kMemberBytes != 0)
    {
        throw Error(ErrorCode::Usage, std::string(name) + " has no struct_size, but " + std::to_string(size) +
                                          ": begin with ZVO_..._INIT");
    }
    return size;
}

/// A copy of a host's struct, with defaults for members that the host does not know. Throws Error{Usage} for null, for
/// a size that is not valid, and for members that must be 0 and are not: reserved ones, and those that this version
/// does not know.
template <typename Struct> Struct readStruct(const Struct* given, const char* name)
{
    const std::size_t size = sizeOf(given, name);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
    for (std::size_t i = sizeof(Struct); i < size; ++i)
    {
        if (bytes[i] != 0)
        {
            throw Error(ErrorCode::Usage, std::string(name) + " has members that this library, version " +
                                              std::to_string(ZVO_VERSION) + ", does not know");
        }
    }
    Struct result = CStruct<Struct>::initial();
    std::memcpy(&result, given, std::min(size, sizeof(Struct)));
    result.struct_size = sizeof(Struct);
    if constexpr (requires { result.reserved; })
    {
        if (result.reserved != 0)
        {
            throw Error(ErrorCode::Usage, std::string(name) + " has a reserved member that is not 0");
        }
    }
    return result;
}

/// Throws Error{Usage} for more elements than any memory has.
inline void requireCount(std::size_t count, std::size_t element_bytes, const char* name)
{
    if (count > PTRDIFF_MAX / element_bytes)
    {
        throw Error(ErrorCode::Usage,
                    std::string(name) + " has more elements than any memory: " + std::to_string(count));
    }
}

/// The elements of a host's array.
template <typename Struct> std::vector<Struct> readStructs(const Struct* given, std::size_t count, const char* name)
{
    std::vector<Struct> result;
    if (count == 0)
    {
        return result;
    }
    const std::size_t stride = sizeOf(given, name);
    requireCount(count, stride, name);
    for (std::size_t i = 0; i < count; ++i)
    {
        const auto* const element =
            reinterpret_cast<const Struct*>(reinterpret_cast<const unsigned char*>(given) + i * stride);
        if (sizeOf(element, name) != stride)
        {
            throw Error(ErrorCode::Usage, std::string(name) + " has elements of several sizes");
        }
        result.push_back(readStruct(element, name));
    }
    return result;
}

/// Fills as much of a host's struct as the host knows. Throws as sizeOf().
template <typename Struct> void writeStruct(Struct* out, const char* name, const Struct& value)
{
    const std::size_t size = sizeOf(out, name);
    auto* const bytes = reinterpret_cast<unsigned char*>(out);
    const std::size_t known = std::min(size, sizeof(Struct));
    std::memcpy(bytes + sizeof(size), reinterpret_cast<const unsigned char*>(&value) + sizeof(size),
                known - sizeof(size));
    std::memset(bytes + known, 0, size - known);
}

} // namespace zvo
