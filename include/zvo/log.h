// SPDX-License-Identifier: MIT
#pragma once

namespace zvo
{

/// What a message is about. Failures are no messages: they are thrown.
enum class LogSeverity : int
{
    Debug,   ///< what zvo does: kernels compiled, memory taken and returned
    Info,    ///< what it does without, as the device has it not
    Warning, ///< what is refused, and what may be wrong
};

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
