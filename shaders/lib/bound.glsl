// SPDX-License-Identifier: MIT
// Descriptors in place of addresses. A kernel that includes this file is compiled a second time, with BOUND: its bound
// form, which reaches some buffers through descriptors of set 0. The frame graph runs that form where the device's owner
// chooses it (vk::LoadForm), if the buffers are not too large for descriptors, and finds them by their addresses, which
// both forms have in their parameters.
//
//   TEXELS_2(0, nodes);   binding 0, texels2_nodes: the bytes of params.nodes in texels of 2 words of 32 bits
#ifdef BOUND
#define TEXELS_1(BINDING, MEMBER) layout(set = 0, binding = BINDING) uniform usamplerBuffer texels1_##MEMBER
#define TEXELS_2(BINDING, MEMBER) layout(set = 0, binding = BINDING) uniform usamplerBuffer texels2_##MEMBER
#define TEXELS_4(BINDING, MEMBER) layout(set = 0, binding = BINDING) uniform usamplerBuffer texels4_##MEMBER
#endif
