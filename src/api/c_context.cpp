// SPDX-License-Identifier: MIT
// The C interface: errors, the host's device, contexts and recorders.
#include "api/c_convert.h"
#include "api/c_handles.h"

#include <array>
#include <cstdio>
#include <string_view>

namespace zvo
{

namespace
{

constexpr std::size_t kMessageMax = 4096; // bytes; fixed, because memory may be what was lacking

std::array<char, kMessageMax>& lastMessage()
{
    thread_local std::array<char, kMessageMax> message{};
    return message;
}

// The C++ callback, which calls the host's function in C. user: the ZvoContext.
void logInC(void* user, LogSeverity severity, const char* message)
{
    const ZvoLogCallback& log = static_cast<const ZvoContext*>(user)->log;
    log.function(log.user, static_cast<ZvoLogSeverity>(severity), message);
}

ContextInfo contextInfo(const ZvoContextInfo& info, ZvoContext* context)
{
    ContextInfo result = ofC(info);
    if (info.log.function != nullptr)
    {
        result.log = {&logInC, context};
    }
    return result;
}

const std::vector<std::string>& listOf(const DeviceReport& report, ZvoReportList list)
{
    switch (list)
    {
    case ZVO_REPORT_PRESENT:
        return report.present;
    case ZVO_REPORT_MISSING:
        return report.missing;
    case ZVO_REPORT_REASONS:
        return report.reasons;
    default:
        throw Error(ErrorCode::Usage, "a report has no list " + std::to_string(list));
    }
}

} // namespace

ZvoResult failed(const char* function, ErrorCode code, const char* message) noexcept
{
    std::snprintf(lastMessage().data(), kMessageMax, "%s: %s", function, message);
    return static_cast<ZvoResult>(code);
}

} // namespace zvo

using namespace zvo;

ZvoContext::ZvoContext(const ZvoContextInfo& info)
    : log(info.log), object(contextInfo(info, this)), report{object.report()}
{
}

const char* zvoLastError(void)
{
    return lastMessage().data();
}

int zvoVersion(void)
{
    return version();
}

ZvoResult zvoQuery(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                   VkPhysicalDevice physical_device, uint32_t instance_api_version, ZvoDeviceReport** report)
{
    return guarded(__func__,
                   [&]
                   {
                       at(get_instance_proc_addr, "get_instance_proc_addr");
                       at(instance, "instance");
                       at(physical_device, "physical_device");
                       give(report, "report",
                            [&]
                            { return query(get_instance_proc_addr, instance, physical_device, instance_api_version); });
                   });
}

ZvoResult zvoDeviceReportInfo(const ZvoDeviceReport* report, ZvoDeviceInfo* info)
{
    return guarded(__func__, [&] { write(info, "info", objectOf(report, "report")); });
}

ZvoResult zvoDeviceReportText(const ZvoDeviceReport* report, ZvoReportList list, uint32_t index, const char** text)
{
    return guarded(__func__,
                   [&]
                   {
                       const std::vector<std::string>& lines = listOf(objectOf(report, "report"), list);
                       at(text, "text") = index < lines.size() ? lines[index].c_str() : nullptr;
                   });
}

ZvoResult zvoFeatureStorageCreate(ZvoFeatureStorage** storage)
{
    return guarded(__func__, [&] { give(storage, "storage", [] { return FeatureStorage(); }); });
}

ZvoResult zvoPatchFeatures(VkDeviceCreateInfo* info, ZvoFeatureStorage* storage, const ZvoOptionalFeatures* optional)
{
    return guarded(__func__,
                   [&]
                   {
                       const auto features = optional == nullptr ? OptionalFeatures{} : read(optional, "optional");
                       patchFeatures(at(info, "info"), objectOf(storage, "storage"), features);
                   });
}

