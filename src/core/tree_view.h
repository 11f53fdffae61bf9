// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree.h"
#include "core/svdag.h"

namespace zvo
{

/// What rays are traced through: an octree or a DAG, which must outlive the view.
class TreeView
{
public:
    TreeView(const Octree& octree) : m_octree(&octree) {}              // implicit, like the next one
    TreeView(const Svdag& dag) : m_octree(&dag.tree), m_svdag(&dag) {} // a DAG is traced like the octree

    /// The octree, or what the DAG has in common with one.
    [[nodiscard]] const Octree& octree() const { return *m_octree; }

    /// The DAG; null for an octree.
    [[nodiscard]] const Svdag* svdag() const { return m_svdag; }

    /// Entries of a word of lists of children (shaders/shared/svdag.h); 0: nodes have none.
    [[nodiscard]] std::uint32_t entriesPerWord() const { return m_svdag == nullptr ? 0 : m_svdag->entries_per_word; }

private:
    const Octree* m_octree;
    const Svdag* m_svdag = nullptr;
};

} // namespace zvo
