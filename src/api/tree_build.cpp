// SPDX-License-Identifier: MIT
#include "api/checked.h"
#include "api/context_impl.h"
#include "api/model_impl.h"
#include "api/tree_impl.h"
#include "core/algebra/algebra_job.h"
#include "core/attributes/attribute_pack.h"
#include "core/base/step_job.h"
#include "core/octree/octree_builder.h"
#include "core/svdag/svdag_builder.h"
#include "zvo/tree.h"

#include <algorithm>
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
    options.fill = info.fill;
    options.shell = info.shell;
    return options;
}

} // namespace

// Runs a sequence of jobs that make a tree, and a last step that writes the table by which shaders find it, in frames
// of the host: a step in each. The next step follows when the host says that the device is done with the last one.
struct ZVO_LOCAL TreeJob::Impl
{
    // What the tree is made of, by the name that messages have for it.
    struct Source
    {
        std::shared_ptr<FrameState> made_in; // null: known to be done
        const char* name;
    };

    Impl(Context::Impl& context_impl, std::vector<Source> sources)
        : context(context_impl), m_sources(std::move(sources))
    {
    }
    virtual ~Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    bool record(Recorder& recorder)
    {
        requireSame(context, recorder.impl().context);
        if (isDone())
        {
            return false;
        }
        if (!m_frame)
        {
            recording(recorder, [&](Recorder::Impl& impl) { recordStep(impl.graph); });
            m_frame = recorder.impl().frame;
        }
        return true;
    }

    bool isDone()
    {
        for (Source& source : m_sources)
        {
            if (source.made_in)
            {
                requireUsable(*source.made_in, source.name);
                source.made_in = source.made_in->is_done ? nullptr : source.made_in;
            }
        }
        if (m_is_broken)
        {
            throw Error(ErrorCode::Usage, "nothing comes of this any more: an earlier call has said why");
        }
        if (m_frame && m_frame->is_lost)
        {
            m_frame.reset();
        }
        if (m_frame && m_frame->is_done)
        {
            const std::shared_ptr<FrameState> frame = std::exchange(m_frame, nullptr);
            m_is_broken = true; // until the next line has succeeded
            resumeStep(frame->times);
            m_is_broken = false;
        }
        return m_is_published;
    }

    [[nodiscard]] bool isBroken() const
    {
        return m_is_broken || std::ranges::any_of(m_sources, [](const Source& source)
                                                  { return source.made_in && source.made_in->is_lost; });
    }

    std::unique_ptr<Tree::Impl> take()
    {
        if (!isDone() || !m_tree)
        {
            throw Error(ErrorCode::Usage, "the tree is not there, or was taken already");
        }
        return std::move(m_tree);
    }

    std::map<std::string, std::uint64_t> dropped = {};

protected:
    void begin(StepJob& part) { m_part = &part; }
    void setTree(DeviceTree&& tree) { m_tree = std::make_unique<Tree::Impl>(context, std::move(tree)); }

    Context::Impl& context;

private:
    // Called when a part is done: begins the next one, or sets the tree.
    virtual void endPart() = 0;

    void recordStep(vk::FrameGraph& graph)
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

    void resumeStep(const std::vector<vk::PassTime>& passes)
    {
        if (m_tree)
        {
            m_is_published = true;
            return;
        }
        if (!m_part->isDone()) // the part of an empty octree is done from the start
        {
            m_part->resume(passes);
        }
        if (m_part->isDone())
        {
            endPart();
        }
    }

    std::vector<Source> m_sources;
    std::shared_ptr<FrameState> m_frame = nullptr; // of the step that is under way
    StepJob* m_part = nullptr;
    std::unique_ptr<Tree::Impl> m_tree = nullptr;
    bool m_is_published = false;
    bool m_is_broken = false;
};

TreeJob::TreeJob(std::unique_ptr<Impl> impl, const char* name) : m_impl(std::move(impl)), m_name(name) {}

TreeJob::~TreeJob() = default;
TreeJob::TreeJob(TreeJob&&) noexcept = default;
TreeJob& TreeJob::operator=(TreeJob&&) noexcept = default;

