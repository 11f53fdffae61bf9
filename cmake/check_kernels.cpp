// SPDX-License-Identifier: MIT
// Part of the build: tells where what headers declare of kernels differs from the modules that were made of them.
// KERNELS and DECLARATIONS: the functions that list both.
#include "vk/kernel.h"
#include "vk/kernel_declaration.h"

#include <cstdio>
#include <exception>

namespace zvo
{
std::span<const vk::EmbeddedKernel> KERNELS();
std::vector<vk::KernelDeclaration> DECLARATIONS();
} // namespace zvo

int main()
{
    try
    {
        const std::vector<std::string> found = zvo::vk::differences(zvo::DECLARATIONS(), zvo::KERNELS());
        for (const std::string& line : found)
        {
            std::fprintf(stderr, "error: kernel %s\n", line.c_str());
        }
        return found.empty() ? 0 : 1;
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
