// SPDX-License-Identifier: MIT
#include "notices.h"

#include "common/progress.h"

#include <string_view>

namespace zvo::python
{

namespace
{

thread_local std::vector<std::string>* g_lines = nullptr;

} // namespace

Notices::Notices()
{
    g_lines = &m_lines;
}

Notices::~Notices()
{
    g_lines = nullptr;
}

void Notices::issue() const
{
    if (m_lines.empty())
    {
        return;
    }
    const pybind11::object category = pybind11::module_::import("zvo").attr("ZvoWarning");
    constexpr int kCaller = 2; // of the function in Python that called this module
    for (const std::string& line : m_lines)
    {
        if (PyErr_WarnEx(category.ptr(), line.c_str(), kCaller) != 0)
        {
            throw pybind11::error_already_set();
        }
    }
}

void Notices::listen()
{
    cli::setQuiet(true);
    cli::listenToTalk(
        [](std::string_view line)
        {
            constexpr std::string_view kPrefix = "warning: ";
            if (g_lines != nullptr)
            {
                g_lines->emplace_back(line.substr(line.starts_with(kPrefix) ? kPrefix.size() : 0));
            }
        },
        cli::TalkTo::ListenerAlone);
}

} // namespace zvo::python
