// SPDX-License-Identifier: MIT
// NumPy's arrays and vectors. python/zvo/_arrays.py has checked what comes in: shapes, types of elements, and that the
// elements stand one behind the other.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace zvo::python
{

namespace py = pybind11;

template <typename T> using Array = py::array_t<T, py::array::c_style>;

/// The elements of an array, each of several numbers, such as a glm::vec3 of a row of three. Copies nothing: the array
/// must outlive it.
template <typename Element, typename T> std::span<const Element> elementsOf(const Array<T>& array)
{
    static_assert(sizeof(Element) % sizeof(T) == 0 && alignof(Element) == alignof(T));
    return {reinterpret_cast<const Element*>(array.data()),
            static_cast<std::size_t>(array.size()) * sizeof(T) / sizeof(Element)};
}

/// The same; nothing for None.
template <typename Element, typename T> std::span<const Element> elementsOf(const std::optional<Array<T>>& array)
{
    return array ? elementsOf<Element>(*array) : std::span<const Element>();
}

/// An array that owns a vector's numbers, which are not copied. shape: the numbers of elements along each axis.
template <typename T> py::array_t<T> arrayOf(std::vector<T>&& numbers, std::vector<py::ssize_t> shape)
{
    auto owned = std::make_unique<std::vector<T>>(std::move(numbers));
    const T* const data = owned->data();
    const py::capsule owner(owned.release(), [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
    return py::array_t<T>(std::move(shape), data, owner);
}

} // namespace zvo::python
