// SPDX-License-Identifier: MIT

// By what light is divided before it is filtered, and multiplied afterwards: the albedo, kept away from 0.
vec3 divisorOf(vec3 albedo)
{
    return max(albedo, 0.01);
}
