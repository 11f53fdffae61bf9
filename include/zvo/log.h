// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/enums.h"

namespace zvo
{

/// Gets one message without a line's end, in UTF-8, that lives until it returns; on the thread that calls zvo, within
/// that call. It must not throw, nor call zvo. user: LogCallback::user.
using LogFunction = void (*)(void* user, LogSeverity severity, const char* message);

/// Where messages go.
struct LogCallback
{
    LogFunction function = nullptr; // null: nowhere, and no message is made
    void* user = nullptr;
};

} // namespace zvo
