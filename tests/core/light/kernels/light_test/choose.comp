#version 460
// SPDX-License-Identifier: MIT
// Chooses lights for places, or asks how probable each is.
#extension GL_GOOGLE_include_directive : require
#include "choose.h"

GPU_ENTRY(ChooseParams, LIGHT_TEST_CHOOSE_CONSTANTS);
layout(local_size_x = 64) in;

#include "lib/dispatch.glsl"
#include "lib/face.glsl"
#include "lib/sampling.glsl"

const bool kByPower = false;

#include "light/choose.glsl"
#include "light/importance.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.place_count * params.face_count)
        return;
    TestPlace test = params.places.data[i / params.face_count];
    LitPlace place = LitPlace(test.position, normalAxis(test.normal));
    if (kChoose)
    {
        ChosenLight chosen = chooseLight(params.nodes, params.bricks, place,
                                         samplePair(i % params.face_count, i / params.face_count, 0u));
        params.faces.data[i] = TestFace(chosen.cell, chosen.face, chosen.probability);
    }
    else
        params.faces.data[i].probability =
            lightProbability(params.nodes, params.bricks, place, params.faces.data[i].cell, params.faces.data[i].face);
}
