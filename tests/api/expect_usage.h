// SPDX-License-Identifier: MIT
#pragma once

#include "support/errors.h"

#include <functional>
#include <string>

namespace zvo::test
{

/// action throws Error{Usage}, and word is in its message.
inline void expectUsage(const std::function<void()>& action, const std::string& word)
{
    expectParts(messageOf(action, ErrorCode::Usage), {word.c_str()});
}

} // namespace zvo::test
