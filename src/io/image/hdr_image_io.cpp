// SPDX-License-Identifier: MIT
#include "io/image/hdr_image_io.h"

#include "io/image/image_io.h"
#include "zvo/error.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace zvo
{

namespace
{

constexpr std::array<std::uint8_t, 4> kExrMagic = {0x76, 0x2F, 0x31, 0x01};
constexpr int kHdrChannels = 3;

bool startsWith(std::span<const std::uint8_t> bytes, std::string_view text)
{
    return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

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

// Reads a Radiance picture (G. Ward, Real Pixels, in Graphics Gems II, 1991, and the format's description in Radiance).
// stb's decoder does not end for some files that are cut off.
class RadianceReader
{
public:
    RadianceReader(std::span<const std::uint8_t> bytes, const std::string& where) : m_bytes(bytes), m_where(where) {}

    HdrImage read()
    {
        readHeader();
        HdrImage image = readSize();
        image.texels.reserve(std::size_t{image.width} * image.height);
        std::vector<Texel> row(image.width);
        for (std::uint32_t y = 0; y < image.height; ++y)
        {
            readRow(row);
            for (const Texel& texel : row)
            {
                const float step = texel[3] == 0 ? 0.0F : std::ldexp(1.0F, int{texel[3]} - kExponentBias);
                image.texels.push_back(step * glm::vec3(texel[0], texel[1], texel[2]));
            }
        }
        return image;
    }

private:
    using Texel = std::array<std::uint8_t, 4>; // three mantissas and an exponent

    static constexpr int kExponentBias = 128 + 8;
    static constexpr std::uint8_t kRowMark = 2;      // twice, before a row of runs
    static constexpr std::uint8_t kRunMark = 128;    // lengths above it are those of runs
    static constexpr std::uint32_t kRowMin = 8;      // texels of a row of runs
    static constexpr std::uint32_t kRowMax = 0x7FFF; // likewise

    [[nodiscard]] Error fault(const std::string& what) const
    {
        return imageError(m_where, "the Radiance picture does not decode (" + what + ")");
    }

    std::uint8_t next()
    {
        if (m_at == m_bytes.size())
        {
            throw fault("unexpected end of file");
        }
        return m_bytes[m_at++];
    }

    std::string readLine()
    {
        constexpr std::size_t kLineMax = 4096;
        std::string line;
        for (char letter = static_cast<char>(next()); letter != '\n'; letter = static_cast<char>(next()))
        {
            line += letter;
            if (line.size() > kLineMax)
            {
                throw fault("a line of its header has no end");
            }
        }
        return line;
    }

    void readHeader()
    {
        bool has_format = false;
        for (std::string line = readLine(); !line.empty(); line = readLine())
        {
            has_format = has_format || line == "FORMAT=32-bit_rle_rgbe";
        }
        if (!has_format)
        {
            throw fault("its format is not 32-bit_rle_rgbe");
        }
    }

    HdrImage readSize()
    {
        const std::string line = readLine();
        std::int64_t width = 0;
        std::int64_t height = 0;
        int end = 0;
        if (std::sscanf(line.c_str(), "-Y %9" SCNd64 " +X %9" SCNd64 "%n", &height, &width, &end) != 2 ||
            static_cast<std::size_t>(end) != line.size())
        {
            throw fault("its size is not given as -Y HEIGHT +X WIDTH");
        }
        checkTexels(width, height, m_where);
        constexpr std::uint64_t kTexelsPerByteMax = kImageEdgeMax; // of the oldest runs
        if (static_cast<std::uint64_t>(width * height) > kTexelsPerByteMax * m_bytes.size())
        {
            throw fault("it announces more texels than its bytes can hold");
        }
        return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    }

    void readRow(std::vector<Texel>& row)
    {
        const std::span<const std::uint8_t> rest = m_bytes.subspan(m_at);
        if (row.size() >= kRowMin && row.size() <= kRowMax && rest.size() >= 4 && rest[0] == kRowMark &&
            rest[1] == kRowMark && (std::size_t{rest[2]} << 8 | rest[3]) == row.size())
        {
            m_at += 4;
            for (std::size_t channel = 0; channel < Texel().size(); ++channel)
            {
                readRuns(row, channel);
            }
            return;
        }
        readOldRow(row);
    }

    // The values of a channel: runs of one value, and stretches of several.
    void readRuns(std::vector<Texel>& row, std::size_t channel)
    {
        for (std::size_t x = 0; x < row.size();)
        {
            const std::uint8_t code = next();
            const std::size_t length = code > kRunMark ? code - kRunMark : code;
            if (length == 0 || length > row.size() - x)
            {
                throw fault("a run is longer than its row");
            }
            std::uint8_t value = 0;
            for (std::size_t i = 0; i < length; ++i)
            {
                value = i == 0 || code <= kRunMark ? next() : value;
                row[x++][channel] = value;
            }
        }
    }

    // Texels one by one. One of (1, 1, 1, n) repeats the texel before it n times; several of them in a row give the
    // digits of n.
    void readOldRow(std::vector<Texel>& row)
    {
        int shift = 0;
        for (std::size_t x = 0; x < row.size();)
        {
            const Texel texel = {next(), next(), next(), next()};
            if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1)
            {
                row[x++] = texel;
                shift = 0;
                continue;
            }
            const std::size_t count = shift < 32 ? std::size_t{texel[3]} << shift : row.size() + 1;
            if (x == 0 || count > row.size() - x)
            {
                throw fault("a run is longer than its row");
            }
            std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
            x += count;
            shift += 8;
        }
    }

    std::span<const std::uint8_t> m_bytes;
    const std::string& m_where;
    std::size_t m_at = 0;
};

// The bytes of a picture as OpenEXR reads them.
class ByteStream : public Imf::IStream
{
public:
    ByteStream(std::span<const std::uint8_t> bytes, const std::string& name) : IStream(name.c_str()), m_bytes(bytes) {}

    bool read(char to[], int count) override
    {
        if (count < 0 || static_cast<std::uint64_t>(count) > m_bytes.size() - m_at)
        {
            throw std::runtime_error("unexpected end of file");
        }
        std::memcpy(to, m_bytes.data() + m_at, static_cast<std::size_t>(count));
        m_at += static_cast<std::uint64_t>(count);
        return m_at < m_bytes.size();
    }

    std::uint64_t tellg() override { return m_at; }
    void seekg(std::uint64_t at) override { m_at = std::min<std::uint64_t>(at, m_bytes.size()); }
    void clear() override {}

private:
    std::span<const std::uint8_t> m_bytes;
    std::uint64_t m_at = 0;
};

class ByteSink : public Imf::OStream
{
public:
    ByteSink() : OStream("picture") {}

    void write(const char from[], int count) override
    {
        const auto end = m_at + static_cast<std::uint64_t>(count);
        bytes.resize(std::max<std::size_t>(bytes.size(), end));
        std::memcpy(bytes.data() + m_at, from, static_cast<std::size_t>(count));
        m_at = end;
    }

    std::uint64_t tellp() override { return m_at; }
    void seekp(std::uint64_t at) override { m_at = at; }

    std::vector<std::uint8_t> bytes;

private:
    std::uint64_t m_at = 0;
};

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
    std::vector<std::array<float, kHdrChannels>> texels(std::size_t{image.width} * image.height);
    const bool grey = std::string_view(names[0]) == names[1];
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < (grey ? 1 : names.size()); ++i)
    {
        const std::ptrdiff_t texel = sizeof(texels.front());
        const std::ptrdiff_t row = texel * static_cast<std::ptrdiff_t>(image.width);
        char* const origin =
            reinterpret_cast<char*>(texels.data()) + i * sizeof(float) - window.min.x * texel - window.min.y * row;
        buffer.insert(names.at(i),
                      Imf::Slice(Imf::FLOAT, origin, static_cast<std::size_t>(texel), static_cast<std::size_t>(row)));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    image.texels.reserve(texels.size());
    for (const std::array<float, kHdrChannels>& texel : texels)
    {
        image.texels.emplace_back(texel[0], texel[grey ? 0 : 1], texel[grey ? 0 : 2]);
    }
    return image;
}

HdrImage decodeExr(std::span<const std::uint8_t> encoded, const std::string& where)
{
    try
    {
        ByteStream stream(encoded, where);
        Imf::InputFile file(stream, 0);
        return readExr(file, where);
    }
    catch (const Error&)
    {
        throw;
    }
    catch (const std::exception& error)
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
    const bool is_exr =
        encoded.size() >= kExrMagic.size() && std::equal(kExrMagic.begin(), kExrMagic.end(), encoded.begin());
    if (!is_exr && !startsWith(encoded, "#?RADIANCE") && !startsWith(encoded, "#?RGBE"))
    {
        throw imageError(where, "neither a Radiance (.hdr) nor an OpenEXR (.exr) picture");
    }
    HdrImage image = is_exr ? decodeExr(encoded, where) : RadianceReader(encoded, where).read();
    repair(image, where, warnings);
    return image;
}

std::vector<std::uint8_t> encodeExr(const HdrImage& image, std::span<const ExrChannel> others)
{
    try
    {
        ByteSink sink;
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
        return std::move(sink.bytes);
    }
    catch (const std::exception& error)
    {
        throw Error(ErrorCode::Memory, fmt::format("cannot encode an OpenEXR picture: {}", error.what()));
    }
}

} // namespace zvo
