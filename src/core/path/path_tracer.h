// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/light/tree_lights.h"
#include "core/path/develop.h"
#include "core/path/path_batch.h"
#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "path/path.h"
#include "vk/deletion_queue.h"
#include "vk/frame_graph.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace zvo
{

/// How paths advance. In both forms a path does the same, and its light is summed up in the same order.
enum class PathForm : std::uint8_t
{
    /// A bounce of all paths of a batch at a time, in small kernels over lists of those that need them. For devices
    /// that skip no branch: software devices.
    Stages,
    /// One kernel, whose threads follow a path each. For GPUs: nothing is stored between bounces.
    OneKernel,
};

/// The form that is chosen for a device: Tunable::PathForm.
PathForm pathFormOn(const vk::Device& device);

/// Options of a path-traced picture.
struct PathOptions
{
    std::uint32_t bounces = 8; // diffuse reflections of a path; 0: only light that the camera sees directly
    std::uint32_t seed = 0;
    float lens_radius = 0.0F;    // world units; 0: a pinhole
    float focus_distance = 1.0F; // world units along the camera's direction, where the picture is sharp; more than 0
    LightSampling sampling = LightSampling::Both;
    bool lights_by_power = false; // chooses voxels by their light alone, wherever they are; for comparisons
    bool smooth = false;          // what the camera sees is shaded by the normals of voxels, not by faces
    bool roulette = false;        // ends paths early that would bring little light, by chance
    bool reseeds = false;         // has other random numbers whenever it begins anew
    bool features = false;        // sums up what the camera sees, too (PathTracer::guided())

    bool operator==(const PathOptions&) const = default;
};

/// The most bounces that PathOptions::bounces asks for.
inline constexpr std::uint32_t kBouncesMax = 1024;

/// The rays of a sample, from the camera, of bounces and to lights, from the lists of all of its batches.
std::uint64_t rayCountOf(std::span<const gpu::DispatchArgs> lists);

/// The samples of a picture, and what else is known of its pixels.
struct GuidedPicture
{
    SampledPicture picture;
    const vk::BufferOf<gpu::PixelFeatures>& features; // [width * height] in the order of shaders/path/path.h
    const TraceCamera& camera;
    float voxel_edge;       // unit space
    std::uint64_t subject;  // another number where samples began anew
    std::uint64_t lighting; // another number where pictures of the same place may have no light in common
};

/// Path traces pictures of a tree, a sample for each pixel at a time, and keeps their sum. Owns all buffers.
class PathTracer
{
public:
    /// deletion_queue: as in TreeTracer.
    explicit PathTracer(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr)
        : m_device(device), m_deletion_queue(deletion_queue), m_lights(device, deletion_queue)
    {
    }

    /// Sets the size of the pictures, and begins anew if that, or the form, is another one. Must be called before the
    /// first sample. form: by default pathFormOn() the device. Throws Error{Memory}; then all stays as it was.
    void resize(std::uint32_t width, std::uint32_t height, std::optional<PathForm> form = std::nullopt);

    /// Forgets all samples, and what was made of trees: because the last frame was lost, or kernels may have changed.
    void forget();

    /// Records the passes that add a sample to each pixel. Begins anew where tree or environment has another version,
    /// or camera or options are others. lists: gets the lists of all batches, [listElements(options)], for
    /// rayCountOf(); may be null.
    /// Throws Error{Memory}. Cost: pixels times bounces.
    void addSample(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                   const TraceCamera& camera, const PathOptions& options,
                   vk::BufferOf<gpu::DispatchArgs>* lists = nullptr);

    /// The number of elements of the lists of a sample.
    [[nodiscard]] std::uint64_t listElements(const PathOptions& options) const;

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const;

    [[nodiscard]] std::uint32_t sampleCount() const { return m_sample_count; }

    /// The samples so far.
    [[nodiscard]] SampledPicture picture() const
    {
        return {m_pixels->sums, m_pixels->width, m_pixels->height, m_sample_count};
    }

    /// Likewise, of a picture with PathOptions::features.
    [[nodiscard]] GuidedPicture guided() const
    {
        return {picture(), m_pixels->features, m_camera, m_voxel_edge, m_subject_number, m_lighting_number};
    }

    /// Rays that were given up (TraceStatus::capped_rays), since the last resize().
    [[nodiscard]] const vk::BufferOf<gpu::TraceStatus>& status() const { return m_pixels->status; }

    /// With PathForm::Stages: the rays of a bounce (0: from the camera) of the last batch, and those to lights, as many
    /// as the lists tell. Only of the last two bounces, and of the last bounce but one, they are still there.
    [[nodiscard]] const vk::BufferOf<gpu::Ray>& rays(std::uint32_t bounce) const
    {
        return m_pixels->batch.rays.at(bounce % 2);
    }
    [[nodiscard]] const vk::BufferOf<gpu::Ray>& shadowRays() const { return m_pixels->batch.shadow_rays; }

    /// With PathForm::Stages: the lists of the last batch (shaders/path/path.h). Lengths count its rays.
    [[nodiscard]] const vk::BufferOf<gpu::DispatchArgs>& lists() const { return m_pixels->batch.lists; }

private:
    struct Pixels;
    struct Batch;

    void begin(vk::FrameGraph& graph, const DeviceTree& tree, const DeviceEnvironment& environment,
               const TraceCamera& camera, const PathOptions& options);
    [[nodiscard]] std::uint64_t batchPixels(std::uint32_t bounces) const;
    void traceInOneKernel(vk::FrameGraph& graph, const Batch& batch);
    void traceInStages(vk::FrameGraph& graph, const Batch& batch);
    void shade(vk::FrameGraph& graph, const Batch& batch, std::uint32_t bounce);
    void addFeatures(vk::FrameGraph& graph, const Batch& batch);
    void finish(vk::FrameGraph& graph, const Batch& batch);

    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    std::uint32_t m_sample_count = 0;

    /// What all samples of a picture show.
    struct Subject
    {
        std::uint64_t tree_version = 0; // 0: nothing
        std::uint64_t environment_version = 0;
        std::array<std::uint32_t, sizeof(gpu::CameraRays) / sizeof(std::uint32_t)> camera{}; // its bits
        bool orthographic = false;
        PathOptions options;

        bool operator==(const Subject&) const = default;
    };
    Subject m_subject;
    std::uint64_t m_subject_number = 0; // how often samples began anew
    std::uint64_t m_lighting_number = 0;
    TraceCamera m_camera; // of the subject, like the next two
    gpu::PathView m_view{};
    float m_voxel_edge = 0.0F;

    /// What its light depends on, beside voxels.
    struct Lighting
    {
        std::uint64_t environment_version = 0;
        glm::vec4 grid{0.0F}; // origin and edge of a voxel
        PathOptions options;  // but for the seed

        bool operator==(const Lighting&) const = default;
    };
    Lighting m_lighting;
    struct Pixels
    {
        Pixels(vk::Device& device, std::uint32_t width, std::uint32_t height, PathForm form);

        void addFeatures(vk::Device& device);
        [[nodiscard]] std::uint64_t bytes() const;

        std::uint32_t width;
        std::uint32_t height;
        PathForm form;
        vk::BufferOf<gpu::PixelSum> sums;          // [width * height]
        vk::BufferOf<gpu::PixelFeatures> features; // [width * height], empty until they are asked for
        PathBatch batch;                           // PathForm::OneKernel: of no paths
        vk::BufferOf<float> direct;                // [PathBatch::capacity()], empty without features
        vk::BufferOf<gpu::TraceStatus> status;     // [1]
        vk::BufferOf<gpu::PathView> view;          // [1] PathForm::OneKernel only
        bool is_status_clear = false;
    };
    std::unique_ptr<Pixels> m_pixels;
    TreeLights m_lights;
};

} // namespace zvo
