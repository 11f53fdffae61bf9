// SPDX-License-Identifier: MIT
// Keeps exceptions from leaving functions of the C interface.
#pragma once

#include "zvo/error.h"
#include "zvo/zvo.h"

#include <new>
#include <string>
#include <utility>

namespace zvo
{

/// Stores why a function of the C interface failed, for zvoLastError(). Returns code.
ZvoResult failed(const char* function, ErrorCode code, const char* message) noexcept;

/// Calls what does the work of a function of the C interface. What it throws becomes a result.
template <typename Work> ZvoResult guarded(const char* function, Work&& work) noexcept
{
    try
    {
        std::forward<Work>(work)();
        return ZVO_OK;
    }
    catch (const Error& error)
    {
        return failed(function, error.code(), error.what());
    }
    catch (const std::bad_alloc&)
    {
        return failed(function, ErrorCode::Memory, "the host has no memory left");
    }
    catch (const std::exception& error)
    {
        return failed(function, ErrorCode::Other, error.what());
    }
    catch (...)
    {
        return failed(function, ErrorCode::Other, "an exception of an unknown type");
    }
}

/// The object that a pointer refers to. Throws Error{Usage} for null.
template <typename Object> Object& at(Object* object, const char* name)
{
    if (object == nullptr)
    {
        throw Error(ErrorCode::Usage, std::string(name) + " is null");
    }
    return *object;
}

/// Stores a new handle of the object that make() returns. Throws Error{Usage} for null, and throws when memory is
/// short, before make() is called, so that nothing which make() takes over is lost.
template <typename Handle, typename Make> void give(Handle** out, const char* name, const Make& make)
{
    Handle*& handle = at(out, name);
    handle = new Handle{make()};
}

/// Stores what work() answers, as guarded(). Null is Error{Usage} before work() is called.
template <typename Work>
ZvoResult answered(const char* function, VkBool32* out, const char* name, const Work& work) noexcept
{
    return guarded(function,
                   [&]
                   {
                       VkBool32& answer = at(out, name);
                       answer = work() ? VK_TRUE : VK_FALSE;
                   });
}

} // namespace zvo
