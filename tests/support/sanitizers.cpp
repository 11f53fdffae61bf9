// SPDX-License-Identifier: MIT
// This file is compiled into every test binary of a sanitizer build.

// Keeps libraries loaded. If the Vulkan loader unloaded a driver, the memory that its globals hold would count as
// leaked.
extern "C" int dlclose(void*) noexcept
{
    return 0;
}

// Does not quarantine freed memory, which would slow the software device down at least 20 times.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options()
{
    return "quarantine_size_mb=1";
}

// The validation layer leaks some memory.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libVkLayer_khronos_validation\n";
}
