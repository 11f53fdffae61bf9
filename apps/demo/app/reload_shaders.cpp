// SPDX-License-Identifier: MIT
#include "demo/app/reload_shaders.h"

#include "zvo/error.h"

#include <utility>
#include <vector>

namespace zvo::demo
{

ReloadedShaders reloadShaders(vk::KernelCache& kernels, ShaderSources& sources)
{
    ReloadedShaders result;
    try
    {
        for (CompiledShader& shader : sources.compile(sources.takeChanged(kernels.names())))
        {
            if (shader.words.empty())
            {
                result.message += shader.message;
                continue;
            }
            try
            {
                kernels.replace(shader.name, std::move(shader.words));
                ++result.count;
            }
            catch (const Error& error)
            {
                result.message += std::string(error.what()) + "\n";
            }
        }
    }
    catch (const Error& error)
    {
        result.message += error.what();
    }
    kernels.releaseReplaced();
    return result;
}

} // namespace zvo::demo
