// SPDX-License-Identifier: MIT
// Guides of the filter (denoise.h), packed and compared. The includer includes denoise/denoise.h and lib/camera.glsl
// before.

/// What a pixel shows.
struct Guide
{
    float depth;
    vec3 normal;    // mean over the samples: shorter than 1 where they show several faces
    float coverage; // part of the samples that hit a surface
};

const float kNormalSteps = 255.0;
const float kCoverageSteps = 31.0;

uint packSurface(vec3 normal, float coverage)
{
    uvec3 code = uvec3(ivec3(round(clamp(normal, -1.0, 1.0) * kNormalSteps)) & 511);
    uint cover = coverage > 0.0 ? max(uint(coverage * kCoverageSteps + 0.5), 1u) : 0u;
    return code.x | (code.y << 9) | (code.z << 18) | (cover << 27);
}

Guide loadGuide(DenoiseGuide_ConstPtr guides, uint pixel)
{
    uvec2 word = unpackUint2x32(uint64_t_ConstPtr(uint64_t(guides)).data[pixel]);
    ivec3 code = ivec3(bitfieldExtract(int(word.y), 0, 9), bitfieldExtract(int(word.y), 9, 9),
                       bitfieldExtract(int(word.y), 18, 9));
    return Guide(uintBitsToFloat(word.x), vec3(code) / kNormalSteps, float(word.y >> 27) / kCoverageSteps);
}

vec4 loadLight(vec4_ConstPtr light, uint pixel)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(light));
    return uintBitsToFloat(uvec4(unpackUint2x32(words.data[2u * pixel]), unpackUint2x32(words.data[2u * pixel + 1u])));
}

void storeLight(vec4_Ptr light, uint pixel, vec4 value)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(light));
    words.data[2u * pixel] = packUint2x32(floatBitsToUint(value.rg));
    words.data[2u * pixel + 1u] = packUint2x32(floatBitsToUint(value.ba));
}

// Workgroups take tiles of kDenoiseTile x kDenoiseTile pixels, row by row.
ivec2 pixelOfThread(uint workgroup, uint thread, uint width)
{
    uint columns = (width + kDenoiseTile - 1u) / kDenoiseTile;
    return ivec2(kDenoiseTile * uvec2(workgroup % columns, workgroup / columns) + pixelInTile(thread));
}

// A place at a pixel, from the camera's origin.
vec3 placeAt(ivec2 pixel, float depth, uvec2 size, bool orthographic, vec3 forward, vec3 half_pixel_x, vec3 half_pixel_y)
{
    vec3 offset = rayOffset(pixelOffset(uvec2(pixel), size), half_pixel_x, half_pixel_y);
    return depth * forward + (orthographic ? 1.0 : depth) * offset;
}

// The distance of a pixel's place from the plane of another one, in voxels; way: from that to the other place. 0 where
// faces of all directions are seen, which have no plane.
float distanceFromPlane(Guide guide, vec3 way, float edge)
{
    float normal_length = length(guide.normal);
    return normal_length > 0.1 ? abs(dot(guide.normal, way)) / (normal_length * edge) : 0.0;
}

// How different the normals of two pixels are; at 1, by as much as may be chance. Means over few samples of several
// faces are less exact the shorter they are.
float turnOf(Guide a, Guide b)
{
    vec3 turn = a.normal - b.normal;
    float mixed = max(1.0 - dot(a.normal, a.normal), 0.0) + max(1.0 - dot(b.normal, b.normal), 0.0);
    return dot(turn, turn) / (0.1 + mixed);
}

// How much the light of a pixel tells about that of another one.
float alikeness(Guide guide, Guide other, vec3 way, float edge)
{
    const float planes_apart = 8.0; // voxels
    return other.coverage * exp(-distanceFromPlane(guide, way, edge) / planes_apart - turnOf(guide, other));
}
