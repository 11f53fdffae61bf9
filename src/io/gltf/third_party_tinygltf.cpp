// SPDX-License-Identifier: MIT
#include <fstream> // tinygltf's writers use it even without a file system

#define TINYGLTF_IMPLEMENTATION
#include "io/gltf/third_party_tinygltf.h"
