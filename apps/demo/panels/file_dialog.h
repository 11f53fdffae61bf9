// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zvo::demo
{

/// A file or a folder in a list.
struct FileEntry
{
    std::string name;
    bool is_folder = false;

    bool operator==(const FileEntry&) const = default;
};

/// What a folder holds: folders first, each sorted by name, without what is hidden. extensions: of the files, in lower
/// case with their dots; "" lists all. Empty for a folder that cannot be read.
std::vector<FileEntry> listFolder(const std::filesystem::path& folder, const std::vector<std::string>& extensions);

/// A list of files over the picture, in which the user chooses one to read or one to write.
class FileDialog
{
public:
    /// Opens the list at a folder. extensions: of what is listed.
    void openToRead(std::filesystem::path folder, std::vector<std::string> extensions);

    /// Likewise, with a name to begin with. extensions: one of them is chosen by the user, and belongs to the name.
    void openToWrite(std::filesystem::path folder, const std::string& name, std::vector<std::string> extensions);

    [[nodiscard]] bool isOpen() const { return m_is_open; }
    [[nodiscard]] bool writes() const { return m_writes; }

    /// Shows the list within a frame of Dear ImGui. Returns the file that the user has chosen; then the list is closed.
    std::optional<std::filesystem::path> show();

private:
    void open(std::filesystem::path folder, std::vector<std::string> extensions);
    void enter(const std::filesystem::path& folder);
    bool showEntries();
    void showExtensions();
    [[nodiscard]] std::filesystem::path chosen() const { return m_folder / std::filesystem::path(m_name); }

    bool m_is_open = false;
    bool m_appears = false; // in the next frame
    bool m_writes = false;
    std::filesystem::path m_folder;
    std::vector<std::string> m_extensions;
    std::vector<FileEntry> m_entries;
    std::string m_name; // in m_folder
};

} // namespace zvo::demo
