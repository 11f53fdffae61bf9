// SPDX-License-Identifier: MIT
#pragma once

#include "vk/headless.h"

#include <cstdint>
#include <span>

namespace zvo::test
{

/// Options of the tests' devices: the software device, or the one that ZVO_TEST_DEVICE names. With
/// ZVO_TEST_VALIDATION=1 they ask for validation, with 2 for instrumented kernels, too. With ZVO_TEST_TYPE=discrete
/// kernels have the forms that GPUs get. Messages go to the file that ZVO_LOG names, if any.
vk::HeadlessOptions deviceOptions();

/// The device that the tests of a binary share, made on first use with kernels; later calls must name the same ones.
vk::HeadlessDevice& sharedDevice(std::span<const vk::EmbeddedKernel> kernels);

/// Validation messages so far, of all devices made with deviceOptions().
std::uint32_t validationMessageCount();

/// Destroys the shared device.
void destroySharedDevice();

} // namespace zvo::test
