// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_document.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/scene/scene_size.h"
#include "io/file/folder_bounds.h"
#include "io/gltf/gltf_container.h"
#include "io/gltf/gltf_meshopt.h"
#include "io/gltf/gltf_schema.h"
#include "io/gltf/gltf_uri.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace zvo
{

namespace
{

using nlohmann::json;
using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kUnpackedFreeBytes = std::uint64_t{1} << 30U;
constexpr std::uint64_t kUnpackedBytesPerByte = 128; // twice what a vertex codec reaches on equal vertices

/// The parts of the document that tinygltf reads. Buffers and images are read here, because it does not check their
/// sizes and files enough; animations and cameras, because it refuses some that can be used.
constexpr std::array kModelParts = {"asset",       "extensionsUsed", "extensionsRequired", "scene",     "scenes",
                                    "nodes",       "meshes",         "accessors",          "materials", "textures",
                                    "bufferViews", "samplers"};

/// How the names of extensions begin whose effect is loaded, or that do not change surfaces, base colour or emission
/// (scattering of light, lights, alternatives that are not chosen, what answers to users, data about the file), or that
/// name formats of images, which cost the textures that have no other image.
constexpr std::array<std::string_view, 20> kAcceptedExtensions = {"EXT_instance_features",
                                                                  "EXT_lights_",
                                                                  "EXT_mesh_features",
                                                                  "EXT_mesh_gpu_instancing",
                                                                  "EXT_meshopt_compression",
                                                                  "EXT_structural_metadata",
                                                                  "EXT_texture_avif",
                                                                  "EXT_texture_webp",
                                                                  "KHR_animation_pointer",
                                                                  "KHR_draco_mesh_compression",
                                                                  "KHR_interactivity",
                                                                  "KHR_lights_",
                                                                  "KHR_materials_",
                                                                  "KHR_mesh_quantization",
                                                                  "KHR_meshopt_compression",
                                                                  "KHR_node_",
                                                                  "KHR_texture_basisu",
                                                                  "KHR_texture_transform",
                                                                  "KHR_xmp",
                                                                  "MSFT_texture_dds"};

void checkVersion(const json& document, const std::filesystem::path& path)
{
    const json* asset = document.contains("asset") ? &document["asset"] : nullptr;
    if (asset == nullptr || !asset->is_object() || !asset->contains("version") || !(*asset)["version"].is_string())
    {
        throw gltfError(path, fmt::format("not a glTF file: asset.version is missing; {}",
                                          document.contains("objects") ? "if it is a scene file, name it .scene.json"
                                                                       : "check that it is glTF 2.0 (.gltf or .glb)"));
    }
    const auto minimum = asset->find("minVersion");
    const bool has_minimum = minimum != asset->end() && minimum->is_string();
    const auto version = (has_minimum ? *minimum : (*asset)["version"]).get<std::string>();
    if (has_minimum ? version != "2.0" : !version.starts_with("2."))
    {
        throw gltfError(path, fmt::format("glTF version {} is not supported; export it as glTF 2.0", version));
    }
}

void checkExtensions(const json& document, const std::filesystem::path& path)
{
    for (const json& item : gltfItems(document, "extensionsRequired"))
    {
        const auto name = item.get<std::string>();
        const auto is_accepted = [&](std::string_view accepted) { return name.starts_with(accepted); };
        if (std::ranges::none_of(kAcceptedExtensions, is_accepted))
        {
            throw gltfError(path,
                            fmt::format("requires the extension {}, which is not supported; export it without", name));
        }
    }
}

/// Takes the indices out of all primitives, in order. tinygltf refuses a document whose indices have an accessor
/// without a buffer view, which sparse and packed ones may have.
std::vector<int> takeIndices(json& document)
{
    std::vector<int> taken;
    json none = json::array();
    for (json& mesh : document.contains("meshes") ? document["meshes"] : none)
    {
        for (json& primitive : mesh["primitives"])
        {
            taken.push_back(primitive.value("indices", -1));
            primitive.erase("indices");
        }
    }
    return taken;
}

/// Puts the indices back. Returns false if tinygltf has left out a primitive.
bool putIndices(tinygltf::Model& model, const std::vector<int>& taken)
{
    std::size_t next = 0;
    for (tinygltf::Mesh& mesh : model.meshes)
    {
        for (tinygltf::Primitive& primitive : mesh.primitives)
        {
            primitive.indices = next < taken.size() ? taken[next] : -1;
            ++next;
        }
    }
    return next == taken.size();
}

tinygltf::Model parseModel(json& document, const std::filesystem::path& path)
{
    const std::vector<int> indices = takeIndices(document);
    json parts = json::object();
    for (const char* part : kModelParts)
    {
        if (document.contains(part))
        {
            parts[part] = std::move(document[part]);
        }
    }
    const std::string text = parts.dump();
    if (text.size() > std::numeric_limits<unsigned int>::max())
    {
        throw gltfError(path, "more than 4 GiB of JSON; export it as smaller files");
    }
    tinygltf::Model model;
    std::string failure;
    std::string warning;
    const bool parsed = tinygltf::TinyGLTF().LoadASCIIFromString(&model, &failure, &warning, text.c_str(),
                                                                 static_cast<unsigned int>(text.size()), "");
    if (!parsed || !failure.empty() || !putIndices(model, indices))
    {
        throw gltfError(path, fmt::format("not valid glTF; {}", kExportAgain)); // nothing that the schema lets through
    }
    return model;
}

void loadBuffers(GltfDocument& document, const json& root, Bytes bin)
{
    std::map<std::string, Bytes> files; // by path; several buffers may share a file
    const json& buffers = gltfItems(root, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i)
    {
        if (isMeshoptFallback(root, i))
        {
            document.buffers.emplace_back();
            continue;
        }
        const std::string where = fmt::format("buffers[{}]", i);
        const auto wanted = buffers[i]["byteLength"].get<std::uint64_t>();
        const auto uri = buffers[i].find("uri");
        Bytes bytes = bin;
        if (uri != buffers[i].end())
        {
            const auto text = uri->get<std::string>();
            const std::string key = isDataUri(text) ? text : std::filesystem::path(text).lexically_normal().string();
            const auto [file, is_new] = files.emplace(key, Bytes());
            if (is_new)
            {
                document.storage.push_back(document.readUri(text, where + ".uri"));
                file->second = document.storage.back();
            }
            bytes = file->second;
        }
        else if (i > 0 || bin.empty())
        {
            throw document.error(
                fmt::format("{} has neither a URI nor a binary chunk in the file; {}", where, kExportAgain));
        }
        if (bytes.size() < wanted)
        {
            throw document.error(
                fmt::format("{} needs {} bytes, but its data has {}; {}", where, wanted, bytes.size(), kCutShort));
        }
        document.buffers.push_back(bytes.first(wanted));
    }
}

std::vector<tinygltf::Camera> listCameras(const json& cameras, GltfFaults& faults)
{
    std::vector<tinygltf::Camera> list;
    for (const json& source : cameras)
    {
        tinygltf::Camera camera;
        camera.name = source.value("name", std::string());
        camera.type = source["type"].get<std::string>();
        const auto shape = source.find(camera.type);
        if (camera.type == "perspective" && shape != source.end())
        {
            camera.perspective.yfov = (*shape)["yfov"].get<double>();
        }
        else if (camera.type == "orthographic" && shape != source.end())
        {
            camera.orthographic.ymag = (*shape)["ymag"].get<double>();
        }
        else
        {
            const std::string part = fmt::format("cameras[{}]", list.size());
            faults[part] = {fmt::format("{} has neither a perspective nor an orthographic shape that its type \"{}\" "
                                        "names; {}",
                                        part, camera.type, kExportAgain)};
        }
        list.push_back(std::move(camera));
    }
    return list;
}

std::vector<GltfImageSource> listImages(const json& images)
{
    std::vector<GltfImageSource> sources;
    for (const json& image : images)
    {
        sources.push_back(
            {image.value("name", std::string()), image.value("uri", std::string()), image.value("bufferView", -1)});
    }
    return sources;
}

} // namespace

Error gltfError(const std::filesystem::path& path, std::string_view text)
{
    return inputError(path, text);
}

void GltfDocument::use(const std::string& part) const
{
    const auto fault = faults.find(part);
    if (fault != faults.end())
    {
        fault->second.is_told = true;
        throw error(fault->second.text);
    }
}

void GltfDocument::warnOfUnusedFaults() const
{
    for (const auto& [part, fault] : faults)
    {
        if (!fault.is_told)
        {
            const std::string without_advice = fault.text.substr(0, fault.text.rfind("; "));
            warnings.add("parts with faults left out, as nothing needs them", without_advice);
        }
    }
}

Bytes GltfDocument::bufferView(int index) const
{
    use(fmt::format("bufferViews[{}]", index));
    const auto packed = packed_views.find(index);
    if (packed != packed_views.end())
    {
        auto unpacked = unpacked_views.find(index);
        if (unpacked == unpacked_views.end())
        {
            unpacked = unpacked_views.emplace(index, unpackMeshoptView(*this, index, packed->second)).first;
        }
        return unpacked->second;
    }
    const tinygltf::BufferView& view = model.bufferViews[index];
    const Bytes buffer = buffers[view.buffer];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
    {
        throw error(fmt::format("bufferViews[{}] takes {} bytes at {} of buffers[{}], which has {}; {}", index,
                                view.byteLength, view.byteOffset, view.buffer, buffer.size(), kExportAgain));
    }
    return buffer.subspan(view.byteOffset, view.byteLength);
}

void GltfDocument::countUnpacked(std::uint64_t bytes, const std::string& where) const
{
    std::uint64_t limit = kUnpackedFreeBytes;
    for (const Bytes buffer : buffers)
    {
        limit += std::uint64_t{buffer.size()} * kUnpackedBytesPerByte;
    }
    limit = std::min(limit, sceneBytesMax());
    if (bytes > limit - std::min(unpacked_bytes, limit))
    {
        throw error(fmt::format("{} needs {} bytes and makes the file unpack to more than {}, out of proportion to its "
                                "size or to this machine; export it again, without compression if it is right",
                                where, bytes, limit));
    }
    unpacked_bytes += bytes;
}

std::vector<std::uint8_t> GltfDocument::readUri(const std::string& uri, const std::string& where) const
{
    if (isDataUri(uri))
    {
        if (auto bytes = decodeDataUri(uri))
        {
            return *std::move(bytes);
        }
        throw error(fmt::format("{} is not a valid data URI; {}", where, kExportAgain));
    }
    const std::filesystem::path file = fileOf(uri, where);
    try
    {
        return readFile(file);
    }
    catch (const Error& failure)
    {
        throw error(fmt::format("{}: {}", where, failure.what()));
    }
}

std::filesystem::path GltfDocument::fileOf(const std::string& uri, const std::string& where) const
{
    if (isRemoteUri(uri))
    {
        throw error(fmt::format("{} is {}: only files beside the document and data URIs are read; download it and name "
                                "the file",
                                where, uri));
    }
    const std::string decoded = decodePercent(uri);
    if (decoded.find('\0') != std::string::npos)
    {
        throw error(fmt::format("{} has a zero byte in it; {}", where, kExportAgain));
    }
    // Some exporters write names without percent-encoding.
    std::error_code unreadable;
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const bool as_written =
        !std::filesystem::exists(folder / decoded, unreadable) && std::filesystem::exists(folder / uri, unreadable);
    const std::filesystem::path file = folder / (as_written ? uri : decoded);
    if (!liesBelow(folder, file))
    {
        throw error(fmt::format("{} is {}, which leaves the document's folder; only files in it and below are read; "
                                "put the file there and name it",
                                where, uri));
    }
    if (!std::filesystem::exists(file, unreadable))
    {
        throw error(fmt::format("{} is {}: there is no such file; put it there, or name another", where, uri));
    }
    if (std::filesystem::is_fifo(file, unreadable) || std::filesystem::is_socket(file, unreadable))
    {
        throw error(fmt::format("{} is {}, which is not a file; name one", where, uri));
    }
    return file;
}

std::optional<std::uint64_t> GltfDocument::offsetInFile(std::span<const std::uint8_t> bytes) const
{
    const std::vector<std::uint8_t>& content = storage.front();
    const std::less_equal<const std::uint8_t*> precedes;
    std::error_code unknown;
    if (!precedes(content.data(), bytes.data()) ||
        !precedes(bytes.data() + bytes.size(), content.data() + content.size()) ||
        !std::filesystem::is_regular_file(path, unknown))
    {
        return std::nullopt;
    }
    return static_cast<std::uint64_t>(bytes.data() - content.data());
}

std::string GltfDocument::reason(const Error& error) const
{
    const std::string message = error.what();
    const std::string start = this->error("").what();
    return message.starts_with(start) ? message.substr(start.size()) : message;
}

bool GltfDocument::uses(std::string_view extension) const
{
    const auto isIn = [&](const auto& list) { return std::ranges::find(list, extension) != list.end(); };
    return isIn(model.extensionsUsed) || isIn(model.extensionsRequired);
}

void GltfWarnings::add(const std::string& kind, const std::string& where)
{
    const auto [entry, is_new] = m_by_kind.emplace(kind, m_entries.size());
    if (is_new)
    {
        m_entries.push_back({kind, where, 0});
    }
    ++m_entries[entry->second].count;
}

std::vector<std::string> GltfWarnings::lines(const std::filesystem::path& path) const
{
    std::vector<std::string> lines;
    for (const Entry& entry : m_entries)
    {
        const std::string more = entry.count > 1 ? fmt::format(" and {} more", entry.count - 1) : "";
        lines.emplace_back(gltfError(path, fmt::format("{} ({}{})", entry.kind, entry.where, more)).what());
    }
    return lines;
}

GltfDocument openGltf(const std::filesystem::path& path, std::vector<std::uint8_t> content)
{
    GltfDocument document;
    document.path = path;
    document.storage.push_back(std::move(content));
    const GltfContainer container = openGltfContainer(document.storage.front(), path);
    json root = parseGltfJson(container.json, path);
    checkVersion(root, path);
    checkGltfSchema(root, document);
    checkExtensions(root, path);
    loadBuffers(document, root, container.bin);
    document.packed_views = listMeshoptViews(root);
    document.images = listImages(gltfItems(root, "images"));
    document.skins = listGltfSkins(root);
    document.animations = listGltfAnimations(root, path);
    std::vector<tinygltf::Camera> cameras = listCameras(gltfItems(root, "cameras"), document.faults);
    document.model = parseModel(root, path);
    document.model.cameras = std::move(cameras);
    return document;
}

} // namespace zvo
