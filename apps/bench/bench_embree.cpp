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
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

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

// A slab test without branches. The compiler makes one vector operation of each line.
template <unsigned Width> void intersectPacket(const RTCIntersectFunctionNArguments& arguments)
{
    const Voxels& voxels = *static_cast<const Voxels*>(arguments.geometryUserPtr);
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
        const bool is_hit = (arguments.valid[i] != 0) & (t_enter <= t_leave);
        at(ray.tfar, i) = is_hit ? t_enter : at(ray.tfar, i);
        at(hit.primID, i) = is_hit ? arguments.primID : at(hit.primID, i);
        at(hit.geomID, i) = is_hit ? arguments.geomID : at(hit.geomID, i);
    }
}

void intersectVoxel(const RTCIntersectFunctionNArguments* arguments)
{
    switch (arguments->N)
    {
    case 1: // Embree passes the last rays of a packet one by one
        return intersectPacket<1>(*arguments);
    case 8:
        return intersectPacket<8>(*arguments);
    case 16:
        return intersectPacket<16>(*arguments);
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
            at(packet.ray.tfar, i) = kInfinity;
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

// Million rays a second, as the median of the runs after a warm-up.
template <unsigned Width> double measureRate(RTCScene scene, std::span<const PrimaryRay> rays, std::uint32_t run_count)
{
    traceOnce<Width>(scene, rays);
    std::vector<double> seconds;
    for (std::uint32_t run = 0; run < run_count; ++run)
    {
        const auto start = std::chrono::steady_clock::now();
        traceOnce<Width>(scene, rays);
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return static_cast<double>(rays.size()) / Spread::of(seconds).median / 1e6;
}

EmbreeResult measure(RTCScene scene, std::span<const PrimaryRay> rays, std::uint32_t run_count)
{
    return {.mrays_per_s = std::max(measureRate<8>(scene, rays, run_count), measureRate<16>(scene, rays, run_count)),
            .single_mrays_per_s = measureRate<1>(scene, rays, 1),
            .hit_count = traceOnce<8>(scene, rays)};
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

EmbreeResult traceVoxelsByEmbree(const Grid& grid, std::span<const std::uint64_t> codes,
                                 std::span<const PrimaryRay> rays, std::uint32_t run_count)
{
    Voxels voxels;
    voxels.size = 1.0F / static_cast<float>(grid.rootResolution());
    voxels.cells.reserve(codes.size());
    for (const std::uint64_t code : codes)
    {
        voxels.cells.emplace_back(cellOfCode(code));
    }
    const DeviceHandle device(rtcNewDevice(nullptr));
    const SceneHandle scene(rtcNewScene(device.get()));
    const GeometryHandle geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(voxels.cells.size()));
    rtcSetGeometryUserData(geometry.get(), &voxels);
    rtcSetGeometryBoundsFunction(geometry.get(), boundVoxel, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), intersectVoxel);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
    commit(device.get(), scene.get());
    return measure(scene.get(), rays, run_count);
}

EmbreeResult traceTrianglesByEmbree(const Grid& grid, const Scene& scene, std::span<const PrimaryRay> rays,
                                    std::uint32_t run_count)
{
    const DeviceHandle device(rtcNewDevice(nullptr));
    const SceneHandle embree_scene(rtcNewScene(device.get()));
    rtcSetSceneBuildQuality(embree_scene.get(), RTC_BUILD_QUALITY_HIGH);
    for (const Instance& instance : scene.instances)
    {
        addInstance(device.get(), embree_scene.get(), grid, scene.primitives[instance.primitive], instance.transform);
    }
    commit(device.get(), embree_scene.get());
    return measure(embree_scene.get(), rays, run_count);
}

} // namespace zvo::cli
