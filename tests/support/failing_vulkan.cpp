// SPDX-License-Identifier: MIT
#include "support/failing_vulkan.h"

#include "vk/instance.h"

#include <map>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace zvo::test
{

namespace
{

// Functions with shims that are no members of vk::Functions.
#define ZVO_TEST_GLOBAL_FUNCTIONS(X)                                                                                   \
    X(vkCreateInstance)                                                                                                \
    X(vkEnumerateInstanceExtensionProperties)                                                                          \
    X(vkEnumerateInstanceLayerProperties)

// Further functions that submit or wait; vk::Functions has none of them.
#define ZVO_TEST_WAITING_FUNCTIONS(X)                                                                                  \
    X(vkQueueSubmit)                                                                                                   \
    X(vkQueueWaitIdle)                                                                                                 \
    X(vkWaitSemaphores)

struct State
{
    std::uint64_t fail_number = UINT64_MAX;
    std::string fail_function; // empty: any function
    bool fail_on = false;      // all later calls fail, too
    bool counts_names = true;
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    std::uint64_t call_count = 0;
    std::map<std::string, std::uint64_t> call_counts; // by function
    std::string failed;
    std::map<std::uint64_t, std::string> live; // handle -> function that made it
};

State g_state;

bool mustFail(const char* name)
{
    if (!g_state.counts_names && std::string_view(name) == "vkSetDebugUtilsObjectNameEXT")
    {
        return false;
    }
    std::uint64_t number = g_state.call_count++;
    const std::uint64_t number_of_its_own = g_state.call_counts[name]++;
    if (!g_state.fail_function.empty())
    {
        number = g_state.fail_function == name ? number_of_its_own : UINT64_MAX - 1;
    }
    if (number == g_state.fail_number || (g_state.fail_on && number > g_state.fail_number))
    {
        g_state.failed = g_state.failed.empty() ? name : g_state.failed;
        return true;
    }
    return false;
}

// Numbers objects by their handles. On some drivers, handles that are not dispatchable may be equal for objects of
// different kinds; on those of the tests they are addresses or numbers of the layers, and differ.
template <typename Handle> std::uint64_t numberOf(Handle handle)
{
    return reinterpret_cast<std::uint64_t>(handle);
}

template <typename Last> void noteCreated(const char* name, Last last)
{
    if constexpr (std::is_pointer_v<Last>)
    {
        if constexpr (std::is_pointer_v<std::remove_pointer_t<Last>>)
        {
            g_state.live[numberOf(*last)] = name;
        }
    }
}

// The handle to destroy is the second argument, or the first one for instances and devices.
template <typename First, typename Second, typename... Rest>
std::uint64_t destroyedHandle(First first, Second second, Rest...)
{
    if constexpr (sizeof...(Rest) == 0)
    {
        return numberOf(first);
    }
    else
    {
        return numberOf(second);
    }
}

#define ZVO_TEST_TAG(name)                                                                                             \
    struct Tag_##name                                                                                                  \
    {                                                                                                                  \
        static constexpr const char* kName = #name;                                                                    \
    };
ZVO_TEST_GLOBAL_FUNCTIONS(ZVO_TEST_TAG)
ZVO_TEST_WAITING_FUNCTIONS(ZVO_TEST_TAG)
ZVO_VK_INSTANCE_FUNCTIONS(ZVO_TEST_TAG)
ZVO_VK_DEVICE_FUNCTIONS(ZVO_TEST_TAG)
ZVO_VK_DEBUG_FUNCTIONS(ZVO_TEST_TAG)
ZVO_VK_OWNER_INSTANCE_FUNCTIONS(ZVO_TEST_TAG)
ZVO_VK_OWNER_DEVICE_FUNCTIONS(ZVO_TEST_TAG)
ZVO_VK_OWNER_DEBUG_FUNCTIONS(ZVO_TEST_TAG)
#undef ZVO_TEST_TAG

// One class for each function; Tag makes them different.
template <typename Tag, typename Function> struct Shim;

template <typename Tag, typename Result, typename... Arguments> struct Shim<Tag, Result(VKAPI_PTR*)(Arguments...)>
{
    static inline Result(VKAPI_PTR* real)(Arguments...) = nullptr;

    static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments)
    {
        constexpr std::string_view name = Tag::kName;
        if constexpr (std::is_same_v<Result, VkResult>)
        {
            if (mustFail(Tag::kName))
            {
                if constexpr (name == "vkDeviceWaitIdle")
                {
                    real(arguments...); // a lost device is idle, too
                }
                return g_state.result;
            }
            const VkResult result = real(arguments...);
            if (result >= 0 && (name.starts_with("vkCreate") || name == "vkAllocateMemory"))
            {
                noteCreated(Tag::kName, std::get<sizeof...(Arguments) - 1>(std::tuple(arguments...)));
            }
            return result;
        }
        else
        {
            if constexpr (name.starts_with("vkDestroy") || name == "vkFreeMemory")
            {
                g_state.live.erase(destroyedHandle(arguments...));
            }
            return real(arguments...);
        }
    }
};

PFN_vkVoidFunction VKAPI_CALL deviceProcAddr(VkDevice device, const char* name);
PFN_vkVoidFunction VKAPI_CALL instanceProcAddr(VkInstance instance, const char* name);

PFN_vkGetDeviceProcAddr g_real_device_proc_addr = nullptr;

PFN_vkVoidFunction shimOf(std::string_view wanted, PFN_vkVoidFunction real)
{
#define ZVO_TEST_SHIM(name)                                                                                            \
    if (wanted == #name)                                                                                               \
    {                                                                                                                  \
        using TheShim = Shim<Tag_##name, PFN_##name>;                                                                  \
        TheShim::real = reinterpret_cast<PFN_##name>(real);                                                            \
        return reinterpret_cast<PFN_vkVoidFunction>(&TheShim::call);                                                   \
    }
    ZVO_TEST_GLOBAL_FUNCTIONS(ZVO_TEST_SHIM)
    ZVO_TEST_WAITING_FUNCTIONS(ZVO_TEST_SHIM)
    ZVO_VK_INSTANCE_FUNCTIONS(ZVO_TEST_SHIM)
    ZVO_VK_DEVICE_FUNCTIONS(ZVO_TEST_SHIM)
    ZVO_VK_DEBUG_FUNCTIONS(ZVO_TEST_SHIM)
    ZVO_VK_OWNER_INSTANCE_FUNCTIONS(ZVO_TEST_SHIM)
    ZVO_VK_OWNER_DEVICE_FUNCTIONS(ZVO_TEST_SHIM)
    ZVO_VK_OWNER_DEBUG_FUNCTIONS(ZVO_TEST_SHIM)
#undef ZVO_TEST_SHIM
    return real;
}

PFN_vkVoidFunction VKAPI_CALL deviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction real = g_real_device_proc_addr(device, name);
    return real != nullptr ? shimOf(name, real) : nullptr;
}

PFN_vkVoidFunction VKAPI_CALL instanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction real = vk::loadVulkan()(instance, name);
    if (real == nullptr)
    {
        return nullptr;
    }
    if (std::string_view(name) == "vkGetDeviceProcAddr")
    {
        g_real_device_proc_addr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(deviceProcAddr);
    }
    return shimOf(name, real);
}

