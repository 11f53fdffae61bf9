// SPDX-License-Identifier: MIT
#pragma once

#include "vk/buffer.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace zvo::vk
{

class Device;
class FrameGraph;
class DeletionQueue;

/// Fills buffers from the host's memory. The implementation decides when: HeadlessDevice copies at once and waits,
/// RecordedUploads records the copies into a frame.
class Uploader
{
public:
    virtual ~Uploader() = default;

    [[nodiscard]] virtual Device& device() = 0;

    /// Runs the passes of `record` after all earlier uploads, and before whatever uses their results. Objects that are
    /// not needed after the passes go into the DeletionQueue that `record` gets. Throws what `record` throws.
    virtual void perform(const std::function<void(FrameGraph&, DeletionQueue&)>& record) = 0;

    /// Keeps an object for as long as work that was handed over earlier may use it.
    virtual void keep(std::shared_ptr<void> thing) = 0;

    /// Copies values to buffer from element first on. Throws Error{Other} when they do not fit, Error{Memory}.
    template <typename T> void upload(BufferOf<T>& buffer, std::span<const T> values, std::uint64_t first = 0)
    {
        uploadBytes(buffer, first * sizeof(T), values.data(), values.size_bytes());
    }

    /// Makes a new buffer with these values.
    template <typename T> BufferOf<T> makeBuffer(std::string name, std::span<const T> values)
    {
        BufferOf<T> buffer(device(), std::move(name), values.size());
        upload(buffer, values);
        return buffer;
    }

protected:
    virtual void uploadBytes(Buffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes) = 0;
};

} // namespace zvo::vk
