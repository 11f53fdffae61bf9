// SPDX-License-Identifier: MIT
#include "core/gltf_accessor.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <type_traits>

namespace zvo
{

namespace
{

/// Bytes of a component; 0 for what the specification does not know.
std::size_t componentBytes(int component_type)
{
    switch (component_type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

/// Components of an element; 0 for matrices, which no vertex has.
std::uint32_t componentCount(int type)
{
    switch (type)
    {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    default:
        return 0;
    }
}

template <typename Component> Component load(const std::uint8_t* bytes)
{
    Component component;
    std::memcpy(&component, bytes, sizeof(component));
    return component;
}

template <typename Component> float toFloat(Component component, bool normalized)
{
    const auto value = static_cast<float>(component);
    if (std::is_floating_point_v<Component> || !normalized)
    {
        return value;
    }
    return std::max(value / static_cast<float>(std::numeric_limits<Component>::max()), -1.0F);
}

template <typename Component, int N> std::vector<glm::vec<N, float>> readAs(const GltfAccessor& accessor)
{
    std::vector<glm::vec<N, float>> vectors(accessor.count);
    const std::uint8_t* element = accessor.data;
    for (glm::vec<N, float>& vector : vectors)
    {
        for (int i = 0; i < N; ++i)
        {
            const auto component = load<Component>(element + static_cast<std::size_t>(i) * sizeof(Component));
            vector[i] = toFloat(component, accessor.normalized);
        }
        element += accessor.stride_bytes;
    }
    return vectors;
}

template <typename Component> std::vector<std::uint32_t> readIndicesAs(const GltfAccessor& accessor)
{
    std::vector<std::uint32_t> indices(accessor.count);
    const std::uint8_t* element = accessor.data;
    for (std::uint32_t& index : indices)
    {
        index = load<Component>(element);
        element += accessor.stride_bytes;
    }
    return indices;
}

} // namespace

GltfAccessor openAccessor(const GltfDocument& document, int index, const std::string& use)
{
    const tinygltf::Accessor& source = document.model.accessors[index];
    GltfAccessor accessor;
    accessor.where = fmt::format("accessors[{}] ({})", index, use);
    const auto fail = [&](const std::string& what)
    { return document.error(fmt::format("{} {}", accessor.where, what)); };
    if (source.sparse.isSparse)
    {
        throw fail("is sparse, which is not supported yet; export it without sparse accessors");
    }
    if (source.bufferView < 0)
    {
        throw fail(fmt::format("has no buffer view, so no data; {}", kExportAgain));
    }
    const std::size_t component_bytes = componentBytes(source.componentType);
    accessor.component_count = componentCount(source.type);
    const std::size_t element_bytes = component_bytes * accessor.component_count;
    if (element_bytes == 0)
    {
        throw fail(fmt::format("has component type {} or an element type that no vertex has; {}", source.componentType,
                               kExportAgain));
    }
    const std::span<const std::uint8_t> view = document.bufferView(source.bufferView);
    const std::size_t stride = document.model.bufferViews[source.bufferView].byteStride;
    accessor.stride_bytes = stride == 0 ? element_bytes : stride;
    if (accessor.stride_bytes < element_bytes)
    {
        throw fail(fmt::format("has elements of {} bytes, {} apart; {}", element_bytes, stride, kExportAgain));
    }
    // count elements fit when the last one does; written so that nothing overflows.
    const std::size_t available = view.size() - std::min(source.byteOffset, view.size());
    const bool fits = source.count == 0 || (available >= element_bytes &&
                                            source.count - 1 <= (available - element_bytes) / accessor.stride_bytes);
    if (!fits || source.byteOffset > view.size())
    {
        throw fail(fmt::format("takes {} elements of {} bytes, {} apart, at {} of bufferViews[{}], which has {} bytes; "
                               "{}",
                               source.count, element_bytes, accessor.stride_bytes, source.byteOffset, source.bufferView,
                               view.size(), kExportAgain));
    }
    accessor.data = view.data() + source.byteOffset;
    accessor.count = source.count;
    accessor.component_type = source.componentType;
    accessor.normalized = source.normalized;
    return accessor;
}

template <int N> std::vector<glm::vec<N, float>> readVectors(const GltfAccessor& accessor)
{
    assert(accessor.component_count == N);
    switch (accessor.component_type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return readAs<std::int8_t, N>(accessor);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return readAs<std::uint8_t, N>(accessor);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return readAs<std::int16_t, N>(accessor);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return readAs<std::uint16_t, N>(accessor);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return readAs<std::uint32_t, N>(accessor);
    default:
        return readAs<float, N>(accessor);
    }
}

template std::vector<glm::vec2> readVectors<2>(const GltfAccessor& accessor);
template std::vector<glm::vec3> readVectors<3>(const GltfAccessor& accessor);
template std::vector<glm::vec4> readVectors<4>(const GltfAccessor& accessor);

std::vector<std::uint32_t> readIndices(const GltfAccessor& accessor)
{
    assert(accessor.component_count == 1);
    switch (accessor.component_type)
    {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return readIndicesAs<std::uint8_t>(accessor);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return readIndicesAs<std::uint16_t>(accessor);
    default:
        assert(accessor.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
        return readIndicesAs<std::uint32_t>(accessor);
    }
}

} // namespace zvo
