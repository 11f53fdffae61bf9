// SPDX-License-Identifier: MIT
#include "bench/bench_embree.h"

#include "bench/bench_table.h"
#include "core/base/morton.h"
#include "zvo/error.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

template <typename Handle, auto release> struct Release
{
    using pointer = Handle;
    void operator()(Handle handle) const { release(handle); }
};
using DeviceHandle = std::unique_ptr<RTCDevice, Release<RTCDevice, rtcReleaseDevice>>;
using SceneHandle = std::unique_ptr<RTCScene, Release<RTCScene, rtcReleaseScene>>;
using GeometryHandle = std::unique_ptr<RTCGeometry, Release<RTCGeometry, rtcReleaseGeometry>>;

struct Voxels
{
    std::vector<glm::u16vec3> cells; // half the bytes of boxes
    float size = 0;                  // edge of a voxel; a power of two, so that all planes are exact
};

glm::vec3 lowCorner(const Voxels& voxels, std::uint32_t primitive)
{
    return glm::vec3(voxels.cells[primitive]) * voxels.size + 1.0F;
}

void boundVoxel(const RTCBoundsFunctionArguments* arguments)
{
    const Voxels& voxels = *static_cast<const Voxels*>(arguments->geometryUserPtr);
    const glm::vec3 low = lowCorner(voxels, arguments->primID);
    const glm::vec3 high = low + voxels.size;
    *arguments->bounds_o = {low.x, low.y, low.z, 0.0F, high.x, high.y, high.z, 0.0F};
}

// Width rays that are traced together, which Embree calls a packet.
template <unsigned Width> struct Packet;
template <> struct Packet<1>
{
    using RayHits = RTCRayHit;
    static void trace(const int*, RTCScene scene, RTCIntersectContext* context, RayHits* rays)
    {
        rtcIntersect1(scene, context, rays);
    }
};
template <> struct Packet<8>
{
    using RayHits = RTCRayHit8;
    static constexpr auto trace = rtcIntersect8;
};
template <> struct Packet<16>
{
    using RayHits = RTCRayHit16;
    static constexpr auto trace = rtcIntersect16;
};

// Element i of a packet's field, which is an array, or a single number for one ray.
template <typename Field> auto& at(Field& field, unsigned i)
{
    if constexpr (std::is_array_v<Field>)
    {
        return field[i];
    }
    else
    {
        return field;
    }
}

// Functions that are compiled for each set of vector instructions, as Embree's own are.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ZVO_FOR_EACH_VECTOR_SET [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define ZVO_FOR_EACH_VECTOR_SET
#endif

// A slab test without branches. The compiler makes one vector operation of each line.
template <unsigned Width>
[[gnu::always_inline]] inline void intersectPacket(const RTCIntersectFunctionNArguments& arguments)
{
    const Voxels& voxels = *static_cast<const Voxels*>(arguments.geometryUserPtr);
    const unsigned primitive = arguments.primID; // loaded here, as conditional loads would prevent vectors
    const unsigned geometry = arguments.geomID;
    const int* const valid = arguments.valid;
    const glm::vec3 low = lowCorner(voxels, arguments.primID);
    const glm::vec3 high = low + voxels.size;
    auto& [ray, hit] = *reinterpret_cast<typename Packet<Width>::RayHits*>(arguments.rayhit);
    for (unsigned i = 0; i < Width; ++i)
    {
        const float inverse_x = 1.0F / at(ray.dir_x, i);
        const float inverse_y = 1.0F / at(ray.dir_y, i);
        const float inverse_z = 1.0F / at(ray.dir_z, i);
        const float x0 = (low.x - at(ray.org_x, i)) * inverse_x;
        const float x1 = (high.x - at(ray.org_x, i)) * inverse_x;
        const float y0 = (low.y - at(ray.org_y, i)) * inverse_y;
        const float y1 = (high.y - at(ray.org_y, i)) * inverse_y;
        const float z0 = (low.z - at(ray.org_z, i)) * inverse_z;
        const float z1 = (high.z - at(ray.org_z, i)) * inverse_z;
        const float t_enter =
            std::max(std::max(std::min(x0, x1), std::min(y0, y1)), std::max(std::min(z0, z1), at(ray.tnear, i)));
        const float t_leave =
            std::min(std::min(std::max(x0, x1), std::max(y0, y1)), std::min(std::max(z0, z1), at(ray.tfar, i)));
        const bool is_hit = (valid[i] != 0) & (t_enter <= t_leave);
        at(ray.tfar, i) = is_hit ? t_enter : at(ray.tfar, i);
        at(hit.primID, i) = is_hit ? primitive : at(hit.primID, i);
        at(hit.geomID, i) = is_hit ? geometry : at(hit.geomID, i);
    }
}

