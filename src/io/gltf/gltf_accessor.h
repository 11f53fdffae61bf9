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

/// An accessor's types and count, without its data. Throws Error{Input} for a type that nothing in a scene has.
GltfAccessor describeAccessor(const GltfDocument& document, int index, const std::string& use);

/// The accessor with that index. use: what it is for. A sparse one has its changes applied, to zeros where it has no
/// buffer view. Throws Error{Input} where it has no data, leaves its buffer view, or its sparse indices are not
/// strictly increasing and below its count.
GltfAccessor openAccessor(const GltfDocument& document, int index, const std::string& use);

/// Bytes of an element whose components lie one behind the other.
std::size_t elementBytes(const GltfAccessor& accessor);

/// Components as single precision numbers, integers as they are or normalized; component_count of the accessor is N.
template <int N> std::vector<glm::vec<N, float>> readVectors(const GltfAccessor& accessor);

/// The same one behind the other, whatever their number in an element: [count * component_count].
std::vector<float> readNumbers(const GltfAccessor& accessor);

/// Unsigned integers of 8, 16 or 32 bits.
std::vector<std::uint32_t> readIndices(const GltfAccessor& accessor);

} // namespace zvo
