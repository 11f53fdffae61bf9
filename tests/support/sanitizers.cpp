// SPDX-License-Identifier: MIT
// Compiled into every test binary of a sanitizer build.

// What a driver's globals still hold would count as leaked once the Vulkan loader has unloaded the driver: nothing is
// unloaded here.
extern "C" int dlclose(void*) noexcept
{
    return 0;
}

// Freed memory that is kept back slows the software device down 20 times and more.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options()
{
    return "quarantine_size_mb=1";
}

// The validation layer loses some memory of its own.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libVkLayer_khronos_validation\n";
}
