#include "signals.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <utility>

namespace ao::tools {
namespace {

std::atomic<bool> flag{ false };
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not take locks");

extern "C" void on_interrupt(int)
{
    flag.store(true);
}

} // namespace

void catch_interrupts()
{
    struct sigaction action = {};
    action.sa_handler = on_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interrupted()
{
    return flag;
}

progress_line::progress_line(std::string w, bool asked) : what(std::move(w)), wanted(asked) {}

progress_line::~progress_line()
{
    if (width > 0)
        std::fprintf(stderr, "\r%*s\r", static_cast<int>(width), "");
}

std::string progress_line::text(const std::string& what, double share, double seconds_so_far)
{
    const int percent = static_cast<int>(std::clamp(share, 0.0, 1.0) * 100.0);
    std::string line = what + "  " + std::to_string(percent) + " %";
    if (percent > 0) {
        const auto left = std::lround(seconds_so_far * (1.0 - share) / share);
        const auto seconds = std::to_string(left % 60);
        line += ", " + std::to_string(left / 60) + ":" + (seconds.size() < 2 ? "0" : "") + seconds + " left";
    }
    return line;
}

void progress_line::update(double share)
{
    if (!wanted)
        return;
    const std::lock_guard lock(busy);
    const clock::time_point now = clock::now();
    if (now - written < std::chrono::milliseconds(200))
        return;
    written = now;
    const std::string line = text(what, share, std::chrono::duration<double>(now - start).count());
    std::fprintf(stderr, "\r%-*s", static_cast<int>(std::max(width, line.size())), line.c_str());
    std::fflush(stderr);
    width = std::max(width, line.size());
}

} // namespace ao::tools
