// SPDX-License-Identifier: MIT
// What embed_minimal does step by step, for the examples that are about something else.
#pragma once

#include "common/host.h"
#include "common/mesh.h"
#include "common/program.h"
#include "zvo/zvo.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace host
{

/// An instance, and a device on which zvo can work.
class Start
{
public:
    /// host_features: a chain of what the host itself enables, or null; it lives as long as this. number: among the
    /// devices that will do, taken round.
    explicit Start(const Options& options, void* host_features = nullptr, std::size_t number = 0);
    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;

    [[nodiscard]] const Device& device() const { return *m_device; }

    /// For zvo::Context.
    [[nodiscard]] zvo::ContextInfo contextInfo() const;

private:
    Instance m_instance;
    zvo::FeatureStorage m_features;
    VkDeviceCreateInfo m_info{};
    std::unique_ptr<Device> m_device;
};

/// Uploads a mesh and builds its tree, in frames from ++frame on, each of which it waits for. In the smallest grid
/// around the mesh, of that depth.
zvo::Tree buildTree(const Device& device, zvo::Context& context, const Mesh& mesh, std::uint32_t depth,
                    std::uint64_t& frame, bool keep_sums = false);

/// The same for a model.
zvo::Tree buildTree(const Device& device, zvo::Context& context, const zvo::ModelInfo& model_info, std::uint32_t depth,
                    std::uint64_t& frame, bool keep_sums = false);

} // namespace host
