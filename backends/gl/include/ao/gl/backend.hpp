// Ambient occlusion in OpenGL 4.5 core (ao::gl), on the host's context and textures.
//
//     auto gl = ao::gl::backend::create(glfwGetProcAddress);        // or SDL_GL_GetProcAddress, eglGetProcAddress, …
//     auto ao = ao::effect<ao::gl::backend>::create(*gl, settings, facts, camera);
//     auto bound = ao->bind({ depth_texture, normal_texture, visibility_texture });
//     ao->set_camera(camera);                                       // each frame
//     ao->record({}, *bound);                                       // after the G-buffer, before lighting
//
// Context. One context of at least 4.5 core, current at every call and when backend, program and binding are destroyed; the
// thread may change, one at a time. Several contexts: a backend each. backend outlives its programs, a program its bindings.
// The library links against no GL library, and its headers include none.
//
// Textures: GL_TEXTURE_2D, one sample, level 0 of the plan's size, with a sized internal format:
//   depth       linear: GL_R32F, eye depth d = -z in scene units, d > 0; 0, negative, NaN, infinite: background.
//               hardware: GL_DEPTH_COMPONENT32F, GL_DEPTH32F_STENCIL8 (d32f), GL_DEPTH_COMPONENT24, GL_DEPTH24_STENCIL8 (d24)
//               or GL_R32F; window depth as gl_FragCoord.z gives it with the default glDepthRange. State the projection with
//               depth_range::minus_one_to_one unless glClipControl chose zero to one.
//               position: GL_RGBA16F or GL_RGBA32F, view space, scene units; only z is read, z >= 0: background.
//   normal      view space, or world space with facts::world_normals; any length.
//               vector: GL_RGBA16F or GL_RGBA32F, xyz. unorm10: GL_RGB10_A2, n * 0.5 + 0.5. octahedral: GL_RG16, the same of
//               the octahedral map. from_depth: none; the name is not looked at.
//   visibility  GL_R32F or GL_R8, with bent normals GL_RGBA16F; 1 = open, 0 = occluded; level 0 is written whole.
// The last bit of d24 as a float is the driver's: llvmpipe multiplies by the rounded 1 / (2^24 - 1), one step off for half of
// the codes. Everything else is exact.
// The first row in memory is the bottom row of the picture in GL's convention: camera_projection's Y points up.
// Immutable textures (glTextureStorage2D) are read through views of the backend's own: their swizzle, depth-stencil mode and
// levels do not matter. Those of glTexImage2D must have the default swizzle, GL_DEPTH_COMPONENT as depth-stencil mode and base
// level 0; bind() checks that, afterwards they must stay. Filters, wrapping and comparison never matter.
// A texture must not be in the host's framebuffer with depth writes on while the passes run (a feedback loop).
//
// Memory beside the host's textures, per pixel: 12 bytes with a filter (docs/integrating.md: of bitmask others), 4 more unless
// depth is linear; constant: 32 KiB of rotations, 16 KiB of taps, 1 KiB of constants per program.
//
// Order. Passes see what earlier draws wrote; where the host wrote an input by image stores or from a buffer, it issues the
// barrier. After the last pass visibility is ready for texture fetches, image access, framebuffers and read-back.
//
// State. With options::restore_state (the default) a pass leaves all state as it was. Without it, a pass leaves changed
//   both routes: the current program; 2-D textures and samplers of units 0 to 2 (never glActiveTexture); uniform buffer bindings
//                0 and 1 and the generic GL_UNIFORM_BUFFER binding;
//   compute:     image unit 0;
//   fragment:    the vertex array; the draw framebuffer; viewport 0; color mask 0 (all on); polygon mode (fill); disabled: blend
//                and scissor test of index 0, depth and stencil test, face culling, dither, color logic operation, rasterizer
//                discard, clip distances 0 to 7.
// Preconditions of the fragment route: no active transform feedback or conditional rendering; a running occlusion or
// statistics query counts the passes. GL errors that the host left pending are dropped by create(), prepare() and bind();
// recording neither raises nor reads errors.
#pragma once

#include "ao/backend.hpp"
#include "ao/gl/options.hpp"
#include "ao/gl/program.hpp"

#include <cstddef>
#include <memory>
#include <string>

namespace ao::gl {

struct functions;

// Nothing: GL records into the current context.
struct commands {};

class backend {
public:
    using image = unsigned int; // a texture name (GLuint)
    using commands = gl::commands;
    using program = gl::program;
    using binding = gl::binding;

    // Both kinds of loader that window libraries have. They may answer null for what the driver lacks.
    using get_proc_address = void (*(*)(const char*))();
    using get_proc_address_as_data = void* (*)(const char*);

    // errc::device: no context, OpenGL below 4.5, a missing entry point, SPIR-V asked for but not offered;
    // errc::invalid_settings: a group size beyond the driver's limits. Loaders are called here only.
    static result<backend> create(get_proc_address loader, const options& chosen = {});
    static result<backend> create(get_proc_address_as_data loader, const options& chosen = {});

    backend(backend&&) noexcept;
    backend& operator=(backend&&) noexcept;
    ~backend();

    // errc::invalid_size: beyond the driver's limits; errc::shader: with the first line of the driver's log.
    result<program> prepare(const plan& p);
    // errc::invalid_size, errc::unsupported_format: a texture that does not fit the plan, and which.
    result<binding> bind(program& prepared, const plan& p, const host_images<image>& images);
    // No allocation, no lock, no error. Constants are uploaded (at most 128 bytes) where they changed.
    void record_pass(commands into, program& prepared, binding& bound, const plan& p, std::size_t index);

    // GL_RENDERER.
    const std::string& device() const { return device_; }
    // With what automatic has come to.
    const options& chosen() const { return options_; }

private:
    backend(std::unique_ptr<functions> loaded, const options& chosen);
    static result<backend> create(std::unique_ptr<functions> loaded, options chosen);

    // On the heap, where programs and bindings keep pointing when the backend moves.
    std::unique_ptr<functions> gl_;
    options options_;
    std::string device_;
};

static_assert(ao::backend<backend>);

} // namespace ao::gl