ZVO_FOR_EACH_VECTOR_SET void intersectPacket8(const RTCIntersectFunctionNArguments& arguments)
{
    intersectPacket<8>(arguments);
}

ZVO_FOR_EACH_VECTOR_SET void intersectPacket16(const RTCIntersectFunctionNArguments& arguments)
{
    intersectPacket<16>(arguments);
}

void intersectVoxel(const RTCIntersectFunctionNArguments* arguments)
{
    switch (arguments->N)
    {
    case 1: // Embree passes the last rays of a packet one by one
        return intersectPacket<1>(*arguments);
    case 8:
        return intersectPacket8(*arguments);
    case 16:
        return intersectPacket16(*arguments);
    default:
        assert(false);
    }
}

template <unsigned Width>
std::uint64_t traceBatch(RTCScene scene, RTCIntersectContext& context, std::span<const PrimaryRay> rays)
{
    std::uint64_t hit_count = 0;
    for (std::size_t first = 0; first < rays.size(); first += Width)
    {
        alignas(64) int valid[Width];
        alignas(64) typename Packet<Width>::RayHits packet;
        for (unsigned i = 0; i < Width; ++i)
        {
            const PrimaryRay& ray = rays[std::min(first + i, rays.size() - 1)];
            valid[i] = first + i < rays.size() ? -1 : 0;
            at(packet.ray.org_x, i) = ray.origin.x;
            at(packet.ray.org_y, i) = ray.origin.y;
            at(packet.ray.org_z, i) = ray.origin.z;
            at(packet.ray.tnear, i) = ray.t_min;
            at(packet.ray.dir_x, i) = ray.direction.x;
            at(packet.ray.dir_y, i) = ray.direction.y;
            at(packet.ray.dir_z, i) = ray.direction.z;
            at(packet.ray.time, i) = 0.0F;
            at(packet.ray.tfar, i) = ray.t_max;
            at(packet.ray.mask, i) = ~0U;
            at(packet.ray.flags, i) = 0;
            at(packet.hit.geomID, i) = RTC_INVALID_GEOMETRY_ID;
            at(packet.hit.instID[0], i) = RTC_INVALID_GEOMETRY_ID;
        }
        Packet<Width>::trace(valid, scene, &context, &packet);
        for (unsigned i = 0; i < Width; ++i)
        {
            hit_count += valid[i] != 0 && at(packet.hit.geomID, i) != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
        }
    }
    return hit_count;
}

// Traces all rays on all processors. Returns the number of hits.
template <unsigned Width> std::uint64_t traceOnce(RTCScene scene, std::span<const PrimaryRay> rays)
{
    std::atomic<std::uint64_t> hit_count = 0;
    forEachBatch(rays,
                 [&](std::size_t, std::span<const PrimaryRay> batch)
                 {
                     RTCIntersectContext context;
                     rtcInitIntersectContext(&context);
                     context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
                     hit_count += traceBatch<Width>(scene, context, batch);
                 });
    return hit_count;
}

void commit(RTCDevice device, RTCScene scene)
{
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
    {
        throw Error(ErrorCode::Memory, fmt::format("Embree cannot build its tree (RTCError {}); lower the resolution",
                                                   static_cast<int>(error)));
    }
}

