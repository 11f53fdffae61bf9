// SPDX-License-Identifier: MIT
// zvo/trace.glsl declares only names with its prefix, so that a host can use all others.
#include "glsl/host_kernels.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp11>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

const std::filesystem::path kShaders = ZVO_SHADERS_DIR;
const std::filesystem::path kTraceGlsl = std::filesystem::path(ZVO_GLSL_DIR) / "zvo/trace.glsl";

using Names = std::set<std::string>;

std::string readText(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern)
{
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), pattern); i != std::sregex_iterator(); ++i)
    {
        found.push_back((*i)[1]);
    }
    return found;
}

// The shaders that make up zvo/trace.glsl: its entry, and all that these include.
std::vector<std::filesystem::path> sources()
{
    std::vector<std::filesystem::path> files = {"host/trace.glsl"};
    for (std::size_t i = 0; i < files.size(); ++i)
    {
        static const std::regex include("(?:^|\n)#include \"([^\"]+)\"");
        for (const std::string& name : matches(readText(kShaders / files[i]), include))
        {
            if (std::find(files.begin(), files.end(), name) == files.end())
            {
                files.emplace_back(name);
            }
        }
    }
    return files;
}

// The names that text declares outside of braces: functions, structs, blocks, constants and variables.
Names declaredNames(const std::string& text)
{
    static const std::regex comment("//[^\n]*");
    static const std::regex directive("#(?:[^\n]*\\\\\n)*[^\n]*");
    const std::string code = std::regex_replace(std::regex_replace(text, comment, ""), directive, "");
    std::string outside; // text outside of braces and parentheses, with a declaration in each line
    int braces = 0;
    int parentheses = 0;
    for (const char c : code)
    {
        braces += c == '{' ? 1 : c == '}' ? -1 : 0;
        parentheses += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (braces == (c == '{' ? 1 : 0) && c != '}' && parentheses == 0)
        {
            outside += c == ';' || c == '{' ? '\n' : c == '\n' || c == ')' ? ' ' : c;
        }
    }
    // The name is the last word before a value or an array's length.
    static const std::regex declared("(?:^|\n)[^\n=\\[]*?(\\w+) *(?=[\n=\\[])");
    Names names;
    for (const std::string& name : matches(outside, declared))
    {
        if (!name.starts_with("GPU_"))
        {
            names.insert(name);
        }
    }
    return names;
}

Names definedMacros(const std::string& text)
{
    const std::vector<std::string> macros = matches(text, std::regex("\n#define (\\w+)"));
    return {macros.begin(), macros.end()};
}

bool hasPrefix(const std::string& name)
{
    return name.starts_with("zvo_") || name.starts_with("ZVO_");
}

// The compiler's message about a host's shader, or "". stage: the file's extension.
std::string compile(const std::string& text, const std::string& stage = "comp")
{
    const test::TempDir folder;
    const std::filesystem::path source = folder.write("host." + stage, text);
    const std::filesystem::path log = folder.path() / "log";
    const std::string command = std::string("\"") + ZVO_GLSLANG + "\" --quiet --target-env vulkan1.3 -I\"" +
                                ZVO_GLSL_DIR + "\" -o \"" + (folder.path() / "host.spv").string() + "\" \"" +
                                source.string() + "\" > \"" + log.string() + "\" 2>&1";
    return std::system(command.c_str()) == 0 ? "" : "failed: " + readText(log);
}

const std::string kBegin = "#version 460\n#extension GL_GOOGLE_include_directive : require\n";
const std::string kEnd = R"(
#define ZVO_DETAIL
#include "zvo/trace.glsl"
layout(local_size_x = 8) in;
layout(push_constant, scalar) uniform Push { zvo_TreeTable_ConstPtr tree; zvo_uint_Ptr results; };
void main()
{
    results.data[gl_GlobalInvocationID.x] = zvo_trace(tree, vec3(0.0), vec3(1.0), 0.0, 1.0).index;
}
)";

