// SPDX-License-Identifier: MIT
// zvo query: questions to trees in files, and what is no question.
#include "cli/cli_folder.h"
#include "zvo/query.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

// cube.zvo: a cube at 32^3.
class CliQuery : public CliFolder
{
protected:
    CliQuery() { run("build cube.glb --resolution 32 -o cube.zvo"); }

    // The fields of each line that zvo query prints for a file of questions, without the header.
    [[nodiscard]] std::vector<std::vector<std::string>> answers(const std::string& kind, const std::string& questions)
    {
        m_dir.write("questions.csv", questions);
        std::istringstream out(run("query cube.zvo --" + kind + " questions.csv -o -").out);
        std::vector<std::vector<std::string>> lines;
        for (std::string line; std::getline(out, line);)
        {
            std::istringstream fields(line + ",");
            lines.emplace_back();
            for (std::string field; std::getline(fields, field, ',');)
            {
                lines.back().push_back(field);
            }
            EXPECT_EQ(lines.back().size(), 17U) << line;
        }
        EXPECT_EQ(lines.at(0).at(0), "state");
        lines.erase(lines.begin());
        return lines;
    }

    [[nodiscard]] Outcome refused(const std::string& kind, const std::string& questions)
    {
        m_dir.write("bad.csv", questions);
        return runZvo(m_dir.path(), "query cube.zvo --" + kind + " bad.csv -o -");
    }
};

TEST_F(CliQuery, EachKindIsAnsweredInOrder)
{
    const json grid = printedBy("inspect --json cube.zvo")["grid"];
    const double edge = grid["voxel_size"].get<double>() * 32;
    const auto at = [&](double x, double y, double z)
    {
        return std::to_string(grid["origin"][0].get<double>() + x * edge) + "," +
               std::to_string(grid["origin"][1].get<double>() + y * edge) + "," +
               std::to_string(grid["origin"][2].get<double>() + z * edge);
    };
    const auto rays = answers("rays", "x,y,z,dx,dy,dz\n" + at(0.4, 0.4, 2) + ",0,0,-1\n\n# away\n" + at(0.4, 0.4, 2) +
                                          ", 0, 0, 1\r\n" + at(0.4, 0.4, 2) + ",0,0,-1,0,1e-6");
    ASSERT_EQ(rays.size(), 3U);
    EXPECT_EQ(rays[0][0], "found");
    EXPECT_EQ(rays[0][4], "z");
    EXPECT_NE(rays[0][8], "");
    EXPECT_EQ(rays[1][0], "nothing");
    EXPECT_EQ(rays[2][0], "nothing");
    const std::string x = rays[0][1];
    const std::string y = rays[0][2];
    const std::string z = rays[0][3];
    const std::string middle = at((std::stod(x) + 0.5) / 32, (std::stod(y) + 0.5) / 32, (std::stod(z) + 0.5) / 32);
    EXPECT_EQ(answers("points", middle + "\n" + at(0.4, 0.4, 2)),
              (std::vector<std::vector<std::string>>{
                  {"found", x, y, z, "inside", "0", "0", "1", rays[0][8], rays[0][9], rays[0][10], rays[0][11],
                   rays[0][12], rays[0][13], "0", "0", "0"},
                  {"nothing", "", "", "", "", "", "", "", "", "", "", "", "", "", "", "", ""}}));
    const auto nearest = answers("nearest", middle + "\n" + at(0.4, 0.4, 2) + "\n" + at(0.4, 0.4, 2) + ",0.001");
    EXPECT_EQ(nearest.at(0)[6], "0");
    EXPECT_GT(std::stod(nearest.at(1)[5]), 0.9 * edge);
    EXPECT_EQ(nearest.at(2)[0], "nothing");
    const auto boxes = answers("boxes", at(0, 0, 0) + "," + at(1, 1, 1) + "\n" + at(2, 2, 2) + "," + at(3, 3, 3));
    EXPECT_EQ(boxes.at(0)[0], "found");
    EXPECT_EQ(boxes.at(1)[0], "nothing");
    const auto sweeps =
        answers("sweeps", at(0.4, 0.4, 2) + "," + at(0.41, 0.41, 2.1) + ",0,0," + std::to_string(-2 * edge));
    EXPECT_EQ(sweeps.at(0)[3], z);
    EXPECT_EQ(sweeps.at(0)[4], "z");
    EXPECT_GT(std::stod(sweeps.at(0)[5]), 0.4);
}

TEST_F(CliQuery, BinaryFilesHoldTheSame)
{
    const std::vector<float> points = {0.1F, 0.2F, 0.3F, 100, 0, 0, 0, 0, 0};
    std::string bytes(points.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), points.data(), bytes.size());
    m_dir.write("points.bin", bytes);
    run("query cube.zvo --points points.bin -o answers.bin");
    EXPECT_EQ(file("answers.bin").size(), 3 * sizeof(QueryAnswer));
    m_dir.write("points.raw", bytes);
    EXPECT_EQ(run("query cube.zvo --points points.raw --format bin -o -").out, file("answers.bin"));
    run("query cube.zvo --points points.bin -o from_binary.csv");
    m_dir.write("points.csv", "0.1,0.2,0.3\n100,0,0\n0,0,0\n");
    run("query cube.zvo --points points.csv -o from_text.csv");
    EXPECT_EQ(file("from_binary.csv"), file("from_text.csv"));
    m_dir.write("near.csv", "100,0,0\n");
    run("query cube.zvo --nearest near.csv -o near.bin");
    QueryAnswer answer;
    std::memcpy(static_cast<void*>(&answer), file("near.bin").data(), sizeof(answer));
    EXPECT_EQ(answer.state, QueryState::Found);
    EXPECT_GT(answer.t, 90.0F);
    EXPECT_NE(answer.color, 0U);
}

TEST_F(CliQuery, WhatIsNoQuestionIsAnErrorWithItsLine)
{
    expectErrorLine(refused("points", "1,2,3\n1,2\n"), 3, {"bad.csv", "line 2", "x,y,z"});
    expectErrorLine(refused("points", "1,2,3,4\n"), 3, {"line 1"});
    expectErrorLine(refused("points", "\n#\n1,2,nan\n"), 3, {"line 3"});
    expectErrorLine(refused("rays", "1,2,3,inf,0,0\n"), 3, {"line 1"});
    expectErrorLine(refused("nearest", "1,2,3,-1\n"), 3, {"line 1"});
    expectErrorLine(refused("boxes", "x\nx,2,3,4,5,6\n"), 3, {"line 2"});
    m_dir.write("short.bin", "0123456789abcd");
    expectError("query cube.zvo --points short.bin -o -", 3, {"record 2", "12 bytes"});
    expectError("query cube.zvo --points no.csv -o -", 3, {"no.csv"});
    expectError("query cube.glb --points short.bin -o -", 3, {"zvo build"});
    expectError("query cube.zvo -o -", 2, {"--points"});
    expectError("query cube.zvo --points a --rays b -o -", 2, {"--points"});
    m_dir.write("one.csv", "1,2,3\n");
    expectError("query cube.zvo --points one.csv -o one.csv -f", 2, {"one.csv"});
    EXPECT_EQ(answers("points", "").size(), 0U);
}

} // namespace
} // namespace zvo::test
