// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_document.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace zvo
{

/// The elements of an accessor, checked to lie inside their buffer view and buffer.
struct GltfAccessor
{
    std::vector<std::uint8_t> storage;  // of elements that do not lie in a buffer as they are; data stays when it moves
    const std::uint8_t* data = nullptr; // of the first element; unaligned
    std::size_t count = 0;              // elements
    std::size_t stride_bytes = 0;       // from one element to the next
    std::uint32_t component_count = 0;  // in an element
    int component_type = 0;             // TINYGLTF_COMPONENT_TYPE_*
    bool normalized = false;            // integers stand for [0, 1] or [-1, 1]
    std::string where;                  // "accessors[3] (POSITION of meshes[0].primitives[1])"

    GltfAccessor() = default;
    GltfAccessor(GltfAccessor&&) = default;
    GltfAccessor& operator=(GltfAccessor&&) = default;
};

/// Type and count of an accessor, without its data. Throws Error{Input} for one with a fault or of a type that nothing
/// in a scene has.
GltfAccessor describeAccessor(const GltfDocument& document, int index, const std::string& use);

/// The elements of the accessor with that index. use: its purpose, for messages. An accessor without a buffer view has
/// zeros, with a warning if it is not sparse; the changes of a sparse one are applied to them. Throws Error{Input} if
/// the accessor has a fault, leaves its buffer view, or has sparse indices that are not strictly increasing and below
/// its count.
GltfAccessor openAccessor(const GltfDocument& document, int index, const std::string& use);

/// Bytes of an element whose components are stored without gaps.
std::size_t elementBytes(const GltfAccessor& accessor);

/// The elements as vectors of N single precision numbers; integers as they are, or normalized. N must be the accessor's
/// component_count.
template <int N> std::vector<glm::vec<N, float>> readVectors(const GltfAccessor& accessor);

/// The same as one array of numbers, for any number of components: [count * component_count].
std::vector<float> readNumbers(const GltfAccessor& accessor);

/// Unsigned integers of 8, 16 or 32 bits.
std::vector<std::uint32_t> readIndices(const GltfAccessor& accessor);

} // namespace zvo
