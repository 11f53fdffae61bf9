// SPDX-License-Identifier: MIT
// Tables in Markdown, written line by line.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

namespace zvo::cli
{

/// A column of a table of Rows. The first column has names, aligned left; the others have numbers, aligned right.
template <typename Row> struct Column
{
    const char* name;
    int width; // usual width of its values
    std::function<std::string(const Row&)> value;
};

template <typename Row> using Columns = std::vector<Column<Row>>;

template <typename Row>
std::string tableCell(const Columns<Row>& columns, const Column<Row>& column, const std::string& value)
{
    const bool is_name = &column == &columns.front();
    return is_name ? fmt::format(" {:<{}} |", value, column.width) : fmt::format(" {:>{}} |", value, column.width);
}

/// The columns' names, and the line below them.
template <typename Row> std::string columnNames(const Columns<Row>& columns)
{
    std::string names = "|";
    std::string rule = "|";
    for (const Column<Row>& column : columns)
    {
        const bool is_name = &column == &columns.front();
        names += tableCell(columns, column, column.name);
        rule += fmt::format("{:-<{}}{}|", "", column.width + 1, is_name ? "-" : ":");
    }
    return names + "\n" + rule + "\n";
}

/// One line of the table.
template <typename Row> std::string columnValues(const Columns<Row>& columns, const Row& row)
{
    std::string line = "|";
    for (const Column<Row>& column : columns)
    {
        line += tableCell(columns, column, column.value(row));
    }
    return line + "\n";
}

} // namespace zvo::cli
