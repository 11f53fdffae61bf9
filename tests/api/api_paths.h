// SPDX-License-Identifier: MIT
// What the tests of path-traced pictures through the API share: a host, its trees and its light.
#pragma once

#include "api_scene.h"
#include "core/light/environment.h"
#include "core/scene/hdr_image.h"
#include "support/embedding_host.h"
#include "support/host_model.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace zvo::test
{

/// The scene of the tests of the API, as a host describes it.
const HostModel& pathModel();

/// A map with a bright spot, with the numbers that hosts and the engine take.
struct SpotMap
{
    static constexpr double kTurn = 0.7;
    static constexpr float kStrength = 1.5F;

    SpotMap();

    [[nodiscard]] EnvironmentMapInfo info() const { return {16, 8, texels, kTurn, kStrength}; }

    HdrImage picture;
    std::vector<Vec3> texels;
};

/// The engine's environment that is as a host's without a map.
DeviceEnvironment engineSky();

/// All of these tests have one host, because path tracing takes many kernels.
class ApiPaths : public testing::Test
{
public:
    using Words = std::vector<std::uint32_t>;

    static constexpr std::uint32_t kWidth = 41;
    static constexpr std::uint32_t kHeight = 27;
    static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
    static constexpr PathInfo kFewBounces = {.bounces = 2};
    static constexpr PathInfo kDenoised = {.bounces = 2, .denoise = true};

protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite() { s_host.reset(); }

    ~ApiPaths() override;

    Tree octree(std::uint32_t depth = 5);
    Environment sky() { return m_host.make<Environment>(); }
    Environment spotMap() { return m_host.make<Environment>(SpotMap().info()); }
    Tracer tracer(VkFormat format = kFormat) { return {m_host.context, kWidth, kHeight, format}; }

    [[nodiscard]] std::uint64_t used() { return m_host.context.memory().used; }

    /// Adds samples in a frame of its own. Returns the picture.
    template <typename AnyTree>
    Words paths(Tracer& tracer, AnyTree& tree, Environment& environment, const PathInfo& info = kFewBounces,
                const CameraInfo& camera = apiCamera())
    {
        TargetImage image(m_host.device, kFormat, kWidth, kHeight);
        return m_host.picture(image, [&](Recorder& recorder, const ImageTarget& target)
                              { tracer.tracePaths(recorder, tree, environment, camera, info, target); });
    }

    /// The first picture of a new tracer.
    template <typename AnyTree>
    Words newPaths(AnyTree& tree, Environment& environment, const PathInfo& info = kFewBounces,
                   const CameraInfo& camera = apiCamera())
    {
        Tracer tracer = this->tracer();
        return paths(tracer, tree, environment, info, camera);
    }

    static std::unique_ptr<EmbeddingHost> s_host;
    EmbeddingHost& m_host = *s_host;
};

} // namespace zvo::test
