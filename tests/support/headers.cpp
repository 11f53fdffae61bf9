// SPDX-License-Identifier: MIT
// Empty: CMake precompiles the headers of all tests with it.
