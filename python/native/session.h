// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace zvo::python
{

/// A device, which threads use one after the other. It lives as long as its trees.
class Session
{
public:
    /// The device that a text names, as --device does; empty: the best one. It is opened once in a process. Throws
    /// Error{Device}.
    static std::shared_ptr<Session> of(const std::string& name);

    /// Lets go of all devices, for when the interpreter ends.
    static void closeAll();

    /// name: as of().
    explicit Session(const std::string& name);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Calls work with the device, once no other thread uses it. Call it without Python's lock. Throws Error{Usage} in
    /// a process that was forked from that of the device, and what work throws.
    template <typename Work> auto use(const Work& work)
    {
        checkProcess();
        const std::scoped_lock lock(m_in_use);
        freeRetired();
        return work(*m_device);
    }

    /// Frees a tree: now, or if another thread uses the device, before the device is used next. Does not wait.
    void retire(DeviceTree&& tree) noexcept;

private:
    void checkProcess() const;
    [[nodiscard]] bool isForked() const;
    void freeRetired();

    std::shared_ptr<vk::HeadlessDevice> m_device;
    int m_process;       // that has opened the device
    std::mutex m_in_use; // the device
    std::mutex m_guard;  // of m_retired
    std::vector<DeviceTree> m_retired;
};

} // namespace zvo::python
