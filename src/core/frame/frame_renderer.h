// SPDX-License-Identifier: MIT
#pragma once

#include "core/denoise/denoiser.h"
#include "core/frame/frame_options.h"
#include "core/frame/primary_samples.h"
#include "core/light/environment.h"
#include "core/path/develop.h"
#include "core/path/path_tracer.h"
#include "core/radiance/device_radiance_cache.h"
#include "core/radiance/radiance_view.h"
#include "core/scene/camera.h"
#include "core/trace/tree_tracer.h"
#include "core/tree/device_tree.h"
#include "vk/deletion_queue.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <memory>

namespace zvo
{

/// What a frame shows, and from where.
struct FrameSubject
{
    const DeviceTree& tree;
    const TraceCamera& camera;
    DeviceEnvironment* environment = nullptr; // Integrator::Primary needs none
    /// Light that was brought up to date elsewhere, for the same tree and environment. Null: that of the renderer,
    /// which samples bring up to date.
    const DeviceRadianceCache* cache = nullptr;
};

/// From a tree to a picture: records the passes of every integrator, and owns their buffers, which are made when an
/// integrator needs them. The API, `zvo render` and the window make their pictures here.
class FrameRenderer
{
public:
    /// deletion_queue, texels: as in TreeTracer.
    explicit FrameRenderer(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr,
                           TexelFormat texels = TexelFormat::Rgba8)
        : m_device(device), m_deletion_queue(deletion_queue), m_tracer(device, deletion_queue, texels)
    {
    }

    /// Sets the size of the next pictures. Must be called before the first one. Throws Error{Memory}; then the size
    /// stays as it was.
    void resize(std::uint32_t width, std::uint32_t height) { m_tracer.resize(width, height); }

    /// Makes the buffers that samples of a tree need, with light of the renderer; addSample() makes them, too. Throws
    /// Error{Memory}; then what pictures show stays as it was.
    void reserve(const DeviceTree& tree, const FrameOptions& options);

    /// Records the passes of a whole frame, and makes the picture: addSample(), denoise() and develop(). All but paths
    /// begin a new picture. ray_lists: as in PathTracer::addSample().
    void render(vk::FrameGraph& graph, const FrameSubject& subject, const FrameOptions& options,
                vk::BufferOf<gpu::DispatchArgs>* ray_lists = nullptr);

    /// Records the passes that add a sample to each pixel of samples(), or make the picture where options have none.
    /// Paths begin anew by themselves (PathTracer::addSample()); others do so after beginPicture(), and their samples
    /// go through other points of the pixels, the same of each. Throws Error{Memory}. Cost: that of the integrator.
    void addSample(vk::FrameGraph& graph, const FrameSubject& subject, const FrameOptions& options,
                   vk::BufferOf<gpu::DispatchArgs>* ray_lists = nullptr);

    /// Records the passes that smooth samples(), where options ask for it. Cost: pixels.
    void denoise(vk::FrameGraph& graph, const FrameOptions& options);

    /// Records the passes that make the picture of samples(), where options have any. Cost: pixels.
    void develop(vk::FrameGraph& graph, const FrameOptions& options);

    /// Records the passes that make the node paths of a tree, if they are out of date. Primary rays begin with this.
    void prepare(vk::FrameGraph& graph, const DeviceTree& tree) { m_tracer.prepare(graph, tree); }

    /// Records what tracePrimary() records: the hits of the camera's rays, in buffers().
    void traceHits(vk::FrameGraph& graph, const FrameSubject& subject, const FrameOptions& options)
    {
        m_tracer.tracePrimary(graph, subject.tree, subject.camera, options.trace);
    }

    /// Records the passes of a frame that brings the renderer's light up to date and shows none, for as long as there
    /// is no picture. Throws Error{Memory}. Cost: as addSample(), without what it takes to show light.
    void settle(vk::FrameGraph& graph, const FrameSubject& subject, const FrameOptions& options);

    /// Begins a new picture of the integrator with the next sample. The radiance cache stays, and so do earlier
    /// pictures that help to denoise.
    void beginPicture(const FrameOptions& options);

    /// Forgets the samples of paths, and earlier pictures that help to denoise: because the last frame was lost, or
    /// others are to be shown.
    void forgetSamples();

    /// Has the node paths made anew for the next picture: because the last frame was lost.
    void forgetNodePaths() { m_tracer.forget(); }

    /// Drops what samples need, and the radiance cache; frames make it anew. Call it when another integrator is shown
    /// from now on, or kernels may have changed.
    void dropSamples();

    /// The samples of the integrator's picture so far, denoised where options ask for it and denoise() has recorded so.
    [[nodiscard]] SampledPicture samples(const FrameOptions& options) const;

    /// What is known of the pixels beside the samples of paths, with PathOptions::features.
    [[nodiscard]] GuidedPicture guided() const { return m_paths->guided(); }

    /// The buffers of primary rays, and of the last picture: `image`.
    [[nodiscard]] const TraceBuffers& buffers() const { return m_tracer.buffers(); }

    /// [1] the factor of the radiance in the last picture of samples.
    [[nodiscard]] const vk::BufferOf<float>& exposure() const { return m_developer->exposure(); }

    /// The radiance cache, if samples bring it up to date.
    [[nodiscard]] DeviceRadianceCache& cache();

    /// Frames that brought the radiance cache up to date so far; 0 without one.
    [[nodiscard]] std::uint32_t cacheFrameCount() const { return m_cache == nullptr ? 0 : m_cache->frameCount(); }

    /// Paths that were traced for each pixel so far; 0 without paths.
    [[nodiscard]] std::uint32_t pathCount() const { return m_paths == nullptr ? 0 : m_paths->sampleCount(); }

    /// [1] the rays of paths that were given up.
    [[nodiscard]] const vk::BufferOf<gpu::TraceStatus>& pathStatus() const { return m_paths->status(); }

    /// Elements of the lists of a sample's rays (PathTracer::listElements()); 0 for other integrators.
    [[nodiscard]] std::uint64_t rayListElements(const FrameOptions& options) const;

    /// Device memory of all buffers but the node paths'.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    // These make what is not there yet.
    PathTracer& pathsOfSize(const FrameOptions& options);
    Denoiser& denoiserOfSize();
    RadianceView& viewOfSize();
    PrimarySamples& primaryOfSize();
    Developer& developer();
    void updateCache(vk::FrameGraph& graph, const FrameSubject& subject, const TraceCamera& camera,
                     const FrameOptions& options);

    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    TreeTracer m_tracer;
    std::unique_ptr<PathTracer> m_paths; // null until an integrator needs it, like those below
    std::unique_ptr<Denoiser> m_denoiser;
    std::unique_ptr<DeviceRadianceCache> m_cache;
    std::unique_ptr<RadianceView> m_view;
    std::unique_ptr<PrimarySamples> m_primary;
    std::unique_ptr<Developer> m_developer;
};

} // namespace zvo
