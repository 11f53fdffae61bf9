// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <string>

namespace zvo::vk
{

/// A pipeline cache that is read from a file and written back on destruction. A file that is missing, damaged or of
/// another device gives an empty cache, and a file that cannot be written is left alone; neither is an error.
class PipelineCacheFile
{
public:
    /// path: empty for a cache without a file. functions must outlive the cache.
    PipelineCacheFile(const Functions& functions, VkPhysicalDevice physical_device, VkDevice device, std::string path);
    ~PipelineCacheFile();
    PipelineCacheFile(const PipelineCacheFile&) = delete;
    PipelineCacheFile& operator=(const PipelineCacheFile&) = delete;

    [[nodiscard]] VkPipelineCache handle() const { return m_handle; }

    /// Whether the cache was filled from the file.
    [[nodiscard]] bool loaded() const { return m_loaded; }

private:
    void save() const;

    const Functions& m_functions;
    VkDevice m_device;
    std::string m_path;
    VkPipelineCache m_handle = VK_NULL_HANDLE;
    bool m_loaded = false;
};

} // namespace zvo::vk
