// SPDX-License-Identifier: MIT
#include "vk/owner_functions.h"

namespace zvo::vk
{

namespace
{

void addOfInstance(Functions& functions, VkInstance instance)
{
#define ZVO_VK_LOAD(name)                                                                                              \
    functions.name = reinterpret_cast<PFN_##name>(functions.vkGetInstanceProcAddr(instance, #name));
    ZVO_VK_OWNER_INSTANCE_FUNCTIONS(ZVO_VK_LOAD)
    ZVO_VK_OWNER_DEBUG_FUNCTIONS(ZVO_VK_LOAD)
    ZVO_VK_WINDOW_INSTANCE_FUNCTIONS(ZVO_VK_LOAD)
#undef ZVO_VK_LOAD
}

} // namespace

Functions ownerFunctions(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance)
{
    Functions functions = Functions::ofInstance(get_instance_proc_addr, instance);
    addOfInstance(functions, instance);
    return functions;
}

Functions ownerFunctions(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkDevice device)
{
    Functions functions = Functions::ofDevice(get_instance_proc_addr, instance, device);
    addOfInstance(functions, instance);
    std::string missing;
#define ZVO_VK_LOAD(name)                                                                                              \
    functions.name = reinterpret_cast<PFN_##name>(functions.vkGetDeviceProcAddr(device, #name));                       \
    missing += functions.name == nullptr ? " " #name : "";
    ZVO_VK_OWNER_DEVICE_FUNCTIONS(ZVO_VK_LOAD)
#undef ZVO_VK_LOAD
#define ZVO_VK_LOAD(name) functions.name = reinterpret_cast<PFN_##name>(functions.vkGetDeviceProcAddr(device, #name));
    ZVO_VK_WINDOW_DEVICE_FUNCTIONS(ZVO_VK_LOAD)
#undef ZVO_VK_LOAD
    requireFunctions(missing);
    return functions;
}

} // namespace zvo::vk
