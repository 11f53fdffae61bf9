// SPDX-License-Identifier: MIT
#include "vk/instance.h"

#include "vk/check.h"
#include "vk/owner_functions.h"
#include "zvo/error.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace zvo::vk
{

namespace
{

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

template <typename Function> Function globalFunction(PFN_vkGetInstanceProcAddr get, const char* name)
{
    return reinterpret_cast<Function>(get(VK_NULL_HANDLE, name));
}

bool hasLayer(PFN_vkGetInstanceProcAddr get, const char* name)
{
    const auto enumerate =
        globalFunction<PFN_vkEnumerateInstanceLayerProperties>(get, "vkEnumerateInstanceLayerProperties");
    std::uint32_t count = 0;
    VK_CHECK(enumerate(&count, nullptr));
    std::vector<VkLayerProperties> layers(count);
    VK_CHECK(enumerate(&count, layers.data()));
    return std::any_of(layers.begin(), layers.end(),
                       [&](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool hasExtension(PFN_vkGetInstanceProcAddr get, const char* name)
{
    const auto enumerate =
        globalFunction<PFN_vkEnumerateInstanceExtensionProperties>(get, "vkEnumerateInstanceExtensionProperties");
    std::uint32_t count = 0;
    VK_CHECK(enumerate(nullptr, &count, nullptr));
    std::vector<VkExtensionProperties> extensions(count);
    VK_CHECK(enumerate(nullptr, &count, extensions.data()));
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& extension)
                       { return std::strcmp(extension.extensionName, name) == 0; });
}

void requireValidationLayer(PFN_vkGetInstanceProcAddr get)
{
    if (!hasLayer(get, kValidationLayer))
    {
        throw Error(ErrorCode::Device, fmt::format("the Vulkan layer {} is not installed: install the package "
                                                   "vulkan-validationlayers or the Vulkan SDK, or run without "
                                                   "validation",
                                                   kValidationLayer));
    }
}

VkInstance createInstance(PFN_vkGetInstanceProcAddr get, const VkInstanceCreateInfo& info)
{
    const auto create = globalFunction<PFN_vkCreateInstance>(get, "vkCreateInstance");
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = create(&info, nullptr, &instance);
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
    {
        throwFailedCall(result, "vkCreateInstance", __FILE_NAME__, __LINE__);
    }
    if (result != VK_SUCCESS)
    {
        throw Error(ErrorCode::Device, fmt::format("vkCreateInstance failed with {}: install a Vulkan 1.3 driver, such "
                                                   "as the package mesa-vulkan-drivers",
                                                   resultName(result)));
    }
    return instance;
}

std::string lowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

int rank(const DeviceReport& report)
{
    constexpr std::string_view kBestFirst[] = {"discrete", "integrated", "virtual", "cpu"};
    return static_cast<int>(std::find(std::begin(kBestFirst), std::end(kBestFirst), report.type) -
                            std::begin(kBestFirst));
}

bool matches(const DeviceReport& report, std::size_t index, const std::string& wanted)
{
    const bool is_number =
        !wanted.empty() && std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c); });
    if (is_number)
    {
        return wanted == std::to_string(index);
    }
    return wanted.empty() || (wanted == "cpu" && report.type == "cpu") ||
           lowerCase(report.name).find(lowerCase(wanted)) != std::string::npos;
}

std::string listing(std::span<const DeviceReport> reports)
{
    if (reports.empty())
    {
        return "there is no Vulkan device: install a driver, such as the package mesa-vulkan-drivers";
    }
    std::string text = "the devices are";
    for (std::size_t i = 0; i < reports.size(); ++i)
    {
        const DeviceReport& report = reports[i];
        text +=
            fmt::format("{} {}: {} ({}), {}", i == 0 ? "" : ";", i, report.name, report.type,
                        report.usable() ? "usable" : fmt::format("not usable: {}", fmt::join(report.reasons, ", ")));
    }
    return text;
}

} // namespace

