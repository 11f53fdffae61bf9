// SPDX-License-Identifier: MIT
#include "cli/cli_run.h"

#include <algorithm>

namespace zvo::test
{

namespace
{

// Lists the paths of fields with their types. The first element stands for all of an array.
void listFields(const json& value, const std::string& path, std::vector<std::string>& fields)
{
    if (value.is_object() && !value.empty())
    {
        for (const auto& [name, member] : value.items())
        {
            listFields(member, path.empty() ? name : path + "." + name, fields);
        }
    }
    else if (value.is_array() && !value.empty())
    {
        listFields(value.front(), path + "[]", fields);
    }
    else
    {
        fields.push_back(path + " " + value.type_name());
    }
}

} // namespace

void expectFields(const json& value, const std::vector<std::string>& expected)
{
    std::vector<std::string> fields;
    listFields(value, "", fields);
    for (const std::string& field : expected)
    {
        EXPECT_NE(std::find(fields.begin(), fields.end(), field), fields.end()) << field << " is not in " << value;
    }
}

} // namespace zvo::test
