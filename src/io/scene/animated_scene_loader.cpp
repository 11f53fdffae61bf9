// SPDX-License-Identifier: MIT
// Loads animated scenes (io/scene/animated_scene.h): finds and loads files, and divides them into static and dynamic
// parts.
#include "core/base/finite.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/scene/animation.h"
#include "core/scene/deform.h"
#include "core/scene/scene_size.h"
#include "io/file/folder_bounds.h"
#include "io/scene/animated_scene.h"
#include "io/scene/load_scene.h"
#include "io/scene/scene_part.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <system_error>
#include <tuple>
#include <utility>

namespace zvo
{

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kShownAnimations = 8;                       // more are only counted
constexpr std::size_t kSceneFileBytesMax = std::size_t{4} << 20U; // many times the size of 4096 objects

/// The product in double precision, rounded once.
glm::mat4 placed(const glm::dmat4& to_world, const glm::mat4& transform)
{
    return glm::mat4(to_world * glm::dmat4(transform));
}

Error objectError(const fs::path& scene_file_path, const SceneFileObject& object, std::string_view text)
{
    return inputError(scene_file_path, fmt::format("{}.{}", object.where, text));
}

/// The object's file, in the first of the folders that has it. other_folder: the name of the second one in messages.
fs::path resolve(const fs::path& scene_file_path, const SceneFileObject& object, const std::vector<fs::path>& folders,
                 const std::string& other_folder)
{
    const fs::path file = object.file;
    for (const fs::path& folder : folders)
    {
        std::error_code missing;
        if (file.is_absolute() || !liesBelow(folder, folder / file))
        {
            throw objectError(scene_file_path, object,
                              fmt::format("file is \"{}\", which leaves the folder of the scene file or of {}; "
                                          "expected a file in one of them or below",
                                          object.file, other_folder));
        }
        if (fs::exists(folder / file, missing))
        {
            return folder / file;
        }
    }
    std::vector<std::string> names;
    std::transform(folders.begin(), folders.end(), std::back_inserter(names),
                   [](const fs::path& folder) { return folder.string(); });
    throw objectError(scene_file_path, object,
                      fmt::format("file is \"{}\", which is not in {}; {}{} tells where else to look", object.file,
                                  fmt::join(names, " or "), folders.size() > 1 ? "another " : "", other_folder));
}

template <typename Item> void moveBehind(std::vector<Item>& into, std::vector<Item>& from)
{
    into.insert(into.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    from.clear();
}

/// The memory that the arrays of a scene take.
SceneSize sizeOf(const Scene& scene)
{
    SceneSize size;
    size.instance_count = static_cast<double>(scene.instances.size());
    size.triangle_count = static_cast<double>(scene.triangleCount());
    const auto take = [&size](const auto& array)
    { size.bytes += static_cast<double>(array.size()) * static_cast<double>(sizeof(array[0])); };
    for (const Primitive& primitive : scene.primitives)
    {
        size.vertex_count = std::max(size.vertex_count, static_cast<double>(primitive.positions.size()));
        take(primitive.positions);
        take(primitive.normals);
        take(primitive.uvs);
        take(primitive.emission_uvs);
        take(primitive.colors);
        take(primitive.triangles);
        take(primitive.joints);
        take(primitive.weights);
        for (const MorphTarget& target : primitive.morph_targets)
        {
            take(target.positions);
            take(target.normals);
        }
    }
    for (const Image& image : scene.images)
    {
        take(image.rgba);
    }
    take(scene.instances);
    return size;
}

/// Loads the files of an animated scene's objects, once each.
class ObjectLoader
{
public:
    ObjectLoader(const fs::path& scene_file_path, const std::vector<fs::path>& paths, const LoadOptions& options)
        : m_scene_file_path(scene_file_path), m_options{.every_animation = true,
                                                        .keep_hulls = options.keep_hulls,
                                                        .strict = options.strict,
                                                        .images = options.images},
          m_skipped(options.skip_materials)
    {
        for (const fs::path& path : paths)
        {
            ++m_files[path].use_count;
        }
    }

    /// Returns the scene of a file, for one of its uses.
    Scene load(const fs::path& path)
    {
        File& file = m_files.at(path);
        if (!file.is_loaded)
        {
            file.scene = loadScene(std::span(&path, 1), m_options, m_skipped);
            file.size = sizeOf(file.scene);
            file.is_loaded = true;
        }
        m_size.instance_count += file.size.instance_count;
        m_size.triangle_count += file.size.triangle_count;
        m_size.vertex_count = std::max(m_size.vertex_count, file.size.vertex_count);
        m_size.bytes += file.size.bytes;
        checkSceneSize(m_scene_file_path, m_size); // checked before the scene is copied
        if (--file.use_count == 0)
        {
            return std::move(file.scene);
        }
        Scene copy = file.scene;
        file.scene.warnings.clear(); // warnings are printed once
        file.scene.rest_warnings.clear();
        return copy;
    }

    [[nodiscard]] const SkippedMaterials& skipped() const { return m_skipped; }

private:
    struct File
    {
        std::size_t use_count = 0; // uses still to come
        bool is_loaded = false;
        Scene scene;
        SceneSize size;
    };

    const fs::path& m_scene_file_path;
    LoadOptions m_options; // of each file
    SkippedMaterials m_skipped;
    std::map<fs::path, File> m_files;
    SceneSize m_size; // of all objects
};

void placeCamera(const glm::dmat4& to_world, Camera& camera)
{
    const glm::dvec3 up(camera.transform[1]);
    const double length = glm::length(up);
    const double scale = length > 0.0 ? glm::length(glm::dmat3(to_world) * up) / length : 1.0;
    camera.transform = placed(to_world, camera.transform);
    camera.half_height = static_cast<float>(scale * static_cast<double>(camera.half_height));
}

void checkTransform(const fs::path& scene_file_path, const SceneFileObject& object, const Scene& scene)
{
    for (const Instance& instance : scene.instances)
    {
        if (!isFinite(placed(object.transform, instance.transform)))
        {
            throw objectError(scene_file_path, object,
                              "place makes the object larger than single precision holds; expected a smaller scale");
        }
    }
}

/// The text that a message has about the animations of a file.
std::string listAnimations(const std::vector<Animation>& animations)
{
    if (animations.empty())
    {
        return "has no animations that move anything";
    }
    std::vector<std::string> names;
    for (const Animation& animation : animations)
    {
        if (names.size() == kShownAnimations)
        {
            names.push_back(fmt::format("{} more", animations.size() - kShownAnimations));
            break;
        }
        names.push_back(animation.name.empty() ? fmt::format("{}", animation.number)
                                               : fmt::format("{} (\"{}\")", animation.number, animation.name));
    }
    return fmt::format("has {}", fmt::join(names, ", "));
}

/// Keeps only the animation that the object plays.
void chooseAnimation(const fs::path& scene_file_path, const SceneFileObject& object, Scene& scene)
{
    if (keepAnimation(scene, object.animation))
    {
        return;
    }
    const auto* const name = std::get_if<std::string>(&*object.animation);
    const std::string wanted =
        name != nullptr ? fmt::format("\"{}\"", *name) : fmt::format("{}", std::get<std::uint32_t>(*object.animation));
    throw objectError(scene_file_path, object,
                      fmt::format("animation is {}, which {} does not have; it {}", wanted, object.file,
                                  listAnimations(scene.animations)));
}

bool isDeformedAtAll(const Scene& scene)
{
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& instance)
                       { return isDeformed(scene.primitives[instance.primitive], instance); });
}

