// SPDX-License-Identifier: MIT
#include "query_files.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iostream>
#include <iterator>
#include <limits>
#include <string_view>

namespace zvo::cli
{

namespace
{

static_assert(std::endian::native == std::endian::little && sizeof(QueryAnswer) == 72);

// What a question of a kind has: those of the numbers from `least` on may be left out.
struct Shape
{
    std::size_t least;
    std::size_t most;
    const char* names;
};

Shape shapeOf(QueryKind kind)
{
    switch (kind)
    {
    case QueryKind::Point:
        return {3, 3, "x,y,z"};
    case QueryKind::Ray:
        return {6, 8, "x,y,z,dx,dy,dz and perhaps t_min,t_max"};
    case QueryKind::Box:
        return {6, 6, "x0,y0,z0,x1,y1,z1"};
    case QueryKind::Nearest:
        return {3, 4, "x,y,z and perhaps a distance from 0 on"};
    case QueryKind::Sweep:
        break;
    }
    return {9, 9, "x0,y0,z0,x1,y1,z1,dx,dy,dz"};
}

// Whether the numbers of a question are allowed. Those that may be left out are there.
bool isAllowed(QueryKind kind, std::span<const double> numbers)
{
    const bool is_ray = kind == QueryKind::Ray;
    const std::size_t finite = numbers.size() - (is_ray || kind == QueryKind::Nearest ? 1 : 0);
    return std::ranges::all_of(numbers.first(finite), [](double number) { return std::isfinite(number); }) &&
           (!is_ray || !std::isnan(numbers.back())) && (kind != QueryKind::Nearest || numbers.back() >= 0);
}

std::string_view trimmed(std::string_view text)
{
    const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && isSpace(text.front()))
    {
        text.remove_prefix(1);
    }
    while (!text.empty() && isSpace(text.back()))
    {
        text.remove_suffix(1);
    }
    return text;
}

// The numbers of a line, or none where it is not a list of numbers.
std::vector<double> numbersIn(std::string_view line)
{
    std::vector<double> numbers;
    for (;;)
    {
        const std::size_t comma = line.find(',');
        const std::string_view word = trimmed(line.substr(0, comma));
        double number = 0;
        const auto [stop, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (failure != std::errc{} || stop != word.data() + word.size())
        {
            return {};
        }
        numbers.push_back(number);
        if (comma == std::string_view::npos)
        {
            return numbers;
        }
        line.remove_prefix(comma + 1);
    }
}

std::vector<double> readCsv(const std::filesystem::path& path, std::string_view text, QueryKind kind)
{
    const Shape shape = shapeOf(kind);
    std::vector<double> all;
    for (std::uint64_t number = 1; !text.empty(); ++number)
    {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        const bool is_header = number == 1 && !line.empty() && std::isalpha(static_cast<unsigned char>(line[0])) != 0;
        if (line.empty() || line[0] == '#' || is_header)
        {
            continue;
        }
        std::vector<double> numbers = numbersIn(line);
        const bool is_long_enough = numbers.size() >= shape.least && numbers.size() <= shape.most;
        if (kind == QueryKind::Ray && numbers.size() == shape.least)
        {
            numbers.push_back(0);
        }
        numbers.resize(is_long_enough ? shape.most : 0, std::numeric_limits<double>::infinity());
        if (!is_long_enough || !isAllowed(kind, numbers))
        {
            throw inputError(path, fmt::format("line {}: expected {}, as finite numbers", number, shape.names));
        }
        all.insert(all.end(), numbers.begin(), numbers.end());
    }
    return all;
}

std::vector<double> readBinary(const std::filesystem::path& path, std::string_view bytes, QueryKind kind)
{
    const Shape shape = shapeOf(kind);
    const std::size_t record = shape.most * sizeof(float);
    if (bytes.size() % record != 0)
    {
        throw inputError(path, fmt::format("ends within record {}: records of {} bytes are expected",
                                           bytes.size() / record + 1, record));
    }
    std::vector<float> words(bytes.size() / sizeof(float));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    std::vector<double> all(words.begin(), words.end());
    for (std::size_t first = 0; first < all.size(); first += shape.most)
    {
        if (!isAllowed(kind, std::span(all).subspan(first, shape.most)))
        {
            throw inputError(
                path, fmt::format("record {}: expected {}, as finite numbers", first / shape.most + 1, shape.names));
        }
    }
    return all;
}

std::string csvLine(const QueryAnswer& answer, bool has_attributes)
{
    static constexpr std::array kStates = {"nothing", "found", "undecided"};
    static constexpr std::array kFaces = {"x", "y", "z", "inside"};
    std::string line = kStates.at(static_cast<std::size_t>(answer.state));
    if (answer.state != QueryState::Found)
    {
        return line + ",,,,,,,,,,,,,,,,\n";
    }
    line += fmt::format(",{},{},{},{},{},{},{}", answer.cell[0], answer.cell[1], answer.cell[2], kFaces.at(answer.face),
                        answer.t, answer.numerator, answer.denominator);
    if (!has_attributes)
    {
        return line + ",,,,,,,,,\n";
    }
    return line + fmt::format(",{},{},{},{},{},{},{},{},{}\n", answer.color & 255U, answer.color >> 8U & 255U,
                              answer.color >> 16U & 255U, answer.normal[0], answer.normal[1], answer.normal[2],
                              answer.emission[0], answer.emission[1], answer.emission[2]);
}

} // namespace

QueryFormat queryFormatOf(const std::filesystem::path& path)
{
    return extensionOf(path.string()) == ".bin" ? QueryFormat::Binary : QueryFormat::Csv;
}

std::size_t numbersOf(QueryKind kind)
{
    return shapeOf(kind).most;
}

std::vector<double> readQueries(const std::filesystem::path& path, QueryFormat format, QueryKind kind)
{
    const std::vector<std::uint8_t> bytes =
        path == "-" ? std::vector<std::uint8_t>(std::istreambuf_iterator<char>(std::cin), {}) : readFile(path);
    return format == QueryFormat::Binary ? readBinary(path, asText(bytes), kind) : readCsv(path, asText(bytes), kind);
}

std::string queryHeader(QueryFormat format)
{
    return format == QueryFormat::Binary
               ? ""
               : "state,x,y,z,face,t,numerator,denominator,red,green,blue,nx,ny,nz,emission_r,emission_g,emission_b\n";
}

void writeAnswers(Output& output, QueryFormat format, std::span<const QueryAnswer> answers, bool has_attributes)
{
    if (format == QueryFormat::Binary)
    {
        output.write(std::as_bytes(answers));
        return;
    }
    std::string text;
    for (const QueryAnswer& answer : answers)
    {
        text += csvLine(answer, has_attributes);
    }
    output.write(text);
}

} // namespace zvo::cli
