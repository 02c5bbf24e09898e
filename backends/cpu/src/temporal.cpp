#include "ao/cpu/temporal.hpp"

#include "machine.hpp"
#include "views.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace ao::cpu {

struct temporal_program_state {
    temporal_plan plan; // what it was prepared for
    int pitch = 0;      // floats between rows of the pictures
    std::size_t pixels = 0;
    int words = 0; // of a pixel's history
    std::size_t period = 0;
    detail::aligned_floats rotation;
    detail::aligned_floats taps;
    detail::aligned_floats linear_depth;
    detail::aligned_floats rows;
    std::array<detail::aligned_words, 2> histories; // as temporal_resources.hpp reads them
    std::unique_ptr<std::uint8_t[]> filtered;       // of each row of each tile
    int tile_width = 0;

    std::size_t history_size() const { return static_cast<std::size_t>(words) * pixels; }
};

temporal_program::temporal_program(std::unique_ptr<temporal_program_state> state) : state_(std::move(state)) {}
temporal_program::temporal_program(temporal_program&&) noexcept = default;
temporal_program& temporal_program::operator=(temporal_program&&) noexcept = default;
temporal_program::~temporal_program() = default;

bool temporal_program::read_history(int which, std::span<std::uint32_t> words) const
{
    if (words.size() != state_->history_size()) {
        return false;
    }
    const std::uint32_t* from = state_->histories[static_cast<std::size_t>(which)].get();
    const auto each = static_cast<std::size_t>(state_->words);
    for (std::size_t i = 0; i < words.size(); ++i) {
        words[i] = from[i % each * state_->pixels + i / each];
    }
    return true;
}

bool temporal_program::write_history(int which, std::span<const std::uint32_t> words)
{
    if (words.size() != state_->history_size()) {
        return false;
    }
    std::uint32_t* to = state_->histories[static_cast<std::size_t>(which)].get();
    const auto each = static_cast<std::size_t>(state_->words);
    for (std::size_t i = 0; i < words.size(); ++i) {
        to[i % each * state_->pixels + i / each] = words[i];
    }
    return true;
}

temporal::temporal(std::unique_ptr<detail::machine> m) : machine_(std::move(m)) {}
temporal::temporal(temporal&&) noexcept = default;
temporal& temporal::operator=(temporal&&) noexcept = default;
temporal::~temporal() = default;

width temporal::lanes() const
{
    return machine_->lanes;
}

int temporal::threads() const
{
    return machine_->workers->count();
}

result<temporal> temporal::create(const options& o)
{
    auto made = detail::make_machine(o);
    if (!made) {
        return made.error();
    }
    return temporal(std::move(*made));
}

result<temporal_program> temporal::prepare_temporal(const temporal_plan& p)
{
    const facts& f = p.facts.frame;
    std::unique_ptr<temporal_program_state> made(new (std::nothrow) temporal_program_state);
    if (!made) {
        return error(errc::out_of_memory, "no memory for a program");
    }
    bool filters = false;
    for (const temporal_step& step : p.steps) {
        filters = filters || step.type == temporal_pass_type::filter_rows;
    }
    made->plan = p;
    made->pitch = detail::padded_pitch(f.width);
    made->pixels = static_cast<std::size_t>(f.width) * static_cast<std::size_t>(f.height);
    const std::size_t padded = static_cast<std::size_t>(made->pitch) * static_cast<std::size_t>(f.height);
    if (padded > 0x7fffffffU) {
        return error(errc::invalid_size, "more than 2^31 - 1 pixels");
    }
    made->words = math<float>::ao_history_words(static_cast<int>(p.settings.format));
    made->period = static_cast<std::size_t>(p.settings.period);

    made->rotation = detail::allocate(2 * tile_size * tile_size);
    made->taps = detail::allocate(4 * made->period);
    bool complete = made->rotation && made->taps;
    if (p.linearize) {
        made->linear_depth = detail::allocate(padded);
        complete = complete && made->linear_depth;
    }
    if (filters) {
        made->rows = detail::allocate(padded);
        complete = complete && made->rows;
    }
    for (detail::aligned_words& history : made->histories) {
        history = detail::allocate_words(made->history_size());
        complete = complete && history;
    }
    made->tile_width = machine_->workers->tile_width;
    const int columns = (f.width + made->tile_width - 1) / made->tile_width;
    made->filtered.reset(new (std::nothrow) std::uint8_t[static_cast<std::size_t>(columns) * static_cast<std::size_t>(f.height)]);
    complete = complete && made->filtered;
    if (!complete) {
        return error(errc::out_of_memory, "no memory for the histories and the pictures between the passes");
    }
    for (const detail::aligned_words& history : made->histories) {
        std::fill_n(history.get(), made->history_size(), 0U);
    }
    detail::fill_rotation(made->rotation.get(), make_tile(p.settings));
    for (std::size_t i = 0; i < made->period; ++i) {
        const glm::vec4 tap = temporal_tap(p.settings, static_cast<std::uint32_t>(i));
        for (std::size_t component = 0; component < 4; ++component) {
            made->taps[component * made->period + i] = tap[static_cast<glm::length_t>(component)];
        }
    }
    return temporal_program(std::move(made));
}

