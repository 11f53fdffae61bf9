// SPDX-License-Identifier: MIT
#include "zvo/kernel_list.h"

#include "api/checked.h"
#include "api/context_impl.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

// The first line of a list.
constexpr std::string_view kHeadingBegins = "zvo ";
constexpr std::string_view kHeading = "zvo " ZVO_VERSION_TEXT;

// Names of forms in lists.
constexpr std::string_view kAddressed = "addressed";
constexpr std::string_view kBound = "bound";

std::string lineOf(const vk::KernelChoice& choice)
{
    const std::string_view form = choice.form == vk::KernelForm::Bound ? kBound : kAddressed;
    return fmt::format("{} {} {}", choice.name, form, fmt::join(choice.specialization, " "));
}

// Takes the first word off a line.
std::string_view takeWord(std::string_view& line)
{
    const std::size_t end = std::min(line.find(' '), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    return word;
}

std::optional<vk::KernelChoice> choiceOf(std::string_view line)
{
    vk::KernelChoice choice;
    choice.name = takeWord(line);
    const std::string_view form = takeWord(line);
    if (form != kAddressed && form != kBound)
    {
        return std::nullopt;
    }
    choice.form = form == kBound ? vk::KernelForm::Bound : vk::KernelForm::Addressed;
    while (!line.empty())
    {
        const std::string_view word = takeWord(line);
        std::uint32_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size())
        {
            return std::nullopt;
        }
        choice.specialization.push_back(value);
    }
    return choice;
}

// The kernels of a list's parts that are of this version, each once.
std::set<vk::KernelChoice> choicesOf(std::string_view list)
{
    std::set<vk::KernelChoice> choices;
    bool is_current = false;
    while (!list.empty())
    {
        const std::size_t end = std::min(list.find('\n'), list.size());
        std::string_view line = list.substr(0, end);
        list.remove_prefix(std::min(end + 1, list.size()));
        line.remove_suffix(line.ends_with('\r') ? 1 : 0);
        is_current = line.starts_with(kHeadingBegins) ? line == kHeading : is_current;
        const std::optional<vk::KernelChoice> choice = choiceOf(line);
        if (choice && is_current)
        {
            choices.insert(*choice);
        }
    }
    return choices;
}

} // namespace

struct ZVO_LOCAL KernelPreparation::Impl
{
    vk::KernelCache& cache;
    std::vector<vk::PendingKernel> kernels = {};
};

std::string madeKernels(Context& context)
{
    std::string lines = fmt::format("{}\n", kHeading);
    for (const vk::KernelChoice& choice : context.impl().device.kernels().made())
    {
        lines += lineOf(choice) + '\n';
    }
    return lines;
}

KernelPreparation::KernelPreparation(Context& context, std::string_view kernels)
    : m_impl(std::make_unique<Impl>(Impl{context.impl().device.kernels()}))
{
    for (const vk::KernelChoice& choice : choicesOf(kernels))
    {
        try
        {
            std::optional<vk::PendingKernel> pending = m_impl->cache.begin(choice);
            if (pending)
            {
                m_impl->kernels.push_back(std::move(*pending));
            }
        }
        catch (const Error& error)
        {
            if (error.code() != ErrorCode::Other) // a choice of another device, with workgroups too large for this one
            {
                throw;
            }
        }
    }
}

KernelPreparation::~KernelPreparation() = default;

std::size_t KernelPreparation::size() const
{
    return m_impl->kernels.size();
}

void KernelPreparation::make(std::size_t i)
{
    if (i >= m_impl->kernels.size())
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("there is no kernel {} to make: there are {}", i, m_impl->kernels.size()));
    }
    if (!m_impl->kernels[i].hasPipeline())
    {
        m_impl->cache.compile(m_impl->kernels[i]);
    }
}

void KernelPreparation::finish()
{
    for (vk::PendingKernel& kernel : m_impl->kernels)
    {
        if (kernel.hasPipeline())
        {
            m_impl->cache.keep(std::move(kernel));
        }
    }
    m_impl->kernels.clear();
}

} // namespace zvo