ZvoResult zvoPatchFeatureChain(const void** chain, ZvoFeatureStorage* storage, VkPhysicalDeviceFeatures* core,
                               const ZvoOptionalFeatures* optional)
{
    return guarded(__func__,
                   [&]
                   {
                       const auto features = optional == nullptr ? OptionalFeatures{} : read(optional, "optional");
                       patchFeatures(at(chain, "chain"), objectOf(storage, "storage"), core, features);
                   });
}

ZvoResult zvoContextCreate(const ZvoContextInfo* info, ZvoContext** context)
{
    return guarded(__func__, [&] { give(context, "context", [&] { return readStruct(info, "info"); }); });
}

ZvoResult zvoContextFrameDone(ZvoContext* context, uint64_t frame)
{
    return guarded(__func__, [&] { objectOf(context, "context").frameDone(frame); });
}

ZvoResult zvoContextFrameLost(ZvoContext* context, uint64_t frame)
{
    return guarded(__func__, [&] { objectOf(context, "context").frameLost(frame); });
}

ZvoResult zvoContextMemory(const ZvoContext* context, ZvoMemoryUse* use)
{
    return guarded(__func__, [&] { write(use, "use", objectOf(context, "context").memory()); });
}

ZvoResult zvoContextPassTimeCount(const ZvoContext* context, uint32_t* count)
{
    return guarded(__func__,
                   [&]
                   {
                       const std::size_t passes = objectOf(context, "context").passTimes().size();
                       at(count, "count") = static_cast<std::uint32_t>(passes);
                   });
}

ZvoResult zvoContextPassTime(const ZvoContext* context, uint32_t index, ZvoPassTime* time)
{
    return guarded(__func__,
                   [&]
                   {
                       const std::vector<PassTime>& times = objectOf(context, "context").passTimes();
                       if (index >= times.size())
                       {
                           throw Error(ErrorCode::Usage, "there is no pass " + std::to_string(index));
                       }
                       write(time, "time", times[index]);
                   });
}

ZvoResult zvoContextReport(const ZvoContext* context, const ZvoDeviceReport** report)
{
    return guarded(__func__, [&] { at(report, "report") = &at(context, "context").report; });
}

ZvoResult zvoContextMadeKernels(ZvoContext* context, const char** text)
{
    return guarded(__func__,
                   [&]
                   {
                       const char*& result = at(text, "text");
                       ZvoContext& handle = at(context, "context");
                       handle.made_kernels = madeKernels(handle.object);
                       result = handle.made_kernels.c_str();
                   });
}

ZvoResult zvoKernelPreparationCreate(ZvoContext* context, const char* kernels, ZvoKernelPreparation** preparation)
{
    return guarded(__func__,
                   [&]
                   {
                       Context& object = objectOf(context, "context");
                       const std::string_view list = &at(kernels, "kernels");
                       give(preparation, "preparation", [&] { return KernelPreparation(object, list); });
                   });
}

ZvoResult zvoKernelPreparationSize(const ZvoKernelPreparation* preparation, size_t* size)
{
    return guarded(__func__, [&] { at(size, "size") = objectOf(preparation, "preparation").size(); });
}

ZvoResult zvoKernelPreparationMake(ZvoKernelPreparation* preparation, size_t index)
{
    return guarded(__func__, [&] { objectOf(preparation, "preparation").make(index); });
}

ZvoResult zvoKernelPreparationFinish(ZvoKernelPreparation* preparation)
{
    return guarded(__func__, [&] { objectOf(preparation, "preparation").finish(); });
}

ZvoResult zvoRecorderBegin(ZvoContext* context, VkCommandBuffer commands, uint64_t frame, VkPipelineStageFlags2 readers,
                           ZvoRecorder** recorder)
{
    return guarded(__func__,
                   [&]
                   {
                       at(commands, "commands");
                       Context& object = objectOf(context, "context");
                       give(recorder, "recorder", [&] { return Recorder(object, commands, frame, readers); });
                   });
}

ZvoResult zvoRecorderMakeVisible(ZvoRecorder* recorder, VkPipelineStageFlags2 stages)
{
    return guarded(__func__, [&] { objectOf(recorder, "recorder").makeVisible(stages); });
}
