// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_accessor.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

namespace zvo
{

namespace
{

/// Bytes of a component; 0 if the specification does not know the type.
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

/// Components of an element; 0 for small matrices, which scenes do not use.
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
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default:
        return 0;
    }
}

bool isIndexType(int component_type)
{
    return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
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

template <typename Component> std::vector<float> readNumbersAs(const GltfAccessor& accessor)
{
    std::vector<float> numbers;
    numbers.reserve(accessor.count * accessor.component_count);
    const std::uint8_t* element = accessor.data;
    for (std::size_t i = 0; i < accessor.count; ++i)
    {
        for (std::uint32_t k = 0; k < accessor.component_count; ++k)
        {
            numbers.push_back(toFloat(load<Component>(element + k * sizeof(Component)), accessor.normalized));
        }
        element += accessor.stride_bytes;
    }
    return numbers;
}

/// Calls read(Component{}) with the type of the accessor's components.
template <typename Read> auto withComponent(const GltfAccessor& accessor, const Read& read)
{
    switch (accessor.component_type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return read(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return read(std::uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return read(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return read(std::uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return read(std::uint32_t{});
    default:
        return read(float{});
    }
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

/// A range of elements in a buffer view.
struct ElementRange
{
    int buffer_view = -1;
    std::size_t offset_bytes = 0; // of the first element in the view
    std::size_t count = 0;
    std::size_t element_bytes = 0;
    std::size_t stride_bytes = 0;
};

/// The first element. Throws if some of them lie outside of the view.
const std::uint8_t* locate(const GltfDocument& document, const ElementRange& range, const std::string& where)
{
    if (range.stride_bytes < range.element_bytes)
    {
        throw document.error(fmt::format("{} has elements of {} bytes, {} apart; {}", where, range.element_bytes,
                                         range.stride_bytes, kExportAgain));
    }
    const std::span<const std::uint8_t> view = document.bufferView(range.buffer_view);
    // count elements fit if the last one does; written so that nothing overflows.
    const std::size_t available = view.size() - std::min(range.offset_bytes, view.size());
    const bool fits = range.count == 0 || (available >= range.element_bytes &&
                                           range.count - 1 <= (available - range.element_bytes) / range.stride_bytes);
    if (!fits || range.offset_bytes > view.size())
    {
        throw document.error(
            fmt::format("{} takes {} elements of {} bytes, {} apart, at {} of bufferViews[{}], which has {} bytes; {}",
                        where, range.count, range.element_bytes, range.stride_bytes, range.offset_bytes,
                        range.buffer_view, view.size(), kExportAgain));
    }
    return view.data() + range.offset_bytes;
}

/// Copies the accessor's elements into its own storage, or zeros if it has no buffer view.
void copyElements(const GltfDocument& document, GltfAccessor& accessor)
{
    const std::size_t element_bytes = elementBytes(accessor);
    if (accessor.count > std::numeric_limits<std::uint32_t>::max())
    {
        throw document.error(fmt::format("{} has more than 2^32 elements; split the mesh", accessor.where));
    }
    document.countUnpacked(std::uint64_t{accessor.count} * element_bytes, accessor.where);
    std::vector<std::uint8_t> elements(accessor.count * element_bytes);
    for (std::size_t i = 0; accessor.data != nullptr && i < accessor.count; ++i)
    {
        std::memcpy(&elements[i * element_bytes], accessor.data + i * accessor.stride_bytes, element_bytes);
    }
    accessor.storage = std::move(elements);
    accessor.data = accessor.storage.data();
    accessor.stride_bytes = element_bytes;
}

/// Writes the values of a sparse accessor over the others.
void applySparse(const GltfDocument& document, const tinygltf::Accessor& source, GltfAccessor& accessor)
{
    const auto& sparse = source.sparse;
    const auto count = static_cast<std::size_t>(sparse.count);
    if (count > accessor.count)
    {
        throw document.error(fmt::format("{} has {} sparse values for {} elements; {}", accessor.where, count,
                                         accessor.count, kExportAgain));
    }
    const std::size_t element_bytes = elementBytes(accessor);
    GltfAccessor indices;
    indices.where = accessor.where + ".sparse.indices";
    indices.count = count;
    indices.component_type = sparse.indices.componentType;
    indices.component_count = 1;
    indices.stride_bytes = elementBytes(indices);
    if (!isIndexType(indices.component_type))
    {
        throw document.error(
            fmt::format("{} has component type {}; {}", indices.where, indices.component_type, kExportAgain));
    }
    const auto indices_offset = static_cast<std::size_t>(sparse.indices.byteOffset);
    const auto values_offset = static_cast<std::size_t>(sparse.values.byteOffset);
    indices.data =
        locate(document, {sparse.indices.bufferView, indices_offset, count, indices.stride_bytes, indices.stride_bytes},
               indices.where);
    const std::uint8_t* value =
        locate(document, {sparse.values.bufferView, values_offset, count, element_bytes, element_bytes},
               accessor.where + ".sparse.values");
    std::size_t next = 0; // the least allowed index
    for (const std::uint32_t index : readIndices(indices))
    {
        if (index < next || index >= accessor.count)
        {
            throw document.error(fmt::format("{} contains {}, but they must increase and stay below {}; {}",
                                             indices.where, index, accessor.count, kExportAgain));
        }
        std::memcpy(&accessor.storage[index * element_bytes], value, element_bytes);
        value += element_bytes;
        next = std::size_t{index} + 1;
    }
}

} // namespace

std::size_t elementBytes(const GltfAccessor& accessor)
{
    return componentBytes(accessor.component_type) * accessor.component_count;
}

GltfAccessor describeAccessor(const GltfDocument& document, int index, const std::string& use)
{
    document.use(fmt::format("accessors[{}]", index));
    const tinygltf::Accessor& source = document.model.accessors[index];
    GltfAccessor accessor;
    accessor.where = fmt::format("accessors[{}] ({})", index, use);
    accessor.count = source.count;
    accessor.component_count = componentCount(source.type);
    accessor.component_type = source.componentType;
    accessor.normalized = source.normalized;
    if (elementBytes(accessor) == 0)
    {
        throw document.error(fmt::format("{} has component type {} or an element type that nothing has; {}",
                                         accessor.where, source.componentType, kExportAgain));
    }
    return accessor;
}

GltfAccessor openAccessor(const GltfDocument& document, int index, const std::string& use)
{
    const tinygltf::Accessor& source = document.model.accessors[index];
    GltfAccessor accessor = describeAccessor(document, index, use);
    if (source.bufferView >= 0)
    {
        const std::size_t element_bytes = elementBytes(accessor);
        const std::size_t stride = document.model.bufferViews[source.bufferView].byteStride;
        accessor.stride_bytes = stride == 0 ? element_bytes : stride;
        accessor.data = locate(
            document, {source.bufferView, source.byteOffset, accessor.count, element_bytes, accessor.stride_bytes},
            accessor.where);
    }
    else if (!source.sparse.isSparse)
    {
        document.warnings.add("accessors without a buffer view have only zeros", accessor.where);
        copyElements(document, accessor);
    }
    if (source.sparse.isSparse)
    {
        copyElements(document, accessor);
        applySparse(document, source, accessor);
    }
    return accessor;
}

template <int N> std::vector<glm::vec<N, float>> readVectors(const GltfAccessor& accessor)
{
    assert(accessor.component_count == N);
    return withComponent(accessor, [&](auto component) { return readAs<decltype(component), N>(accessor); });
}

template std::vector<glm::vec2> readVectors<2>(const GltfAccessor& accessor);
template std::vector<glm::vec3> readVectors<3>(const GltfAccessor& accessor);
template std::vector<glm::vec4> readVectors<4>(const GltfAccessor& accessor);

std::vector<float> readNumbers(const GltfAccessor& accessor)
{
    return withComponent(accessor, [&](auto component) { return readNumbersAs<decltype(component)>(accessor); });
}

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
