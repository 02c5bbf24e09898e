#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace ao::tools {

// From here on the first Ctrl-C (or SIGTERM) only sets the flag, and long work ends at its next look; the second one
// ends the process at once.
void catch_interrupts();
[[nodiscard]] const std::atomic<bool>& interrupted();

// One line on stderr, rewritten in place: what is done, per cent, time left. Silent unless asked for.
class progress_line {
public:
    progress_line(std::string what, bool wanted);
    progress_line(const progress_line&) = delete;
    progress_line& operator=(const progress_line&) = delete;
    ~progress_line(); // wipes the line

    // 0..1, from any thread; writes at most five times a second.
    void update(double share);

    // "truth  42 %, 1:07 left"; no time before the first per cent.
    [[nodiscard]] static std::string text(const std::string& what, double share, double seconds_so_far);

private:
    using clock = std::chrono::steady_clock;

    std::string what;
    bool wanted;
    clock::time_point start = clock::now();
    clock::time_point written{};
    std::size_t width = 0;
    std::mutex busy;
};

} // namespace ao::tools
