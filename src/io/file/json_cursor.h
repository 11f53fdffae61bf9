// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/error.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

/// The largest absolute value of a number in a file: the largest one of single precision.
inline constexpr double kJsonNumberMax = 3.4e38;

/// Parses text as JSON. Throws Error{Input} if it is not JSON, is nested more than 64 deep, or has a key twice in an
/// object.
nlohmann::json parseJsonStrictly(std::string_view text, const std::filesystem::path& file);

/// What is wrong with text that does not parse as JSON: the line, and where in it. failure: what the parser threw.
std::string jsonFault(std::string_view text, const std::exception& failure);

/// A value in a JSON document together with its path, so that errors can say what is wrong where. Every function that
/// reads throws Error{Input}, one line with the file, the path, what is there and what is expected. Keeps references to
/// the document and to the file's path.
class JsonCursor
{
public:
    JsonCursor(const nlohmann::json& document, const std::filesystem::path& file);

    /// The path, such as objects[1].place.scale; empty for the document.
    [[nodiscard]] const std::string& where() const { return m_where; }

    /// Makes an error about this value: file, path, text.
    [[nodiscard]] Error error(std::string_view text) const;
    /// Makes the error that the value is not what is expected.
    [[nodiscard]] Error mismatch(std::string_view expected) const;

    /// Checks that the value is an object and has only these keys.
    void allowKeys(std::span<const std::string_view> keys) const;
    void allowKeys(std::initializer_list<std::string_view> keys) const { allowKeys(std::span(keys)); }
    /// A member of an object.
    [[nodiscard]] std::optional<JsonCursor> find(std::string_view key) const;
    [[nodiscard]] JsonCursor at(std::string_view key) const;
    /// What read makes of a member, such as &JsonCursor::flag; otherwise, where there is none.
    template <typename Value, typename Read>
    [[nodiscard]] Value valueOr(std::string_view key, const Read& read, Value otherwise) const
    {
        const std::optional<JsonCursor> member = find(key);
        return member ? Value(std::invoke(read, *member)) : otherwise;
    }
    /// The elements of an array.
    [[nodiscard]] std::vector<JsonCursor> items() const;

    [[nodiscard]] bool isText() const;
    [[nodiscard]] bool isNumber() const;
    [[nodiscard]] bool flag() const;
    [[nodiscard]] std::string text() const;
    /// The index of the value, a text, among names.
    [[nodiscard]] std::size_t oneOf(std::span<const std::string_view> names) const;
    [[nodiscard]] std::size_t oneOf(std::initializer_list<std::string_view> names) const;
    /// A number of at most kJsonNumberMax in size.
    [[nodiscard]] double number() const;
    /// A number above 0 and at most high.
    [[nodiscard]] double positive(double high) const;
    [[nodiscard]] std::uint32_t whole(std::uint32_t low, std::uint32_t high) const;
    /// Three numbers.
    [[nodiscard]] glm::dvec3 vector() const;
    /// Three numbers, not all 0.
    [[nodiscard]] glm::dvec3 nonZeroVector() const;
    /// The same, scaled to length 1.
    [[nodiscard]] glm::dvec3 direction() const;

private:
    JsonCursor(const nlohmann::json& value, const std::filesystem::path& file, std::string where);

    [[nodiscard]] JsonCursor child(const nlohmann::json& value, std::string_view key) const;
    void requireObject() const;
    [[nodiscard]] bool isVector() const;

    const nlohmann::json* m_value;
    const std::filesystem::path* m_file;
    std::string m_where;
};

} // namespace zvo
