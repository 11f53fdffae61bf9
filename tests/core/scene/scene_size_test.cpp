// SPDX-License-Identifier: MIT
#include "core/scene/scene_size.h"

#include "io/gltf/gltf_builder.h"

#include <cmath>
#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

TEST(SceneSize, EveryLimitStands)
{
    const std::filesystem::path path = "a.ply";
    const SceneSize largest = {.instance_count = 16777216.0,
                               .triangle_count = 4294967295.0,
                               .vertex_count = 4294967295.0,
                               .bytes = static_cast<double>(sceneBytesMax())};
    EXPECT_NO_THROW(checkSceneSize(path, largest));
    const auto expectRefused = [&](double SceneSize::*count, const char* what)
    {
        SceneSize size = largest;
        size.*count = std::nextafter(size.*count, INFINITY);
        expectInputError([&] { checkSceneSize(path, size); }, {"a.ply", what});
    };
    expectRefused(&SceneSize::instance_count, "16777216 primitives");
    expectRefused(&SceneSize::triangle_count, "triangles");
    expectRefused(&SceneSize::vertex_count, "vertices");
    expectRefused(&SceneSize::bytes, "half of this machine's memory");
}

TEST(SceneSize, BytesAreLeftUntilTheLast)
{
    const std::filesystem::path path = "a.stl";
    SceneBytesLeft left(path);
    left.take(sceneBytesMax() - 48);
    EXPECT_NO_THROW(left.take(48));
    EXPECT_NO_THROW(left.take(0));
    expectInputError([&] { left.take(1); }, {"a.stl", "half of this machine's memory"});
    expectInputError([&] { left.take(~std::uint64_t{0}); }, {"a.stl"});
}

} // namespace

} // namespace zvo::test
