// What a backend is: it executes plans on handles that the host owns. It creates no window, no device and no context, and
// while it records it allocates nothing, compiles nothing and takes no lock.
#pragma once

#include "ao/plan.hpp"
#include "ao/result.hpp"

#include <concepts>
#include <cstddef>
#include <utility>

namespace ao {

// The host's pictures of one frame. `normal` is not looked at where facts::normals is from_depth.
// `visibility`: 1 - occlusion, 1 = open, in facts::output_format; of bent normals the directions, too.
template <class Image>
struct host_images {
    Image depth;
    Image normal;
    Image visibility;
};

// image:    a handle of the host: a span, a texture name, an image view
// commands: what recording writes to: a command buffer, or nothing where the API records implicitly
// program:  everything prepared for plans of one structure: pipelines, tables, the plan's own pictures
// binding:  a program's inputs and output bound to pictures of the host
// program and binding are movable, own what they hold and free it when destroyed; the host sees to it that no command that
// uses them is still executing then.
template <class B>
concept backend = requires
{
    typename B::image;
    typename B::commands;
    typename B::program;
    typename B::binding;
}
&&std::movable<typename B::program>&& std::movable<typename B::binding>&& requires(B& b, typename B::program& program,
                                                                                   typename B::binding& binding,
                                                                                   typename B::commands commands, const plan& p,
                                                                                   const host_images<typename B::image>& images,
                                                                                   std::size_t index)
{
    // Compiles and allocates; slow.
    {
        b.prepare(p)
        } -> std::same_as<result<typename B::program>>;
    // Binds pictures of the plan's size and formats; allocates. A program may have several bindings.
    {
        b.bind(program, p, images)
        } -> std::same_as<result<typename B::binding>>;
    // Records pass `index` of a plan with the structure that the program was prepared for. Passes are recorded in order.
    { b.record_pass(commands, program, binding, p, index) };
};

// Ambient occlusion for an engine: a plan and the program that runs it.
template <backend B>
class effect {
public:
    using binding = typename B::binding;

    // Plans and prepares. `b` must outlive the effect.
    static result<effect> create(B& b, const settings& s, const facts& f, const camera& view)
    {
        result<plan> planned = make_plan(s, f, view);
        if (!planned) {
            return planned.error();
        }
        result<typename B::program> program = b.prepare(*planned);
        if (!program) {
            return program.error();
        }
        return effect(b, *planned, std::move(*program));
    }

    result<binding> bind(const host_images<typename B::image>& images) { return backend_->bind(program_, plan_, images); }

    // Takes this frame's camera. On failure the last one stays.
    std::optional<error> set_camera(const camera& view)
    {
        plan next = plan_;
        if (const auto wrong = update(next, view)) {
            return wrong;
        }
        plan_ = next;
        return std::nullopt;
    }

    // Takes settings that keep the plan's structure: radius, bias, and thickness where it stays finite or infinite.
    // plan_mismatch for others: those need another effect.
    std::optional<error> set_settings(const settings& s, const camera& view)
    {
        const result<plan> next = make_plan(s, plan_.facts, view);
        if (!next) {
            return next.error();
        }
        if (!same_structure(plan_, *next)) {
            return error(errc::plan_mismatch, "these settings need another plan: create a new effect");
        }
        plan_ = *next;
        return std::nullopt;
    }

    void record(typename B::commands commands, binding& bound)
    {
        for (std::size_t i = 0; i < plan_.passes.size(); ++i) {
            backend_->record_pass(commands, program_, bound, plan_, i);
        }
    }

    // One pass, for hosts that time or label passes. Record all of them in order.
    void record_pass(typename B::commands commands, binding& bound, std::size_t index)
    {
        backend_->record_pass(commands, program_, bound, plan_, index);
    }

    const ao::plan& current_plan() const { return plan_; }

private:
    effect(B& b, const ao::plan& p, typename B::program program) : backend_(&b), plan_(p), program_(std::move(program)) {}

    B* backend_;
    ao::plan plan_;
    typename B::program program_;
};

} // namespace ao
