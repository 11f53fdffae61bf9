// SPDX-License-Identifier: MIT
// Files of questions to trees and of their answers (docs/command-line.md).
#pragma once

#include "common/output.h"
#include "zvo/query.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace zvo::cli
{

enum class QueryFormat : std::uint8_t
{
    Csv,   // numbers with commas, a question or an answer a line
    Binary // records of 32-bit words, little-endian
};

/// Binary for the extension .bin, else CSV; so is standard input or output, "-".
QueryFormat queryFormatOf(const std::filesystem::path& path);

/// How many numbers a question of a kind has, with those that may be left out.
std::size_t numbersOf(QueryKind kind);

/// The numbers of all questions in a file, or in standard input for "-". All are finite, but a ray may end at infinity.
/// Throws Error{Input}, which names the line or the record.
std::vector<double> readQueries(const std::filesystem::path& path, QueryFormat format, QueryKind kind);

/// What stands before the answers.
std::string queryHeader(QueryFormat format);

/// Throws Error{Output}.
void writeAnswers(Output& output, QueryFormat format, std::span<const QueryAnswer> answers, bool has_attributes);

} // namespace zvo::cli
