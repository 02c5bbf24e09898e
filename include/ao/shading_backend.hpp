// What executes shading plans: the counterpart of ao/backend.hpp.
#pragma once

#include "ao/shading.hpp"
#include "ao/texture.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ao {

// The host's pictures of one frame: targets of a geometry pass, the visibility, and where the color goes. Those that the plan's
// facts and options leave out are not looked at.
template <class Image>
struct shade_images {
    Image depth{};
    Image position{};
    Image normal{};
    Image ids{};
    Image surface{};
    Image frame{};
    Image visibility{};
    Image color{}; // rgba32f: linear, w = 1; background 0 0 0 0
};

// image and commands: as in `backend`. shade_program: the table, the heap and the pipelines. shade_binding: a program's pictures.
template <class B>
concept shading_backend = requires
{
    typename B::image;
    typename B::commands;
    typename B::shade_program;
    typename B::shade_binding;
}
&&std::movable<typename B::shade_program>&& std::movable<typename B::shade_binding>&& requires(
    B& b, typename B::shade_program& program, typename B::shade_binding& binding, typename B::commands commands,
    const shade_plan& p, const texel_heap& heap, const shade_images<typename B::image>& images, std::size_t index)
{
    // Uploads and compiles; slow. The heap may go afterwards.
    {
        b.prepare_shading(p, heap)
        } -> std::same_as<result<typename B::shade_program>>;
    // The plan's table after set_lights or set_weight, before it is recorded.
    {
        b.update_table(program, p)
        } -> std::same_as<std::optional<error>>;
    {
        b.bind_shading(program, p, images)
        } -> std::same_as<result<typename B::shade_binding>>;
    // Records pass `index`; all of them in order, each after what the one before it wrote.
    { b.record_shading(commands, program, binding, p, index) };
    // Weights found outside [0, 1] or NaN since the program was prepared, one for each pixel and use. Waits for nothing: call
    // when what was recorded has run.
    {
        b.clamped_weights(program)
        } -> std::same_as<result<std::uint64_t>>;
};

} // namespace ao
