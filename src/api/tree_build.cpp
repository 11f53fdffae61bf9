// SPDX-License-Identifier: MIT
#include "api/checked.h"
#include "api/job_run.h"
#include "api/model_impl.h"
#include "api/tree_impl.h"
#include "core/attributes/attribute_pack.h"
#include "core/octree/octree_builder.h"
#include "core/svdag/svdag_builder.h"
#include "zvo/tree.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

BuildOptions optionsOf(const TreeBuildInfo& info)
{
    BuildOptions options;
    options.coverage = checked(info).coverage;
    options.attributes = info.format != AttributeFormat::None;
    options.keep_sums = info.keep_sums;
    return options;
}

// A sequence of jobs that make a tree, and a last step that writes the table by which shaders find it.
class TreeJob : public StepJob
{
public:
    TreeJob(Context::Impl& context_impl, std::shared_ptr<FrameState> made_in, const char* source)
        : context(context_impl), run(context_impl, *this, std::move(made_in), source)
    {
    }

    [[nodiscard]] bool isDone() const override { return m_is_published; }

    void record(vk::FrameGraph& graph) override
    {
        if (m_tree)
        {
            m_tree->publish(graph);
        }
        else if (!m_part->isDone())
        {
            m_part->record(graph);
        }
    }

    void resume(std::vector<vk::PassTime> passes) override
    {
        if (m_tree)
        {
            m_is_published = true;
            return;
        }
        if (!m_part->isDone()) // the part of an empty octree is done from the start
        {
            m_part->resume(std::move(passes));
        }
        if (m_part->isDone())
        {
            endPart();
        }
    }

    std::unique_ptr<Tree::Impl> take()
    {
        if (!run.isDone() || !m_tree)
        {
            throw Error(ErrorCode::Usage, "the tree is not there, or was taken already");
        }
        return std::move(m_tree);
    }

    Context::Impl& context;
    JobRun run;

protected:
    void begin(StepJob& part) { m_part = &part; }
    void setTree(DeviceTree&& tree) { m_tree = std::make_unique<Tree::Impl>(context, std::move(tree)); }

private:
    // Called when a part is done: begins the next one, or sets the tree.
    virtual void endPart() = 0;

    StepJob* m_part = nullptr;
    std::unique_ptr<Tree::Impl> m_tree;
    bool m_is_published = false;
};

} // namespace

struct ZVO_LOCAL TreeBuild::Impl final : TreeJob
{
    Impl(Context::Impl& context_impl, const Model::Impl& model, const TreeBuildInfo& info)
        : TreeJob(context_impl, model.made_in, "model"), mesh(model.mesh), format(info.format),
          builder(std::make_unique<OctreeBuilder>(context_impl.device, mesh->uploaded, checkedGrid(info.grid),
                                                  optionsOf(info)))
    {
        begin(*builder);
    }

    ~Impl() override
    {
        context.deleteLater(std::move(builder));
        context.deleteLater(std::move(mesh));
        context.deleteLater(std::move(built));
        context.deleteLater(std::move(packer));
    }

    void endPart() override
    {
        if (!packer)
        {
            built = builder->take();
            dropped = built.dropped;
            packer = std::make_unique<TreePacker>(context.device, format, built.octree);
            begin(*packer);
        }
        if (packer->isDone())
        {
            setTree(std::move(built.octree));
        }
    }

    std::shared_ptr<const DynamicMesh> mesh; // the builder reads it
    AttributeFormat format;
    std::unique_ptr<OctreeBuilder> builder;
    BuildResult built;
    std::unique_ptr<TreePacker> packer; // of `built`; null until that is there
    std::map<std::string, std::uint64_t> dropped;
};

namespace
{

const Model::Impl& buildable(Context& context, const Model& model)
{
    const Model::Impl& impl = usable(model);
    requireSame(context.impl(), impl.context);
    return impl;
}

} // namespace

TreeBuild::TreeBuild(Context& context, const Model& model, const TreeBuildInfo& info)
    : m_impl(std::make_unique<Impl>(context.impl(), buildable(context, model), info))
{
}

TreeBuild::~TreeBuild() = default;
TreeBuild::TreeBuild(TreeBuild&&) noexcept = default;
TreeBuild& TreeBuild::operator=(TreeBuild&&) noexcept = default;

bool TreeBuild::record(Recorder& recorder)
{
    return contentOf(m_impl.get(), "build").run.record(recorder);
}

bool TreeBuild::isDone()
{
    return contentOf(m_impl.get(), "build").run.isDone();
}

bool TreeBuild::isBroken() const
{
    return contentOf(m_impl.get(), "build").run.isBroken();
}

Tree TreeBuild::take()
{
    return Tree(contentOf(m_impl.get(), "build").take());
}

const std::map<std::string, std::uint64_t>& TreeBuild::dropped() const
{
    return contentOf(m_impl.get(), "build").dropped;
}

struct ZVO_LOCAL TreeCompression::Impl final : TreeJob
{
    Impl(Context::Impl& context_impl, Tree&& octree)
        : TreeJob(context_impl, octree.impl()->made_in, "octree"), source(octree.release()),
          builder(std::make_unique<SvdagBuilder>(context_impl.device, std::move(source->fixed), CompressOptions{}))
    {
        begin(*builder);
    }

    ~Impl() override
    {
        context.deleteLater(std::move(builder));
        source.reset(); // it deletes its buffers later
    }

    void endPart() override { setTree(builder->take().dag); }

    std::unique_ptr<Tree::Impl> source; // the rest of the octree
    std::unique_ptr<SvdagBuilder> builder;
};

namespace
{

Tree&& compressible(Context& context, Tree&& octree)
{
    const Tree::Impl& impl = usable(octree);
    requireSame(context.impl(), impl.context);
    if (impl.fixed.isDag())
    {
        throw Error(ErrorCode::Usage, "this tree is a DAG already");
    }
    return std::move(octree);
}

} // namespace

TreeCompression::TreeCompression(Context& context, Tree&& octree)
    : m_impl(std::make_unique<Impl>(context.impl(), compressible(context, std::move(octree))))
{
}

TreeCompression::~TreeCompression() = default;
TreeCompression::TreeCompression(TreeCompression&&) noexcept = default;
TreeCompression& TreeCompression::operator=(TreeCompression&&) noexcept = default;

bool TreeCompression::record(Recorder& recorder)
{
    return contentOf(m_impl.get(), "compression").run.record(recorder);
}

bool TreeCompression::isDone()
{
    return contentOf(m_impl.get(), "compression").run.isDone();
}

bool TreeCompression::isBroken() const
{
    return contentOf(m_impl.get(), "compression").run.isBroken();
}

Tree TreeCompression::take()
{
    return Tree(contentOf(m_impl.get(), "compression").take());
}

} // namespace zvo
