// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace zvo::vk
{

/// Bounds on the length of a submission.
struct SliceOptions
{
    double submission_ms = 400;   // aimed at; desktop systems stop a GPU after about 2,000; 0: never split anything
    std::uint64_t most_units = 0; // for tests: the most units of one submission; 0: no such bound
};

/// Decides how much work goes into one submission, from the cost of earlier work. A unit is a workgroup of a kernel, or
/// a number of bytes of a fill. Knows nothing of Vulkan. Its decisions never change results.
///
/// Work of unknown cost starts with kFirstUnits. In every run, the first piece of any work should cost at most 1 /
/// kCaution of the target, because the same kernel may cost more on other data. After a measurement, the next piece may
/// have kCaution times as many units.
class SlicePlanner
{
public:
    static constexpr std::uint64_t kFirstUnits = 256;
    static constexpr std::uint64_t kCaution = 8;

    /// The kind of work: any number, such as a kernel's address.
    using Key = std::uint64_t;

    explicit SlicePlanner(const SliceOptions& options) : m_options(options) {}

    void beginRun();

    /// Sets the target in milliseconds of submissions from the next run on. Returns the last target.
    double aimAt(double submission_ms) { return std::exchange(m_options.submission_ms, submission_ms); }

    /// How many of `units` may go into the current submission; 0: submit first. Never 0 for an empty submission.
    std::uint64_t admit(Key key, std::uint64_t units);

    /// Whether work of at most `bound` units, whose number only the device knows, may go into the current submission
    /// without reading the number. If not, the caller reads it and passes it to learnCount().
    bool admitUnseen(Key key, std::uint64_t bound);
    void learnCount(Key key, std::uint64_t bound, std::uint64_t units);

    /// Learns from the submission, which is complete. pass_ms: the time of each admitted piece in order; if empty,
    /// total_ms is the time of all of them together.
    void endSubmission(std::span<const double> pass_ms, double total_ms);

private:
    struct Rate
    {
        double ms_per_unit = 0;     // 0: not known
        double part_of_bound = 1;   // of work whose number of units only the device knows
        bool part_known = false;    // part_of_bound has been seen
        std::uint64_t trusted = 0;  // units of the largest piece measured in this run
        std::uint64_t admitted = 0; // units in the current submission
    };
    struct Piece
    {
        Key key;
        double units;
        double estimate_ms;
    };

    [[nodiscard]] double unitCost(const Rate& rate) const;
    [[nodiscard]] std::uint64_t cautious(const Rate& rate) const;
    void add(Key key, double units);

    SliceOptions m_options;
    std::map<Key, Rate> m_rates;
    std::vector<Piece> m_pieces; // of the current submission
    double m_planned_ms = 0;     // of the current submission
    std::uint64_t m_units = 0;   // of the current submission
};

} // namespace zvo::vk
