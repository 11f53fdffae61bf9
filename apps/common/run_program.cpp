// SPDX-License-Identifier: MIT
#include "common/run_program.h"

#include "common/progress.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string_view>

namespace zvo::cli
{

namespace
{

int fail(ErrorCode code, std::string_view what)
{
    talk(fmt::format("error: {}", what));
    return static_cast<int>(code);
}

} // namespace

int runProgram(const std::function<void()>& program)
{
    try
    {
        program();
        return 0;
    }
    catch (const Error& error)
    {
        return fail(error.code(), error.what());
    }
    catch (const std::bad_alloc&)
    {
        return fail(ErrorCode::Memory, "the host's memory does not suffice; lower the resolution");
    }
    catch (const std::exception& error)
    {
        return fail(ErrorCode::Other, error.what());
    }
}

} // namespace zvo::cli
