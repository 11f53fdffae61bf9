// SPDX-License-Identifier: MIT
#include "common/picture_file.h"

#include "common/output.h"
#include "io/image/hdr_image_io.h"
#include "io/image/image_io.h"
#include "io/image/webp_write.h"

#include <bit>

namespace zvo::cli
{

std::vector<std::uint8_t> encodePicture(const std::string& path, std::uint32_t width, std::uint32_t height,
                                        std::span<const std::uint32_t> texels, std::uint32_t quality)
{
    static_assert(std::endian::native == std::endian::little); // red is the lowest byte of a texel
    const std::span rgba(reinterpret_cast<const std::uint8_t*>(texels.data()), texels.size_bytes());
    const std::string extension = extensionOf(path);
    return extension == ".webp"                          ? encodeWebp(width, height, rgba, quality)
           : extension == ".jpg" || extension == ".jpeg" ? encodeJpeg(width, height, rgba, quality)
                                                         : encodePng(width, height, rgba);
}

std::vector<std::uint8_t> encodeRadiance(const std::string& path, const HdrImage& image)
{
    return extensionOf(path) == ".hdr" ? encodeHdr(image) : encodeExr(image);
}

} // namespace zvo::cli
