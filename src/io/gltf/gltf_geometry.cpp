// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_geometry.h"

#include "core/base/finite.h"
#include "io/gltf/gltf_accessor.h"
#include "io/gltf/gltf_draco.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::initializer_list<int> kFloat = {TINYGLTF_COMPONENT_TYPE_FLOAT};
constexpr std::initializer_list<int> kFloatOrUnsigned = {
    TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
constexpr std::initializer_list<int> kFloatOrShort = {
    TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
    TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}; // with KHR_mesh_quantization
constexpr std::initializer_list<int> kFloatOrSigned = {
    TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_BYTE,
    TINYGLTF_COMPONENT_TYPE_SHORT}; // of morph targets with KHR_mesh_quantization
constexpr std::initializer_list<int> kJointTypes = {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
constexpr std::initializer_list<int> kIndexTypes = {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT};

/// Normalizes a vertex's weights to the sum 1. Joints of weight 0, whose indices may be invalid, become copies of one
/// that counts. Returns false if no weight is usable; the vertex then follows joint 0.
bool normalizeWeights(glm::u16vec4& joints, glm::vec4& weights)
{
    double sum = 0.0;
    bool valid = true;
    for (int i = 0; i < 4; ++i)
    {
        valid = valid && weights[i] >= 0.0F && std::isfinite(weights[i]);
        sum += weights[i];
    }
    if (!valid || sum == 0.0)
    {
        joints = glm::u16vec4(0);
        weights = glm::vec4(1, 0, 0, 0);
        return false;
    }
    int heaviest = 0;
    for (int i = 0; i < 4; ++i)
    {
        weights[i] = static_cast<float>(weights[i] / sum);
        heaviest = weights[i] > weights[heaviest] ? i : heaviest;
    }
    for (int i = 0; i < 4; ++i)
    {
        joints[i] = weights[i] == 0.0F ? joints[heaviest] : joints[i];
    }
    return true;
}

class PrimitiveLoader
{
public:
    PrimitiveLoader(const GltfDocument& document, const tinygltf::Primitive& source, std::string where,
                    GltfWarnings& warnings)
        : m_document(document), m_source(source), m_where(std::move(where)), m_warnings(warnings)
    {
    }

    std::optional<Primitive> load(const GltfMaterial& material)
    {
        const bool is_points =
            m_source.mode == TINYGLTF_MODE_POINTS && !m_source.extensions.contains("KHR_draco_mesh_compression");
        if (m_source.mode < TINYGLTF_MODE_TRIANGLES && !is_points)
        {
            m_warnings.add("lines left out, only triangles and points become voxels", m_where);
            return std::nullopt;
        }
        if (m_source.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        {
            throw m_document.error(
                fmt::format("{}.mode is {}, not in 0 to 6; {}", m_where, m_source.mode, kExportAgain));
        }
        if (!m_source.attributes.contains("POSITION"))
        {
            m_warnings.add("primitive without positions left out", m_where);
            return std::nullopt;
        }
        m_draco = GltfDracoMesh::unpack(m_document, m_source, m_where);
        Primitive primitive;
        primitive.positions = readPositions();
        m_vertex_count = primitive.positions.size();
        primitive.is_points = is_points;
        primitive.triangles = is_points ? readPoints() : readTriangles();
        primitive.normals = readNormals();
        primitive.material = material.index;
        primitive.uvs = readUvs(material.uvs);
        if (material.emission_uvs)
        {
            primitive.emission_uvs = readUvs(material.emission_uvs);
            primitive.emission_uvs.resize(m_vertex_count); // viewers take missing coordinates for zeros
        }
        primitive.colors = readColors();
        readJoints(primitive);
        for (std::size_t i = 0; i < m_source.targets.size(); ++i)
        {
            primitive.morph_targets.push_back(readMorphTarget(i, !primitive.normals.empty()));
        }
        return primitive;
    }

private:
    /// The accessor of an attribute, or nothing if there is none.
    std::optional<GltfAccessor> open(const std::string& attribute, std::initializer_list<int> component_types,
                                     std::uint32_t component_count_min, std::uint32_t component_count_max) const
    {
        const auto found = m_source.attributes.find(attribute);
        if (found == m_source.attributes.end())
        {
            return std::nullopt;
        }
        const std::string use = attribute + " of " + m_where;
        GltfAccessor accessor = m_draco && m_draco->has(attribute)
                                    ? m_draco->open(m_document, attribute, found->second, use)
                                    : openAccessor(m_document, found->second, use);
        checkType(accessor, component_types, component_count_min, component_count_max);
        if (attribute != "POSITION")
        {
            checkCount(accessor);
        }
        return accessor;
    }

    void checkCount(const GltfAccessor& accessor) const
    {
        if (accessor.count != m_vertex_count)
        {
            throw m_document.error(fmt::format("{} has {} elements for {} vertices; {}", accessor.where, accessor.count,
                                               m_vertex_count, kExportAgain));
        }
    }

    void checkType(const GltfAccessor& accessor, std::initializer_list<int> component_types,
                   std::uint32_t component_count_min, std::uint32_t component_count_max) const
    {
        const bool type_fits =
            std::find(component_types.begin(), component_types.end(), accessor.component_type) != component_types.end();
        if (!type_fits || accessor.component_count < component_count_min ||
            accessor.component_count > component_count_max)
        {
            throw m_document.error(fmt::format("{} has {} components of type {}, which glTF does not allow there; {}",
                                               accessor.where, accessor.component_count, accessor.component_type,
                                               kExportAgain));
        }
    }

    [[nodiscard]] bool quantized() const { return m_document.uses("KHR_mesh_quantization"); }

    std::vector<glm::vec3> readPositions() const
    {
        return readVectors<3>(*open("POSITION", quantized() ? kFloatOrShort : kFloat, 3, 3));
    }

    /// Unit normals; a normal without direction becomes zero.
    std::vector<glm::vec3> readNormals() const
    {
        const auto accessor = open("NORMAL", quantized() ? kFloatOrShort : kFloat, 3, 3);
        if (!accessor)
        {
            return {};
        }
        std::vector<glm::vec3> normals = readVectors<3>(*accessor);
        for (glm::vec3& normal : normals)
        {
            const glm::dvec3 wide(normal);
            const double length = std::sqrt(glm::dot(wide, wide));
            normal = length > 0.0 && std::isfinite(length) ? glm::vec3(wide / length) : glm::vec3(0.0F);
        }
        return normals;
    }

    std::vector<glm::vec2> readUvs(const std::optional<GltfUvSource>& source) const
    {
        const GltfUvSource uv_source = source.value_or(GltfUvSource{});
        const std::string attribute = fmt::format("TEXCOORD_{}", uv_source.set);
        const auto accessor = open(attribute, quantized() ? kFloatOrShort : kFloatOrUnsigned, 2, 2);
        if (!accessor)
        {
            if (source)
            {
                m_warnings.add("textured, but without the texture coordinates " + attribute, m_where);
            }
            return {};
        }
        if (accessor->component_type != TINYGLTF_COMPONENT_TYPE_FLOAT && !accessor->normalized && !quantized())
        {
            throw m_document.error(
                fmt::format("{} has whole numbers that are not normalized; {}", accessor->where, kExportAgain));
        }
        std::vector<glm::vec2> uvs = readVectors<2>(*accessor);
        if (uv_source != GltfUvSource{.set = uv_source.set})
        {
            for (glm::vec2& uv : uvs)
            {
                const glm::dvec2 wide(uv);
                uv = glm::vec2(wide.x * uv_source.along_u + wide.y * uv_source.along_v + uv_source.offset);
            }
        }
        return uvs;
    }

    /// Colours with alpha, which is 1 if missing. Integers are normalized even if the file does not say so.
    std::vector<glm::vec4> readColors() const
    {
        auto accessor = open("COLOR_0", kFloatOrUnsigned, 3, 4);
        if (!accessor)
        {
            return {};
        }
        accessor->normalized = true;
        if (accessor->component_count == 4)
        {
            return readVectors<4>(*accessor);
        }
        std::vector<glm::vec4> colors;
        colors.reserve(accessor->count);
        for (const glm::vec3& color : readVectors<3>(*accessor))
        {
            colors.emplace_back(color, 1.0F);
        }
        return colors;
    }

    /// Reads joints and weights, or neither if one of them is missing.
    void readJoints(Primitive& primitive) const
    {
        auto joints = open("JOINTS_0", kJointTypes, 4, 4);
        auto weights = open("WEIGHTS_0", kFloatOrUnsigned, 4, 4);
        if (!joints || !weights)
        {
            if (joints || weights)
            {
                m_warnings.add("joints without weights, or weights without joints, left out", m_where);
            }
            return;
        }
        if (m_source.attributes.contains("JOINTS_1"))
        {
            m_warnings.add("joints beyond four a vertex left out", m_where);
        }
        joints->normalized = false;
        for (const glm::vec4& vertex : readVectors<4>(*joints))
        {
            primitive.joints.emplace_back(vertex);
        }
        weights->normalized = true; // integers are normalized even if the file does not say so
        primitive.weights = readVectors<4>(*weights);
        bool all_valid = true;
        for (std::size_t i = 0; i < m_vertex_count; ++i)
        {
            all_valid = normalizeWeights(primitive.joints[i], primitive.weights[i]) && all_valid;
        }
        if (!all_valid)
        {
            m_warnings.add("vertices whose joint weights are negative, not finite or all 0 follow the first joint",
                           m_where);
        }
    }

    MorphTarget readMorphTarget(std::size_t index, bool has_normals) const
    {
        const std::string where = fmt::format("{}.targets[{}]", m_where, index);
        const std::map<std::string, int>& attributes = m_source.targets[index];
        MorphTarget target;
        for (const auto& [attribute, accessor] : attributes)
        {
            if (attribute == "POSITION")
            {
                target.positions = readDeltas(accessor, attribute, where);
            }
            else if (attribute == "NORMAL" && has_normals)
            {
                target.normals = readDeltas(accessor, attribute, where);
            }
            else if (attribute.starts_with("TEXCOORD_") || attribute.starts_with("COLOR_"))
            {
                m_warnings.add("morph targets do not move texture coordinates and colours", where);
            }
        }
        return target;
    }

    /// The deltas of a morph target. Those that are not finite become 0, as even a weight of 0 would not hide them.
    std::vector<glm::vec3> readDeltas(int index, const std::string& attribute, const std::string& where) const
    {
        GltfAccessor accessor = openAccessor(m_document, index, attribute + " of " + where);
        checkType(accessor, quantized() ? kFloatOrSigned : kFloat, 3, 3);
        checkCount(accessor);
        accessor.normalized = accessor.normalized || attribute == "NORMAL";
        std::vector<glm::vec3> deltas = readVectors<3>(accessor);
        if (!std::all_of(deltas.begin(), deltas.end(), [](const glm::vec3& delta) { return isFinite(delta); }))
        {
            m_warnings.add("vertices that a morph target moves by what is not finite stay where they are", where);
            std::replace_if(
                deltas.begin(), deltas.end(), [](const glm::vec3& delta) { return !isFinite(delta); }, glm::vec3(0.0F));
        }
        return deltas;
    }

    std::vector<std::uint32_t> readVertexOrder() const
    {
        if (m_draco)
        {
            std::vector<std::uint32_t> order = m_draco->indices();
            checkVertices(order, "indices of " + m_where);
            return order;
        }
        if (m_source.indices < 0)
        {
            std::vector<std::uint32_t> order(m_vertex_count);
            std::iota(order.begin(), order.end(), 0U);
            return order;
        }
        const GltfAccessor accessor = openAccessor(m_document, m_source.indices, "indices of " + m_where);
        checkType(accessor, kIndexTypes, 1, 1);
        std::vector<std::uint32_t> order = readIndices(accessor);
        checkVertices(order, accessor.where);
        return order;
    }

    void checkVertices(const std::vector<std::uint32_t>& order, const std::string& where) const
    {
        const auto bad = std::find_if(order.begin(), order.end(), [&](auto index) { return index >= m_vertex_count; });
        if (bad != order.end())
        {
            throw m_document.error(fmt::format("element {} of {} is vertex {}, but there are {}; {}",
                                               bad - order.begin(), where, *bad, m_vertex_count, kExportAgain));
        }
    }

    std::vector<glm::uvec3> readPoints() const
    {
        const std::vector<std::uint32_t> order = readVertexOrder();
        std::vector<glm::uvec3> points;
        points.reserve(order.size());
        for (const std::uint32_t vertex : order)
        {
            points.emplace_back(vertex);
        }
        return points;
    }

    std::vector<glm::uvec3> readTriangles() const
    {
        const std::vector<std::uint32_t> order = readVertexOrder();
        std::vector<glm::uvec3> triangles;
        if (m_source.mode == TINYGLTF_MODE_TRIANGLES || m_draco)
        {
            if (order.size() % 3 != 0)
            {
                m_warnings.add("vertices after the last whole triangle left out", m_where);
            }
            triangles.reserve(order.size() / 3);
            for (std::size_t i = 0; i + 2 < order.size(); i += 3)
            {
                triangles.emplace_back(order[i], order[i + 1], order[i + 2]);
            }
            return triangles;
        }
        for (std::size_t i = 0; i + 2 < order.size(); ++i)
        {
            const std::size_t odd = i % 2;
            const glm::uvec3 triangle = m_source.mode == TINYGLTF_MODE_TRIANGLE_STRIP
                                            ? glm::uvec3(order[i], order[i + 1 + odd], order[i + 2 - odd])
                                            : glm::uvec3(order[i + 1], order[i + 2], order[0]);
            if (triangle.x != triangle.y && triangle.y != triangle.z && triangle.z != triangle.x)
            {
                triangles.push_back(triangle);
            }
        }
        return triangles;
    }

    const GltfDocument& m_document;
    const tinygltf::Primitive& m_source;
    std::string m_where; // "meshes[0].primitives[1]"
    GltfWarnings& m_warnings;
    std::optional<GltfDracoMesh> m_draco; // present if the primitive is packed
    std::size_t m_vertex_count = 0;
};

} // namespace

std::optional<Primitive> loadGltfPrimitive(const GltfDocument& document, int mesh, int primitive,
                                           const GltfMaterial& material, GltfWarnings& warnings)
{
    const tinygltf::Primitive& source = document.model.meshes[mesh].primitives[primitive];
    const std::string where = fmt::format("meshes[{}].primitives[{}]", mesh, primitive);
    return PrimitiveLoader(document, source, where, warnings).load(material);
}

} // namespace zvo
