// SPDX-License-Identifier: MIT
#include "io/image/hdr_image_io.h"

#include "core/base/read_file.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#include <stb/stb_image.h>

namespace zvo
{

namespace
{

constexpr int kHdrChannels = 3;

void checkTexels(std::int64_t width, std::int64_t height, const std::string& where)
{
    if (width < 1 || height < 1)
    {
        throw imageError(where, "the picture has no texels");
    }
    if (std::max(width, height) > std::int64_t{kImageEdgeMax} ||
        static_cast<std::uint64_t>(width * height) > kHdrTexelsMax)
    {
        throw imageError(where,
                         fmt::format("the picture has {} x {} texels, more than {} on an edge or {} in all; scale "
                                     "it down",
                                     width, height, kImageEdgeMax, kHdrTexelsMax));
    }
}

/// The bytes that stb has not read yet. It waits without an end for the rest of a row that is cut off, so behind the
/// bytes there are others, which end any row.
struct RadianceBytes
{
    std::span<const std::uint8_t> rest;
    int is_cut_off = 0;
};

int readRadiance(void* source, char* to, int count)
{
    auto& bytes = *static_cast<RadianceBytes*>(source);
    const std::size_t taken = std::min(bytes.rest.size(), static_cast<std::size_t>(count));
    bytes.is_cut_off = taken == 0 ? 1 : 0;
    std::memset(to, UINT8_MAX, static_cast<std::size_t>(count));
    std::copy_n(bytes.rest.begin(), taken, to);
    bytes.rest = bytes.rest.subspan(taken);
    return count;
}

/// Reads a Radiance picture (G. Ward, Real Pixels, in Graphics Gems II, 1991), flat or in runs by channel.
HdrImage decodeRadiance(std::span<const std::uint8_t> encoded, const std::string& where)
{
    const auto fault = [&](const std::string& what)
    { return imageError(where, "the Radiance picture does not decode (" + what + ")"); };
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(encoded.data(), static_cast<int>(std::min<std::size_t>(encoded.size(), INT_MAX)), &width,
                              &height, &channels) == 0)
    {
        throw fault("its head has no format 32-bit_rle_rgbe and no size -Y HEIGHT +X WIDTH");
    }
    checkTexels(width, height, where);
    constexpr std::uint64_t kTexelsPerByteMax = 16; // runs of 127 texels take 8 bytes
    if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) > kTexelsPerByteMax * encoded.size())
    {
        throw fault("it announces more texels than its bytes can hold");
    }
    RadianceBytes bytes = {encoded};
    constexpr stbi_io_callbacks kCallbacks = {
        readRadiance, [](void*, int) {}, [](void* source) { return static_cast<RadianceBytes*>(source)->is_cut_off; }};
    const std::unique_ptr<float, decltype(&std::free)> texels(
        stbi_loadf_from_callbacks(&kCallbacks, &bytes, &width, &height, &channels, kHdrChannels), std::free);
    if (!texels || bytes.is_cut_off != 0)
    {
        throw fault("a row of it is damaged, or it is cut off");
    }
    HdrImage image = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    image.texels.resize(std::size_t{image.width} * image.height);
    std::memcpy(image.texels.data(), texels.get(), image.texels.size() * sizeof(glm::vec3));
    return image;
}

// Names of the channels that become red, green and blue.
std::array<const char*, kHdrChannels> channelsOf(const Imf::Header& header, const std::string& where)
{
    const Imf::ChannelList& channels = header.channels();
    if (channels.findChannel("R") != nullptr && channels.findChannel("G") != nullptr &&
        channels.findChannel("B") != nullptr)
    {
        return {"R", "G", "B"};
    }
    if (channels.findChannel("Y") != nullptr)
    {
        return {"Y", "Y", "Y"};
    }
    throw imageError(where, "the OpenEXR picture has neither the channels R, G and B nor Y");
}

