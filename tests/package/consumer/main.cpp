// SPDX-License-Identifier: MIT
// A program that embeds zvo, as small as it can be: it opens the Vulkan loader itself, and looks whether the library
// and the GLSL that it was built with are those that it was meant to be built with. consumer shared|static VERSION
// SHADER.spv
#include <zvo/zvo.hpp>

#include <dlfcn.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace
{

int failures = 0;

void expect(bool holds, const char* what)
{
    std::printf("%s: %s\n", holds ? "ok" : "FAILED", what);
    failures += holds ? 0 : 1;
}

// The file that a function of zvo came from: the library, or this program.
std::string fileOfZvo()
{
    Dl_info info{};
    return dladdr(reinterpret_cast<void*>(&zvo::version), &info) != 0 ? info.dli_fname : "";
}

template <typename Function>
Function load(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, const char* name)
{
    return reinterpret_cast<Function>(get_instance_proc_addr(instance, name));
}

// Whether zvo can use any device of this machine.
bool findsDevice()
{
    void* const loader = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (loader == nullptr)
    {
        std::printf("%s\n", dlerror());
        return false;
    }
    const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(loader, "vkGetInstanceProcAddr"));
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    VkInstance instance = VK_NULL_HANDLE;
    if (load<PFN_vkCreateInstance>(get, VK_NULL_HANDLE, "vkCreateInstance")(&info, nullptr, &instance) != VK_SUCCESS)
    {
        return false;
    }
    const auto enumerate = load<PFN_vkEnumeratePhysicalDevices>(get, instance, "vkEnumeratePhysicalDevices");
    std::uint32_t count = 0;
    enumerate(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    enumerate(instance, &count, devices.data());
    bool found = false;
    for (VkPhysicalDevice device : devices)
    {
        const zvo::DeviceReport report = zvo::query(get, instance, device, application.apiVersion);
        std::printf("%s, %s: %s\n", report.name.c_str(), report.type.c_str(),
                    report.usable() ? "usable" : "not usable");
        found = found || report.usable();
    }
    load<PFN_vkDestroyInstance>(get, instance, "vkDestroyInstance")(instance, nullptr);
    return found;
}

// What the library throws has a type that this program knows.
bool catchesError()
{
    try
    {
        const zvo::Context context{zvo::ContextInfo{}};
    }
    catch (const zvo::Error& error)
    {
        std::printf("%s\n", error.what());
        return error.code() == zvo::ErrorCode::Usage;
    }
    catch (...)
    {
        std::printf("caught something that is no zvo::Error\n");
    }
    return false;
}

bool isSpirv(const char* path)
{
    std::uint32_t magic = 0;
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(&magic), sizeof(magic));
    return magic == 0x07230203;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 4)
    {
        std::printf("consumer shared|static VERSION SHADER.spv\n");
        return 2;
    }
    expect(zvo::version() == ZVO_VERSION, "the library's version is the headers'");
    expect(std::string(ZVO_VERSION_TEXT) == argv[2], "the headers' version is the package's");
    const bool is_shared = fileOfZvo().find("libzvo.so") != std::string::npos;
    expect(is_shared == (std::string(argv[1]) == "shared"), "the library is the one that was asked for");
    expect(findsDevice(), "there is a device that zvo can use");
    expect(catchesError(), "errors of the library are caught by their type");
    expect(isSpirv(argv[3]), "the shader was compiled with zvo/trace.glsl");
    return failures == 0 ? 0 : 1;
}