void addInstance(RTCDevice device, RTCScene scene, const Grid& grid, const Primitive& primitive,
                 const glm::mat4& transform)
{
    const double scale = 1.0 / (double{grid.voxel_size} * grid.rootResolution());
    const GeometryHandle geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), primitive.positions.size()));
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), primitive.triangles.size()));
    for (const glm::vec3& position : primitive.positions)
    {
        const glm::dvec3 world(transformPoint(transform, position));
        *positions++ = glm::vec3((world - glm::dvec3(grid.origin)) * scale + 1.0);
    }
    std::copy(primitive.triangles.begin(), primitive.triangles.end(), triangles);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene, geometry.get());
}

} // namespace

struct EmbreeScene::Tree
{
    Voxels voxels; // that the geometry reads
    DeviceHandle device{rtcNewDevice(nullptr)};
    SceneHandle scene{rtcNewScene(device.get())};
};

EmbreeScene::EmbreeScene(std::unique_ptr<Tree> tree) : m_tree(std::move(tree)) {}
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene::~EmbreeScene() = default;

EmbreeScene EmbreeScene::ofVoxels(const Grid& grid, std::span<const std::uint64_t> codes)
{
    auto tree = std::make_unique<Tree>();
    tree->voxels.size = 1.0F / static_cast<float>(grid.rootResolution());
    tree->voxels.cells.reserve(codes.size());
    for (const std::uint64_t code : codes)
    {
        tree->voxels.cells.emplace_back(cellOfCode(code));
    }
    const GeometryHandle geometry(rtcNewGeometry(tree->device.get(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(tree->voxels.cells.size()));
    rtcSetGeometryUserData(geometry.get(), &tree->voxels);
    rtcSetGeometryBoundsFunction(geometry.get(), boundVoxel, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), intersectVoxel);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(tree->scene.get(), geometry.get());
    commit(tree->device.get(), tree->scene.get());
    return EmbreeScene(std::move(tree));
}

EmbreeScene EmbreeScene::ofTriangles(const Grid& grid, const Scene& scene)
{
    auto tree = std::make_unique<Tree>();
    rtcSetSceneBuildQuality(tree->scene.get(), RTC_BUILD_QUALITY_HIGH);
    for (const Instance& instance : scene.instances)
    {
        addInstance(tree->device.get(), tree->scene.get(), grid, scene.primitives[instance.primitive],
                    instance.transform);
    }
    commit(tree->device.get(), tree->scene.get());
    return EmbreeScene(std::move(tree));
}

EmbreeRun EmbreeScene::trace(std::span<const PrimaryRay> rays, unsigned width) const
{
    const RTCScene scene = m_tree->scene.get();
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t hit_count = width == 1   ? traceOnce<1>(scene, rays)
                                    : width == 8 ? traceOnce<8>(scene, rays)
                                                 : traceOnce<16>(scene, rays);
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), hit_count};
}

unsigned EmbreeScene::fasterWidth(std::span<const PrimaryRay> rays) const
{
    trace(rays, 8);
    trace(rays, 16);
    return trace(rays, 8).seconds <= trace(rays, 16).seconds ? 8 : 16;
}

EmbreeResult measureEmbree(const EmbreeScene& scene, std::span<const PrimaryRay> rays, std::uint32_t run_count)
{
    const unsigned width = scene.fasterWidth(rays);
    std::vector<double> seconds;
    EmbreeResult result;
    for (std::uint32_t run = 0; run < run_count; ++run)
    {
        const EmbreeRun traced = scene.trace(rays, width);
        seconds.push_back(traced.seconds);
        result.hit_count = traced.hit_count;
    }
    const auto rate = [&](double time) { return static_cast<double>(rays.size()) / time / 1e6; };
    result.mrays_per_s = rate(Spread::of(seconds).median);
    result.single_mrays_per_s = rate(scene.trace(rays, 1).seconds);
    return result;
}

} // namespace zvo::cli