// Names in zvo's shaders that zvo/trace.glsl must not declare.
Names namesOfSources()
{
    Names names;
    for (const std::filesystem::path& file : sources())
    {
        names.merge(declaredNames(readText(kShaders / file)));
    }
    std::erase_if(names, hasPrefix);
    return names;
}

TEST(HostGlslNames, AllHaveThePrefix)
{
    const std::string text = readText(kTraceGlsl);
    const Names names = declaredNames(text);
    EXPECT_GT(names.size(), 100U);
    for (const char* name : {"zvo_trace", "zvo_Hit", "zvo_TreeTable_ConstPtr", "zvo_kHitMiss", "zvo_g_halves"})
    {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    for (const std::string& name : names)
    {
        EXPECT_TRUE(name.starts_with("zvo_")) << name;
    }
    const Names macros = definedMacros(text);
    EXPECT_TRUE(macros.contains("ZVO_TRACE_GLSL"));
    for (const std::string& macro : macros)
    {
        EXPECT_TRUE(macro.starts_with("ZVO_")) << macro;
    }
}

TEST(HostGlslNames, ModulesNameNothingOfZvoWithoutThePrefix)
{
    const Names own = {"main", "Frame", "FrameAddress", "Pixel", "Pixels", "Push"};
    for (const vk::EmbeddedKernel& kernel : hostKernels())
    {
        if (!kernel.name.starts_with("host/picture"))
        {
            continue;
        }
        std::map<std::uint32_t, std::string> names;
        std::size_t checked = 0;
        for (std::size_t at = 5; at < kernel.words.size(); at += kernel.words[at] >> spv::WordCountShift)
        {
            const auto op = static_cast<spv::Op>(kernel.words[at] & spv::OpCodeMask);
            if (op == spv::Op::OpName)
            {
                names[kernel.words[at + 1]] = reinterpret_cast<const char*>(&kernel.words[at + 2]);
            }
            const bool is_type = op == spv::Op::OpTypeStruct;
            const bool is_global = op == spv::Op::OpVariable &&
                                   static_cast<spv::StorageClass>(kernel.words[at + 3]) != spv::StorageClass::Function;
            if (!is_type && !is_global && op != spv::Op::OpFunction)
            {
                continue;
            }
            const std::string name = names[kernel.words[at + (is_type ? 1 : 2)]];
            const std::string word = name.substr(0, name.find('('));
            EXPECT_TRUE(word.empty() || word.starts_with("zvo_") || word.starts_with("gl_") || own.contains(word))
                << word << " in " << kernel.name;
            ++checked;
        }
        EXPECT_GT(checked, 100U);
    }
}

TEST(HostGlslNames, AHostMayDeclareThemAllWithoutThePrefix)
{
    const Names names = namesOfSources();
    EXPECT_GT(names.size(), 100U);
    for (const char* name : {"traverse", "Hit", "kHitMiss", "g_halves", "listEntry", "kNodeLevels"})
    {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    std::string declarations;
    std::string macros;
    for (const std::string& name : names)
    {
        declarations += "const int " + name + " = 0;\n";
        macros += "#define " + name + " { not to be used }\n";
    }
    for (const char* type : {"uint", "uvec2", "uvec4", "vec3", "uint64_t", "Node", "Hit", "Ray", "Attribute"})
    {
        declarations += std::string("const int ") + type + "_Ptr = 0, " + type + "_ConstPtr = 0;\n";
        macros += std::string("#define ") + type + "_Ptr { no }\n#define " + type + "_ConstPtr { no }\n";
    }
    for (const std::filesystem::path& file : sources())
    {
        for (const std::string& macro : definedMacros(readText(kShaders / file)))
        {
            macros += hasPrefix(macro) ? "" : "#undef " + macro + "\n#define " + macro + " { not to be used }\n";
        }
    }
    EXPECT_EQ(compile(kBegin + kEnd), "");
    EXPECT_EQ(compile(kBegin + declarations + kEnd), "");
    EXPECT_EQ(compile(kBegin + macros + kEnd), "");
    // The check reports a name that is taken.
    EXPECT_NE(compile(kBegin + "const int zvo_traverse = 0;\n" + kEnd), "");
    EXPECT_NE(compile(kBegin + "#define zvo_kHitMiss { not to be used }\n" + kEnd), "");
}

TEST(HostGlslNames, ExamplesInTheDocumentationCompile)
{
    const std::string text = readText(std::filesystem::path(ZVO_DOCS_DIR) / "host-glsl.md");
    const std::vector<std::string> examples = matches(text, std::regex("\n```glsl\n([^`]*)```"));
    ASSERT_EQ(examples.size(), 3U);
    EXPECT_EQ(compile(examples[0], "comp"), "");
    EXPECT_EQ(compile(examples[1], "frag"), "");
    EXPECT_EQ(compile(examples[2], "frag"), "");
}

TEST(HostGlslNames, OneFileIsAllThatIsIncluded)
{
    const std::string text = readText(kTraceGlsl);
    for (const char* directive : {"\n#include", "\n#version", "__cplusplus", "\n#extension GL_GOOGLE"})
    {
        EXPECT_EQ(text.find(directive), std::string::npos) << directive;
    }
    // Including it twice is allowed.
    EXPECT_EQ(compile(kBegin + "#define ZVO_DETAIL\n#include \"zvo/trace.glsl\"\n" + kEnd), "");
}

// What cmake/BundleGlsl.cmake makes of a shader, in one line, or its message.
std::string bundleOf(const std::string& text)
{
    const test::TempDir folder;
    folder.write("entry.glsl", text);
    const std::filesystem::path output = folder.path() / "bundle.glsl";
    const std::filesystem::path log = folder.path() / "log";
    const std::string command = std::string("\"") + ZVO_CMAKE + "\" -DROOT=\"" + folder.path().string() +
                                "\" -DENTRY=entry.glsl -DOUTPUT=\"" + output.string() + "\" -P \"" + ZVO_BUNDLE +
                                "\" > \"" + log.string() + "\" 2>&1";
    const bool is_made = std::system(command.c_str()) == 0;
    std::string result = readText(is_made ? output : log);
    result = std::regex_replace(result, std::regex("//[^\n]*\n"), "");
    return std::regex_replace(result, std::regex("\\s+"), " ");
}

TEST(HostGlslNames, ConditionsAreDecidedOrRefused)
{
    EXPECT_EQ(bundleOf("#ifdef BOUND\nint a;\n#else\nint b;\n#endif\n"), "int zvo_b; ");
    EXPECT_EQ(bundleOf("#if defined(BOUND) && defined(ANY)\nint a;\n#else\nint b;\n#endif\n"), "int zvo_b; ");
    EXPECT_EQ(bundleOf("#ifdef BOUND\nint a;\n#elif defined(FACES_BINDING)\nint b;\n#endif\nint c;\n"), "int zvo_c; ");
    EXPECT_EQ(bundleOf("#if !defined(ANY) || ANY > 1\nint a;\n#endif\n"),
              "#if !defined(ANY) || ANY > 1 int zvo_a; #endif ");
    const auto expectRefused = [](const std::string& text, const std::string& message)
    {
        const std::string log = bundleOf(text + "\nint a;\n#endif\n");
        EXPECT_NE(log.find("entry.glsl: cannot " + message), std::string::npos) << log;
    };
    expectRefused("#if !defined(BOUND)", "decide #if !defined(BOUND)");
    expectRefused("#if defined(BOUND) || defined(ANY)", "decide #if defined(BOUND) || defined(ANY)");
    expectRefused("#if defined(TRAVERSE_VARIABLES) && defined(ANY)", "decide #if defined(TRAVERSE_VARIABLES)");
    expectRefused("#ifdef BOUND\n#elif defined(ANY)", "decide #elif defined(ANY)");
    expectRefused("#ifdef ANY\n#elif defined(BOUND)", "leave out #elif defined(BOUND)");
}

} // namespace
} // namespace zvo
