// SPDX-License-Identifier: MIT
#include "lanes/kernel_names.h"

#include "core/base/kernels.h"
#include "core/voxelize/voxelize.h"
#include "support/engine_device.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <set>

namespace zvo::test
{

namespace
{

std::set<std::string> g_names;

} // namespace

void run(const std::function<void(vk::FrameGraph&)>& record)
{
    noteKernels(device().run(record));
}

void noteKernels(const std::vector<vk::PassTime>& passes)
{
    for (const vk::PassTime& pass : passes)
    {
        g_names.insert(pass.name);
    }
}

bool hasRun(const std::string& name)
{
    return g_names.contains(name);
}

void forgetKernels()
{
    g_names.clear();
}

void expectAllRan(bool of_brushes)
{
    for (const vk::EmbeddedKernel& kernel : zvoKernels())
    {
        const std::string name(kernel.name);
        const bool can_run = SumForm::on(device().device()).int64 || !name.ends_with("_int64");
        if (can_run && name.starts_with("edit/") == of_brushes)
        {
            EXPECT_TRUE(hasRun(name)) << name << " did not run";
        }
    }
}

Scene smallScene()
{
    Scene scene = randomTriangles(3, 12, 16.0F);
    Primitive& plain = scene.primitives[0];
    Primitive textured = plain;
    for (const glm::vec3& position : plain.positions)
    {
        textured.uvs.emplace_back(position.x * 0.1F, position.y * 0.1F);
        textured.normals.emplace_back(0.0F, 1.0F, 0.0F);
        textured.colors.emplace_back(0.5F, 1.0F, 0.25F, 0.75F);
    }
    scene.images.push_back({"checker", 2, 2, {255, 0, 0, 255, 0, 255, 0, 90, 0, 0, 255, 255, 255, 255, 255, 160}});
    scene.textures.push_back({0, WrapMode::Repeat, WrapMode::MirroredRepeat});
    Material emissive;
    emissive.base_color_texture = 0;
    emissive.emission = glm::vec3(2.0F, 1.0F, 0.5F);
    emissive.emission_texture = 0;
    Material blended;
    blended.base_color_texture = 0;
    blended.alpha_mode = AlphaMode::Blend;
    Material cut_out = emissive; // whole: its fragments have neither voxels nor leaves
    cut_out.alpha_mode = AlphaMode::Mask;
    cut_out.base_color.a = 0.1F;
    scene.materials.push_back(emissive);
    scene.materials.push_back(blended);
    scene.materials.push_back(cut_out);
    textured.material = 1;
    scene.primitives.push_back(textured);
    textured.material = 2;
    scene.primitives.push_back(textured);
    textured.material = 3;
    textured.positions = {{9.0F, 10.0F, 15.5F}, {15.5F, 10.0F, 15.5F}, {15.5F, 15.5F, 15.5F}};
    textured.triangles = {{0, 1, 2}};
    textured.normals.resize(3);
    textured.uvs.resize(3);
    textured.colors.resize(3);
    scene.primitives.push_back(textured);
    scene.instances.push_back({1, glm::mat4(0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1)});
    scene.instances.push_back({3, glm::mat4(1.0F)});
    scene.instances.push_back({2, glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 16, 0, 0, 1)});
    return scene;
}

} // namespace zvo::test