result<temporal_binding> temporal::bind_temporal(temporal_program& program, const temporal_plan& p,
                                                 const temporal_images<image>& images)
{
    const facts& f = p.facts.frame;
    if (!same_program(program.state_->plan, p)) {
        return error(errc::plan_mismatch, "the plan differs from the one prepared");
    }
    struct expected {
        const image_view& view;
        const char* name;
        pixel_format format;
        bool wanted;
    };
    const expected all[] = {
        { images.depth, "depth", f.depth_format, true },
        { images.normal, "normal", f.normal_format, f.normals != normal_source::from_depth },
        { images.motion, "motion", p.facts.motion_format, p.facts.motion },
        { images.visibility, "visibility", f.output_format, true },
    };
    for (const expected& each : all) {
        if (each.wanted) {
            if (const auto wrong = detail::unfit(each.view, f.width, f.height, each.format, each.name)) {
                return *wrong;
            }
        }
    }
    return temporal_binding(images);
}

void temporal::record_temporal(commands, temporal_program& program, temporal_binding& bound, const temporal_plan& p,
                               const temporal_frame& frame, std::size_t index)
{
    const temporal_program_state& state = *program.state_;
    const temporal_images<image_view>& images = bound.images_;
    const temporal_step& step = p.steps[frame.steps[index]];
    const detail::plane stored = detail::plane_of(images.depth);
    const detail::plane linear = detail::plane_of(state.linear_depth, state.pitch);
    if (step.type == temporal_pass_type::linearize) {
        detail::pass_arguments a;
        a.options.affine = step.options.affine;
        std::memcpy(a.constants, step.constants.data(), step.constants_size);
        a.width = p.facts.frame.width;
        a.height = p.facts.frame.height;
        a.source = stored;
        a.target = linear;
        return machine_->run(machine_->kernels.linearize, a);
    }

    const bool accumulates = step.type == temporal_pass_type::accumulate;
    const detail::plane rows = detail::plane_of(state.rows, state.pitch);
    detail::temporal_arguments a;
    a.options = step.options;
    assert(step.constants_size <= sizeof a.constants);
    std::memcpy(a.constants, step.constants.data(), step.constants_size);
    a.width = p.facts.frame.width;
    a.height = p.facts.frame.height;
    a.depth = p.linearize ? linear : stored;
    a.normal = detail::plane_of(images.normal);
    a.motion = detail::plane_of(images.motion);
    a.rows = rows;
    a.target = step.type == temporal_pass_type::filter_rows ? rows : detail::plane_of(images.visibility);
    a.read = state.histories[static_cast<std::size_t>(accumulates ? frame.read : frame.write)].get();
    a.write = state.histories[static_cast<std::size_t>(frame.write)].get();
    a.history_plane = state.pixels;
    a.history_words = state.words;
    a.rotation = state.rotation.get();
    a.taps = state.taps.get();
    a.tap_plane = state.period;
    assert(state.tile_width == machine_->workers->tile_width);
    a.filtered = state.filtered.get();
    a.tile_width = state.tile_width;

    const detail::temporal_kernel_table& kernels = machine_->kernels.temporal;
    switch (step.type) {
    case temporal_pass_type::linearize:
        return;
    case temporal_pass_type::accumulate: {
        const int motion = step.options.reproject ? (step.options.cubic ? 2 : 1) : 0;
        const std::size_t precise = p.settings.format == history_format::precise ? 1 : 0;
        return machine_->run(kernels.accumulate[motion].of[step.options.contribution][precise], a);
    }
    case temporal_pass_type::filter_rows:
        return machine_->run(kernels.filter_rows, a);
    case temporal_pass_type::filter_columns:
        return machine_->run(kernels.filter_columns, a);
    case temporal_pass_type::resolve:
        return machine_->run(kernels.resolve, a);
    }
}

} // namespace ao::cpu