bool TreeJob::record(Recorder& recorder)
{
    return contentOf(m_impl.get(), m_name).record(recorder);
}

bool TreeJob::isDone()
{
    return contentOf(m_impl.get(), m_name).isDone();
}

bool TreeJob::isBroken() const
{
    return contentOf(m_impl.get(), m_name).isBroken();
}

Tree TreeJob::take()
{
    return Tree(contentOf(m_impl.get(), m_name).take());
}

const std::map<std::string, std::uint64_t>& TreeJob::dropped() const
{
    return contentOf(m_impl.get(), m_name).dropped;
}

namespace
{

struct Build final : TreeJob::Impl
{
    Build(Context::Impl& context_impl, const Model::Impl& model, const TreeBuildInfo& info)
        : Impl(context_impl, {{model.made_in, "model"}}), mesh(model.mesh), format(info.format),
          builder(std::make_unique<OctreeBuilder>(context_impl.device, mesh->uploaded, checkedGrid(info.grid),
                                                  optionsOf(info)))
    {
        begin(*builder);
    }

    ~Build() override
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
};

struct Compression final : TreeJob::Impl
{
    Compression(Context::Impl& context_impl, Tree&& octree)
        : Impl(context_impl, {{octree.impl()->made_in, "octree"}}), source(octree.release()),
          builder(std::make_unique<SvdagBuilder>(context_impl.device, std::move(source->fixed), CompressOptions{}))
    {
        begin(*builder);
    }

    ~Compression() override
    {
        context.deleteLater(std::move(builder));
        source.reset(); // it deletes its buffers later
    }

    void endPart() override { setTree(builder->take().dag); }

    std::unique_ptr<Tree::Impl> source; // the rest of the octree
    std::unique_ptr<SvdagBuilder> builder;
};

struct Algebra final : TreeJob::Impl
{
    Algebra(Recorder::Impl& recorder, const Tree::Impl& a, const Tree::Impl* b, const TreeAlgebraInfo& info)
        : Impl(recorder.context,
               {{recorder.frame, "algebra"}, {a.made_in, "tree"}, {b != nullptr ? b->made_in : nullptr, "other tree"}}),
          tables(std::make_unique<GpuScene>(uploadColorTables(context.uploads))),
          job(std::make_unique<AlgebraJob>(context.device, *tables,
                                           AlgebraInfo{.operation = info.operation,
                                                       .corners = info.corners,
                                                       .voxels = info.voxels,
                                                       .largest = info.largest,
                                                       .least_voxels = info.least_voxels},
                                           a.fixed, b != nullptr ? &b->fixed : nullptr))
    {
        begin(*job);
    }

    ~Algebra() override
    {
        context.deleteLater(std::move(job));
        context.deleteLater(std::move(tables));
    }

    void endPart() override { setTree(job->take()); }

    std::unique_ptr<GpuScene> tables;
    std::unique_ptr<AlgebraJob> job;
};

// A tree that may be an operand.
const Tree::Impl& operand(Recorder::Impl& recorder, const Tree& tree)
{
    const Tree::Impl& impl = usable(tree);
    requireSame(recorder.context, impl.context);
    return impl;
}

const Model::Impl& buildable(Context& context, const Model& model)
{
    const Model::Impl& impl = usable(model);
    requireSame(context.impl(), impl.context);
    return impl;
}

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

TreeBuild::TreeBuild(Context& context, const Model& model, const TreeBuildInfo& info)
    : TreeJob(std::make_unique<Build>(context.impl(), buildable(context, model), info), "build")
{
}

TreeAlgebra::TreeAlgebra(Recorder& recorder, const Tree& tree, const Tree* other, const TreeAlgebraInfo& info)
    : TreeJob(recording(recorder,
                        [&](Recorder::Impl& impl)
                        {
                            const Tree::Impl* const b = other != nullptr ? &operand(impl, *other) : nullptr;
                            return std::make_unique<Algebra>(impl, operand(impl, tree), b, checked(info));
                        }),
              "algebra")
{
}

TreeCompression::TreeCompression(Context& context, Tree&& octree)
    : TreeJob(std::make_unique<Compression>(context.impl(), compressible(context, std::move(octree))), "compression")
{
}

} // namespace zvo