void reset(std::uint64_t number, VkResult result, bool fail_on)
{
    g_state.fail_number = number;
    g_state.fail_function.clear();
    g_state.fail_on = fail_on;
    g_state.result = result;
    g_state.call_count = 0;
    g_state.call_counts.clear();
    g_state.failed.clear();
}

} // namespace

PFN_vkGetInstanceProcAddr failingVulkan()
{
    return instanceProcAddr;
}

void failCall(std::uint64_t number, VkResult result)
{
    reset(number, result, false);
}

void failCallOf(const std::string& function, std::uint64_t number)
{
    failCall(number);
    g_state.fail_function = function;
}

void failAllFrom(std::uint64_t number, VkResult result)
{
    reset(number, result, true);
}

void countNames(bool counts)
{
    g_state.counts_names = counts;
}

std::uint64_t fallibleCallCount()
{
    return g_state.call_count;
}

std::uint64_t callCount(const std::string& function)
{
    const auto found = g_state.call_counts.find(function);
    return found != g_state.call_counts.end() ? found->second : 0;
}

std::uint64_t submitOrWaitCount()
{
    std::uint64_t count = 0;
    for (const char* function : {"vkQueueSubmit", "vkQueueSubmit2", "vkQueueWaitIdle", "vkDeviceWaitIdle",
                                 "vkWaitForFences", "vkWaitSemaphores"})
    {
        count += callCount(function);
    }
    return count;
}

std::string failedFunction()
{
    return g_state.failed;
}

std::vector<std::string> liveObjects()
{
    std::vector<std::string> objects;
    for (const auto& [handle, maker] : g_state.live)
    {
        objects.push_back(maker);
    }
    return objects;
}

} // namespace zvo::test
