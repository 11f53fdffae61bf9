// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/octree.h"
#include "core/tree/overlaid_tree.h"
#include "core/tree/svdag.h"

namespace zvo
{

/// What rays are traced through: an octree or a DAG, maybe with overlays, which must outlive the view.
class TreeView
{
public:
    TreeView(const Octree& octree) : m_octree(&octree) {}              // implicit, like the next ones
    TreeView(const Svdag& dag) : m_octree(&dag.tree), m_svdag(&dag) {} // a DAG is traced like the octree
    TreeView(const OverlaidTree& tree)
        : m_octree(&tree.dag.tree), m_svdag(tree.has_lists ? &tree.dag : nullptr),
          m_overlaid(tree.has_lists ? &tree : nullptr)
    {
    }

    /// The octree, or what the DAG has in common with one.
    [[nodiscard]] const Octree& octree() const { return *m_octree; }

    /// The DAG; null for an octree.
    [[nodiscard]] const Svdag* svdag() const { return m_svdag; }

    /// Of a DAG that has room for overlays; null otherwise, and for an octree, which is traced alike with and without.
    [[nodiscard]] const OverlaidTree* overlaid() const { return m_overlaid; }

    /// Entries of a word of lists of children (shaders/shared/svdag.h); 0: nodes have none.
    [[nodiscard]] std::uint32_t entriesPerWord() const { return m_svdag == nullptr ? 0 : m_svdag->entries_per_word; }

    /// Whether nodes may have lists.
    [[nodiscard]] bool hasLists() const { return m_svdag != nullptr; }

private:
    const Octree* m_octree;
    const Svdag* m_svdag = nullptr;
    const OverlaidTree* m_overlaid = nullptr;
};

} // namespace zvo
