// SPDX-License-Identifier: MIT
#pragma once

namespace zvo::cli
{

/// Signals that end the program leave no half-written files; closed pipes and full disks become errors of the write.
void installSignalHandlers();

/// Which signals an InterruptWatch notices.
enum class Noticed
{
    Interrupt, ///< SIGINT (Ctrl-C)
    All        ///< SIGTERM and SIGHUP, too
};

/// While one exists, the first of these signals does not end the program, but is noticed here: so that what is done so
/// far can be written. The second one ends it. One at a time.
class InterruptWatch
{
public:
    explicit InterruptWatch(Noticed noticed = Noticed::Interrupt);
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    [[nodiscard]] bool interrupted() const;
};

} // namespace zvo::cli
