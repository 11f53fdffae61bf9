// SPDX-License-Identifier: MIT
// Choosing light of voxels. The includer includes path/path.h, lib/hit.glsl, lib/sobol.glsl, light/choose.glsl,
// path/emission.glsl, path/face.glsl, path/numbers.glsl, path/point_of_face.glsl and path/chosen.glsl before and declares
// params.
#ifndef ZVO_SHADERS_PATH_VOXEL_LIGHT_GLSL
#define ZVO_SHADERS_PATH_VOXEL_LIGHT_GLSL

#include "lib/emission.glsl"
#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "lib/sampling.glsl"
#include "light/choose.glsl"
#include "light/importance.glsl"
#include "path/chosen.glsl"
#include "path/numbers.glsl"
#include "path/path.h"

// A point of a face of an emissive voxel, for a path that leaves a face at origin.
ChosenDirection chooseVoxelLight(PathState state, vec3 origin, uint bounce)
{
    uint pair = bounce * kPathPairs;
    vec2 point = samplePair(params.sample_index, state.seed, pair + kPairPoint);
    ChosenLight light = chooseLight(LitPlace(origin, normalAxis(state.normal)),
                                    samplePair(params.sample_index, state.seed, pair + kPairChoice));
    float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 way = pointOfFace(light.cell, light.face, edge, point) - origin;
    float square = max(dot(way, way), 1e-30);
    ChosenDirection chosen;
    chosen.direction = way / sqrt(square);
    chosen.target = unpackUint2x32(packHitCell(light.cell, kNodeLevels, light.face % 3u));
    float cosine = -dot(normalAxis(light.face), chosen.direction);
    chosen.density = 0.0;
    chosen.light = vec3(0.0);
    if (cosine > 0.0 && light.probability > 0.0)
    {
        chosen.density = state.kinds.z * light.probability / (edge * edge) * square / cosine;
        chosen.light = emissionOf(params.tree, light.voxel);
    }
    return chosen;
}

#endif
