#version 460
// SPDX-License-Identifier: MIT
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(push_constant) uniform Push
{
    mat4 to_clip;
    vec3 place; // of the mesh
};
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 world_normal;
layout(location = 2) out vec3 code; // sRGB

void main()
{
    world = position + place;
    world_normal = normal;
    code = color.rgb;
    gl_Position = to_clip * vec4(world, 1.0);
}
