// SPDX-License-Identifier: MIT
// Loads animated scenes (io/scene/animated_scene.h): finds and loads files, and divides them into static and dynamic
// parts.
#include "core/base/finite.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/scene/animation.h"
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
#include <set>
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

/// The memory that the arrays of a scene take, but for its instances.
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
    return size;
}

/// The same parts of the same file: what objects share that agree in it.
using PartsKey = std::tuple<fs::path, decltype(SceneFileObject::animation), decltype(SceneFileObject::is_dynamic)>;

/// Loads the files of an animated scene's objects, once each.
class ObjectLoader
{
public:
    /// keys: of the parts that load() is called for.
    ObjectLoader(const fs::path& scene_file_path, const std::set<PartsKey>& keys, const LoadOptions& options)
        : m_scene_file_path(scene_file_path), m_options{.every_animation = true,
                                                        .keep_hulls = options.keep_hulls,
                                                        .strict = options.strict,
                                                        .point_size = options.point_size,
                                                        .images = options.images},
          m_skipped(options.skip_materials)
    {
        for (const PartsKey& key : keys)
        {
            ++m_files[std::get<fs::path>(key)].use_count;
        }
    }

    /// Returns the scene of a file, for some of its parts.
    Scene load(const fs::path& path)
    {
        File& file = m_files.at(path);
        if (!file.is_loaded)
        {
            file.scene = loadScene(std::span(&path, 1), m_options, m_skipped);
            file.size = sizeOf(file.scene);
            file.is_loaded = true;
        }
        m_size.vertex_count = std::max(m_size.vertex_count, file.size.vertex_count);
        m_size.bytes += file.size.bytes;
        checkSceneSize(m_scene_file_path, m_size); // checked before the scene is copied
        if (--file.use_count == 0)
        {
            return std::move(file.scene);
        }
        Scene copy = file.scene;
        file.scene.warnings.clear(); // warnings are printed once
        return copy;
    }

    /// Counts an object that shows a file, which is loaded.
    void show(const fs::path& path)
    {
        const SceneSize& size = m_files.at(path).size;
        m_size.instance_count += size.instance_count;
        m_size.triangle_count += size.triangle_count;
        m_size.bytes += size.instance_count * static_cast<double>(sizeof(Instance));
        checkSceneSize(m_scene_file_path, m_size);
    }

