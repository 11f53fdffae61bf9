// SPDX-License-Identifier: MIT
#include "api/checked.h"
#include "api/model_impl.h"
#include "api/step_job.h"
#include "api/tree_impl.h"
#include "core/attributes/attribute_pack.h"
#include "core/octree/octree_builder.h"
#include "core/svdag/svdag_builder.h"
#include "zvo/tree.h"

#include <optional>

namespace zvo
{

namespace
{

BuildOptions optionsOf(const TreeBuildInfo& info)
{
    BuildOptions options;
    options.coverage = checked(info).coverage;
    options.attributes = info.form != AttributeForm::None;
    options.keep_sums = info.keep_sums;
    return options;
}

// The last step of both: the table by which shaders find the tree.
class TreeJob : public StepJob
{
public:
    using StepJob::StepJob;

    std::unique_ptr<Tree::Impl> take()
    {
        if (!isDone() || !m_tree)
        {
            throw Error(ErrorCode::Usage, "the tree is not there, or was taken already");
        }
        return std::move(m_tree);
    }

protected:
    void setTree(StaticTree&& tree) { m_tree = std::make_unique<Tree::Impl>(context(), std::move(tree)); }
    [[nodiscard]] bool hasTree() const { return m_tree != nullptr; }
    void publish(vk::FrameGraph& graph) { m_tree->publish(graph); }
    void setPublished() { m_is_complete = true; }

private:
    [[nodiscard]] bool isComplete() const override { return m_is_complete; }

    std::unique_ptr<Tree::Impl> m_tree;
    bool m_is_complete = false;
};

} // namespace

struct ZVO_LOCAL TreeBuild::Impl final : TreeJob
{
    Impl(Context::Impl& context_impl, const Model::Impl& model, const TreeBuildInfo& info)
        : TreeJob(context_impl, model.made_in, "model"), mesh(model.mesh), form(info.form),
          builder(std::make_unique<OctreeBuilder>(context_impl.device, mesh->uploaded, checkedGrid(info.grid),
                                                  optionsOf(info)))
    {
    }

    ~Impl() override
    {
        context().retire(std::move(builder));
        context().retire(std::move(mesh));
        context().retire(std::move(built));
        context().retire(std::move(packed));
    }

    void recordStep(vk::FrameGraph& graph) override
    {
        if (!builder->isDone())
        {
            builder->record(graph);
        }
        else if (hasTree())
        {
            publish(graph);
        }
        else
        {
            pack(graph);
        }
    }

    void stepDone(const std::vector<PassTime>& passes) override
    {
        if (hasTree())
        {
            setPublished();
            return;
        }
        if (!builder->isDone())
        {
            builder->stepDone(passes);
            if (!builder->isDone())
            {
                return;
            }
            built = builder->take();
            dropped = built.dropped;
            if (isPacked(form) && built.octree.hasAttributes())
            {
                return;
            }
        }
        else
        {
            built.octree.packed = std::move(packed);
            built.octree.voxel_attributes = {};
            built.octree.node_attributes = {};
        }
        setTree(StaticTree(std::move(built)));
    }

    void pack(vk::FrameGraph& graph)
    {
        if (packed.form == AttributeForm::None)
        {
            packed = makePackedAttributes(context().device, form, built.octree);
        }
        packAttributes(graph, built.octree.voxel_attributes, form, packed.voxels);
        packAttributes(graph, built.octree.node_attributes, nodeForm(form), packed.nodes);
    }

    std::shared_ptr<const MoverMesh> mesh; // what builder reads
    AttributeForm form;
    std::unique_ptr<OctreeBuilder> builder;
    BuildResult built;
    PackedAttributes packed;
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
    return contentOf(m_impl.get(), "build").record(recorder);
}

bool TreeBuild::isDone()
{
    return contentOf(m_impl.get(), "build").isDone();
}

bool TreeBuild::isBroken() const
{
    return contentOf(m_impl.get(), "build").isBroken();
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
          builder(
              std::make_unique<SvdagBuilder>(context_impl.device, std::move(source->fixed.dag.tree), CompressOptions{}))
    {
    }

    ~Impl() override
    {
        context().retire(std::move(builder));
        source.reset(); // it retires what it has
    }

    void recordStep(vk::FrameGraph& graph) override
    {
        if (hasTree())
        {
            publish(graph);
        }
        else if (!builder->isDone())
        {
            builder->record(graph);
        }
    }

    void stepDone(const std::vector<PassTime>& passes) override
    {
        if (hasTree())
        {
            setPublished();
            return;
        }
        if (!builder->isDone())
        {
            builder->stepDone(passes);
        }
        if (builder->isDone())
        {
            setTree(StaticTree(builder->take().dag, std::move(source->fixed.sums)));
        }
    }

    std::unique_ptr<Tree::Impl> source; // what is left of the octree
    std::unique_ptr<SvdagBuilder> builder;
};

namespace
{

Tree&& compressible(Context& context, Tree&& octree)
{
    const Tree::Impl& impl = usable(octree);
    requireSame(context.impl(), impl.context);
    if (impl.fixed.has_lists)
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
    return contentOf(m_impl.get(), "compression").record(recorder);
}

bool TreeCompression::isDone()
{
    return contentOf(m_impl.get(), "compression").isDone();
}

bool TreeCompression::isBroken() const
{
    return contentOf(m_impl.get(), "compression").isBroken();
}

Tree TreeCompression::take()
{
    return Tree(contentOf(m_impl.get(), "compression").take());
}

} // namespace zvo
