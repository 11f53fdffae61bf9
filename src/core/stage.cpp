// SPDX-License-Identifier: MIT
#include "core/stage.h"

#include "core/folder_bounds.h"
#include "core/input_error.h"
#include "core/load_scene.h"
#include "core/read_file.h"
#include "core/scene_size.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <system_error>
#include <utility>

namespace zvo
{

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kStageFileBytesMax = std::size_t{4} << 20U; // many times what 4096 objects take
constexpr std::size_t kSweepSteps = 64;
constexpr double kFrameCountTolerance = 1e-9; // relative
constexpr double kRoundingMargin = 1e-6;      // of the largest coordinate: a few units in the last place

bool isFinite(const glm::vec3& point)
{
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

bool isFinite(const glm::mat4& matrix)
{
    return isFinite(glm::vec3(matrix[0])) && isFinite(glm::vec3(matrix[1])) && isFinite(glm::vec3(matrix[2])) &&
           isFinite(glm::vec3(matrix[3]));
}

/// The product in double precision, rounded once.
glm::mat4 placed(const glm::dmat4& place, const glm::mat4& transform)
{
    return glm::mat4(place * glm::dmat4(transform));
}

Error objectError(const fs::path& stage_path, const StageObject& object, std::string_view text)
{
    return inputError(stage_path, fmt::format("{}.{}", object.where, text));
}

/// The file of an object in the first of the folders that has it.
fs::path resolve(const fs::path& stage_path, const StageObject& object, const std::vector<fs::path>& folders)
{
    const fs::path file = object.file;
    for (const fs::path& folder : folders)
    {
        std::error_code missing;
        if (file.is_absolute() || !liesBelow(folder, folder / file))
        {
            throw objectError(stage_path, object,
                              fmt::format("file is \"{}\", which leaves the folder of the scene file or of --scenes; "
                                          "expected a file in one of them or below",
                                          object.file));
        }
        if (fs::exists(folder / file, missing))
        {
            return folder / file;
        }
    }
    std::vector<std::string> names;
    std::transform(folders.begin(), folders.end(), std::back_inserter(names),
                   [](const fs::path& folder) { return folder.string(); });
    throw objectError(stage_path, object,
                      fmt::format("file is \"{}\", which is not in {}; {} tells where else to look", object.file,
                                  fmt::join(names, " or "), folders.size() > 1 ? "another --scenes" : "--scenes DIR"));
}

/// What the arrays of a scene take.
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
        take(primitive.colors);
        take(primitive.triangles);
    }
    for (const Image& image : scene.images)
    {
        take(image.rgba);
    }
    take(scene.instances);
    return size;
}

/// Loads the files of a stage's objects, each once.
class ObjectLoader
{
public:
    ObjectLoader(const fs::path& stage_path, const std::vector<fs::path>& paths) : m_stage_path(stage_path)
    {
        for (const fs::path& path : paths)
        {
            ++m_files[path].use_count;
        }
    }

    /// The scene in a file, at one of its uses.
    Scene load(const fs::path& path)
    {
        File& file = m_files.at(path);
        if (!file.is_loaded)
        {
            file.scene = loadScene(std::span(&path, 1));
            file.size = sizeOf(file.scene);
            file.is_loaded = true;
        }
        m_size.instance_count += file.size.instance_count;
        m_size.triangle_count += file.size.triangle_count;
        m_size.vertex_count = std::max(m_size.vertex_count, file.size.vertex_count);
        m_size.bytes += file.size.bytes;
        checkSceneSize(m_stage_path, m_size); // before it is copied
        if (--file.use_count == 0)
        {
            return std::move(file.scene);
        }
        Scene copy = file.scene;
        file.scene.warnings.clear(); // are told once
        return copy;
    }

private:
    struct File
    {
        std::size_t use_count = 0; // still to come
        bool is_loaded = false;
        Scene scene;
        SceneSize size;
    };