    [[nodiscard]] const SkippedMaterials& skipped() const { return m_skipped; }

private:
    struct File
    {
        std::size_t use_count = 0; // calls of load() still to come
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

Camera placed(const glm::dmat4& to_world, Camera camera)
{
    const glm::dvec3 up(camera.transform[1]);
    const double length = glm::length(up);
    const double scale = length > 0.0 ? glm::length(glm::dmat3(to_world) * up) / length : 1.0;
    camera.transform = placed(to_world, camera.transform);
    camera.half_height = static_cast<float>(scale * static_cast<double>(camera.half_height));
    return camera;
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

/// The parts of a file, in its own space.
struct FileParts
{
    Scene fixed;                           // what stands still, at rest; once it was added, empty
    std::uint32_t first_fixed = kNone;     // where AnimatedScene::fixed has its primitives; kNone: not added yet
    std::vector<Instance> fixed_instances; // of primitives of `fixed`
    std::vector<Camera> cameras;
    std::shared_ptr<const Scene> moving; // null: nothing moves
    bool deforms = false;                // as DynamicObject::deforms
    std::vector<std::string> warnings;
};

void moveFixed(FileParts& parts, Scene&& scene)
{
    scene.warnings.clear();
    parts.fixed = atRest(std::move(scene));
    moveBehind(parts.fixed_instances, parts.fixed.instances);
}

/// Divides a scene into the instances that move and those that stand still.
FileParts divide(Scene&& scene, const std::vector<bool>& moves)
{
    FileParts parts;
    moveBehind(parts.warnings, scene.warnings);
    moveBehind(parts.cameras, scene.cameras);
    if (std::find(moves.begin(), moves.end(), true) == moves.end())
    {
        moveFixed(parts, std::move(scene));
        return parts;
    }
    std::vector<bool> stays = moves;
    stays.flip();
    const bool all_move = std::find(stays.begin(), stays.end(), true) == stays.end();
    Scene moving = all_move ? std::move(scene) : partOf(scene, moves);
    if (!all_move)
    {
        moveFixed(parts, partOf(std::move(scene), stays));
    }
    const std::vector<bool> is_animated = animatedInstances(moving);
    parts.deforms = std::find(is_animated.begin(), is_animated.end(), true) != is_animated.end();
    parts.moving = std::make_shared<const Scene>(std::move(moving));
    return parts;
}

void checkTransforms(const fs::path& scene_file_path, const SceneFileObject& object, const FileParts& parts)
{
    const auto overflows = [&](const Instance& instance)
    { return !isFinite(placed(object.transform, instance.transform)); };
    if (std::any_of(parts.fixed_instances.begin(), parts.fixed_instances.end(), overflows) ||
        (parts.moving != nullptr &&
         std::any_of(parts.moving->instances.begin(), parts.moving->instances.end(), overflows)))
    {
        throw objectError(scene_file_path, object,
                          "place makes the object larger than single precision holds; expected a smaller scale");
    }
}

/// Adds an object, which has no scene yet, with the parts of its file.
void addObject(AnimatedScene& animated, DynamicObject object, FileParts& parts)
{
    Scene& fixed = animated.fixed;
    moveBehind(animated.warnings, parts.warnings);
    if (parts.first_fixed == kNone)
    {
        parts.first_fixed = static_cast<std::uint32_t>(fixed.primitives.size());
        fixed.append(std::exchange(parts.fixed, {}));
    }
    for (Instance instance : parts.fixed_instances)
    {
        instance.primitive += parts.first_fixed;
        instance.transform = placed(object.transform, instance.transform);
        fixed.instances.push_back(instance);
    }
    if (std::holds_alternative<std::monostate>(object.motion)) // moving cameras are not supported
    {
        std::transform(parts.cameras.begin(), parts.cameras.end(), std::back_inserter(fixed.cameras),
                       [&](const Camera& camera) { return placed(object.transform, camera); });
    }
    if (parts.moving != nullptr)
    {
        object.scene = parts.moving;
        object.deforms = parts.deforms;
        animated.objects.push_back(std::move(object));
    }
}

/// Loads the file of an object and divides it.
FileParts loadParts(const fs::path& scene_file_path, const fs::path& path, const SceneFileObject& object,
                    ObjectLoader& loader)
{
    Scene scene = loader.load(path);
    chooseAnimation(scene_file_path, object, scene);
    const std::vector<bool> moves =
        object.is_dynamic ? std::vector<bool>(scene.instances.size(), *object.is_dynamic) : animatedInstances(scene);
    return divide(std::move(scene), moves);
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
    DynamicObject object;
    object.name = name;
    FileParts parts = divide(std::move(scene), moves);
    addObject(animated, std::move(object), parts);
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
    static_cast<SceneSettings&>(animated) = file;
    for (const SceneFileObject& object : file.objects)
    {
        animated.files.push_back(resolve(path, object, folders, options.scenes_folder_name));
    }
    std::vector<PartsKey> keys;
    for (std::size_t i = 0; i < file.objects.size(); ++i)
    {
        keys.emplace_back(animated.files[i], file.objects[i].animation, file.objects[i].is_dynamic);
    }
    ObjectLoader loader(path, {keys.begin(), keys.end()}, options.load);
    std::map<PartsKey, FileParts> all_parts;
    for (std::size_t i = 0; i < file.objects.size(); ++i)
    {
        const SceneFileObject& object = file.objects[i];
        const auto [place, is_new] = all_parts.try_emplace(keys[i]);
        FileParts& parts = place->second;
        if (is_new)
        {
            parts = loadParts(path, animated.files[i], object, loader);
        }
        loader.show(animated.files[i]);
        checkTransforms(path, object, parts);
        DynamicObject dynamic_object;
        dynamic_object.name = object.name;
        dynamic_object.transform = object.transform;
        dynamic_object.motion = object.motion;
        dynamic_object.carves = object.carves;
        dynamic_object.fill = object.fill;
        addObject(animated, std::move(dynamic_object), parts);
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
