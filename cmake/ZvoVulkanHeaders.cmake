# SPDX-License-Identifier: MIT
# Makes Vulkan::Headers, if vulkan/vulkan_core.h can be found and nobody made it before. CMake's own FindVulkan asks for
# a loader too, which zvo does not link.
if(NOT TARGET Vulkan::Headers)
    find_package(VulkanHeaders CONFIG QUIET)
endif()
if(NOT TARGET Vulkan::Headers)
    find_path(Vulkan_INCLUDE_DIR vulkan/vulkan_core.h HINTS $ENV{VULKAN_SDK}/include)
    mark_as_advanced(Vulkan_INCLUDE_DIR)
    if(Vulkan_INCLUDE_DIR)
        add_library(Vulkan::Headers INTERFACE IMPORTED)
        target_include_directories(Vulkan::Headers INTERFACE ${Vulkan_INCLUDE_DIR})
    endif()
endif()
