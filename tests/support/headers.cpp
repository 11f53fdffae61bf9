// SPDX-License-Identifier: MIT
// Nothing: the headers of all tests are precompiled with it.
