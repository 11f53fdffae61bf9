// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "api/tree_impl.h"
#include "core/base/new_version.h"
#include "core/dynamic/dynamic_octree.h"
#include "zvo/dynamic_tree.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace zvo
{

struct ZVO_LOCAL DynamicTree::Impl
{
    static constexpr const char* kName = "dynamic tree"; // in messages

    Impl(Recorder::Impl& recorder, Tree&& fixed, const DynamicTreeInfo& info);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// Learns which frames are done or lost. Dynamic objects that were made in a lost frame are removed.
    void learn();

    /// Has the octree record into this frame.
    void enter(Recorder::Impl& recorder);

    /// Records a change of the tree that is traced, and its new table.
    template <typename Change> bool change(Recorder& recorder, const Change& record)
    {
        enter(recorder.impl());
        return recording(recorder,
                         [&](Recorder::Impl& impl)
                         {
                             try
                             {
                                 const bool result = std::invoke(record, *octree, impl.graph);
                                 publish(impl.graph);
                                 return result;
                             }
                             catch (...) // the buffers may have grown all the same
                             {
                                 publish(impl.graph);
                                 throw;
                             }
                         });
    }

    /// The same for what brushes change.
    template <typename Change> bool changeEdits(Recorder& recorder, const Change& record)
    {
        const bool is_changed = change(recorder, record);
        edit_count += is_changed ? 1 : 0;
        return is_changed;
    }

    void publish(vk::FrameGraph& graph);

    // A frame that is not known to be done, and the octree's number for it.
    struct Frame
    {
        std::shared_ptr<FrameState> host;
        std::uint64_t number;
    };

    // A dynamic object that was made in a frame that is not known to be done.
    struct NewObject
    {
        std::shared_ptr<FrameState> made_in;
        DynamicObjectId object;
    };

    Context::Impl& context;
    TreeInfo tree_info;
    std::unique_ptr<DynamicOctree> octree;
    vk::BufferOf<gpu::TreeTable> table;
    std::deque<Frame> frames;
    std::shared_ptr<FrameState> made_in; // the frame in which the tree was made; null: known to be done
    std::vector<NewObject> new_objects;
    std::vector<UpdateStats> updates;
    std::uint64_t edit_count = 0;                // dabs, and strokes that went back or forth
    const std::uint64_t identity = newVersion(); // no other tree's, nor any version's
};

} // namespace zvo
