// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/hdr_image.h"
#include "core/scene/sky.h"
#include "light/environment.h"
#include "vk/buffer.h"
#include "vk/frame_graph.h"
#include "vk/uploader.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo
{

/// The sun: a disc.
struct Sun
{
    glm::dvec3 direction = {0.0, 1.0, 0.0}; // towards its middle, any length
    glm::dvec3 irradiance{0.0};             // of a surface that faces it, over pi
    double angle = 0.00465;                 // radians from the middle to the rim
};

/// Light from outside of the grid: a map, or the simple sky, and a sun.
class DeviceEnvironment
{
public:
    /// The simple sky (core/scene/sky.h) at the place of the sun.
    explicit DeviceEnvironment(vk::Device& device);

    /// A map of radiance in all directions (shaders/light/environment.h says which one is where). All values must be
    /// finite and at least 0. turn: the angle, in radians, by which it is turned about up, counterclockwise as seen
    /// from above. strength: factor for its radiance. Throws Error{Usage} for a picture of no texels, and
    /// Error{Memory}.
    DeviceEnvironment(vk::Device& device, const HdrImage& picture, double turn, double strength);

    /// The map of texels [width * height], which are uploaded at once.
    DeviceEnvironment(vk::Uploader& uploads, std::uint32_t width, std::uint32_t height,
                      std::span<const glm::vec3> texels, double turn, double strength);

    void setSun(const Sun& sun);

    /// Puts the map, or the simple sky, upright in a world whose up (length 1) is another one than +y, by the least
    /// turn (uprightTurn()): before prepare() is called.
    void setUp(const glm::dvec3& up);

    /// Has the camera see another map, turned in the same way, in place of the one that gives light: before prepare()
    /// is called. Throws Error{Memory}.
    void setBackground(vk::Device& device, HdrImage map);

    /// From the next prepare() on, directions to the map are chosen evenly, whatever light comes from there; for
    /// comparisons.
    void chooseEvenly();

    /// Records what is needed before kernels use the environment, if anything has changed: uploads, and the passes that
    /// make the alias tables.
    void prepare(vk::FrameGraph& graph);

    /// Has the next prepare() record the sun anew, because the last frame was lost. The tables must be in an earlier
    /// one.
    void forgetSun()
    {
        m_is_current = false;
        m_is_prepared = m_is_prepared && !m_is_sky; // which follows the sun
    }

    /// Changes whenever the light does.
    [[nodiscard]] std::uint64_t version() const { return m_version; }

    /// Declares that pass reads all of it.
    [[nodiscard]] gpu::ConstPtr<gpu::Environment> read(vk::AnyPass& pass) const;

    /// [1] what shaders read of it, as prepare() has recorded it.
    [[nodiscard]] const vk::BufferOf<gpu::Environment>& buffer() const { return m_buffer; }

    /// [kNormals] as gpu::Environment::gives in shaders/light/environment.h.
    [[nodiscard]] const vk::BufferOf<gpu::vec2>& gives() const { return m_gives; }
    [[nodiscard]] const vk::BufferOf<gpu::AliasCell>& cells() const { return m_cells; }
    [[nodiscard]] const vk::BufferOf<gpu::AliasTotals>& totals() const { return m_totals; }
    [[nodiscard]] const gpu::EnvironmentMap& map() const { return m_values.map; }

private:
    DeviceEnvironment(vk::Device& device, std::uint32_t width, std::uint32_t height, double turn, double strength);

    void buildTables(vk::FrameGraph& graph);

    std::uint64_t m_version;
    gpu::Environment m_values{};
    std::vector<glm::vec3> m_upload; // texels that the device does not have yet
    bool m_is_sky = false;           // the simple one
    double m_turn;                   // of the map
    glm::dvec3 m_up = kUp;
    bool m_chooses_evenly = false;
    bool m_is_prepared = false;   // texels and tables
    bool m_is_current = false;    // m_buffer
    HdrImage m_background_upload; // texels that the device does not have yet
    vk::BufferOf<gpu::vec3> m_texels;
    vk::BufferOf<gpu::vec3> m_background; // no elements: the camera sees m_texels
    vk::BufferOf<gpu::AliasCell> m_cells;
    vk::BufferOf<gpu::AliasTotals> m_totals;
    vk::BufferOf<gpu::vec2> m_gives;
    vk::BufferOf<gpu::Environment> m_buffer;
    // What only the making of tables needs.
    vk::BufferOf<gpu::uint> m_weights;
    vk::BufferOf<gpu::AliasSums> m_sums;
    vk::BufferOf<gpu::AliasItem> m_light;
    vk::BufferOf<gpu::AliasItem> m_heavy;
};

} // namespace zvo
