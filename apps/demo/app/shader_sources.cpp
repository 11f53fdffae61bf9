// SPDX-License-Identifier: MIT
#include "demo/app/shader_sources.h"

#include "core/base/read_file.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <map>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

extern char** environ; // NOLINT: POSIX

namespace zvo::demo
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* kCompiler = "glslangValidator";

std::string textOf(const fs::path& file)
{
    const std::vector<std::uint8_t> bytes = readFile(file);
    return {bytes.begin(), bytes.end()};
}

// A folder for the compiler's results, removed with its contents.
class ScratchFolder
{
public:
    ScratchFolder()
    {
        std::string pattern = (fs::temp_directory_path() / "zvo-shaders-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr)
        {
            throw Error(ErrorCode::Output, fmt::format("cannot make a folder {} for compiled shaders", pattern));
        }
        m_path = pattern;
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        fs::remove_all(m_path, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return m_path; }

private:
    fs::path m_path;
};

// A run of the compiler on one kernel.
class Compilation
{
public:
    Compilation(const fs::path& root, const std::string& name, const fs::path& folder, std::size_t number)
        : m_name(name), m_binary(folder / fmt::format("{}.spv", number)), m_log(folder / fmt::format("{}.log", number))
    {
        std::vector<std::string> words = {
            kCompiler, "--quiet", "--target-env", "vulkan1.3",       "-I" + root.string(),
            "-S",      "comp",    "-o",           m_binary.string(), (root / (name + ".comp")).string()};
        std::vector<char*> arguments;
        for (std::string& word : words)
        {
            arguments.push_back(word.data());
        }
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions{};
        posix_spawn_file_actions_init(&actions);
        constexpr mode_t kMode = 0600;
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, m_log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
        posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
        const int failure = posix_spawnp(&m_pid, kCompiler, &actions, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failure != 0)
        {
            m_pid = -1;
            m_failure = fmt::format("cannot run {}: {}; install the package glslang-tools", kCompiler,
                                    std::generic_category().message(failure));
        }
    }

    CompiledShader wait() const
    {
        CompiledShader result = {m_name, {}, m_failure};
        int status = 0;
        if (m_pid < 0 || ::waitpid(m_pid, &status, 0) != m_pid)
        {
            return result;
        }
        result.message = textOf(m_log);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        {
            result.message = result.message.empty() ? m_name + ": the compiler failed" : result.message;
            return result;
        }
        const std::vector<std::uint8_t> bytes = readFile(m_binary);
        result.words.resize(bytes.size() / sizeof(std::uint32_t));
        std::memcpy(result.words.data(), bytes.data(), result.words.size() * sizeof(std::uint32_t));
        return result;
    }

private:
    std::string m_name;
    fs::path m_binary;
    fs::path m_log;
    std::string m_failure;
    pid_t m_pid = -1;
};

// The times at which files below a folder, and their includes, were last written. Each file is read once.
class Dependencies
{
public:
    explicit Dependencies(const fs::path& root) : m_root(root) {}

    // The latest time of a file and all its includes; nothing if it is missing.
    std::optional<fs::file_time_type> latest(const std::string& file)
    {
        const auto known = m_latest.find(file);
        if (known != m_latest.end())
        {
            return known->second;
        }
        m_latest[file] = std::nullopt; // ends the recursion of files that include each other
        std::error_code missing;
        const fs::file_time_type own = fs::last_write_time(m_root / file, missing);
        if (missing)
        {
            return std::nullopt;
        }
        std::optional<fs::file_time_type> result = own;
        for (const std::string& include : includesOf(textOf(m_root / file)))
        {
            const std::string sibling = (fs::path(file).parent_path() / include).generic_string();
            for (const std::string& place : {include, sibling})
            {
                result = std::max(result, latest(place));
            }
        }
        m_latest[file] = result;
        return result;
    }

private:
    const fs::path& m_root;
    std::map<std::string, std::optional<fs::file_time_type>> m_latest;
};

} // namespace

std::vector<std::string> includesOf(std::string_view source)
{
    std::vector<std::string> includes;
    while (!source.empty())
    {
        const std::string_view line = source.substr(0, source.find('\n'));
        source.remove_prefix(std::min(source.size(), line.size() + 1));
        const std::size_t hash = line.find_first_not_of(" \t");
        if (hash == std::string_view::npos || !line.substr(hash).starts_with("#include"))
        {
            continue;
        }
        const std::size_t first = line.find('"');
        const std::size_t last = line.find('"', first == std::string_view::npos ? first : first + 1);
        if (last != std::string_view::npos)
        {
            includes.emplace_back(line.substr(first + 1, last - first - 1));
        }
    }
    return includes;
}

fs::path shadersOf(const fs::path& program)
{
    std::error_code missing;
    const fs::path installed = (program.parent_path() / ZVO_INSTALLED_SHADERS).lexically_normal();
    return !program.empty() && fs::is_directory(installed, missing) ? installed : fs::path(ZVO_SHADERS_DIR);
}

fs::path thisProgram()
{
    std::error_code missing;
    return fs::read_symlink("/proc/self/exe", missing);
}

ShaderSources::ShaderSources(fs::path root) : m_root(std::move(root)), m_checked(fs::file_time_type::clock::now()) {}

bool ShaderSources::exist() const
{
    std::error_code missing;
    return fs::is_directory(m_root, missing);
}

std::vector<std::string> ShaderSources::takeChanged(const std::vector<std::string>& names)
{
    const fs::file_time_type now = fs::file_time_type::clock::now();
    Dependencies dependencies(m_root);
    std::vector<std::string> changed;
    for (const std::string& name : names)
    {
        const std::optional<fs::file_time_type> latest = dependencies.latest(name + ".comp");
        if (m_failed.contains(name) || (latest && *latest > m_checked))
        {
            changed.push_back(name);
        }
    }
    m_checked = now;
    return changed;
}

std::vector<CompiledShader> ShaderSources::compile(const std::vector<std::string>& names)
{
    const ScratchFolder folder;
    const std::size_t together = std::max(std::thread::hardware_concurrency(), 1U);
    std::vector<CompiledShader> results;
    for (std::size_t first = 0; first < names.size(); first += together)
    {
        std::vector<Compilation> under_way;
        for (std::size_t i = first; i < std::min(first + together, names.size()); ++i)
        {
            under_way.emplace_back(m_root, names[i], folder.path(), i);
        }
        for (const Compilation& compilation : under_way)
        {
            results.push_back(compilation.wait());
        }
    }
    for (const CompiledShader& shader : results)
    {
        if (shader.words.empty())
        {
            m_failed.insert(shader.name);
        }
        else
        {
            m_failed.erase(shader.name);
        }
    }
    return results;
}

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
