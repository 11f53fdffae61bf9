// SPDX-License-Identifier: MIT
// A host that embeds zvo through its C interface.
#pragma once

#include "c_program.h"
#include "support/embedding_host.h"
#include "zvo/zvo.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace zvo::test
{

/// A declaration in C, without log and tuning; refers to what info refers to.
ZvoContextInfo cDeclaration(const ContextInfo& info);

/// A host with one frame under way at a time, as EmbeddingHost. Fails a test where zvo does.
class CEmbeddingHost
{
public:
    /// change: of what it declares. prepare: called with the device before the context is made.
    explicit CEmbeddingHost(const HostOptions& options = {}, const std::function<void(ZvoContextInfo&)>& change = {},
                            const std::function<void(const HostDevice&)>& prepare = {});
    ~CEmbeddingHost();
    CEmbeddingHost(const CEmbeddingHost&) = delete;
    CEmbeddingHost& operator=(const CEmbeddingHost&) = delete;

    /// Runs c_program.c, which fills pictures. Returns what it returns. Its frames are the first ones.
    std::uint32_t runProgram();

    void frame(const std::function<void(ZvoRecorder*)>& record);
    ZvoModel* uploadBox();
    ZvoTree* build(const ZvoModel* model, const ZvoTreeBuildInfo& info);

    /// Of the tests' camera.
    std::vector<std::uint32_t> picture(const ZvoTree* tree, const ZvoTraceInfo* info = nullptr);

    HostDevice device;
    Declaration declaration;
    TargetImage image;
    ZvoContextInfo info;
    ZvoContext* context = nullptr;
    std::uint64_t last_frame = 0;
    std::vector<std::vector<std::uint32_t>> pictures;

    static constexpr std::uint32_t kWidth = EmbeddingHost::kWidth;
    static constexpr std::uint32_t kHeight = EmbeddingHost::kHeight;

    /// Records in a frame that the image has the layout that targets have.
    void beginImage() { image.beginCopies(m_commands); }

    /// The image in C.
    [[nodiscard]] ZvoImageTarget target() const;

private:
    VkCommandBuffer m_commands = VK_NULL_HANDLE; // of the frame that is recorded
};

} // namespace zvo::test
