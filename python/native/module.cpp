// SPDX-License-Identifier: MIT
// The module zvo._native, on which the package stands (python/zvo). Its functions take arrays that _arrays.py has
// checked, do their work without Python's lock, and wait for the device.
#include "arrays.h"
#include "common/names.h"
#include "notices.h"
#include "picture.h"
#include "trace.h"
#include "voxelize.h"
#include "zvo/error.h"
#include "zvo/version.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::python
{

namespace
{

constexpr auto kErrorNames = std::to_array<cli::Named<ErrorCode>>({{"usage", ErrorCode::Usage},
                                                                   {"device", ErrorCode::Device},
                                                                   {"input", ErrorCode::Input},
                                                                   {"output", ErrorCode::Output},
                                                                   {"memory", ErrorCode::Memory},
                                                                   {"other", ErrorCode::Other}});

constexpr auto kIntegrators =
    std::to_array<cli::Named<Integrator>>({{"primary", Integrator::Primary}, {"path", Integrator::Path}});

// Arguments that make no sense are ValueError; all else is ZvoError, with the kind of error in `code`.
void raise(const Error& error)
{
    if (error.code() == ErrorCode::Usage)
    {
        PyErr_SetString(PyExc_ValueError, error.what());
        return;
    }
    const py::object type = py::module_::import("zvo").attr("ZvoError");
    const py::object raised = type(error.what());
    raised.attr("code") = std::string(cli::nameOf(kErrorNames, error.code()));
    PyErr_SetObject(type.ptr(), raised.ptr());
}

// Options of both ways to voxels.
struct GridArguments
{
    std::optional<std::uint32_t> depth;
    std::string coverage;
    std::string fill;
    std::string shell;
    std::optional<std::array<float, 6>> bounds;
    bool attributes = true;
};

cli::VoxelOptions optionsOf(const GridArguments& arguments)
{
    cli::VoxelOptions options;
    options.depth = arguments.depth;
    options.coverage = cli::parseNamed("coverage", arguments.coverage, cli::kCoverages);
    options.fill = cli::parseNamed("fill", arguments.fill, cli::kFills);
    options.shell = cli::parseNamed("shell", arguments.shell, cli::kShells);
    options.attributes = arguments.attributes ? AttributeFormat::Bytes8 : AttributeFormat::None;
    if (arguments.bounds)
    {
        const std::array<float, 6>& box = *arguments.bounds;
        options.bounds = Bounds{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
    }
    return options;
}

Picture pictureOf(const std::optional<Array<std::uint8_t>>& texture)
{
    return texture ? Picture{static_cast<std::uint32_t>(texture->shape(1)),
                             static_cast<std::uint32_t>(texture->shape(0)), elementsOf<std::uint8_t>(*texture)}
                   : Picture();
}

std::unique_ptr<Tree> voxelizeArrays(const std::string& device, const Array<float>& positions,
                                     const std::optional<Array<std::uint32_t>>& triangles,
                                     const std::optional<Array<float>>& normals,
                                     const std::optional<Array<float>>& colors, const std::optional<Array<float>>& uvs,
                                     const std::optional<Array<std::uint8_t>>& texture, const GridArguments& grid)
{
    const Mesh mesh = {.positions = elementsOf<glm::vec3>(positions),
                       .triangles = elementsOf<glm::uvec3>(triangles),
                       .is_points = !triangles,
                       .normals = elementsOf<glm::vec3>(normals),
                       .colors = elementsOf<glm::vec4>(colors),
                       .uvs = elementsOf<glm::vec2>(uvs),
                       .texture = pictureOf(texture)};
    return withoutLock([&] { return voxelize(device, sceneOf(mesh), optionsOf(grid)); });
}

std::unique_ptr<Tree> loadFiles(const std::string& device, const std::vector<std::filesystem::path>& paths,
                                const std::string& up, float scale, std::uint32_t point_size,
                                const std::optional<double>& time, const GridArguments& grid)
{
    cli::VoxelOptions options = optionsOf(grid);
    options.scenes = paths;
    options.load.up = cli::parseNamed("up", up, cli::kAxes);
    options.load.scale = scale;
    options.load.point_size = point_size;
    options.time = time;
    return withoutLock([&] { return load(device, options); });
}

// (coords, colors or None, normals or None)
py::tuple voxelsOf(const Tree& tree)
{
    Voxels voxels = withoutLock([&] { return tree.voxels(); });
    const auto count = static_cast<py::ssize_t>(voxels.coords.size() / 3);
    const auto rows = [&](auto& numbers) { return arrayOf(std::move(numbers), {count, 3}); };
    if (!tree.device().hasAttributes() && count != 0)
    {
        return py::make_tuple(rows(voxels.coords), py::none(), py::none());
    }
    return py::make_tuple(rows(voxels.coords), rows(voxels.colors), rows(voxels.normals));
}

// (state, t, voxel, face, normal, color)
py::tuple traceRays(const Tree& tree, const Array<float>& origins, const Array<float>& directions, float t_min,
                    float t_max)
{
    Hits hits = withoutLock(
        [&] { return trace(tree, elementsOf<glm::vec3>(origins), elementsOf<glm::vec3>(directions), t_min, t_max); });
    const auto count = static_cast<py::ssize_t>(hits.t.size());
    return py::make_tuple(arrayOf(std::move(hits.state), {count}), arrayOf(std::move(hits.t), {count}),
                          arrayOf(std::move(hits.voxel), {count, 3}), arrayOf(std::move(hits.face), {count}),
                          arrayOf(std::move(hits.normal), {count, 3}), arrayOf(std::move(hits.color), {count, 3}));
}

// [height, width] texels
py::array_t<std::uint32_t> renderTree(const Tree& tree, std::uint32_t width, std::uint32_t height,
                                      const std::string& camera, const std::vector<float>& view,
                                      const std::string& integrator, std::uint32_t samples, bool denoise)
{
    const auto found = cli::parseNamed("integrator", integrator, kIntegrators);
    const PictureOptions options = {width, height, camera, view, found, samples, denoise};
    std::vector<std::uint32_t> texels = withoutLock([&] { return render(tree, options); });
    return arrayOf(std::move(texels), {height, width});
}

// (name, type, driver, memory_bytes, reasons)
py::list listDevices()
{
    const std::vector<vk::DeviceReport> reports = withoutLock([] { return vk::queryAllDevices(); });
    py::list devices;
    for (const vk::DeviceReport& report : reports)
    {
        devices.append(py::make_tuple(report.name, report.type, report.driver, report.memory_bytes, report.reasons));
    }
    return devices;
}

} // namespace

PYBIND11_MODULE(_native, module)
{
    py::register_exception_translator(
        [](std::exception_ptr thrown)
        {
            try
            {
                std::rethrow_exception(std::move(thrown));
            }
            catch (const Error& error)
            {
                raise(error);
            }
        });
    Notices::listen();
    py::module_::import("atexit").attr("register")(py::cpp_function(&Session::closeAll));

    module.attr("version") = ZVO_VERSION_TEXT;
    module.def("devices", &listDevices);
    module.def("voxelize", &voxelizeArrays);
    module.def("load", &loadFiles);
    module.def("trace", &traceRays);
    module.def("write_picture",
               [](const std::string& path, const Array<std::uint32_t>& texels)
               {
                   const auto size = [&](int axis) { return static_cast<std::uint32_t>(texels.shape(axis)); };
                   withoutLock([&] { writePicture(path, size(1), size(0), elementsOf<std::uint32_t>(texels)); });
               });

    py::class_<GridArguments>(module, "GridArguments")
        .def(
            py::init([](const std::optional<std::uint32_t>& depth, const std::string& coverage, const std::string& fill,
                        const std::string& shell, const std::optional<std::array<float, 6>>& bounds, bool attributes)
                     { return GridArguments{depth, coverage, fill, shell, bounds, attributes}; }),
            py::kw_only(), py::arg("depth"), py::arg("coverage"), py::arg("fill"), py::arg("shell"), py::arg("bounds"),
            py::arg("attributes"));

    py::class_<Tree>(module, "Tree")
        .def_property_readonly("resolution", [](const Tree& tree) { return tree.device().grid.resolution(); })
        .def_property_readonly("origin",
                               [](const Tree& tree)
                               {
                                   const glm::vec3& origin = tree.device().grid.origin;
                                   return py::make_tuple(origin.x, origin.y, origin.z);
                               })
        .def_property_readonly("voxel_size", [](const Tree& tree) { return tree.device().grid.voxel_size; })
        .def_property_readonly("voxel_count", [](const Tree& tree) { return tree.device().occupiedCount(); })
        .def_property_readonly("is_dag", [](const Tree& tree) { return tree.device().isDag(); })
        .def_property_readonly("bytes", [](const Tree& tree)
                               { return tree.device().geometryBytes() + tree.device().attributeBytes(); })
        .def("voxels", &voxelsOf)
        .def("compress", [](const Tree& tree) { return withoutLock([&] { return tree.compress(); }); })
        .def("save", [](const Tree& tree, const std::string& path) { withoutLock([&] { tree.save(path); }); })
        .def("render", &renderTree);
}

} // namespace zvo::python
