// SPDX-License-Identifier: MIT
// How a path leaves what the camera sees where that is shaded by the normals of voxels.
// Needs the constants kNodeLevels and kSmooth.
#ifndef ZVO_SHADERS_PATH_LEAVE_BY_NORMAL_GLSL
#define ZVO_SHADERS_PATH_LEAVE_BY_NORMAL_GLSL

#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "path/normal.glsl"

// From this cosine with the normal on, a face lies in the surface.
const float kInSurface = 0.9999;
// Paths begin above the steps of a slope from this sine on, and lower where the surface is more even: to the steps of a
// surface that hardly leans, its own shadows belong.
const float kSlopeSine = 0.125;
const float kLeastRise = 0.4; // cosine of the normal and the way back, at which that way gets longest

// Makes a path leave what the camera sees by the normal of its voxel; code: of that. state.normal: of the face.
//
// A slope of voxels is made of steps, which rise over its plane by the sum of the normal's components, in voxels. Paths
// begin above them, or the steps would throw shadows on each other. They go there the way that the camera's ray has
// come: nothing is in that, so no path begins in a voxel, and none behind a wall. Whatever lies below the horizon of a
// step but above the plane is seen from there, and what is below the plane is not looked for: the directions are those
// of the hemisphere about the normal, by their cosine. So a white body in an even sky still looks like the sky.
void leaveByNormal(uint code, Ray ray, Hit hit, inout PathState state, inout vec3 position)
{
    vec3 direction = normalize(1.0 / ray.inverse_direction);
    vec3 face_normal = normalAxis(state.normal);
    vec3 normal = shadingNormal(code, face_normal, direction);
    float along_face = dot(normal, face_normal);
    if (code == kNoNormal || along_face > kInSurface)
        return;
    float sine = sqrt(max(1.0 - along_face * along_face, 0.0));
    float steps = dot(abs(normal), vec3(1.0)) * exp2(-2.0 * float(kNodeLevels)) *
                  (along_face > 0.0 ? min(sine / kSlopeSine, 1.0) : 1.0);
    float back =
        min(steps / max(-dot(normal, direction), kLeastRise), 0.5 * hit.t * length(1.0 / ray.inverse_direction));
    state.normal = codeOf(normal);
    position -= back * direction;
}

#endif