PFN_vkGetInstanceProcAddr loadVulkan()
{
    // Never closed: drivers leave threads and exit handlers behind.
    static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    const auto get = library != nullptr
                         ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"))
                         : nullptr;
    if (get == nullptr)
    {
        throw Error(ErrorCode::Device,
                    "there is no Vulkan loader (libvulkan.so.1): install the package libvulkan1 and a driver");
    }
    return get;
}

Instance::Instance(const InstanceOptions& options) : m_message_counter(options.message_counter)
{
    const PFN_vkGetInstanceProcAddr get =
        options.get_instance_proc_addr != nullptr ? options.get_instance_proc_addr : loadVulkan();
    const bool validates = options.validation || options.gpu_assisted_validation;
    if (validates)
    {
        requireValidationLayer(get);
    }
    std::vector<const char*> extensions = options.extensions;
    if (validates || hasExtension(get, VK_EXT_DEBUG_UTILS_EXTENSION_NAME))
    {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    if (validates)
    {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }

    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = onMessage;
    messenger.pUserData = this;

    std::vector<VkValidationFeatureEnableEXT> checks = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    if (options.gpu_assisted_validation)
    {
        checks.push_back(VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT);
        checks.push_back(VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT);
    }
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = static_cast<std::uint32_t>(checks.size());
    features.pEnabledValidationFeatures = checks.data();

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "zvo";
    application.apiVersion = kInstanceApiVersion;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = validates ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = validates ? 1 : 0;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    m_extensions.assign(extensions.begin(), extensions.end());
    m_handle = createInstance(get, info);
    m_functions = ownerFunctions(get, m_handle);
    if (validates && m_functions.vkCreateDebugUtilsMessengerEXT(m_handle, &messenger, nullptr, &m_messenger) < 0)
    {
        m_messenger = VK_NULL_HANDLE; // messages still arrive through the one in vkCreateInstance
    }
}

Instance::~Instance()
{
    if (m_messenger != VK_NULL_HANDLE)
    {
        m_functions.vkDestroyDebugUtilsMessengerEXT(m_handle, m_messenger, nullptr);
    }
    m_functions.vkDestroyInstance(m_handle, nullptr);
}

std::vector<DeviceReport> Instance::queryAll() const
{
    std::uint32_t count = 0;
    VK_CHECK(m_functions.vkEnumeratePhysicalDevices(m_handle, &count, nullptr));
    std::vector<VkPhysicalDevice> devices(count);
    VK_CHECK(m_functions.vkEnumeratePhysicalDevices(m_handle, &count, devices.data()));
    std::vector<DeviceReport> reports;
    for (VkPhysicalDevice device : devices)
    {
        reports.push_back(query(m_functions.vkGetInstanceProcAddr, m_handle, device, kInstanceApiVersion));
    }
    return reports;
}

VkBool32 Instance::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT,
                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* instance)
{
    Instance& self = *static_cast<Instance*>(instance);
    ++self.m_message_count;
    if (self.m_message_counter != nullptr)
    {
        ++*self.m_message_counter;
    }
    const bool error = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
    std::fprintf(stderr, "validation %s: %s\n", error ? "error" : "warning", data->pMessage);
    return VK_FALSE;
}

const DeviceReport& chooseDevice(std::span<const DeviceReport> reports, const std::string& wanted)
{
    const DeviceReport* best = nullptr;
    bool matched = false;
    for (std::size_t i = 0; i < reports.size(); ++i)
    {
        if (matches(reports[i], i, wanted))
        {
            matched = true;
            if (reports[i].usable() && (best == nullptr || rank(reports[i]) < rank(*best)))
            {
                best = &reports[i];
            }
        }
    }
    if (best == nullptr)
    {
        std::string what = "zvo can use no Vulkan device";
        if (!wanted.empty())
        {
            what = matched ? fmt::format("zvo cannot use the Vulkan device \"{}\"", wanted)
                           : fmt::format("no Vulkan device is called \"{}\"", wanted);
        }
        throw Error(ErrorCode::Device, what + "; " + listing(reports));
    }
    return *best;
}

} // namespace zvo::vk
