// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_meshopt.h"

#include "io/gltf/gltf_schema.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

namespace zvo
{

namespace
{

using nlohmann::json;

constexpr std::uint64_t kVertexStrideMax = 256;
// The vertex codec spends at least two bits on 16 equal bytes, so no data unpacks to more. The index codecs check,
// before they write, that they have at least a byte for each triangle or index.
constexpr std::uint64_t kVertexBytesPerByteMax = 64;

struct PackedView : GltfPackedView
{
    std::span<const std::uint8_t> data;
    std::string where; // "meshopt_compression of bufferViews[2]"
};

/// The extension of a view or buffer, or null.
const json* extensionOf(const json& item)
{
    const auto extensions = item.find("extensions");
    if (extensions == item.end())
    {
        return nullptr;
    }
    auto extension = extensions->find("EXT_meshopt_compression");
    extension = extension == extensions->end() ? extensions->find("KHR_meshopt_compression") : extension;
    return extension != extensions->end() ? &*extension : nullptr;
}

void require(bool condition, const GltfDocument& document, const PackedView& view, std::string_view problem)
{
    if (!condition)
    {
        throw document.error(fmt::format("{} {}; {}", view.where, problem, kExportAgain));
    }
}

/// Checks the sizes that the extension requires, on which the decoders rely.
void checkSizes(const GltfDocument& document, const PackedView& view)
{
    const std::uint64_t stride = view.stride_bytes;
    const std::uint64_t unpacked_bytes = view.unpacked_bytes;
    require(view.count <= std::numeric_limits<std::uint32_t>::max() && stride > 0 && stride <= kVertexStrideMax,
            document, view, fmt::format("has {} elements of {} bytes, which no view has", view.count, stride));
    require(unpacked_bytes == view.count * stride, document, view,
            fmt::format("has {} elements of {} bytes, its view {} bytes", view.count, stride, unpacked_bytes));
    if (view.mode == "ATTRIBUTES")
    {
        require(stride % 4 == 0, document, view, fmt::format("has byteStride {}, not a multiple of 4", stride));
        require(unpacked_bytes / kVertexBytesPerByteMax <= view.data.size(), document, view,
                fmt::format("has {} bytes for {}, too few for any data", view.data.size(), unpacked_bytes));
    }
    else
    {
        require(view.mode == "TRIANGLES" || view.mode == "INDICES", document, view,
                fmt::format("has the mode {}, not ATTRIBUTES, TRIANGLES or INDICES", view.mode));
        require(stride == 2 || stride == 4, document, view, fmt::format("has indices of {} bytes", stride));
        require(view.mode == "INDICES" || view.count % 3 == 0, document, view,
                fmt::format("has {} indices, not whole triangles", view.count));
        require(view.count / 3 <= view.data.size(), document, view,
                fmt::format("has {} bytes for {} indices, too few for any data", view.data.size(), view.count));
    }
    const bool filter_fits =
        view.filter == "NONE" ||
        (view.mode == "ATTRIBUTES" && ((view.filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                                       (view.filter == "QUATERNION" && stride == 8) || view.filter == "EXPONENTIAL"));
    require(filter_fits, document, view,
            fmt::format("has the filter {}, which does not go with {} of {} bytes", view.filter, view.mode, stride));
}

/// Returns false if data is malformed.
bool decode(const PackedView& view, std::vector<std::uint8_t>& unpacked)
{
    const auto count = static_cast<std::size_t>(view.count);
    const auto stride = static_cast<std::size_t>(view.stride_bytes);
    if (view.mode == "TRIANGLES")
    {
        return meshopt_decodeIndexBuffer(unpacked.data(), count, stride, view.data.data(), view.data.size()) == 0;
    }
    if (view.mode == "INDICES")
    {
        return meshopt_decodeIndexSequence(unpacked.data(), count, stride, view.data.data(), view.data.size()) == 0;
    }
    if (meshopt_decodeVertexBuffer(unpacked.data(), count, stride, view.data.data(), view.data.size()) != 0)
    {
        return false;
    }
    if (view.filter == "OCTAHEDRAL")
    {
        meshopt_decodeFilterOct(unpacked.data(), count, stride);
    }
    else if (view.filter == "QUATERNION")
    {
        meshopt_decodeFilterQuat(unpacked.data(), count, stride);
    }
    else if (view.filter == "EXPONENTIAL")
    {
        meshopt_decodeFilterExp(unpacked.data(), count, stride);
    }
    return true;
}

} // namespace

bool isMeshoptFallback(const json& root, std::size_t buffer)
{
    const json& source = gltfItems(root, "buffers")[buffer];
    const json* extension = extensionOf(source);
    if (extension == nullptr || !extension->value("fallback", false))
    {
        return false;
    }
    const json& views = gltfItems(root, "bufferViews");
    return !source.contains("uri") ||
           std::all_of(views.begin(), views.end(),
                       [buffer](const json& view)
                       { return extensionOf(view) != nullptr || view["buffer"].get<std::size_t>() != buffer; });
}

std::map<int, GltfPackedView> listMeshoptViews(const json& root)
{
    std::map<int, GltfPackedView> packed_views;
    const json& views = gltfItems(root, "bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i)
    {
        if (const json* extension = extensionOf(views[i]))
        {
            packed_views[static_cast<int>(i)] = {.buffer = (*extension)["buffer"].get<std::size_t>(),
                                                 .offset_bytes = extension->value("byteOffset", std::uint64_t{0}),
                                                 .length_bytes = (*extension)["byteLength"].get<std::uint64_t>(),
                                                 .count = (*extension)["count"].get<std::uint64_t>(),
                                                 .stride_bytes = (*extension)["byteStride"].get<std::uint64_t>(),
                                                 .unpacked_bytes = views[i]["byteLength"].get<std::uint64_t>(),
                                                 .mode = (*extension)["mode"].get<std::string>(),
                                                 .filter = extension->value("filter", std::string("NONE"))};
        }
    }
    return packed_views;
}

std::vector<std::uint8_t> unpackMeshoptView(const GltfDocument& document, int index, const GltfPackedView& packed)
{
    PackedView view{packed, {}, fmt::format("meshopt_compression of bufferViews[{}]", index)};
    const std::span<const std::uint8_t> buffer = document.buffers[packed.buffer];
    require(view.offset_bytes <= buffer.size() && view.length_bytes <= buffer.size() - view.offset_bytes, document,
            view,
            fmt::format("takes {} bytes at {} of buffers[{}], which has {}", view.length_bytes, view.offset_bytes,
                        view.buffer, buffer.size()));
    view.data = buffer.subspan(view.offset_bytes, view.length_bytes);
    checkSizes(document, view);
    document.countUnpacked(packed.unpacked_bytes, view.where);
    std::vector<std::uint8_t> unpacked(packed.unpacked_bytes);
    const bool is_newer = view.mode == "ATTRIBUTES" && !view.data.empty() && (view.data[0] & 15U) != 0;
    require(decode(view, unpacked), document, view,
            is_newer ? "is of a later version than the 0 that is read" : "does not decode");
    return unpacked;
}

} // namespace zvo
