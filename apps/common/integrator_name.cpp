// SPDX-License-Identifier: MIT
#include "common/integrator_name.h"

#include "common/option_groups.h"

#include <algorithm>

namespace zvo::cli
{

Integrator integratorOf(std::string_view option, std::string_view text)
{
    const std::string name = oneOf(option, text, kIntegratorNames);
    return static_cast<Integrator>(std::ranges::find(kIntegratorNames, name) - kIntegratorNames.begin());
}

} // namespace zvo::cli
