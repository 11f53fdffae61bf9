// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/enums.h"
#include "zvo/export.h"

#include <stdexcept>
#include <string>

namespace zvo
{

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
