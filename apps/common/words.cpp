// SPDX-License-Identifier: MIT
#include "common/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace zvo::cli
{

namespace
{

// The letters that must be inserted, left out, replaced or swapped with their neighbours to make b of a, where no
// letter is touched twice.
std::size_t editDistance(std::string_view a, std::string_view b)
{
    const std::size_t width = b.size() + 1;
    std::vector<std::size_t> costs((a.size() + 1) * width); // of the first i letters of a and j of b
    const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return costs[i * width + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i)
    {
        for (std::size_t j = 0; j <= b.size(); ++j)
        {
            if (i == 0 || j == 0)
            {
                at(i, j) = i + j;
                continue;
            }
            const std::size_t replaced = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
            at(i, j) = std::min({replaced, at(i - 1, j) + 1, at(i, j - 1) + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
            {
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
            }
        }
    }
    return at(a.size(), b.size());
}

} // namespace

std::string counted(std::uint64_t count, std::string_view noun)
{
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string suggestion(std::string_view word, std::span<const std::string> names)
{
    constexpr std::size_t kLettersOfASlip = 3; // a longer word may have one for each of so many letters
    constexpr std::size_t kWordMax = 64;       // what is longer is no name
    const std::size_t most = std::clamp<std::size_t>(word.size() / kLettersOfASlip, 1, 2);
    const std::string* closest = nullptr;
    std::size_t least = most + 1;
    for (const std::string& name : names)
    {
        if (word.size() > kLettersOfASlip && name.starts_with(word)) // left off in the middle
        {
            return fmt::format(" (did you mean {}?)", name);
        }
        const std::size_t distance = word.size() > kWordMax ? least : editDistance(word, name);
        if (distance < least)
        {
            least = distance;
            closest = &name;
        }
    }
    return closest == nullptr ? "" : fmt::format(" (did you mean {}?)", *closest);
}

} // namespace zvo::cli
