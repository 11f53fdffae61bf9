// SPDX-License-Identifier: MIT
// Descriptors in place of addresses. A kernel that includes this file is compiled a second time, with BOUND: its bound
// form, which reaches some buffers through descriptors of set 0. The frame graph runs that form where it suits the
// device (vk::LoadForm), if the buffers are not too large for descriptors. It finds them by their addresses, which both
// forms have in their parameters, or by the names that the pass gives them (vk::AnyPass::reach).
//
//   TEXELS_2(0, nodes);           binding 0, texels2_nodes: the bytes of nodes in texels of 2 words of 32 bits
//   STORAGE(1, uint, bricks);     binding 1, storage_bricks.data[]: the buffer as an array of uint, for atomics
#ifndef ZVO_SHADERS_LIB_BOUND_GLSL
#define ZVO_SHADERS_LIB_BOUND_GLSL

#ifdef BOUND
#define TEXELS_1(BINDING, NAME) layout(set = 0, binding = BINDING) uniform usamplerBuffer texels1_##NAME
#define TEXELS_2(BINDING, NAME) layout(set = 0, binding = BINDING) uniform usamplerBuffer texels2_##NAME
#define TEXELS_3(BINDING, NAME) layout(set = 0, binding = BINDING) uniform usamplerBuffer texels3_##NAME
#define TEXELS_4(BINDING, NAME) layout(set = 0, binding = BINDING) uniform usamplerBuffer texels4_##NAME
#define STORAGE(BINDING, TYPE, NAME)                                                                                   \
    layout(set = 0, binding = BINDING, scalar) buffer Storage_##NAME                                                   \
    {                                                                                                                  \
        TYPE data[];                                                                                                   \
    }                                                                                                                  \
    storage_##NAME
#endif

#endif
