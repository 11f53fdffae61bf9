// SPDX-License-Identifier: MIT
// The table of choices by device, and its overruling by text.
#include "core/base/tuning.h"
#include "core/path/path_tracer.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace zvo
{

namespace
{

std::string tuningRefusal(std::string_view text)
{
    try
    {
        parseTuning("--tuning", text);
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        return error.what();
    }
    ADD_FAILURE() << text << " was taken";
    return {};
}

TEST(Tuning, EveryRowsChoicesAreAmongItsValues)
{
    std::set<std::string_view> names;
    for (const TuningRow& row : tuningTable())
    {
        EXPECT_EQ(&row, &tuningRow(row.tunable));
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_NO_THROW(valueName(row, row.on_software));
        EXPECT_NO_THROW(valueName(row, row.on_gpus));
        EXPECT_EQ(tunedValue("cpu", row.tunable), row.on_software);
        EXPECT_EQ(tunedValue("discrete", row.tunable), row.on_gpus);
        for (const TuningValue& value : row.values)
        {
            const std::string text = std::string(row.name) + "=" + std::string(value.name);
            EXPECT_EQ(tuningText(parseTuning("--tuning", text)), text);
        }
    }
}

TEST(Tuning, WordsStandForTheirEnumerators)
{
    EXPECT_EQ(static_cast<PathForm>(parseTuning("", "path-form=kernel").at("path-form")), PathForm::OneKernel);
    EXPECT_EQ(static_cast<PathForm>(parseTuning("", "path-form=stages").at("path-form")), PathForm::Stages);
}

TEST(Tuning, TextIsReadOrRefused)
{
    EXPECT_TRUE(parseTuning("--tuning", "").empty());
    EXPECT_EQ(tuningText(parseTuning("--tuning", "path-form=stages,block-lanes=8")), "block-lanes=8,path-form=stages");
    EXPECT_NE(tuningRefusal("rows=64").find("--tuning rows=64: expected NAME=VALUE, with one of node-lanes"),
              std::string::npos);
    EXPECT_NE(tuningRefusal("block-lanes").find("expected NAME=VALUE"), std::string::npos);
    EXPECT_NE(tuningRefusal("block-lanes=65").find("expected one of 1, 2"), std::string::npos);
    EXPECT_NE(tuningRefusal("block-lanes=").find("expected one of"), std::string::npos);
    EXPECT_NE(tuningRefusal("path-form=stages,path-form=kernel").find("path-form was given before"), std::string::npos);
    EXPECT_NE(tuningRefusal("path-form=stages,").find("expected NAME=VALUE"), std::string::npos);
    EXPECT_NE(tuningRefusal(",path-form=stages").find("expected NAME=VALUE"), std::string::npos);
}

} // namespace
} // namespace zvo
