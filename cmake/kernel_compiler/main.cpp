// SPDX-License-Identifier: MIT
// Part of the build: compiles kernels to SPIR-V with glslang, simplifies them with spirv-opt's passes and checks them
// as spirv-val does.
//   zvo_kernel_compiler LIST INCLUDE DEPFILE [PASS...]
// LIST: a file with three lines a kernel, its source, the module to write, and a word to define or nothing. INCLUDE:
// the folder where #include looks, after that of the including file. DEPFILE: gets what the modules were made of, as
// make reads it. PASS: as spirv-opt takes them. Many kernels share a process, because glslang makes tables of built-in
// functions when it starts, which takes longer than most kernels.
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#if __has_include(<glslang/SPIRV/GlslangToSpv.h>)
#include <glslang/SPIRV/GlslangToSpv.h>
#else // in glslang's own sources
#include <SPIRV/GlslangToSpv.h>
#endif
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

using Module = std::vector<std::uint32_t>;

constexpr spv_target_env kTarget = SPV_ENV_VULKAN_1_3;

std::string contentOf(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
    {
        throw std::runtime_error("cannot read " + file);
    }
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write(const std::string& file, const void* data, std::size_t size)
{
    std::ofstream stream(file, std::ios::binary);
    stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    if (!stream.flush())
    {
        throw std::runtime_error("cannot write " + file);
    }
}

// Finds includes, and remembers them.
class Includer : public glslang::TShader::Includer
{
public:
    Includer(std::filesystem::path folder, std::set<std::string>& files) : m_folder(std::move(folder)), m_files(files)
    {
    }

    IncludeResult* includeLocal(const char* name, const char* includer, std::size_t /*depth*/) override
    {
        const std::filesystem::path beside = std::filesystem::path(includer).parent_path() / name;
        const std::string path = (std::filesystem::exists(beside) ? beside : m_folder / name).string();
        if (!std::filesystem::exists(path))
        {
            return nullptr; // glslang says where it was asked for
        }
        m_files.insert(path);
        auto* content = new std::string(contentOf(path));
        return new IncludeResult(path, content->data(), content->size(), content);
    }

    void releaseInclude(IncludeResult* result) override
    {
        if (result != nullptr)
        {
            delete static_cast<std::string*>(result->userData);
            delete result;
        }
    }

private:
    std::filesystem::path m_folder;
    std::set<std::string>& m_files;
};

Module compile(const std::string& source, const std::string& word, Includer& includer)
{
    const std::string text = contentOf(source);
    const char* const string = text.data();
    const int length = static_cast<int>(text.size());
    const char* const name = source.c_str();
    const std::string preamble = word.empty() ? "" : "#define " + word + "\n";
    constexpr int kVulkan = 100;
    constexpr auto kRules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&string, &length, &name, 1);
    shader.setPreamble(preamble.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, kVulkan);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    glslang::TProgram program; // goes before its shader
    if (!shader.parse(GetDefaultResources(), kVulkan, false, kRules, includer))
    {
        throw std::runtime_error(shader.getInfoLog());
    }
    program.addShader(&shader);
    if (!program.link(kRules))
    {
        throw std::runtime_error(program.getInfoLog());
    }
    Module module;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), module);
    return module;
}

// Passes run once in their life, so each module has its own.
Module simplified(const Module& module, const std::vector<std::string>& passes)
{
    std::string message;
    spvtools::Optimizer optimizer(kTarget);
    optimizer.SetMessageConsumer([&](auto, auto, const auto&, const char* text) { message = text; });
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    options.set_preserve_spec_constants(true);
    Module result;
    if (!optimizer.RegisterPassesFromFlags(passes) || !optimizer.Run(module.data(), module.size(), &result, options))
    {
        throw std::runtime_error("spirv-opt: " + message);
    }
    return result;
}

void check(const Module& module)
{
    std::string message;
    spvtools::SpirvTools tools(kTarget);
    tools.SetMessageConsumer([&](auto, auto, const auto&, const char* text) { message = text; });
    spvtools::ValidatorOptions rules;
    rules.SetScalarBlockLayout(true);
    if (!tools.Validate(module.data(), module.size(), rules))
    {
        throw std::runtime_error("spirv-val: " + message);
    }
}

// A file's name as make reads it.
std::string escaped(const std::string& file)
{
    std::string result;
    for (const char letter : file)
    {
        result += letter == ' ' || letter == '#' ? "\\" : letter == '$' ? "$" : "";
        result += letter;
    }
    return result;
}

void compileAll(const std::string& list, const std::string& include, const std::string& depfile,
                const std::vector<std::string>& passes)
{
    std::set<std::string> files;
    Includer includer(include, files);
    std::string dependencies;
    std::ifstream lines(list);
    bool failed = false;
    std::string source;
    std::string output;
    std::string word;
    while (std::getline(lines, source) && std::getline(lines, output) && std::getline(lines, word))
    {
        files.insert(source);
        try
        {
            Module module = compile(source, word, includer);
            module = passes.empty() ? module : simplified(module, passes);
            check(module);
            write(output, module.data(), module.size() * sizeof(Module::value_type));
        }
        catch (const std::exception& error)
        {
            std::fprintf(stderr, "%s: %s\n", source.c_str(), error.what());
            failed = true;
        }
        if (dependencies.empty())
        {
            dependencies = escaped(output) + ":";
        }
    }
    if (failed || dependencies.empty())
    {
        throw std::runtime_error("kernels of " + list + " were not made");
    }
    for (const std::string& file : files)
    {
        dependencies += " " + escaped(file);
    }
    dependencies += "\n";
    write(depfile, dependencies.data(), dependencies.size());
}

} // namespace

int main(int argc, char** argv)
{
    try
    {
        const std::vector<std::string> arguments(argv + 1, argv + argc);
        if (arguments.size() < 3)
        {
            throw std::runtime_error("usage: zvo_kernel_compiler LIST INCLUDE DEPFILE [PASS...]");
        }
        glslang::InitializeProcess();
        compileAll(arguments[0], arguments[1], arguments[2], {arguments.begin() + 3, arguments.end()});
        glslang::FinalizeProcess();
        return 0;
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
