// SPDX-License-Identifier: MIT
// tinygltf as a JSON parser: files and images are read by gltf_document.cpp and image_io.cpp, which check what they
// read.
#pragma once

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE

// Under a name of its own: a program that links zvo may bring tinygltf with other options.
#define tinygltf zvo_tinygltf
#include <tiny_gltf.h>
#undef tinygltf

namespace tinygltf = zvo_tinygltf;