/// What objects share that are the same parts of the same file.
struct SharedParts
{
    std::uint32_t first_fixed = kNone;   // primitive of AnimatedScene::fixed; kNone: not there yet
    std::shared_ptr<const Scene> moving; // DynamicObject::scene; null: not there yet
};

/// Adds the static part, cameras included.
void addFixed(AnimatedScene& animated, Scene&& scene, const glm::dmat4& to_world, SharedParts& shared)
{
    if (isDeformedAtAll(scene))
    {
        moveBehind(animated.warnings, scene.rest_warnings);
    }
    scene = atRest(std::move(scene));
    scene.rest_warnings.clear();
    for (Instance& instance : scene.instances)
    {
        instance.transform = placed(to_world, instance.transform);
    }
    for (Camera& camera : scene.cameras)
    {
        placeCamera(to_world, camera);
    }
    Scene& fixed = animated.fixed;
    if (shared.first_fixed == kNone)
    {
        shared.first_fixed = static_cast<std::uint32_t>(fixed.primitives.size());
        fixed.append(std::move(scene));
        return;
    }
    for (Instance& instance : scene.instances)
    {
        instance.primitive += shared.first_fixed;
    }
    fixed.instances.insert(fixed.instances.end(), scene.instances.begin(), scene.instances.end());
    moveBehind(fixed.cameras, scene.cameras);
}

