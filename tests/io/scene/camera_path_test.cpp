// SPDX-License-Identifier: MIT
// Camera paths: the points that they pass, and files of them.
#include "io/scene/camera_path.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace zvo
{
namespace
{

const std::vector<CameraKey> kKeys = {
    {0.5, {1, 2, 3}, {0, 0, 0}, 60}, {1.5, {4, 2, 1}, {0, 1, 0}, 40}, {4.0, {5, 3, -2}, {1, 1, 0}, 90}};

void expectSame(const ViewCamera& a, const ViewCamera& b)
{
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.forward, b.forward);
    EXPECT_EQ(a.right, b.right);
    EXPECT_EQ(a.up, b.up);
    EXPECT_EQ(a.vertical_fov, b.vertical_fov);
}

TEST(CameraPath, PassesItsKeysAndStandsStillBeforeAndAfter)
{
    const CameraPath path(kKeys);
    for (const CameraKey& key : kKeys)
    {
        expectSame(path.at(key.seconds), ViewCamera::lookAt(key.eye, key.target, glm::radians(key.fov_degrees)));
    }
    expectSame(path.at(0.0), path.at(0.5));
    expectSame(path.at(100.0), path.at(4.0));
    EXPECT_EQ(path.seconds(), 4.0);
}

TEST(CameraPath, TwoKeysAreAStraightFlightAtOneSpeed)
{
    const CameraPath path({{1, {0, 0, 0}, {0, 0, -1}, 50}, {3, {4, 2, 0}, {4, 2, -1}, 50}});
    for (const double part : {0.0, 0.125, 0.5, 0.75, 1.0})
    {
        const glm::dvec3 place = path.at(1 + 2 * part).position;
        EXPECT_NEAR(place.x, 4 * part, 1e-12);
        EXPECT_NEAR(place.y, 2 * part, 1e-12);
    }
}

TEST(CameraPath, IsSmoothAtKeysAndReproducesQuadraticFlights)
{
    // Tangents of chords are exact for a parabola with equidistant keys.
    std::vector<CameraKey> keys;
    for (int i = 0; i <= 6; ++i)
    {
        const double s = i;
        keys.push_back({s, {s, s * s, 0}, {s, s * s, -1}, 50});
    }
    const CameraPath path(keys);
    for (double s = 1.0; s < 5.0; s += 0.0625) // not at the ends, which have only one chord
    {
        EXPECT_NEAR(path.at(s).position.y, s * s, 1e-12);
    }
    const CameraPath bent(kKeys);
    const double h = 1e-5;
    const glm::dvec3 before = (bent.at(1.5).position - bent.at(1.5 - h).position) / h;
    const glm::dvec3 after = (bent.at(1.5 + h).position - bent.at(1.5).position) / h;
    EXPECT_LT(glm::length(before - after), 1e-3);
}

TEST(CameraPath, FieldsOfViewStayBetweenThoseOfTheKeys)
{
    const CameraPath path(
        {{0, {0, 0, 0}, {0, 0, -1}, 1}, {1, {0, 0, 0}, {0, 0, -1}, 179}, {2, {0, 0, 0}, {0, 0, -1}, 178}});
    for (double s = 0; s <= 2; s += 0.01)
    {
        const double degrees = glm::degrees(path.at(s).vertical_fov);
        EXPECT_GE(degrees, 1 - 1e-9);
        EXPECT_LE(degrees, 179 + 1e-9);
    }
}

TEST(CameraPath, WhereEyeAndTargetMeetTheDirectionStays)
{
    // Half way, eye and target are the same point.
    const CameraPath path({{0, {0, 0, 0}, {0, 0, -2}, 50}, {1, {0, 0, -2}, {0, 0, 0}, 50}});
    EXPECT_EQ(path.at(0.5).forward, glm::dvec3(0, 0, -1));
}

TEST(CameraPath, AFileHasTheSameKeys)
{
    const CameraPath path({{0, {0.1, -1e-9, 1e20}, {1.0 / 3.0, 2, 3}, 33.3}, {0.1 + 0.2, {4, 5, 6}, {7, 8, 9}, 179.9}});
    EXPECT_EQ(parseCameraPath(cameraPathText(path), "p.json").keys(), path.keys());
}

TEST(CameraPath, AFileMayLeaveTheFieldOfViewOut)
{
    const CameraPath path = parseCameraPath(
        R"({"schema": "zvo.camera_path/1", "keys": [{"time": 0, "eye": [1, 2, 3], "target": [0, 0, 0]}]})", "p.json");
    EXPECT_EQ(path.keys().at(0).fov_degrees, 45);
}

// The message about a file, or nothing.
std::string faultOf(const std::string& text)
{
    try
    {
        parseCameraPath(text, "p.json");
        return "";
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Input);
        return error.what();
    }
}

TEST(CameraPath, BadFilesAreOneLineThatSaysWhere)
{
    const auto file = [](const std::string& keys)
    { return R"({"schema": "zvo.camera_path/1", "keys": [)" + keys + "]}"; };
    const std::string good = R"({"time": 1, "eye": [1, 2, 3], "target": [0, 0, 0]})";
    EXPECT_EQ(faultOf(file(good)), "");
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"", "p.json"},
        {"[]", "p.json"},
        {R"({"schema": "zvo.camera_path/2", "keys": []})", "schema"},
        {R"({"keys": []})", "schema"},
        {R"({"schema": "zvo.camera_path/1"})", "keys"},
        {file(""), "needs a key"},
        {file(good + "," + good), "must go up"},
        {file(R"({"time": -1, "eye": [1, 2, 3], "target": [0, 0, 0]})"), "must go up"},
        {file(R"({"time": 1e7, "eye": [1, 2, 3], "target": [0, 0, 0]})"), "must go up"},
        {file(R"({"time": 1, "eye": [1, 2, 3], "target": [1, 2, 3]})"), "two different points"},
        {file(R"({"time": 1, "eye": [1, 2], "target": [0, 0, 0]})"), "keys[0].eye"},
        {file(R"({"time": 1, "eye": [1, 2, 3], "target": [0, 0, 0], "fov": 0})"), "keys[0].fov"},
        {file(R"({"time": 1, "eye": [1, 2, 3], "target": [0, 0, 0], "fov": 180})"), "field of view"},
        {file(R"({"time": 1, "eye": [1, 2, 3], "target": [0, 0, 0], "roll": 1})"), "roll"},
        {file(R"({"time": "1", "eye": [1, 2, 3], "target": [0, 0, 0]})"), "keys[0].time"},
    };
    for (const auto& [text, part] : bad)
    {
        const std::string fault = faultOf(text);
        EXPECT_TRUE(fault.starts_with("p.json")) << text << ": " << fault;
        EXPECT_NE(fault.find(part), std::string::npos) << text << ": " << fault;
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    }
}

TEST(CameraPath, BadKeysAreRefused)
{
    EXPECT_THROW(CameraPath({}), Error);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(CameraPath({{nan, {1, 2, 3}, {0, 0, 0}, 50}}), Error);
    EXPECT_THROW(CameraPath({{0, {nan, 2, 3}, {0, 0, 0}, 50}}), Error);
    EXPECT_THROW(CameraPath({{0, {1, 2, 3}, {0, 0, 0}, nan}}), Error);
}

} // namespace
} // namespace zvo
