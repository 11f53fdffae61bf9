// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/export.h"

#include <stdexcept>
#include <string>

namespace zvo
{

/// Why an operation failed. The values are the exit codes of the command line program.
enum class ErrorCode : int
{
    Other = 1,  ///< a failure that is none of the below, such as a lost device
    Usage = 2,  ///< the caller asked for something that does not exist or contradicts itself
    Input = 3,  ///< a file that is missing, broken or not supported
    Output = 4, ///< a file that could not be written
    Device = 5, ///< no Vulkan device that will do
    Memory = 6, ///< the memory limit, or the memory of device or host, does not suffice
};

/// A failure at run time. what() is one line: what went wrong, where, and what to do about it.
class ZVO_API Error : public std::runtime_error
{
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), m_code(code) {}

    [[nodiscard]] ErrorCode code() const { return m_code; }

private:
    ErrorCode m_code;
};

} // namespace zvo
