#version 460
// SPDX-License-Identifier: MIT
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(push_constant) uniform Push
{
    mat4 to_clip;
};
layout(location = 0) out vec3 shade;

void main()
{
    gl_Position = to_clip * vec4(position, 1.0);
    shade = color.rgb * (0.65 + 0.35 * normal.y);
}
