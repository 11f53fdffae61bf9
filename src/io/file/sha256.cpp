// SPDX-License-Identifier: MIT
#include "io/file/sha256.h"

#include "zvo/error.h"

#include <array>
#include <fmt/format.h>
#include <openssl/evp.h>

namespace zvo
{

namespace
{

void check(int result)
{
    if (result != 1)
    {
        throw Error(ErrorCode::Other, "libcrypto cannot compute SHA-256: check the installation of OpenSSL");
    }
}

} // namespace

Sha256::Sha256() : m_context(EVP_MD_CTX_new(), EVP_MD_CTX_free)
{
    check(m_context ? 1 : 0);
    check(EVP_DigestInit_ex(m_context.get(), EVP_sha256(), nullptr));
}

void Sha256::update(std::span<const std::byte> bytes)
{
    check(EVP_DigestUpdate(m_context.get(), bytes.data(), bytes.size()));
}

std::string Sha256::hexDigest() const
{
    const decltype(m_context) copy(EVP_MD_CTX_new(), EVP_MD_CTX_free); // finishing a context ends it
    check(copy ? 1 : 0);
    check(EVP_MD_CTX_copy_ex(copy.get(), m_context.get()));
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int digest_bytes = 0;
    check(EVP_DigestFinal_ex(copy.get(), digest.data(), &digest_bytes));
    std::string hex;
    for (const unsigned char byte : std::span(digest).first(digest_bytes))
    {
        hex += fmt::format("{:02x}", byte);
    }
    return hex;
}

std::string sha256Hex(std::span<const std::byte> bytes)
{
    Sha256 hash;
    hash.update(bytes);
    return hash.hexDigest();
}

} // namespace zvo
