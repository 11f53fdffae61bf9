// SPDX-License-Identifier: MIT
// Does nothing, in workgroups of two dimensions.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
}
