// SPDX-License-Identifier: MIT
#include "core/light/environment.h"

#include "core/base/divide_up.h"
#include "core/base/new_version.h"
#include "core/scene/sky.h"
#include "vk/device.h"
#include "zvo/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kSkyWidth = 256;
constexpr std::uint32_t kSkyHeight = 128;

// Cells are at least so many, that each lies on one side of a plane through the middle or has a corner on either.
constexpr std::uint32_t kCellsMin = 16;

// The number of cells along an edge of the map: as many as texels, or so few that one covers `texels` of them.
std::uint32_t cellsAlong(std::uint32_t edge, std::uint32_t texels)
{
    return std::max(static_cast<std::uint32_t>(divideUp(edge, texels)), kCellsMin);
}

gpu::EnvironmentMap mapOf(std::uint32_t width, std::uint32_t height)
{
    std::uint32_t texels = 1;
    while (std::uint64_t{cellsAlong(width, texels)} * cellsAlong(height, texels) > gpu::kAliasCellsMax)
    {
        ++texels;
    }
    gpu::EnvironmentMap map{};
    map.width = width;
    map.height = height;
    map.cells_x = cellsAlong(width, texels);
    map.cells_y = cellsAlong(height, texels);
    return map;
}

} // namespace

DeviceEnvironment::DeviceEnvironment(vk::Device& device, std::uint32_t width, std::uint32_t height, double turn,
                                     double strength)
    : m_version(newVersion()), m_turn(turn)
{
    if (width == 0 || height == 0)
    {
        throw Error(ErrorCode::Usage, "an environment map has no texels");
    }
    m_values.map = mapOf(width, height);
    setUp(kUp);
    m_values.strength = static_cast<float>(strength);
    m_values.background_width = width;
    m_values.background_height = height;
    const std::uint64_t texel_count = std::uint64_t{width} * height;
    const std::uint64_t cell_count = std::uint64_t{m_values.map.cells_x} * m_values.map.cells_y;
    const std::uint64_t table_cells = gpu::kNormals * cell_count;
    device.memory().require(texel_count * sizeof(gpu::vec3) +
                                table_cells * (sizeof(gpu::AliasCell) + sizeof(gpu::uint) + 2 * sizeof(gpu::AliasItem)),
                            "the environment map");
    m_texels = {device, "light/texels", texel_count};
    m_cells = {device, "light/alias_cells", table_cells};
    m_totals = {device, "light/alias_totals", 1};
    m_gives = {device, "light/environment_gives", gpu::kNormals};
    m_buffer = {device, "light/environment", 1};
    m_weights = {device, "light/alias_weights", table_cells};
    m_sums = {device, "light/alias_sums", gpu::kNormals * (divideUp(cell_count, gpu::kAliasBlock) + 1)};
    m_light = {device, "light/alias_light", table_cells};
    m_heavy = {device, "light/alias_heavy", table_cells};
    setSun({});
}

DeviceEnvironment::DeviceEnvironment(vk::Device& device) : DeviceEnvironment(device, kSkyWidth, kSkyHeight, 0.0, 1.0)
{
    m_is_sky = true;
}

DeviceEnvironment::DeviceEnvironment(vk::Device& device, const HdrImage& picture, double turn, double strength)
    : DeviceEnvironment(device, picture.width, picture.height, turn, strength)
{
    m_upload = picture.texels;
}

DeviceEnvironment::DeviceEnvironment(vk::Uploader& uploads, std::uint32_t width, std::uint32_t height,
                                     std::span<const glm::vec3> texels, double turn, double strength)
    : DeviceEnvironment(uploads.device(), width, height, turn, strength)
{
    uploads.upload(m_texels, texels);
}

void DeviceEnvironment::setSun(const Sun& sun)
{
    const double length = glm::length(sun.direction);
    const glm::dvec3 direction = length > 0.0 ? sun.direction / length : m_up;
    const double sine = std::sin(sun.angle);
    const gpu::vec3 radiance(sun.irradiance / (sine * sine));
    const gpu::Environment before = m_values;
    m_values.to_sun = gpu::vec3(direction);
    m_values.sun = radiance;
    m_values.sun_height = static_cast<float>(2.0 * std::pow(std::sin(0.5 * sun.angle), 2.0));
    if (before.to_sun != m_values.to_sun || before.sun != m_values.sun || before.sun_height != m_values.sun_height)
    {
        m_is_current = false;
        m_is_prepared = m_is_prepared && (!m_is_sky || before.to_sun == m_values.to_sun);
        m_version = newVersion();
    }
}

