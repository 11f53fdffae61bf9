// SPDX-License-Identifier: MIT
#include "vk/pipeline_cache.h"

#include "vk/check.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

namespace zvo::vk
{

namespace
{

constexpr char kMagic[8] = {'z', 'v', 'o', 'p', 'i', 'p', 'e', '1'};

// Stands in front of the driver's data. The driver's header identifies the device; this one detects damaged data, which
// some drivers do not survive.
struct FileHeader
{
    char magic[8];
    std::uint64_t bytes;
    std::uint64_t hash;
};

// FNV-1a hash (Fowler, Noll, Vo).
std::uint64_t hashOf(const std::vector<char>& data)
{
    constexpr std::uint64_t kOffsetBasis = 14695981039346656037ull;
    constexpr std::uint64_t kPrime = 1099511628211ull;
    std::uint64_t hash = kOffsetBasis;
    for (const char byte : data)
    {
        hash = (hash ^ static_cast<unsigned char>(byte)) * kPrime;
    }
    return hash;
}

bool belongsTo(const std::vector<char>& data, const VkPhysicalDeviceProperties& device)
{
    VkPipelineCacheHeaderVersionOne header{};
    if (data.size() < sizeof(header))
    {
        return false;
    }
    std::memcpy(&header, data.data(), sizeof(header));
    return header.headerSize >= sizeof(header) && header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == device.vendorID && header.deviceID == device.deviceID &&
           std::memcmp(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

std::vector<char> load(const std::string& path, const VkPhysicalDeviceProperties& device)
{
    std::ifstream file(path, std::ios::binary);
    FileHeader header{};
    if (!file.read(reinterpret_cast<char*>(&header), sizeof(header)) ||
        std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0)
    {
        return {};
    }
    const std::vector<char> data{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const bool whole = data.size() == header.bytes && hashOf(data) == header.hash;
    return whole && belongsTo(data, device) ? data : std::vector<char>{};
}

} // namespace

PipelineCacheFile::PipelineCacheFile(const Functions& functions, VkPhysicalDevice physical_device, VkDevice device,
                                     std::string path)
    : m_functions(functions), m_device(device), m_path(std::move(path))
{
    std::vector<char> data;
    if (!m_path.empty())
    {
        VkPhysicalDeviceProperties properties{};
        functions.vkGetPhysicalDeviceProperties(physical_device, &properties);
        data = load(m_path, properties);
    }
    m_loaded = !data.empty();
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    info.initialDataSize = data.size();
    info.pInitialData = data.data();
    VK_CHECK(functions.vkCreatePipelineCache(device, &info, nullptr, &m_handle));
}

PipelineCacheFile::~PipelineCacheFile()
{
    try
    {
        save();
    }
    catch (...)
    {
        // Without a cache, only the next run takes longer.
    }
    m_functions.vkDestroyPipelineCache(m_device, m_handle, nullptr);
}

// Writes beside the file and renames, so that a reader never sees an incomplete file.
void PipelineCacheFile::save() const
{
    std::size_t bytes = 0;
    if (m_path.empty() || m_functions.vkGetPipelineCacheData(m_device, m_handle, &bytes, nullptr) != VK_SUCCESS)
    {
        return;
    }
    std::vector<char> data(bytes);
    if (m_functions.vkGetPipelineCacheData(m_device, m_handle, &bytes, data.data()) != VK_SUCCESS)
    {
        return;
    }
    data.resize(bytes);

    namespace fs = std::filesystem;
    std::error_code ignored;
    const fs::path path(m_path);
    if (path.has_parent_path())
    {
        fs::create_directories(path.parent_path(), ignored);
    }
    const fs::path temporary = fmt::format("{}.{}.{}", m_path, getpid(), static_cast<const void*>(this));
    FileHeader header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.bytes = data.size();
    header.hash = hashOf(data);
    bool written = false;
    {
        std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
        file.write(reinterpret_cast<const char*>(&header), sizeof(header));
        file.write(data.data(), static_cast<std::streamsize>(data.size()));
        file.close();
        written = !file.fail();
    }
    std::error_code failed;
    if (written)
    {
        fs::rename(temporary, path, failed);
    }
    if (!written || failed)
    {
        fs::remove(temporary, ignored);
    }
}

} // namespace zvo::vk
