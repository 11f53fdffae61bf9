// SPDX-License-Identifier: MIT
#include "common/program.h"

#include "common/host.h"
#include "common/mesh.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace host
{

namespace
{

Options parse(int count, char** arguments)
{
    Options options;
    if (const char* const device = std::getenv("ZVO_DEVICE"))
    {
        options.device = device;
    }
    for (int i = 1; i < count; ++i)
    {
        const std::string argument = arguments[i];
        const bool has_value = i + 1 < count;
        if (argument == "--help")
        {
            options.help = true;
        }
        else if (argument == "--validation")
        {
            options.validation = true;
        }
        else if (argument == "--no-optional")
        {
            options.optional = false;
        }
        else if (argument == "--device" && has_value)
        {
            options.device = arguments[++i];
        }
        else if (argument == "--ply" && has_value)
        {
            options.ply = arguments[++i];
        }
        else if (argument.starts_with("-"))
        {
            throw std::runtime_error("there is no option " + argument + ", or it lacks its value");
        }
        else
        {
            options.arguments.push_back(argument);
        }
    }
    return options;
}

} // namespace

int run(int count, char** arguments, const char* usage, std::size_t arguments_min,
        const std::function<void(const Options&)>& example)
{
    try
    {
        const Options options = parse(count, arguments);
        const std::string help = std::string("usage: ") + arguments[0] + " " + usage +
                                 " [--device NAME] [--validation] [--no-optional] [--ply FILE]";
        if (options.help)
        {
            std::printf("%s\n", help.c_str());
            return 0;
        }
        if (options.arguments.size() < arguments_min)
        {
            throw std::runtime_error(help);
        }
        if (!options.ply.empty())
        {
            writePly(knot(), options.ply);
        }
        example(options);
        return Instance::messageCount() == 0 ? 0 : 1;
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

} // namespace host
