// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_draco.h"

#include <cstring>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace zvo
{

namespace
{

constexpr const char* kExtension = "KHR_draco_mesh_compression";
constexpr std::uint16_t kVersion = DRACO_BITSTREAM_VERSION(2, 2); // the only one that the extension allows

// Approximate allocations of the decoders.
constexpr std::uint64_t kFaceBytes = 64;          // corners and their neighbours
constexpr std::uint64_t kVertexBytes = 16;        // corner tables
constexpr std::uint64_t kFaceAttributeBytes = 40; // seams of an attribute
constexpr std::uint64_t kPointBytes = 16;         // of an attribute, beside its values

struct Counts
{
    std::uint32_t faces = 0;
    std::uint32_t vertices = 0;
    std::uint32_t split_vertices = 0;
    std::uint8_t attributes = 0; // with connectivity of their own
};

/// Reads the counts that precede a mesh's connectivity.
bool peek(draco::DecoderBuffer buffer, draco::MeshEncoderMethod method, Counts& counts)
{
    if (method == draco::MESH_SEQUENTIAL_ENCODING)
    {
        return draco::DecodeVarint(&counts.faces, &buffer) && draco::DecodeVarint(&counts.vertices, &buffer);
    }
    std::uint32_t symbols = 0;
    return draco::DecodeVarint(&counts.vertices, &buffer) && draco::DecodeVarint(&counts.faces, &buffer) &&
           buffer.Decode(&counts.attributes) && draco::DecodeVarint(&symbols, &buffer) &&
           draco::DecodeVarint(&counts.split_vertices, &buffer);
}

/// A decoder that checks the memory it will need before it allocates any. Draco's decoders trust the data.
template <typename Decoder, draco::MeshEncoderMethod kMethod> class BoundedDecoder final : public Decoder
{
public:
    BoundedDecoder(const GltfDocument& document, const std::string& where) : m_document(document), m_where(where) {}

protected:
    bool DecodeConnectivity() override
    {
        Counts counts;
        if (this->bitstream_version() != kVersion || !peek(*this->buffer(), kMethod, counts))
        {
            return false;
        }
        m_document.countUnpacked(counts.faces * (kFaceBytes + kFaceAttributeBytes * counts.attributes) +
                                     (std::uint64_t{counts.vertices} + counts.split_vertices) * kVertexBytes,
                                 m_where);
        return Decoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override
    {
        const draco::PointCloud& points = *this->point_cloud();
        std::uint64_t bytes = 0; // of a point; a component takes at most 64 bits, and there are at most 255
        for (std::int32_t i = 0; i < points.num_attributes(); ++i)
        {
            bytes += kPointBytes + static_cast<std::uint64_t>(points.attribute(i)->byte_stride());
        }
        m_document.countUnpacked(points.num_points() * bytes, m_where);
        return Decoder::DecodeAllAttributes();
    }

private:
    const GltfDocument& m_document;
    const std::string& m_where;
};

/// Returns null if the data does not decode.
std::unique_ptr<draco::Mesh> decodeMesh(const GltfDocument& document, std::span<const std::uint8_t> data,
                                        const std::string& where)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
    draco::DecoderBuffer header_buffer = buffer;
    draco::DracoHeader header = {};
    if (!draco::PointCloudDecoder::DecodeHeader(&header_buffer, &header).ok() ||
        header.encoder_type != draco::TRIANGULAR_MESH)
    {
        return nullptr;
    }
    std::unique_ptr<draco::MeshDecoder> decoder;
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
    {
        decoder = std::make_unique<BoundedDecoder<draco::MeshSequentialDecoder, draco::MESH_SEQUENTIAL_ENCODING>>(
            document, where);
    }
    else if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
    {
        decoder = std::make_unique<BoundedDecoder<draco::MeshEdgebreakerDecoder, draco::MESH_EDGEBREAKER_ENCODING>>(
            document, where);
    }
    auto mesh = std::make_unique<draco::Mesh>();
    const draco::DecoderOptions options;
    try
    {
        return decoder && decoder->Decode(options, &buffer, mesh.get()).ok() ? std::move(mesh) : nullptr;
    }
    catch (const std::length_error&) // thrown by vectors if a count exceeds all memory
    {
        return nullptr;
    }
}

/// Copies the values of all points in sequence. Returns false if a value does not fit the component type.
template <typename Component>
bool copyValues(const draco::PointAttribute& source, std::uint32_t point_count, std::vector<std::uint8_t>& bytes)
{
    const std::uint32_t component_count = source.num_components();
    std::vector<Component> value(component_count);
    bytes.resize(std::size_t{point_count} * component_count * sizeof(Component));
    std::uint8_t* target = bytes.data();
    for (std::uint32_t i = 0; i < point_count; ++i)
    {
        const draco::AttributeValueIndex index = source.mapped_index(draco::PointIndex(i));
        if (index.value() >= source.size() ||
            !source.ConvertValue(index, static_cast<std::int8_t>(component_count), value.data()))
        {
            return false;
        }
        std::memcpy(target, value.data(), component_count * sizeof(Component));
        target += component_count * sizeof(Component);
    }
    return true;
}

bool copyValuesAs(int component_type, const draco::PointAttribute& source, std::uint32_t point_count,
                  std::vector<std::uint8_t>& bytes)
{
    switch (component_type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return copyValues<std::int8_t>(source, point_count, bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copyValues<std::uint8_t>(source, point_count, bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return copyValues<std::int16_t>(source, point_count, bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copyValues<std::uint16_t>(source, point_count, bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return copyValues<std::uint32_t>(source, point_count, bytes);
    default:
        return copyValues<float>(source, point_count, bytes);
    }
}

} // namespace

GltfDracoMesh::GltfDracoMesh(GltfDracoMesh&&) noexcept = default;
GltfDracoMesh& GltfDracoMesh::operator=(GltfDracoMesh&&) noexcept = default;
GltfDracoMesh::~GltfDracoMesh() = default;

std::optional<GltfDracoMesh> GltfDracoMesh::unpack(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                                   const std::string& where)
{
    const auto extension = primitive.extensions.find(kExtension);
    if (extension == primitive.extensions.end())
    {
        return std::nullopt;
    }
    const std::string property = fmt::format("{}.extensions.{}", where, kExtension);
    GltfDracoMesh unpacked;
    const int view = extension->second.Get("bufferView").GetNumberAsInt();
    unpacked.m_mesh = decodeMesh(document, document.bufferView(view), property);
    if (!unpacked.m_mesh)
    {
        throw document.error(
            fmt::format("{} does not decode as a Draco mesh of version 2.2; {}", property, kExportAgain));
    }
    const tinygltf::Value& attributes = extension->second.Get("attributes");
    for (const std::string& attribute : attributes.Keys())
    {
        unpacked.m_attribute_ids[attribute] = static_cast<std::uint32_t>(attributes.Get(attribute).GetNumberAsInt());
    }
    if (primitive.indices < 0)
    {
        throw document.error(
            fmt::format("{} stands for indices, but {}.indices is missing; {}", property, where, kExportAgain));
    }
    document.use(fmt::format("accessors[{}]", primitive.indices));
    // A list must have all faces. A strip may have lost triangles without area; gltf_size counts one face for each
    // index.
    const std::size_t face_count = unpacked.m_mesh->num_faces();
    const std::size_t index_count = document.model.accessors[primitive.indices].count;
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (is_list ? index_count != 3 * face_count : index_count < face_count)
    {
        throw document.error(fmt::format("{} has {} triangles, accessors[{}] {} indices; {}", property, face_count,
                                         primitive.indices, index_count, kExportAgain));
    }
    return unpacked;
}

bool GltfDracoMesh::has(const std::string& attribute) const
{
    return m_attribute_ids.contains(attribute);
}

GltfAccessor GltfDracoMesh::open(const GltfDocument& document, const std::string& attribute, int accessor,
                                 const std::string& use) const
{
    GltfAccessor opened = describeAccessor(document, accessor, use);
    const std::uint32_t id = m_attribute_ids.at(attribute);
    const draco::PointAttribute* source = m_mesh->GetAttributeByUniqueId(id);
    const std::uint32_t point_count = m_mesh->num_points();
    if (source == nullptr)
    {
        throw document.error(
            fmt::format("{} is attribute {} of Draco data that has none; {}", opened.where, id, kExportAgain));
    }
    if (opened.count != point_count || opened.component_count != source->num_components())
    {
        throw document.error(fmt::format("{} has {} elements of {} components, its Draco data {} of {}; {}",
                                         opened.where, opened.count, opened.component_count, point_count,
                                         source->num_components(), kExportAgain));
    }
    if ((!source->is_mapping_identity() && source->indices_map_size() < point_count) ||
        !copyValuesAs(opened.component_type, *source, point_count, opened.storage))
    {
        throw document.error(
            fmt::format("{} does not hold the values of its Draco data; {}", opened.where, kExportAgain));
    }
    opened.data = opened.storage.data();
    opened.stride_bytes = elementBytes(opened);
    return opened;
}

std::vector<std::uint32_t> GltfDracoMesh::indices() const
{
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{m_mesh->num_faces()} * 3);
    for (std::uint32_t i = 0; i < m_mesh->num_faces(); ++i)
    {
        for (const draco::PointIndex& point : m_mesh->face(draco::FaceIndex(i)))
        {
            indices.push_back(point.value());
        }
    }
    return indices;
}

} // namespace zvo
