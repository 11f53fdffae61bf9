// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/tree_export.h"
#include "common/tree_input.h"
#include "common/words.h"
#include "core/base/input_error.h"
#include "io/scene/edit_script.h"
#include "runtime/flatten.h"
#include "runtime/live_scene.h"
#include "runtime/mesh_dabs.h"
#include "runtime/script_brush.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kDabsAtOnce = 16; // whose stamps take up to 4.5 MB each

// Carries out the edits of a script, one after the other.
class Editor
{
public:
    Editor(vk::HeadlessDevice& device, const TreeData& tree, bool strict)
        : m_device(device), m_strict(strict),
          m_scene(device, tree, {.brushes_emit = true, .warn = [](std::string_view what) {
                                     throw Error(ErrorCode::Memory, std::string(what));
                                 }})
    {
    }

    [[nodiscard]] const LiveScene& scene() const { return m_scene; }

    // Carries out what still waits.
    void finish()
    {
        m_scene.updateAndWait(0);
        m_waiting = 0;
    }

    void run(const ScriptedEdit& edit, const std::filesystem::path& script)
    {
        if (const auto* const mesh = std::get_if<EditMesh>(&edit.shape))
        {
            runMesh(*mesh, edit);
        }
        else if (const std::optional<Brush> brush = brushOf(edit, m_scene.tree().grid, script))
        {
            for (const Brush& part : partsOf(*brush, m_scene.tree().grid))
            {
                apply(part);
            }
        }
    }

private:
    void runMesh(const EditMesh& mesh, const ScriptedEdit& edit)
    {
        const Scene scene = loadEditMesh(mesh);
        warnOrRefuse(scene.warnings, m_strict);
        const float brightest = brightestEmission(scene);
        const float scale = m_scene.tree().emission_scale;
        if (edit.action == BrushAction::Fill && brightest > scale)
        {
            warnOrRefuse(
                {fmt::format("{}: the mesh gives off {:g}, more than the {:g} of this tree: what is brighter is "
                             "cut",
                             edit.where, brightest, scale)},
                m_strict);
        }
        const MeshDabOptions options = {.action = edit.action, .fill = mesh.fill};
        const auto dab = [this](const Brush& brush) { apply(brush); };
        if (edit.outside)
        {
            finish();
            forDabsOutside(m_device, scene, m_scene.tree(), flattenTree(m_device, m_scene.tree()), options, dab);
        }
        else
        {
            forMeshDabs(m_device, scene, m_scene.tree(), options, dab);
        }
    }

    void apply(const Brush& brush)
    {
        m_scene.request(brush);
        if (++m_waiting == kDabsAtOnce)
        {
            finish();
        }
    }

    vk::HeadlessDevice& m_device;
    bool m_strict;
    LiveScene m_scene;
    std::uint32_t m_waiting = 0; // dabs
};

} // namespace

void edit(const EditOptions& options)
{
    const std::string format = treeFormatFor(options.output.path, options.format);
    checkPaths(options.output, std::array{options.file, options.script});
    Output output(options.output.path, options.output.overwrite);
    const std::vector<ScriptedEdit> edits = readEditScript(options.script);
    Progress progress(3);
    progress.begin("loading");
    const std::shared_ptr<vk::HeadlessDevice> device = openDevice(options.device);
    TreeData tree = loadTree(
        options.file, [&]() -> vk::HeadlessDevice& { return *device; }, options.strict);
    const TreeStructure structure = options.structure.value_or(tree.structure);
    if (tree.isFilled() && tree.structure == TreeStructure::Svdag && !isPacked(tree.attributeFormat()))
    {
        tree = flattenTree(*device, uploadTree(*device, tree)); // a filled DAG is not edited in place
    }
    std::optional<Editor> editor(std::in_place, *device, tree, options.strict);
    if (!editor->scene().canEdit())
    {
        throw inputError(options.file, "its attributes are packed; only trees with those of 8 bytes can be edited");
    }
    tree = {};
    progress.begin("editing");
    for (const ScriptedEdit& edit : edits)
    {
        editor->run(edit, options.script);
    }
    editor->finish();
    progress.begin("writing");
    tree = flattenTree(*device, editor->scene().tree());
    editor.reset();
    if (format == "zvo" && structure == TreeStructure::Svdag && !tree.nodes.empty())
    {
        tree = compressTree(*device, std::move(tree));
    }
    writeTree(tree, format, output, options.strict);
    checkValidation(*device);
    output.finish();
    tellRun(fmt::format("{} of {}^3 after {}", counted(tree.occupiedCount(), "voxel"), tree.grid.resolution(),
                        counted(edits.size(), "edit")));
}

} // namespace zvo::cli
