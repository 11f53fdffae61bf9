// SPDX-License-Identifier: MIT
#include "session.h"

#include "common/session.h"
#include "zvo/error.h"

#include <map>
#include <unistd.h>
#include <utility>

namespace zvo::python
{

namespace
{

struct OpenSessions
{
    std::mutex guard;
    std::map<std::string, std::shared_ptr<Session>> by_name;
};

// Never destroyed: when the process ends, the driver may be gone before.
OpenSessions& openSessions()
{
    static auto* const sessions = new OpenSessions;
    return *sessions;
}

} // namespace

std::shared_ptr<Session> Session::of(const std::string& name)
{
    OpenSessions& sessions = openSessions();
    const std::scoped_lock lock(sessions.guard);
    std::shared_ptr<Session>& session = sessions.by_name[name];
    if (!session)
    {
        session = std::make_shared<Session>(name);
    }
    return session;
}

void Session::closeAll()
{
    std::map<std::string, std::shared_ptr<Session>> closed;
    {
        OpenSessions& sessions = openSessions();
        const std::scoped_lock lock(sessions.guard);
        closed.swap(sessions.by_name);
    }
}

Session::Session(const std::string& name) : m_process(::getpid())
{
    cli::DeviceOptions options;
    options.device = name;
    m_device = cli::openDevice(options);
}

// In a process that was forked, nothing of the device is touched: its threads are not there.
Session::~Session()
{
    if (isForked())
    {
        static_cast<void>(new std::pair(std::move(m_device), std::move(m_retired)));
    }
}

void Session::retire(DeviceTree&& tree) noexcept
{
    if (isForked())
    {
        static_cast<void>(new DeviceTree(std::move(tree)));
        return;
    }
    {
        const std::scoped_lock lock(m_guard);
        m_retired.push_back(std::move(tree));
    }
    if (const std::unique_lock lock(m_in_use, std::try_to_lock); lock)
    {
        freeRetired();
    }
}

void Session::checkProcess() const
{
    if (isForked())
    {
        throw Error(ErrorCode::Usage,
                    "a process that was forked cannot use the device of the one before: start processes "
                    "by multiprocessing's method \"spawn\"");
    }
}

bool Session::isForked() const
{
    return ::getpid() != m_process;
}

void Session::freeRetired()
{
    std::vector<DeviceTree> retired;
    {
        const std::scoped_lock lock(m_guard);
        retired.swap(m_retired);
    }
}

} // namespace zvo::python
