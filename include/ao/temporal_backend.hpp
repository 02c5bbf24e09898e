// What executes temporal plans: the counterpart of ao/backend.hpp.
#pragma once

#include "ao/temporal.hpp"

#include <concepts>
#include <cstddef>
#include <optional>
#include <utility>

namespace ao {

// The host's pictures of a frame. `normal` and `motion` are not looked at where the plan's facts leave them out.
// `visibility` must be the same picture in every frame, or be copied by the host where a frame has no steps.
template <class Image>
struct temporal_images {
    Image depth{};
    Image normal{};
    Image motion{};
    Image visibility{}; // 1 = open, in facts::output_format
};

// image and commands: as in `backend`. temporal_program: pipelines, the sequence, the rotations, eye depth and row values where
// the plan has them, and two buffers of history. temporal_binding: a program's pictures.
template <class B>
concept temporal_backend = requires
{
    typename B::image;
    typename B::commands;
    typename B::temporal_program;
    typename B::temporal_binding;
}
&&std::movable<typename B::temporal_program>&& std::movable<typename B::temporal_binding>&& requires(
    B& b, typename B::temporal_program& program, typename B::temporal_binding& binding, typename B::commands commands,
    const temporal_plan& p, const temporal_frame& frame, const temporal_images<typename B::image>& images, std::size_t index)
{
    // Compiles and allocates; slow.
    {
        b.prepare_temporal(p)
        } -> std::same_as<result<typename B::temporal_program>>;
    {
        b.bind_temporal(program, p, images)
        } -> std::same_as<result<typename B::temporal_binding>>;
    // Records step frame.steps[index]; all of them in order.
    { b.record_temporal(commands, program, binding, p, frame, index) };
};

// Temporal ambient occlusion for an engine.
template <temporal_backend B>
class temporal_effect {
public:
    using binding = typename B::temporal_binding;

    // Plans and prepares. `b` must outlive the effect.
    static result<temporal_effect> create(B& b, const temporal_settings& s, const temporal_facts& f)
    {
        const result<temporal_plan> planned = make_temporal_plan(s, f);
        if (!planned) {
            return planned.error();
        }
        result<typename B::temporal_program> program = b.prepare_temporal(*planned);
        if (!program) {
            return program.error();
        }
        return temporal_effect(b, *planned, std::move(*program));
    }

    result<binding> bind(const temporal_images<typename B::image>& images)
    {
        return backend_->bind_temporal(program_, plan_, images);
    }

    // The next frame, seen from `view`. On failure nothing is recorded and the history stays.
    std::optional<error> record(typename B::commands commands, binding& bound, const temporal_camera& view, bool cut = false)
    {
        const result<temporal_frame> frame = next_frame(plan_, state_, view, cut);
        if (!frame) {
            return frame.error();
        }
        for (std::size_t i = 0; i < frame->steps.size(); ++i) {
            backend_->record_temporal(commands, program_, bound, plan_, *frame, i);
        }
        return std::nullopt;
    }

    // The next frame begins anew.
    void reset() { state_ = {}; }

    const temporal_plan& current_plan() const { return plan_; }
    const temporal_state& state() const { return state_; }

private:
    temporal_effect(B& b, const temporal_plan& p, typename B::temporal_program program)
        : backend_(&b),
          plan_(p),
          program_(std::move(program))
    {
    }

    B* backend_;
    temporal_plan plan_;
    temporal_state state_;
    typename B::temporal_program program_;
};

} // namespace ao
