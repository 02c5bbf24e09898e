// Temporal ambient occlusion in OpenGL 4.5 core: the executor of ao/temporal.hpp's plans, by compute shaders.
//
//     auto gl = ao::gl::temporal::create(glfwGetProcAddress);
//     auto ao = ao::temporal_effect<ao::gl::temporal>::create(*gl, settings, facts);
//     auto bound = ao->bind({ depth_texture, normal_texture, motion_texture, visibility_texture });
//     ao->record({}, *bound, camera);                               // each frame, after the G-buffer, before lighting
//
// Context, errors and lifetimes are as in ao/gl/backend.hpp; options::route is not looked at.
//
// Textures: depth, normal and visibility as in ao/gl/backend.hpp. motion: GL_RG32F, GL_RGBA16F or GL_RGBA32F, as
// temporal_facts says. All are GL_TEXTURE_2D, one sample, level 0 of the plan's size. Immutable textures are read through views.
//
// Memory beside the host's textures, per pixel: 32 bytes of history, 16 where it is packed; 4 bytes with a filter, 4 more unless
// depth is linear; constant: 16 bytes for each sample of the period, 32 KiB of rotations, 512 bytes of constants per step.
//
// Order. Steps see what earlier draws wrote; where the host wrote an input by image stores or from a buffer, it issues the
// barrier. After a frame's last step visibility is ready for texture fetches, image access, framebuffers and read-back, and the
// history for read-back and copies.
//
// State. With options::restore_state (the default) a step leaves all state as it was. Without it, a step leaves changed: the
// current program; 2-D and buffer textures and samplers of units 0 to 5; image unit 0; uniform buffer binding 0 and shader
// storage binding 0 with their generic bindings. prepare_temporal and bind_temporal change nothing.
#pragma once

#include "ao/gl/backend.hpp"
#include "ao/temporal_backend.hpp"

#include <cstddef>
#include <memory>

namespace ao::gl {

struct temporal_program_state;
struct temporal_binding_state;

// Linked programs, the sequence, the rotations, the plan's own pictures and its histories. The context must be current when it is
// destroyed, and the executor alive.
class temporal_program {
public:
    temporal_program(temporal_program&&) noexcept;
    temporal_program& operator=(temporal_program&&) noexcept;
    ~temporal_program();

    // The name of history buffer 0 or 1: history_bytes(plan) bytes of words (ao/shared/history.h). glNamedBufferSubData works.
    unsigned int history(int which) const;

private:
    friend class temporal;
    explicit temporal_program(std::unique_ptr<temporal_program_state> state);
    std::unique_ptr<temporal_program_state> state_;
};

// Views of the host's textures, which may be deleted before it.
class temporal_binding {
public:
    temporal_binding(temporal_binding&&) noexcept;
    temporal_binding& operator=(temporal_binding&&) noexcept;
    ~temporal_binding();

private:
    friend class temporal;
    explicit temporal_binding(std::unique_ptr<temporal_binding_state> state);
    std::unique_ptr<temporal_binding_state> state_;
};

class temporal {
public:
    using image = unsigned int; // a texture name (GLuint)
    using commands = gl::commands;
    using temporal_program = gl::temporal_program;
    using temporal_binding = gl::temporal_binding;

    // Fails as backend::create does.
    static result<temporal> create(backend::get_proc_address loader, const options& chosen = {});
    static result<temporal> create(backend::get_proc_address_as_data loader, const options& chosen = {});

    temporal(temporal&&) noexcept;
    temporal& operator=(temporal&&) noexcept;
    ~temporal();

    // errc::invalid_size: a picture beyond the driver's limits; errc::out_of_memory: a history beyond them; errc::shader: with
    // the first line of the driver's log.
    result<temporal_program> prepare_temporal(const temporal_plan& p);
    // errc::plan_mismatch; errc::invalid_size, errc::unsupported_format: a texture that does not fit the plan, and which.
    result<temporal_binding> bind_temporal(temporal_program& program, const temporal_plan& p,
                                           const temporal_images<image>& images);
    // No allocation, no lock, no error. Constants are uploaded.
    void record_temporal(commands into, temporal_program& program, temporal_binding& bound, const temporal_plan& p,
                         const temporal_frame& frame, std::size_t index);

    // With what automatic has come to.
    const options& chosen() const { return options_; }

private:
    temporal(std::unique_ptr<functions> loaded, const options& chosen);
    static result<temporal> create(std::unique_ptr<functions> loaded, options chosen);

    std::unique_ptr<functions> gl_;
    options options_;
};

static_assert(temporal_backend<temporal>);

} // namespace ao::gl
