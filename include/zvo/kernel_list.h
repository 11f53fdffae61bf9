// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/export.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace zvo
{

/// The kernels that a context has made so far, a line of text each behind a line with zvo's version: what a host writes
/// to a file before it ends, or ships, so that KernelPreparation makes them before they are recorded the next time. The
/// sizes and forms of kernels follow from the device and ContextInfo::tuning, so each kind of device has a list.
[[nodiscard]] ZVO_API std::string madeKernels(Context& context);

/// Makes kernels of a list beforehand, on threads of the host's. Without that, each is made by the call that first
/// records it, which takes tens of milliseconds where neither the host's pipeline cache nor the driver's knows it.
///
///     zvo::KernelPreparation preparation(context, list);
///     for (std::size_t i = 0; i < preparation.size(); ++i)
///         jobs.add([&, i] { preparation.make(i); }); // in any order, at once
///     // while the jobs run: how many are done, of size()
///     jobs.wait();
///     preparation.finish();
class ZVO_API KernelPreparation
{
public:
    /// kernels: as madeKernels() has told them, of several runs together if the host likes. Those of another version
    /// are left out, and so are kernels that have been made, or that the device cannot run. Throws Error{Memory}.
    KernelPreparation(Context& context, std::string_view kernels);

    /// Drops what has been made, unless finish() was called. No make() may be running.
    ~KernelPreparation();
    KernelPreparation(const KernelPreparation&) = delete;
    KernelPreparation& operator=(const KernelPreparation&) = delete;

    /// The number of kernels that are to be made.
    [[nodiscard]] std::size_t size() const;

    /// Makes kernel i of size(), with the host's pipeline cache. Alone of all functions, several threads may call it at
    /// once, each for kernels of its own, while another thread uses the context. The host's allocation callbacks must
    /// allow that, and its pipeline cache must not be made as externally synchronized, nor be merged into meanwhile.
    /// Throws
    /// Error{Usage} for a number that is not below size(), and Error{Memory} or Error{Other} where the driver fails.
    void make(std::size_t i);

    /// Gives the context the kernels that were made, on the thread that uses it. No make() may be running. Kernels that
    /// were not made are made when they are recorded, as without all this. A second call changes nothing.
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
