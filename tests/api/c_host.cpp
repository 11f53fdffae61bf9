// SPDX-License-Identifier: MIT
#include "c_host.h"

#include "api/c_convert.h"

#include <gtest/gtest.h>

namespace zvo::test
{

ZvoContextInfo cDeclaration(const ContextInfo& info)
{
    ZvoContextInfo result = toC<ZvoContextInfo>(info);
    result.instance_extensions = info.instance_extensions.data();
    result.instance_extension_count = static_cast<std::uint32_t>(info.instance_extensions.size());
    result.device_extensions = info.device_extensions.data();
    result.device_extension_count = static_cast<std::uint32_t>(info.device_extensions.size());
    return result;
}

CEmbeddingHost::CEmbeddingHost(const HostOptions& options, const std::function<void(ZvoContextInfo&)>& change,
                               const std::function<void(const HostDevice&)>& prepare)
    : device(options), declaration(device), image(device, VK_FORMAT_R8G8B8A8_UNORM, kWidth, kHeight),
      info(cDeclaration(declaration.info))
{
    if (change)
    {
        change(info);
    }
    if (prepare)
    {
        prepare(device);
    }
    EXPECT_EQ(zvoContextCreate(&info, &context), ZVO_OK) << zvoLastError();
}

CEmbeddingHost::~CEmbeddingHost()
{
    zvoContextDestroy(context);
}

std::uint32_t CEmbeddingHost::runProgram()
{
    CHost host{};
    host.user = this;
    host.begin = [](void* user) { return static_cast<CEmbeddingHost*>(user)->device.begin(); };
    host.finish = [](void* user, VkCommandBuffer commands)
    {
        HostDevice& own = static_cast<CEmbeddingHost*>(user)->device;
        own.submit(commands);
        own.wait();
    };
    host.beginCopies = [](void* user, VkCommandBuffer commands)
    { static_cast<CEmbeddingHost*>(user)->image.beginCopies(commands); };
    host.endCopies = [](void* user, VkCommandBuffer commands)
    { static_cast<CEmbeddingHost*>(user)->image.read(commands); };
    host.keep = [](void* user)
    {
        auto& own = *static_cast<CEmbeddingHost*>(user);
        own.pictures.push_back(own.image.words());
    };
    host.context = context;
    host.image = target();
    host.width = kWidth;
    host.height = kHeight;
    return runCProgram(&host);
}

void CEmbeddingHost::frame(const std::function<void(ZvoRecorder*)>& record)
{
    m_commands = device.begin();
    ZvoRecorder* recorder = nullptr;
    EXPECT_EQ(zvoRecorderBegin(context, m_commands, ++last_frame, 0, &recorder), ZVO_OK) << zvoLastError();
    record(recorder);
    zvoRecorderEnd(recorder);
    device.submit(m_commands);
    device.wait();
    EXPECT_EQ(zvoContextFrameDone(context, last_frame), ZVO_OK);
}

ZvoModel* CEmbeddingHost::uploadBox()
{
    ZvoMeshInfo mesh = ZVO_MESH_INFO_INIT;
    mesh.positions = kCBoxCorners;
    mesh.vertex_count = 8;
    mesh.triangles = kCBoxTriangles;
    mesh.triangle_count = 12;
    ZvoModelInfo description = ZVO_MODEL_INFO_INIT;
    description.meshes = &mesh;
    description.mesh_count = 1;
    ZvoModel* model = nullptr;
    frame([&](ZvoRecorder* recorder)
          { EXPECT_EQ(zvoModelCreate(recorder, &description, &model), ZVO_OK) << zvoLastError(); });
    return model;
}

ZvoTree* CEmbeddingHost::build(const ZvoModel* model, const ZvoTreeBuildInfo& description)
{
    ZvoTreeJob* build = nullptr;
    EXPECT_EQ(zvoTreeBuildCreate(context, model, &description, &build), ZVO_OK) << zvoLastError();
    VkBool32 has_more = build != nullptr ? VK_TRUE : VK_FALSE;
    while (has_more)
    {
        has_more = VK_FALSE;
        frame([&](ZvoRecorder* recorder)
              { EXPECT_EQ(zvoTreeJobRecord(build, recorder, &has_more), ZVO_OK) << zvoLastError(); });
    }
    ZvoTree* tree = nullptr;
    EXPECT_EQ(zvoTreeJobTake(build, &tree), ZVO_OK) << zvoLastError();
    zvoTreeJobDestroy(build);
    return tree;
}

std::vector<std::uint32_t> CEmbeddingHost::picture(const ZvoTree* tree, const ZvoTraceInfo* trace_info)
{
    const double eye[3] = {22, 17, 25};
    const double look_target[3] = {5, 5, 5};
    ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
    EXPECT_EQ(zvoCameraLookAt(eye, look_target, 0.6, &camera), ZVO_OK);
    const ZvoTraceInfo defaults = ZVO_TRACE_INFO_INIT;
    const ZvoImageTarget color = target();
    ZvoTracer* tracer = nullptr;
    EXPECT_EQ(zvoTracerCreate(context, kWidth, kHeight, color.format, &tracer), ZVO_OK) << zvoLastError();
    frame(
        [&](ZvoRecorder* recorder)
        {
            beginImage();
            EXPECT_EQ(zvoTracerTrace(tracer, recorder, tree, &camera, trace_info != nullptr ? trace_info : &defaults,
                                     &color, nullptr),
                      ZVO_OK)
                << zvoLastError();
            image.read(m_commands);
        });
    zvoTracerDestroy(tracer);
    return image.words();
}

ZvoImageTarget CEmbeddingHost::target() const
{
    return toC<ZvoImageTarget>(image.target());
}

} // namespace zvo::test
