// SPDX-License-Identifier: MIT
#include "vk/functions.h"

#include "zvo/error.h"

namespace zvo::vk
{

Functions Functions::ofInstance(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance)
{
    Functions functions;
    functions.vkGetInstanceProcAddr = get_instance_proc_addr;
#define ZVO_VK_LOAD(name) functions.name = reinterpret_cast<PFN_##name>(get_instance_proc_addr(instance, #name));
    ZVO_VK_INSTANCE_FUNCTIONS(ZVO_VK_LOAD)
    ZVO_VK_DEBUG_FUNCTIONS(ZVO_VK_LOAD)
#undef ZVO_VK_LOAD
    return functions;
}

Functions Functions::ofDevice(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkDevice device)
{
    Functions functions = ofInstance(get_instance_proc_addr, instance);
    if (functions.vkGetDeviceProcAddr == nullptr)
    {
        throw Error(ErrorCode::Device, "the Vulkan instance has no vkGetDeviceProcAddr: pass the vkGetInstanceProcAddr "
                                       "that belongs to it");
    }
    std::string missing;
#define ZVO_VK_LOAD(name)                                                                                              \
    functions.name = reinterpret_cast<PFN_##name>(functions.vkGetDeviceProcAddr(device, #name));                       \
    missing += functions.name == nullptr ? " " #name : "";
    ZVO_VK_DEVICE_FUNCTIONS(ZVO_VK_LOAD)
#undef ZVO_VK_LOAD
    requireFunctions(missing);
    return functions;
}

void requireFunctions(const std::string& missing)
{
    if (!missing.empty())
    {
        throw Error(ErrorCode::Device,
                    "the Vulkan device lacks functions of Vulkan 1.3:" + missing +
                        ": create its instance with apiVersion 1.3 and use a driver that supports it");
    }
}

} // namespace zvo::vk
