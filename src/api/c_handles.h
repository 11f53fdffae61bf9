// SPDX-License-Identifier: MIT
// The objects behind the handles of the C interface.
#pragma once

#include "zvo/zvo.h"
#include "zvo/zvo.hpp"

#include <deque>

struct ZvoDeviceReport
{
    zvo::DeviceReport object;
};

struct ZvoFeatureStorage
{
    zvo::FeatureStorage object;
};

/// The host's C functions stand in front of the Context, so that they outlive it.
struct ZvoContext
{
    explicit ZvoContext(const ZvoContextInfo& info);
    ZvoContext(const ZvoContext&) = delete;
    ZvoContext& operator=(const ZvoContext&) = delete;

    ZvoMemoryCallbacks memory;
    ZvoLogCallback log;
    zvo::Context object;
    ZvoDeviceReport report;
};

struct ZvoRecorder
{
    zvo::Recorder object;
};

struct ZvoModel
{
    zvo::Model object;
};

struct ZvoTree
{
    zvo::Tree object;
};

struct ZvoTreeBuild
{
    zvo::TreeBuild object;
};

struct ZvoTreeCompression
{
    zvo::TreeCompression object;
};

struct ZvoDynamicTree
{
    zvo::DynamicTree object;
    std::deque<zvo::UpdateStats> updates = {}; // that the host has not taken
};

struct ZvoEnvironment
{
    zvo::Environment object;
};

struct ZvoTracer
{
    zvo::Tracer object;
};

struct ZvoKeptLight
{
    zvo::KeptLight object;
};