/// Adds a dynamic object, which has no scene yet, with the instances of scene that move; the others become static.
void addParts(AnimatedScene& animated, DynamicObject moving, Scene&& scene, const std::vector<bool>& moves,
              SharedParts& shared)
{
    moveBehind(animated.warnings, scene.warnings);
    if (!std::holds_alternative<std::monostate>(moving.motion))
    {
        scene.cameras.clear(); // moving cameras are not supported
    }
    if (std::find(moves.begin(), moves.end(), true) == moves.end())
    {
        addFixed(animated, std::move(scene), moving.transform, shared);
        return;
    }
    std::vector<bool> stays = moves;
    stays.flip();
    addFixed(animated, partOf(scene, stays), moving.transform, shared);
    Scene part = std::find(stays.begin(), stays.end(), true) == stays.end() ? std::move(scene) : partOf(scene, moves);
    part.cameras.clear();
    part.rest_warnings.clear();
    const std::vector<bool> is_animated = animatedInstances(part);
    moving.deforms = std::find(is_animated.begin(), is_animated.end(), true) != is_animated.end();
    if (shared.moving == nullptr)
    {
        shared.moving = std::make_shared<const Scene>(std::move(part));
    }
    moving.scene = shared.moving;
    animated.objects.push_back(std::move(moving));
}

void addObject(AnimatedScene& animated, const SceneFileObject& object, Scene&& scene, SharedParts& shared)
{
    const std::vector<bool> moves =
        object.is_dynamic ? std::vector<bool>(scene.instances.size(), *object.is_dynamic) : animatedInstances(scene);
    DynamicObject moving;
    moving.name = object.name;
    moving.transform = object.transform;
    moving.motion = object.motion;
    addParts(animated, std::move(moving), std::move(scene), moves, shared);
}

void checkCamera(const fs::path& scene_file_path, const AnimatedScene& animated)
{
    const auto* const name = animated.camera ? std::get_if<std::string>(&*animated.camera) : nullptr;
    if (name == nullptr || *name == "auto" || *name == "close")
    {
        return;
    }
    std::vector<std::string> names = {"auto", "close"};
    for (const Camera& camera : animated.fixed.cameras)
    {
        if (camera.name == *name)
        {
            return;
        }
        names.push_back(camera.name);
    }
    throw inputError(scene_file_path,
                     fmt::format("camera is \"{}\"; expected one of {} (cameras of objects without a motion), or "
                                 "an object with eye and target",
                                 *name, fmt::join(names, ", ")));
}

std::string readSceneFileText(const fs::path& path)
{
    const std::vector<std::uint8_t> content = readFile(path);
    if (content.size() > kSceneFileBytesMax)
    {
        throw inputError(
            path, fmt::format("a scene file of {} bytes; expected {} at most", content.size(), kSceneFileBytesMax));
    }
    return {content.begin(), content.end()};
}

} // namespace

AnimatedScene animatedSceneOf(Scene scene, const std::string& name)
{
    AnimatedScene animated;
    double seconds = 0.0;
    for (const Animation& animation : scene.animations)
    {
        seconds = std::max(seconds, animation.seconds);
    }
    animated.seconds = seconds > 0.0 ? seconds : animated.seconds;
    const std::vector<bool> moves = animatedInstances(scene);
    DynamicObject moving;
    moving.name = name;
    SharedParts unshared;
    addParts(animated, std::move(moving), std::move(scene), moves, unshared);
    return animated;
}

AnimatedScene loadAnimatedScene(const fs::path& path, const AnimatedSceneOptions& options)
{
    if (!isSceneFile(path))
    {
        AnimatedScene animated = animatedSceneOf(loadScene(std::span(&path, 1), options.load), path.stem().string());
        animated.files.push_back(path);
        return animated;
    }
    const SceneFile file = parseSceneFile(readSceneFileText(path), path);
    std::vector<fs::path> folders = {path.has_parent_path() ? path.parent_path() : fs::path(".")};
    if (options.scenes_folder)
    {
        folders.push_back(*options.scenes_folder);
    }
    AnimatedScene animated;
    animated.seconds = file.seconds;
    animated.frames_per_second = file.frames_per_second;
    animated.grid_depth = file.grid_depth;
    animated.grid_bounds = file.grid_bounds;
    animated.camera = file.camera;
    animated.merge = file.merge;
    for (const SceneFileObject& object : file.objects)
    {
        animated.files.push_back(resolve(path, object, folders, options.scenes_folder_name));
    }
    ObjectLoader loader(path, animated.files, options.load);
    using Key = std::tuple<fs::path, decltype(SceneFileObject::animation), decltype(SceneFileObject::is_dynamic)>;
    std::map<Key, SharedParts> parts;
    for (std::size_t i = 0; i < file.objects.size(); ++i)
    {
        const SceneFileObject& object = file.objects[i];
        Scene scene = loader.load(animated.files[i]);
        checkTransform(path, object, scene);
        chooseAnimation(path, object, scene);
        addObject(animated, object, std::move(scene), parts[{animated.files[i], object.animation, object.is_dynamic}]);
    }
    for (std::string& warning : loader.skipped().warnings())
    {
        animated.warnings.push_back(std::move(warning));
    }
    checkCamera(path, animated);
    animated.files.push_back(path);
    return animated;
}

} // namespace zvo