    const fs::path& m_stage_path;
    std::map<fs::path, File> m_files;
    SceneSize m_size; // of all objects
};

void placeCamera(const glm::dmat4& place, Camera& camera)
{
    const glm::dvec3 up(camera.transform[1]);
    const double length = glm::length(up);
    const double scale = length > 0.0 ? glm::length(glm::dmat3(place) * up) / length : 1.0;
    camera.transform = placed(place, camera.transform);
    camera.half_height = static_cast<float>(scale * static_cast<double>(camera.half_height));
}

void checkPlace(const fs::path& stage_path, const StageObject& object, const Scene& scene)
{
    for (const Instance& instance : scene.instances)
    {
        if (!isFinite(placed(object.place, instance.transform)))
        {
            throw objectError(stage_path, object,
                              "place makes the object larger than single precision holds; expected a smaller scale");
        }
    }
}

void addFixed(Stage& stage, const StageObject& object, Scene&& scene)
{
    for (Instance& instance : scene.instances)
    {
        instance.transform = placed(object.place, instance.transform);
    }
    for (Camera& camera : scene.cameras)
    {
        placeCamera(object.place, camera);
    }
    stage.fixed.append(std::move(scene));
}

void checkCamera(const fs::path& stage_path, const Stage& stage)
{
    const auto* const name = stage.camera ? std::get_if<std::string>(&*stage.camera) : nullptr;
    if (name == nullptr || *name == "auto" || *name == "close")
    {
        return;
    }
    std::vector<std::string> names = {"auto", "close"};
    for (const Camera& camera : stage.fixed.cameras)
    {
        if (camera.name == *name)
        {
            return;
        }
        names.push_back(camera.name);
    }
    throw inputError(stage_path, fmt::format("camera is \"{}\"; expected one of {} (the static objects' cameras), or "
                                             "an object with eye and target",
                                             *name, fmt::join(names, ", ")));
}

std::string readStageText(const fs::path& path)
{
    const std::vector<std::uint8_t> content = readFile(path);
    if (content.size() > kStageFileBytesMax)
    {
        throw inputError(
            path, fmt::format("a scene file of {} bytes; expected {} at most", content.size(), kStageFileBytesMax));
    }
    return {content.begin(), content.end()};
}

/// The finite positions of a scene, those that a triangle uses, each instance's in its transform.
class Points
{
public:
    explicit Points(const Scene& scene) : m_scene(scene), m_used(scene.primitives.size())
    {
        for (std::size_t i = 0; i < scene.primitives.size(); ++i)
        {
            const Primitive& primitive = scene.primitives[i];
            std::vector<bool> is_used(primitive.positions.size(), false);
            for (const glm::uvec3& triangle : primitive.triangles)
            {
                for (const std::uint32_t vertex : {triangle.x, triangle.y, triangle.z})
                {
                    if (!is_used[vertex])
                    {
                        is_used[vertex] = true;
                        m_used[i].push_back(primitive.positions[vertex]);
                    }
                }
            }
        }
    }

    template <typename See> void forEach(const glm::dmat4& place, const See& see) const
    {
        for (const Instance& instance : m_scene.instances)
        {
            const glm::mat4 transform = placed(place, instance.transform);
            for (const glm::vec3& position : m_used[instance.primitive])
            {
                const glm::vec3 point = transformPoint(transform, position);
                if (isFinite(point))
                {
                    see(point);
                }
            }
        }
    }

private:
    const Scene& m_scene;
    std::vector<std::vector<glm::vec3>> m_used; // of each primitive
};

