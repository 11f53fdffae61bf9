// SPDX-License-Identifier: MIT
#include "demo/panels/file_dialog.h"

#include "common/output.h"
#include "demo/panels/panel_text.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace zvo::demo
{

namespace
{

constexpr const char* kTitle = "Files";

} // namespace

std::vector<FileEntry> listFolder(const std::filesystem::path& folder, const std::vector<std::string>& extensions)
{
    std::vector<FileEntry> entries;
    std::error_code failure;
    for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure))
    {
        std::error_code ignored;
        const FileEntry found = {entry->path().filename().string(), entry->is_directory(ignored)};
        const bool is_listed = found.is_folder || extensions.empty() ||
                               std::ranges::find(extensions, cli::extensionOf(found.name)) != extensions.end();
        if (is_listed && !found.name.starts_with('.'))
        {
            entries.push_back(found);
        }
    }
    std::ranges::sort(entries, {}, [](const FileEntry& entry) { return std::pair(!entry.is_folder, entry.name); });
    return entries;
}

void FileDialog::openToRead(std::filesystem::path folder, std::vector<std::string> extensions)
{
    m_writes = false;
    m_name.clear();
    open(std::move(folder), std::move(extensions));
}

void FileDialog::openToWrite(std::filesystem::path folder, const std::string& name, std::vector<std::string> extensions)
{
    m_writes = true;
    m_name = name;
    open(std::move(folder), std::move(extensions));
}

void FileDialog::open(std::filesystem::path folder, std::vector<std::string> extensions)
{
    m_is_open = true;
    m_appears = true;
    m_extensions = std::move(extensions);
    enter(folder);
}

void FileDialog::enter(const std::filesystem::path& folder)
{
    std::error_code failure;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, failure);
    m_folder = failure ? folder : whole;
    m_entries = listFolder(m_folder, m_extensions);
}

// Returns whether a file was chosen for good, by a double click.
bool FileDialog::showEntries()
{
    std::filesystem::path next;
    bool is_chosen = false;
    const ImVec2 size = {ImGui::GetFontSize() * 34, ImGui::GetTextLineHeightWithSpacing() * 16};
    const ImVec2 most = {ImGui::GetIO().DisplaySize.x * 0.8F, ImGui::GetIO().DisplaySize.y * 0.5F};
    if (ImGui::BeginChild("entries", {std::min(size.x, most.x), std::min(size.y, most.y)}, true))
    {
        if (m_folder.has_parent_path() && ImGui::Selectable("../"))
        {
            next = m_folder.parent_path();
        }
        for (const FileEntry& entry : m_entries)
        {
            const std::string label = entry.name + (entry.is_folder ? "/" : "");
            const ImGuiSelectableFlags flags = ImGuiSelectableFlags_AllowDoubleClick;
            if (!ImGui::Selectable(label.c_str(), !entry.is_folder && entry.name == m_name, flags))
            {
                continue;
            }
            if (entry.is_folder)
            {
                next = m_folder / entry.name;
            }
            else
            {
                m_name = entry.name;
                is_chosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !m_writes;
            }
        }
    }
    ImGui::EndChild();
    if (!next.empty())
    {
        m_name = m_writes ? m_name : "";
        enter(next);
    }
    return is_chosen;
}

// The kinds of files that can be written: a choice changes the name's extension.
void FileDialog::showExtensions()
{
    constexpr int kColumns = 5;
    if (!ImGui::BeginTable("kinds", kColumns, ImGuiTableFlags_SizingStretchSame))
    {
        return;
    }
    for (const std::string& extension : m_extensions)
    {
        ImGui::TableNextColumn();
        ImGui::PushID(extension.c_str());
        if (ImGui::RadioButton(extension.c_str(), cli::extensionOf(m_name) == extension))
        {
            m_name = std::filesystem::path(m_name).replace_extension(extension).string();
        }
        ImGui::PopID();
    }
    ImGui::EndTable();
}

std::optional<std::filesystem::path> FileDialog::show()
{
    if (!m_is_open)
    {
        return std::nullopt;
    }
    if (!ImGui::IsPopupOpen(kTitle))
    {
        ImGui::OpenPopup(kTitle);
    }
    const ImVec2 middle = {ImGui::GetIO().DisplaySize.x * 0.5F, ImGui::GetIO().DisplaySize.y * 0.5F};
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5F, 0.5F});
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    {
        return std::nullopt;
    }
    tell(m_folder.string());
    const bool is_clicked = showEntries();
    if (std::exchange(m_appears, false))
    {
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1);
    const bool is_entered = ImGui::InputTextWithHint("##name", "name", &m_name, ImGuiInputTextFlags_EnterReturnsTrue);
    if (m_writes)
    {
        showExtensions();
    }
    std::error_code ignored;
    const bool is_folder = !m_name.empty() && std::filesystem::is_directory(chosen(), ignored);
    const bool is_there = !m_name.empty() && !is_folder && std::filesystem::exists(chosen(), ignored);
    const bool can_write = std::ranges::find(m_extensions, cli::extensionOf(m_name)) != m_extensions.end();
    const bool can_go = m_writes ? can_write && !is_folder : is_there;
    ImGui::BeginDisabled(!can_go);
    const bool is_pressed = ImGui::Button(!m_writes ? "open" : is_there ? "overwrite" : "save");
    ImGui::EndDisabled();
    ImGui::SameLine();
    const bool is_left = ImGui::Button("cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (is_entered && is_folder)
    {
        enter(chosen());
        m_name.clear();
    }
    // Enter overwrites nothing.
    const bool is_done = can_go && (is_clicked || is_pressed || (is_entered && !(m_writes && is_there)));
    if (is_done || is_left)
    {
        m_is_open = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    return is_done ? std::optional(chosen()) : std::nullopt;
}

} // namespace zvo::demo
