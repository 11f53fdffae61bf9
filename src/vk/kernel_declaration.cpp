// SPDX-License-Identifier: MIT
#include "vk/kernel_declaration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace zvo::vk
{

namespace
{

constexpr std::string_view kNoConstant = "no other constant";

// The shader's name of a constant: "wide_keys" becomes kWideKeys.
std::string shaderName(std::string_view name)
{
    std::string result = "k";
    bool begins_word = true;
    for (const char letter : name)
    {
        if (letter == '_')
        {
            begins_word = true;
            continue;
        }
        result += begins_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
        begins_word = false;
    }
    return result;
}

const char* typeName(ConstantType type)
{
    switch (type)
    {
    case ConstantType::Bool:
        return "bool";
    case ConstantType::Uint:
        return "uint";
    case ConstantType::Int:
        return "int";
    case ConstantType::Other:
        break;
    }
    return "of another type";
}

ConstantType typeOf(const gpu::ConstantDescription& constant)
{
    return constant.is_bool ? ConstantType::Bool : constant.is_signed ? ConstantType::Int : ConstantType::Uint;
}

std::string text(const ModuleConstant& constant)
{
    return fmt::format("layout(constant_id = {}) {} {} = {}", constant.id, typeName(constant.type), constant.name,
                       constant.value);
}

std::vector<std::string> constantTexts(const KernelDeclaration& declaration)
{
    std::vector<std::string> texts;
    for (const gpu::ConstantDescription& constant : declaration.constants)
    {
        texts.push_back(text(
            {static_cast<std::uint32_t>(texts.size()), shaderName(constant.name), typeOf(constant), constant.value}));
    }
    return texts;
}

std::vector<std::string> constantTexts(const KernelInterface& interface)
{
    std::vector<std::string> texts;
    std::ranges::transform(interface.constants, std::back_inserter(texts), text);
    return texts;
}

void compare(const KernelDeclaration& declaration, const KernelInterface& interface, std::vector<std::string>& found)
{
    if (declaration.params_name != interface.params_name || declaration.params_bytes != interface.push_constant_bytes)
    {
        found.push_back(fmt::format("{} is declared to take {} of {} bytes; its shader takes {} of {}",
                                    declaration.name, declaration.params_name, declaration.params_bytes,
                                    interface.params_name, interface.push_constant_bytes));
    }
    const std::vector<std::string> declared = constantTexts(declaration);
    const std::vector<std::string> actual = constantTexts(interface);
    for (std::size_t i = 0; i < std::max(declared.size(), actual.size()); ++i)
    {
        const std::string_view expected = i < declared.size() ? std::string_view(declared[i]) : kNoConstant;
        const std::string_view is = i < actual.size() ? std::string_view(actual[i]) : kNoConstant;
        if (expected != is)
        {
            found.push_back(fmt::format("{} is declared with {}; its shader has {}", declaration.name, expected, is));
        }
    }
}

} // namespace

std::vector<std::string> differences(std::span<const KernelDeclaration> declarations,
                                     std::span<const EmbeddedKernel> kernels)
{
    std::vector<std::string> found;
    std::map<std::string_view, const EmbeddedKernel*> undeclared;
    for (const EmbeddedKernel& kernel : kernels)
    {
        undeclared[kernel.name] = &kernel;
    }
    std::set<std::string_view> seen;
    for (const KernelDeclaration& declaration : declarations)
    {
        if (!seen.insert(declaration.name).second)
        {
            found.push_back(fmt::format("{} is declared twice", declaration.name));
        }
        else if (const auto kernel = undeclared.find(declaration.name); kernel != undeclared.end())
        {
            compare(declaration, reflectKernel(kernel->second->words), found);
            if (!kernel->second->bound_words.empty())
            {
                compare(declaration, reflectKernel(kernel->second->bound_words), found);
            }
            undeclared.erase(kernel);
        }
        else
        {
            found.push_back(fmt::format("{} is declared, but no shader has that name", declaration.name));
        }
    }
    for (const auto& [name, kernel] : undeclared)
    {
        found.push_back(fmt::format("{} has no declaration: put GPU_KERNEL beside its parameters", name));
    }
    return found;
}

} // namespace zvo::vk
