// SPDX-License-Identifier: MIT
#include "api/shown_tree.h"

#include "api/context_impl.h"
#include "api/dynamic_tree_impl.h"
#include "api/tree_impl.h"

namespace zvo
{

ShownTree shownIn(Recorder::Impl& recorder, const Tree& tree)
{
    const Tree::Impl& impl = usable(tree);
    requireSame(recorder.context, impl.context);
    return {impl.fixed, impl.fixed.version, 0};
}

ShownTree shownIn(Recorder::Impl& recorder, DynamicTree& tree)
{
    DynamicTree::Impl& impl = usable(tree);
    impl.enter(recorder);
    return {impl.octree->tree(), impl.identity, impl.edit_count};
}

} // namespace zvo