void DeviceEnvironment::setUp(const glm::dvec3& up)
{
    const glm::dmat3 upright = uprightTurn(up);
    const double c = std::cos(m_turn);
    const double s = std::sin(m_turn);
    m_up = up;
    m_values.map.right = gpu::vec3(upright * glm::dvec3(c, 0.0, -s));
    m_values.map.up = gpu::vec3(up);
    m_values.map.back = gpu::vec3(upright * glm::dvec3(s, 0.0, c));
}

void DeviceEnvironment::setBackground(vk::Device& device, HdrImage map)
{
    m_background = {device, "light/background", map.texels.size()};
    m_values.background_width = map.width;
    m_values.background_height = map.height;
    m_background_upload = std::move(map);
}

void DeviceEnvironment::chooseEvenly()
{
    m_chooses_evenly = true;
    m_version = newVersion();
}

void DeviceEnvironment::prepare(vk::FrameGraph& graph)
{
    if (!m_is_prepared)
    {
        if (m_is_sky)
        {
            vk::Pass pass = graph.addPass(gpu::light::SkyTexels{});
            const gpu::SkyTexelsParams params = {pass.write(m_texels),
                                                 skyOf(glm::dvec3(m_values.to_sun) * uprightTurn(m_up)),
                                                 m_values.map.width, m_values.map.height};
            pass.dispatch(m_texels.count(), params);
        }
        else
        {
            graph.update(m_texels, 0, m_upload); // none where they were uploaded
            graph.update(m_background, 0, m_background_upload.texels);
        }
        buildTables(graph);
        m_upload = {};
        m_background_upload = {};
        m_is_prepared = true;
    }
    if (!m_is_current)
    {
        m_values.texels = {m_texels.address()};
        m_values.background = {(m_background.count() == 0 ? m_texels : m_background).address()};
        m_values.cells = {m_cells.address()};
        m_values.gives = {m_gives.address()};
        graph.update(m_buffer, 0, std::array{m_values});
        vk::Pass pass = graph.addPass(gpu::light::EnvironmentGives{});
        const gpu::EnvironmentGivesParams params = {pass.read(m_totals), pass.write(m_gives), m_values.to_sun,
                                                    m_values.sun,        m_values.sun_height, m_values.strength};
        pass.dispatch(1, params);
        m_is_current = true;
    }
}

void DeviceEnvironment::buildTables(vk::FrameGraph& graph)
{
    const std::uint64_t cell_count = m_cells.count() / gpu::kNormals;
    const std::uint64_t block_count = divideUp(cell_count, gpu::kAliasBlock);
    graph.fill(m_totals, 0);
    {
        vk::Pass pass = graph.addPass(gpu::light::AliasWeights{.evenly = m_chooses_evenly});
        const gpu::AliasWeightsParams params = {pass.read(m_texels), pass.write(m_weights), pass.readWrite(m_totals),
                                                m_values.map};
        pass.dispatch(cell_count, params);
    }
    const auto run = [&]<typename Kernel>(const Kernel& kernel, std::uint64_t threads)
    {
        vk::Pass pass = graph.addPass(kernel);
        const gpu::AliasParams params = {pass.readWrite(m_weights),
                                         pass.readWrite(m_totals),
                                         pass.readWrite(m_sums),
                                         pass.readWrite(m_light),
                                         pass.readWrite(m_heavy),
                                         pass.readWrite(m_cells),
                                         static_cast<std::uint32_t>(cell_count),
                                         static_cast<std::uint32_t>(block_count)};
        pass.dispatch(threads, params);
    };
    const std::uint64_t block_threads = gpu::kNormals * block_count * gpu::kAliasGroup;
    run(gpu::light::AliasTotals{}, block_threads);
    run(gpu::light::AliasSums{}, block_threads);
    run(gpu::light::AliasScan{}, gpu::kNormals * gpu::kAliasGroup);
    run(gpu::light::AliasLists{}, block_threads);
    run(gpu::light::AliasFill{}, gpu::kNormals * cell_count);
}

gpu::ConstPtr<gpu::Environment> DeviceEnvironment::read(vk::AnyPass& pass) const
{
    pass.read(m_texels);
    pass.read(m_background);
    pass.read(m_cells);
    return pass.read(m_buffer);
}

} // namespace zvo
