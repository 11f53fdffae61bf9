// SPDX-License-Identifier: MIT
#include "io/file/json_cursor.h"

#include "core/base/input_error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace zvo
{

namespace
{

using nlohmann::json;

constexpr std::size_t kNestingMax = 64;
constexpr std::size_t kShownItems = 4; // longer arrays are only counted
constexpr std::size_t kShownBytes = 80;

std::string childPath(std::string_view where, std::string_view key)
{
    return where.empty() ? std::string(key) : fmt::format("{}.{}", where, key);
}

/// Tracks the parser's position in a document.
class ParserWatch
{
public:
    explicit ParserWatch(const std::filesystem::path& file) : m_file(file) {}

    void see(json::parse_event_t event, const json& parsed)
    {
        switch (event)
        {
        case json::parse_event_t::object_start:
        case json::parse_event_t::array_start:
            countItem();
            m_levels.push_back({event == json::parse_event_t::array_start, 0, {}, {}});
            if (m_levels.size() > kNestingMax)
            {
                throw inputError(m_file, fmt::format("its JSON is nested more than {} deep", kNestingMax));
            }
            break;
        case json::parse_event_t::object_end:
        case json::parse_event_t::array_end:
            m_levels.pop_back();
            break;
        case json::parse_event_t::key:
            m_levels.back().key = parsed.get<std::string>();
            if (!m_levels.back().keys.insert(m_levels.back().key).second)
            {
                throw inputError(m_file, fmt::format("{} stands there twice", path()));
            }
            break;
        case json::parse_event_t::value:
            countItem();
            break;
        }
    }

private:
    struct Level
    {
        bool is_array = false;
        std::size_t item_count = 0; // items begun so far
        std::string key;            // last key
        std::set<std::string> keys;
    };

    void countItem()
    {
        if (!m_levels.empty())
        {
            ++m_levels.back().item_count;
        }
    }

    [[nodiscard]] std::string path() const
    {
        std::string where;
        for (const Level& level : m_levels)
        {
            where = level.is_array ? fmt::format("{}[{}]", where, level.item_count - 1) : childPath(where, level.key);
        }
        return where;
    }

    const std::filesystem::path& m_file;
    std::vector<Level> m_levels;
};

bool isPlain(const json& value)
{
    return !value.is_structured();
}

/// The text of a value in a message.
std::string shown(const json& value)
{
    if (value.is_object())
    {
        return "an object";
    }
    if (value.is_array() && (value.size() > kShownItems || !std::all_of(value.begin(), value.end(), isPlain)))
    {
        return fmt::format("an array of {}", value.size());
    }
    const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    return text.size() <= kShownBytes ? text : text.substr(0, kShownBytes) + "...";
}

bool isNumberInRange(const json& value)
{
    return value.is_number() && std::abs(value.get<double>()) <= kJsonNumberMax;
}

} // namespace

std::string jsonFault(std::string_view text, const std::exception& failure)
{
    constexpr std::size_t kQuotedMax = 24; // bytes
    const auto* const broken = dynamic_cast<const json::parse_error*>(&failure);
    if (broken == nullptr)
    {
        return "a number in it is beyond double precision";
    }
    const std::string_view read = text.substr(0, broken->byte);
    const auto line = 1 + std::count(read.begin(), read.end(), '\n');
    const std::string_view end = read.substr(read.size() - std::min(read.size(), kQuotedMax));
    return end.empty() ? "there is nothing in it"
                       : fmt::format("it breaks off or is wrong in line {}, at the end of \"{}\"", line, end);
}

json parseJsonStrictly(std::string_view text, const std::filesystem::path& file)
{
    ParserWatch watch(file);
    const auto see = [&watch](int /*depth*/, json::parse_event_t event, const json& parsed)
    {
        watch.see(event, parsed);
        return true;
    };
    try
    {
        return json::parse(text, see);
    }
    catch (const json::exception& failure)
    {
        throw inputError(file, fmt::format("not JSON: {}", jsonFault(text, failure)));
    }
}

JsonCursor::JsonCursor(const json& document, const std::filesystem::path& file) : m_value(&document), m_file(&file) {}

JsonCursor::JsonCursor(const json& value, const std::filesystem::path& file, std::string where)
    : m_value(&value), m_file(&file), m_where(std::move(where))
{
}

JsonCursor JsonCursor::child(const json& value, std::string_view key) const
{
    return {value, *m_file, childPath(m_where, key)};
}

Error JsonCursor::error(std::string_view text) const
{
    return inputError(*m_file, fmt::format("{} {}", m_where.empty() ? "the document" : m_where, text));
}

Error JsonCursor::mismatch(std::string_view expected) const
{
    return error(fmt::format("is {}; expected {}", shown(*m_value), expected));
}

void JsonCursor::requireObject() const
{
    if (!m_value->is_object())
    {
        throw mismatch("an object");
    }
}

void JsonCursor::allowKeys(std::span<const std::string_view> keys) const
{
    requireObject();
    for (const auto& [key, value] : m_value->items())
    {
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
        {
            throw child(value, key).error(fmt::format("is not known; expected {}", fmt::join(keys, ", ")));
        }
    }
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const
{
    requireObject();
    const auto member = m_value->find(key);
    return member == m_value->end() ? std::nullopt : std::optional(child(*member, key));
}

JsonCursor JsonCursor::at(std::string_view key) const
{
    const std::optional<JsonCursor> member = find(key);
    if (!member)
    {
        throw child(*m_value, key).error("is missing");
    }
    return *member;
}

std::vector<JsonCursor> JsonCursor::items() const
{
    if (!m_value->is_array())
    {
        throw mismatch("an array");
    }
    std::vector<JsonCursor> items;
    for (std::size_t i = 0; i < m_value->size(); ++i)
    {
        items.push_back(JsonCursor((*m_value)[i], *m_file, fmt::format("{}[{}]", m_where, i)));
    }
    return items;
}

bool JsonCursor::isText() const
{
    return m_value->is_string();
}

bool JsonCursor::isNumber() const
{
    return m_value->is_number();
}

bool JsonCursor::flag() const
{
    if (!m_value->is_boolean())
    {
        throw mismatch("true or false");
    }
    return m_value->get<bool>();
}

std::string JsonCursor::text() const
{
    if (!m_value->is_string())
    {
        throw mismatch("a text");
    }
    return m_value->get<std::string>();
}

std::size_t JsonCursor::oneOf(std::initializer_list<std::string_view> names) const
{
    return oneOf(std::span(names));
}

std::size_t JsonCursor::oneOf(std::span<const std::string_view> names) const
{
    const auto name = m_value->is_string()
                          ? std::find(names.begin(), names.end(), m_value->get_ref<const std::string&>())
                          : names.end();
    if (name == names.end())
    {
        throw mismatch(fmt::format("one of {}", fmt::join(names, ", ")));
    }
    return static_cast<std::size_t>(name - names.begin());
}

double JsonCursor::number() const
{
    if (!isNumberInRange(*m_value))
    {
        throw mismatch(fmt::format("a number of at most {:g}", kJsonNumberMax));
    }
    return m_value->get<double>();
}

double JsonCursor::positive(double high) const
{
    if (!isNumberInRange(*m_value) || !(m_value->get<double>() > 0.0) || m_value->get<double>() > high)
    {
        throw mismatch(fmt::format("a number above 0 and up to {:g}", high));
    }
    return m_value->get<double>();
}

std::uint32_t JsonCursor::whole(std::uint32_t low, std::uint32_t high) const
{
    if (!m_value->is_number_unsigned() || m_value->get<std::uint64_t>() < low || m_value->get<std::uint64_t>() > high)
    {
        throw mismatch(fmt::format("a whole number from {} to {}", low, high));
    }
    return m_value->get<std::uint32_t>();
}

bool JsonCursor::isVector() const
{
    return m_value->is_array() && m_value->size() == 3 &&
           std::all_of(m_value->begin(), m_value->end(), isNumberInRange);
}

glm::dvec3 JsonCursor::vector() const
{
    if (!isVector())
    {
        throw mismatch("three numbers [x, y, z]");
    }
    return {(*m_value)[0].get<double>(), (*m_value)[1].get<double>(), (*m_value)[2].get<double>()};
}

glm::dvec3 JsonCursor::nonZeroVector() const
{
    const glm::dvec3 v = isVector() ? vector() : glm::dvec3(0.0);
    if (v == glm::dvec3(0.0))
    {
        throw mismatch("three numbers [x, y, z], not all 0");
    }
    return v;
}

glm::dvec3 JsonCursor::direction() const
{
    const glm::dvec3 v = nonZeroVector();
    const double longest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return glm::normalize(v / longest); // divided first, as squares of very small numbers would be 0
}

} // namespace zvo
