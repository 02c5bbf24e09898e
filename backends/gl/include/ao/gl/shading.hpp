// Forward shading with ambient occlusion in OpenGL 4.5 core: the executor of ao/shading.hpp's plans, by compute shaders.
//
//     auto shading = ao::gl::shading::create(glfwGetProcAddress);
//     auto plan = ao::make_shade_plan(scene, facts, camera);
//     auto program = shading->prepare_shading(*plan, heap);        // ao::make_texel_heap(scene.textures)
//     auto bound = shading->bind_shading(*program, *plan, images);
//     ao::update(*plan, camera);                                    // each frame
//     for (std::size_t i = 0; i < plan->passes.size(); ++i) shading->record_shading({}, *program, *bound, *plan, i);
//
// Context, errors and lifetimes are as in ao/gl/backend.hpp; options::route is not looked at.
//
// Pictures: GL_TEXTURE_2D, one sample, level 0 of the plan's size, as ao/gl/rasterizer.hpp writes them: depth or position,
// normal, ids, and where the options say so surface, frame, visibility (GL_R32F, GL_R8, GL_RGBA16F). color is GL_RGBA32F, linear,
// written whole. Immutable and mutable textures as in ao/gl/backend.hpp.
//
// Memory beside the host's textures: the table, the heap, 16 bytes per pixel and target of the plan, 256 bytes per pass.
//
// Order. Passes see what earlier draws wrote; where the host wrote an input by image stores, it issues the barrier. After the
// last pass color is ready for texture fetches, image access, framebuffers and read-back.
//
// State. With options::restore_state (the default) a pass leaves all state as it was. Without it, a pass leaves changed: the
// current program; 2-D textures and samplers of units 0 to 5; image units 0 and 1; uniform buffer binding 0 and shader storage
// bindings 0 to 2 with their generic bindings. prepare_shading changes nothing.
#pragma once

#include "ao/gl/backend.hpp"
#include "ao/shading_backend.hpp"

#include <memory>
#include <optional>

namespace ao::gl {

struct shade_program_state;
struct shade_binding_state;

// Linked programs, the table, the heap and the plan's targets.
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

// Views of the host's textures.
class shade_binding {
public:
    shade_binding(shade_binding&&) noexcept;
    shade_binding& operator=(shade_binding&&) noexcept;
    ~shade_binding();

private:
    friend class shading;
    explicit shade_binding(std::unique_ptr<shade_binding_state> state);
    std::unique_ptr<shade_binding_state> state_;
};

class shading {
public:
    using image = unsigned int; // a texture name (GLuint)
    using commands = gl::commands;
    using shade_program = gl::shade_program;
    using shade_binding = gl::shade_binding;

    // Fails as backend::create does.
    static result<shading> create(backend::get_proc_address loader, const options& chosen = {});
    static result<shading> create(backend::get_proc_address_as_data loader, const options& chosen = {});

    shading(shading&&) noexcept;
    shading& operator=(shading&&) noexcept;
    ~shading();

    // errc::invalid_size: a picture beyond the driver's limits; errc::out_of_memory: a heap, a table or targets beyond them;
    // errc::shader.
    result<shade_program> prepare_shading(const shade_plan& p, const texel_heap& heap);
    // errc::plan_mismatch: a table of another size.
    std::optional<error> update_table(shade_program& program, const shade_plan& p);
    // errc::invalid_size, errc::unsupported_format: a texture that does not fit the plan, and which.
    result<shade_binding> bind_shading(shade_program& program, const shade_plan& p, const shade_images<image>& images);
    // No allocation, no error. Constants are uploaded.
    void record_shading(commands into, shade_program& program, shade_binding& bound, const shade_plan& p, std::size_t index);
    // Modulo 2^32. Waits for what was recorded.
    result<std::uint64_t> clamped_weights(shade_program& program);

private:
    shading(std::unique_ptr<functions> loaded, const options& chosen);
    static result<shading> create(std::unique_ptr<functions> loaded, options chosen);

    std::unique_ptr<functions> gl_;
    options options_;
};

static_assert(shading_backend<shading>);

} // namespace ao::gl
