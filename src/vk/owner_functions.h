// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

namespace zvo::vk
{

/// Functions::ofInstance(), and also the functions that owners of instances and windows call.
Functions ownerFunctions(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance);

/// Functions::ofDevice(), and also the functions that owners of devices and windows call. Throws as
/// Functions::ofDevice().
Functions ownerFunctions(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkDevice device);

} // namespace zvo::vk
