#version 460
// SPDX-License-Identifier: MIT
layout(location = 0) in vec3 shade; // sRGB codes, as zvo's picture has them
layout(location = 0) out vec4 color;

void main()
{
    color = vec4(shade, 1.0);
}
