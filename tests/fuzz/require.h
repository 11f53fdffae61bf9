// SPDX-License-Identifier: MIT
// What fuzz targets expect of any input.
#pragma once

#include "zvo/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

// libFuzzer's own mutation, for custom mutators.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t size_max);

namespace zvo::test
{

/// Ends the program, so that libFuzzer keeps the input, unless condition holds.
inline void require(bool condition, const char* what)
{
    if (!condition)
    {
        std::fprintf(stderr, "fuzz: %s\n", what);
        std::abort();
    }
}

/// Ends the program if there is a fault.
inline void requireNoFault(const std::string& fault)
{
    require(fault.empty(), fault.c_str());
}

/// The result of reading an input, or nothing if it is refused, which must be by an Error{Input} of one line.
template <typename Read> auto readOrRefused(const Read& read) -> std::optional<decltype(read())>
{
    try
    {
        return read();
    }
    catch (const Error& error)
    {
        const std::string message = error.what();
        require(error.code() == ErrorCode::Input, "an error of the reader that does not blame the input");
        require(message.find_first_of("\n\r\t") == std::string::npos, "a message of more than one line");
        return std::nullopt;
    }
}

} // namespace zvo::test
