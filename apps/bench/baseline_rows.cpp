// SPDX-License-Identifier: MIT
#include "bench/baseline_rows.h"

#include <cstddef>

namespace zvo::cli
{

void BaselineRows::measure(const BaselineCase& what, const BaselineWork& work, std::uint32_t run_count)
{
    work.baseline();
    work.zvo();
    std::vector<double> baseline_ms;
    std::vector<double> zvo_ms;
    for (std::uint32_t turn = 0; turn < run_count; ++turn)
    {
        if (turn % 2 != 0)
        {
            zvo_ms.push_back(work.zvo());
        }
        baseline_ms.push_back(work.baseline());
        if (turn % 2 == 0)
        {
            zvo_ms.push_back(work.zvo());
        }
    }
    add(what, work.source, work.name, baseline_ms, zvo_ms);
    works.back().on_host = work.on_host;
}

void BaselineRows::add(const BaselineCase& what, const std::string& source, const std::string& work,
                       const std::vector<double>& baseline_ms, const std::vector<double>& zvo_ms)
{
    std::vector<double> ratios;
    for (std::size_t i = 0; i < baseline_ms.size(); ++i)
    {
        ratios.push_back(zvo_ms[i] > 0 ? baseline_ms[i] / zvo_ms[i] : 0.0);
    }
    works.push_back({.what = what,
                     .source = source,
                     .work = work,
                     .on_host = false,
                     .baseline_ms = Spread::of(baseline_ms),
                     .zvo_ms = Spread::of(zvo_ms),
                     .ratio = Spread::of(ratios)});
}

} // namespace zvo::cli