Bounds moverBounds(const Mover& mover, double seconds)
{
    const Points points(mover.scene);
    const MotionSweep sweep = sweepOf(mover.motion, seconds, kSweepSteps);
    double distance = 0.0;
    points.forEach(mover.place, [&](const glm::vec3& point)
                   { distance = std::max(distance, glm::length(glm::dvec3(point) - sweep.pivot)); });
    Bounds bounds;
    for (const glm::dmat4& place : sweep.places)
    {
        points.forEach(place * mover.place, [&](const glm::vec3& point) { bounds.extend(point); });
    }
    if (bounds.empty() || std::holds_alternative<std::monostate>(mover.motion))
    {
        return bounds;
    }
    const glm::vec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    const double largest = std::max({reach.x, reach.y, reach.z});
    const auto margin =
        static_cast<float>(sweep.stray + sweep.stray_per_distance * distance + kRoundingMargin * largest);
    return {bounds.min - margin, bounds.max + margin};
}

Scene withMovers(Scene scene, const std::vector<Mover>& movers, double seconds)
{
    for (const Mover& mover : movers)
    {
        const glm::dmat4 place = placeAt(mover, seconds);
        Scene part = mover.scene;
        part.cameras.clear();
        for (Instance& instance : part.instances)
        {
            instance.transform = placed(place, instance.transform);
        }
        scene.append(std::move(part));
    }
    return scene;
}

} // namespace

Stage loadStage(const fs::path& path, const StageOptions& options)
{
    const StageFile file = parseStageFile(readStageText(path), path);
    std::vector<fs::path> folders = {path.has_parent_path() ? path.parent_path() : fs::path(".")};
    if (options.scenes_folder)
    {
        folders.push_back(*options.scenes_folder);
    }
    Stage stage;
    stage.seconds = file.seconds;
    stage.frames_per_second = file.frames_per_second;
    stage.grid_depth = file.grid_depth;
    stage.grid_bounds = file.grid_bounds;
    stage.camera = file.camera;
    stage.merge = file.merge;
    for (const StageObject& object : file.objects)
    {
        stage.files.push_back(resolve(path, object, folders));
    }
    ObjectLoader loader(path, stage.files);
    for (std::size_t i = 0; i < file.objects.size(); ++i)
    {
        const StageObject& object = file.objects[i];
        Scene scene = loader.load(stage.files[i]);
        stage.warnings.insert(stage.warnings.end(), scene.warnings.begin(), scene.warnings.end());
        scene.warnings.clear();
        checkPlace(path, object, scene);
        if (object.is_dynamic.value_or(false))
        {
            stage.movers.push_back({object.name, std::move(scene), object.place, object.motion});
        }
        else
        {
            addFixed(stage, object, std::move(scene));
        }
    }
    checkCamera(path, stage);
    stage.files.push_back(path);
    return stage;
}

double frameTime(const Stage& stage, std::uint64_t frame)
{
    const double frame_count = stage.seconds * stage.frames_per_second;
    const double whole = std::round(frame_count);
    if (whole >= 1.0 && std::abs(frame_count - whole) <= kFrameCountTolerance * whole)
    {
        return static_cast<double>(frame % static_cast<std::uint64_t>(whole)) / stage.frames_per_second;
    }
    return loopedTime(stage, static_cast<double>(frame) / stage.frames_per_second);
}

double loopedTime(const Stage& stage, double seconds)
{
    return std::fmod(seconds, stage.seconds);
}

glm::dmat4 placeAt(const Mover& mover, double seconds)
{
    return motionAt(mover.motion, seconds) * mover.place;
}

Scene stageAt(const Stage& stage, double seconds)
{
    return withMovers(Scene(stage.fixed), stage.movers, seconds);
}

Scene stageAt(Stage&& stage, double seconds)
{
    return withMovers(std::move(stage.fixed), stage.movers, seconds);
}
Bounds stageBounds(const Stage& stage)
{
    Bounds bounds = stage.fixed.bounds();
    for (const Mover& mover : stage.movers)
    {
        const Bounds swept = moverBounds(mover, stage.seconds);
        bounds.min = glm::min(bounds.min, swept.min);
        bounds.max = glm::max(bounds.max, swept.max);
    }
    return bounds;
}

} // namespace zvo
