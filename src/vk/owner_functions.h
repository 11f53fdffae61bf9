// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

namespace zvo::vk
{

/// Functions::ofInstance(), and what owners of instances and windows call besides.
Functions ownerFunctions(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance);

/// Functions::ofDevice(), and what owners of devices and windows call besides. Throws Error{Device} as that does.
Functions ownerFunctions(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkDevice device);

} // namespace zvo::vk
