// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo
{

/// The unit vector of an octahedral code (gpu::Attribute::normal); 0 for gpu::kNoNormal.
glm::vec3 decodeNormal(std::uint32_t code);

} // namespace zvo
