// Temporal ambient occlusion (ao/temporal.hpp) on the CPU: the executor of temporal plans, over blocks of N pixels, tile by tile,
// on all cores.
//
//     auto cpu = ao::cpu::temporal::create();
//     auto effect = ao::temporal_effect<ao::cpu::temporal>::create(*cpu, settings, facts);
//     auto bound = effect->bind({ depth, normal, motion, visibility });
//     effect->record({}, *bound, camera);                          // each frame
//
// Pictures: views of exactly the plan's width and height and at most 2^31 - 1 words of 4 bytes, as ao/cpu/backend.hpp says;
// motion rg32f, rgba16f or rgba32f. Visibility may not overlap an input.
//
// Memory of a program: 16 bytes per pixel and history, 8 if it is packed, and there are two; 4 per pixel of eye depth unless the
// input is linear, 4 per pixel if there is a filter, 12 per sample of the period and 32 KiB of rotations. A binding is a few
// pointers. Nothing is allocated by record_temporal, other than tasks by oneTBB.
//
// record_temporal runs the pass and returns when it is done; the calling thread works along. Calls may come from any thread; a
// program belongs to one picture at a time. Assumes the default floating-point environment.
//
// Results, history included, are the same bits for every width, number of threads and tile size (exactness class Q).
#pragma once

#include "ao/cpu/backend.hpp"
#include "ao/temporal_backend.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace ao::cpu {

struct temporal_program_state;

// Tables, pictures between the passes, and the two histories.
class temporal_program {
public:
    temporal_program(temporal_program&&) noexcept;
    temporal_program& operator=(temporal_program&&) noexcept;
    ~temporal_program();

    // Copies history `which`, 0 or 1, out of and into the program, in the order of ao/shared/history_load.h: the words of a
    // pixel, pixel after pixel. False, and nothing done, unless there are history_bytes(plan) / 4 of them.
    bool read_history(int which, std::span<std::uint32_t> words) const;
    bool write_history(int which, std::span<const std::uint32_t> words);

private:
    friend class temporal;
    explicit temporal_program(std::unique_ptr<temporal_program_state> state);
    std::unique_ptr<temporal_program_state> state_;
};

class temporal_binding {
    friend class temporal;
    explicit temporal_binding(const temporal_images<image_view>& images) : images_(images) {}
    temporal_images<image_view> images_;
};

// Fulfils ao::temporal_backend. Must outlive its programs.
class temporal {
public:
    using image = image_view;
    using commands = cpu::commands;
    using temporal_program = cpu::temporal_program;
    using temporal_binding = cpu::temporal_binding;

    // errc::device where the width is not available, errc::invalid_settings for negative numbers.
    static result<temporal> create(const options& o = {});

    temporal(temporal&&) noexcept;
    temporal& operator=(temporal&&) noexcept;
    ~temporal();

    // What was chosen.
    width lanes() const;
    int threads() const;

    // errc::out_of_memory, errc::invalid_size.
    result<temporal_program> prepare_temporal(const temporal_plan& p);
    // errc::unsupported_format, errc::invalid_size: a view that does not fit the plan, and which; errc::plan_mismatch.
    result<temporal_binding> bind_temporal(temporal_program& program, const temporal_plan& p,
                                           const temporal_images<image>& images);
    // Precondition: `p` has the structure that the program was prepared for.
    void record_temporal(commands into, temporal_program& program, temporal_binding& bound, const temporal_plan& p,
                         const temporal_frame& frame, std::size_t index);

private:
    explicit temporal(std::unique_ptr<detail::machine> m);
    std::unique_ptr<detail::machine> machine_;
};

static_assert(temporal_backend<temporal>);

} // namespace ao::cpu
