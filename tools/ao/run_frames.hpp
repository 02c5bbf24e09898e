#pragma once

#include "ao/backend.hpp"
#include "ao/runs.hpp"
#include "scene/error.hpp"
#include "scene/signals.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <numeric>

namespace ao::tools {

// The value, or `error` with where it was missing and why.
template <class Result>
auto take(const std::string& where, Result result)
{
    if (result)
        return std::move(*result);
    if constexpr (requires { result.error().reason(); })
        throw error(where + ": " + one_line(std::string(result.error().reason())));
    else
        throw error(where + ": " + one_line(result.reason()));
}

class stopwatch {
public:
    [[nodiscard]] double ms() const { return std::chrono::duration<double, std::milli>(clock::now() - start).count(); }

private:
    using clock = std::chrono::steady_clock;
    clock::time_point start = clock::now();
};

inline const char* name_of(pass_type type)
{
    switch (type) {
    case pass_type::linearize:
        return "linearize";
    case pass_type::occlusion:
        return "occlusion";
    case pass_type::filter_rows:
        return "filter rows";
    case pass_type::filter_columns:
        return "filter columns";
    }
    return "unknown";
}

inline double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Fills in the outcome's times. `draw` draws a frame, waits for it, and returns the milliseconds of each pass;
// `since` runs from before the program was prepared.
template <class Draw>
void time_frames(run_outcome& out, const plan& p, int frames, const stopwatch& since, Draw draw)
{
    const auto stop_if_asked = [] {
        if (interrupted())
            throw error("interrupted");
    };
    (void)draw();
    out.first_frame_ms = since.ms();
    stop_if_asked();
    std::vector<std::vector<double>> times(p.passes.size());
    std::vector<double> totals;
    for (int frame = 0; frame < frames; ++frame) {
        const std::vector<double> ms = draw();
        for (std::size_t i = 0; i < ms.size(); ++i)
            times[i].push_back(ms[i]);
        totals.push_back(std::accumulate(ms.begin(), ms.end(), 0.0));
        stop_if_asked();
    }
    for (std::size_t i = 0; i < times.size(); ++i)
        out.passes.push_back({ name_of(p.passes[i].type), median(times[i]) });
    out.total_ms = median(totals);
}

// For APIs whose passes can be waited for one by one.
template <class Effect, class Commands, class Binding, class Finish>
std::vector<double> draw_pass_by_pass(Effect& effect, Commands commands, Binding& bound, Finish finish)
{
    std::vector<double> ms;
    for (std::size_t i = 0; i < effect.current_plan().passes.size(); ++i) {
        const stopwatch watch;
        effect.record_pass(commands, bound, i);
        finish();
        ms.push_back(watch.ms());
    }
    return ms;
}

inline std::vector<float> floats_of(const picture& p)
{
    std::vector<float> values(p.pixels());
    std::memcpy(values.data(), p.bytes.data(), p.bytes.size());
    return values;
}

} // namespace ao::tools