HdrImage readExr(Imf::InputFile& file, const std::string& where)
{
    const Imath::Box2i& window = file.header().dataWindow();
    checkTexels(std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1, where);
    HdrImage image = {static_cast<std::uint32_t>(window.max.x - window.min.x + 1),
                      static_cast<std::uint32_t>(window.max.y - window.min.y + 1),
                      {}};
    const std::array names = channelsOf(file.header(), where);
    image.texels.resize(std::size_t{image.width} * image.height);
    const bool grey = std::string_view(names[0]) == names[1];
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < (grey ? 1 : names.size()); ++i)
    {
        const std::ptrdiff_t texel = sizeof(glm::vec3);
        const std::ptrdiff_t row = texel * static_cast<std::ptrdiff_t>(image.width);
        char* const origin = reinterpret_cast<char*>(image.texels.data()) + i * sizeof(float) - window.min.x * texel -
                             window.min.y * row;
        buffer.insert(names.at(i),
                      Imf::Slice(Imf::FLOAT, origin, static_cast<std::size_t>(texel), static_cast<std::size_t>(row)));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    std::ranges::for_each(image.texels, [&](glm::vec3& texel) { texel = grey ? glm::vec3(texel.x) : texel; });
    return image;
}

HdrImage decodeExr(std::span<const std::uint8_t> encoded, const std::string& where)
{
    try
    {
        Imf::StdISStream stream;
        stream.str(std::string(asText(encoded)));
        Imf::InputFile file(stream, 0);
        return readExr(file, where);
    }
    catch (const Error&)
    {
        throw;
    }
    catch (const std::exception&)
    {
        throw imageError(where, "the OpenEXR picture does not decode; save it again");
    }
}

// Replaces what no light can be.
void repair(HdrImage& image, const std::string& where, std::vector<std::string>& warnings)
{
    std::uint64_t dark = 0; // texels with values that are less than any light, or no number
    std::uint64_t bright = 0;
    for (glm::vec3& texel : image.texels)
    {
        const bool is_light = texel.x >= 0.0F && texel.y >= 0.0F && texel.z >= 0.0F; // false for NaN
        const bool is_bright = texel.x > kRadianceMax || texel.y > kRadianceMax || texel.z > kRadianceMax;
        for (int i = 0; i < kHdrChannels; ++i)
        {
            texel[i] = texel[i] > 0.0F ? std::min(texel[i], kRadianceMax) : 0.0F; // not -0, either
        }
        dark += is_light ? 0 : 1;
        bright += is_bright ? 1 : 0;
    }
    const auto warn = [&](std::uint64_t count, std::string_view what)
    {
        if (count != 0)
        {
            warnings.push_back(
                fmt::format("{}: {} {} {}", where, count, count == 1 ? "texel has" : "texels have", what));
        }
    };
    warn(dark, "values that are negative or no number; they are taken as 0");
    warn(bright, fmt::format("values above {:g}; they are taken as that", kRadianceMax));
}

} // namespace

HdrImage decodeHdrImage(std::span<const std::uint8_t> encoded, const std::string& where,
                        std::vector<std::string>& warnings)
{
    const std::string_view head = asText(encoded);
    const bool is_exr = head.starts_with("\x76\x2F\x31\x01");
    if (!is_exr && !head.starts_with("#?RADIANCE") && !head.starts_with("#?RGBE"))
    {
        throw imageError(where, "neither a Radiance (.hdr) nor an OpenEXR (.exr) picture");
    }
    HdrImage image = is_exr ? decodeExr(encoded, where) : decodeRadiance(encoded, where);
    repair(image, where, warnings);
    return image;
}

std::vector<std::uint8_t> encodeExr(const HdrImage& image, std::span<const ExrChannel> others)
{
    try
    {
        Imf::StdOSStream sink;
        {
            Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
            Imf::FrameBuffer buffer;
            const auto add = [&](const ExrChannel& channel)
            {
                header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
                auto* const first = const_cast<char*>(reinterpret_cast<const char*>(channel.values));
                const std::size_t bytes = channel.stride * sizeof(float);
                buffer.insert(channel.name, Imf::Slice(Imf::FLOAT, first, bytes, image.width * bytes));
            };
            const float* const red = &image.texels.front().x;
            add({"R", red, kHdrChannels});
            add({"G", red + 1, kHdrChannels});
            add({"B", red + 2, kHdrChannels});
            std::ranges::for_each(others, add);
            Imf::OutputFile file(sink, header, 0);
            file.setFrameBuffer(buffer);
            file.writePixels(static_cast<int>(image.height));
        }
        const std::string bytes = sink.str();
        return {bytes.begin(), bytes.end()};
    }
    catch (const std::exception& error)
    {
        throw Error(ErrorCode::Memory, fmt::format("cannot encode an OpenEXR picture: {}", error.what()));
    }
}

} // namespace zvo
