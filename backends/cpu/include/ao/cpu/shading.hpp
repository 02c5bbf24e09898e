// Forward shading with ambient occlusion on the CPU: the executor of ao/shading.hpp's plans.
//
//     auto shading = ao::cpu::shading::create();
//     auto plan = ao::make_shade_plan(scene, facts, camera);
//     auto program = shading->prepare_shading(*plan, heap);        // ao::make_texel_heap(scene.textures)
//     auto bound = shading->bind_shading(*program, *plan, images);
//     ao::update(*plan, camera);                                    // each frame
//     for (std::size_t i = 0; i < plan->passes.size(); ++i) shading->record_shading({}, *program, *bound, *plan, i);
//
// Pictures: views of exactly the plan's width and height, at most 2^31 - 1 words of 4 bytes, as ao/cpu/rasterizer.hpp writes
// them: depth (d32f, or d24 in the low 24 bits) or position, normal, ids rg32ui, and where the plan's options say so surface and
// frame rgba32f, visibility r32f, r8 or rgba16f. color is rgba32f, linear, written whole; it may not overlap an input.
//
// Memory of a program: copies of the table and, where it is read, of the heap; 16 bytes per pixel and target of the plan. A
// binding is a few pointers. Nothing is allocated when a pass is recorded, other than tasks by oneTBB.
//
// record_shading runs the pass, pixel by pixel, and returns when it is done; the calling thread works along. Calls may come from
// any thread; a program belongs to one picture at a time. Assumes the default floating-point environment.
//
// Colors are the same bits for every number of threads and tile size: those of the shared functions in scalar C++.
#pragma once

#include "ao/cpu/backend.hpp"
#include "ao/shading_backend.hpp"

#include <memory>
#include <optional>

namespace ao::cpu {

namespace detail {

struct threads;

} // namespace detail

struct shade_program_state;

// The table, the heap, the plan's targets and a counter.
class shade_program {
public:
    shade_program(shade_program&&) noexcept;
    shade_program& operator=(shade_program&&) noexcept;
    ~shade_program();

private:
    friend class shading;
    explicit shade_program(std::unique_ptr<shade_program_state> state);
    std::unique_ptr<shade_program_state> state_;
};

class shade_binding {
    friend class shading;
    explicit shade_binding(const shade_images<image_view>& images) : images_(images) {}
    shade_images<image_view> images_;
};

class shading {
public:
    using image = image_view;
    using commands = cpu::commands;
    using shade_program = cpu::shade_program;
    using shade_binding = cpu::shade_binding;

    // errc::invalid_settings for negative numbers; options::lanes is not looked at.
    static result<shading> create(const options& o = {});

    shading(shading&&) noexcept;
    shading& operator=(shading&&) noexcept;
    ~shading();

    // errc::out_of_memory. Precondition: the heap holds the textures of the plan's scene.
    result<shade_program> prepare_shading(const shade_plan& p, const texel_heap& heap);
    // errc::plan_mismatch: a table of another size.
    std::optional<error> update_table(shade_program& program, const shade_plan& p);
    // errc::unsupported_format, errc::invalid_size: a view that does not fit the plan, and which; errc::plan_mismatch.
    result<shade_binding> bind_shading(shade_program& program, const shade_plan& p, const shade_images<image>& images);
    // Precondition: `p` has the structure that the program was prepared for.
    void record_shading(commands into, shade_program& program, shade_binding& bound, const shade_plan& p, std::size_t index);
    result<std::uint64_t> clamped_weights(shade_program& program);

private:
    explicit shading(std::unique_ptr<detail::threads> workers);
    std::unique_ptr<detail::threads> workers_;
};

static_assert(shading_backend<shading>);

} // namespace ao::cpu
