// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "session.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace zvo::python
{

/// The voxels of a tree in Morton order, those that are inside of a filled one included.
struct Voxels
{
    std::vector<std::int32_t> coords; // [3 * voxels] cells
    std::vector<std::uint8_t> colors; // [3 * voxels] sRGB, or empty where the tree has no attributes
    std::vector<float> normals;       // [3 * voxels] length 1, or 0 where there is none; or empty
};

/// A tree in the memory of a device. Nothing changes it. All functions that use the device wait, and for other threads
/// that use it; call them without Python's lock.
class Tree
{
public:
    Tree(std::shared_ptr<Session> session, DeviceTree tree);
    ~Tree();
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;

    [[nodiscard]] Session& session() const { return *m_session; }
    [[nodiscard]] const DeviceTree& device() const { return m_tree; }

    /// Copies the tree to the host. Throws Error{Memory}.
    [[nodiscard]] TreeData download() const;

    [[nodiscard]] Voxels voxels() const;

    /// The DAG with the same voxels. Throws Error{Usage} for a DAG.
    [[nodiscard]] std::unique_ptr<Tree> compress() const;

    /// Writes a file of the kind that its name tells, in place of any that is there. Throws Error{Usage} for a name
    /// that tells none, and as cli::writeTree().
    void save(const std::string& path) const;

private:
    std::shared_ptr<Session> m_session;
    DeviceTree m_tree;
};

} // namespace zvo::python
