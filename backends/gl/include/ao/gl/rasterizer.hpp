// The geometry pass (ao/gbuffer.hpp) in OpenGL 4.5 core, drawn into textures of the host.
//
//     auto gl = ao::gl::rasterizer::create(glfwGetProcAddress);
//     auto plan = ao::plan_drawing(scene, facts);
//     auto model = gl->load(scene, *plan);                          // the scene's memory may go, but for its objects
//     auto targets = gl->bind(*model, images);
//     gl->move(*model, scene);                                      // when objects moved
//     gl->record({}, *model, *targets, camera);                     // each frame
//
// Context, errors and lifetimes are as in ao/gl/backend.hpp: one context, current at every call; rasterizer outlives its models,
// a model its targets.
//
// Textures: GL_TEXTURE_2D, one sample, level 0 of the plan's size. depth: GL_DEPTH_COMPONENT32F or GL_DEPTH32F_STENCIL8 (d32f),
// GL_DEPTH_COMPONENT24 or GL_DEPTH24_STENCIL8 (d24); stencil is neither read nor written. The others as gbuffer_facts says:
// position GL_RGBA32F or GL_RGBA16F, normal GL_RGBA16F, GL_RGBA32F, GL_RGB10_A2 or GL_RG16, motion GL_RG32F or GL_RGBA32F, ids
// GL_RG32UI, surface and frame GL_RGBA32F. What the plan leaves out is neither attached nor written, and its name not looked at.
//
// Projection: any that fold_projection takes, of either depth range, whatever the host's glClipControl is; the first row in
// memory shows the end of NDC y that camera_projection::rows names, by turning y around where that is +1. Depth is cleared to the
// far end and compared with less, or greater where that is 0. Of surfaces at equal depth the first in the plan's order stays.
// Precondition of record: both projections are supported. Motion of points that were behind the eye means nothing.
//
// Normals and tangents are interpolated as the matrices leave them, not normalised in between, and bitangents turn around under
// models that mirror. Footprints come from differences within 2x2 pixels.
//
// Draws: one program for each need of the plan's variants (cull sides and mirroring are state), one glMultiDrawElementsIndirect
// for each variant, or each variant and material with the driver's sampler; objects in a row that share mesh and variant are
// instances.
//
// Memory: vertices in arrays over all meshes, position 12 bytes, and where some variant reads them normal 12, tangent 16, uv 8,
// previous position 12 bytes per vertex; meshes without normals three vertices per triangle; 4 bytes per index; 68 bytes per
// object, 48 more for motion, 20 per draw call. Textures: alpha and normal maps only.
//
// State. With raster_options::restore_state (the default) a pass leaves all state as it was. Without it, a pass leaves changed:
// the current program; vertex array; draw framebuffer; draw indirect buffer; uniform buffer binding 0 and shader storage bindings
// 0 to 3 with their generic bindings; 2-D textures and samplers of units 0 and 1 (the driver's sampler only); viewport 0; depth
// range 0; clip control; depth function; depth mask (on); color masks 0 to 5 (on); culled face (back); front face; polygon mode
// (fill); enabled: depth test, and face culling or not; disabled: blend 0 to 5, scissor test 0, stencil test, dither, color logic
// operation, rasterizer discard, clip distances 0 to 7, depth clamp, polygon offset and smoothing, primitive restart.
// Preconditions: no active transform feedback or conditional rendering. load changes nothing, bind the same.
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/gl/backend.hpp"

#include <cstddef>
#include <memory>
#include <optional>

namespace ao::gl {

struct raster_model_state;
struct raster_targets_state;

// A scene uploaded, and the programs that its variants need.
class raster_model {
public:
    raster_model(raster_model&&) noexcept;
    raster_model& operator=(raster_model&&) noexcept;
    ~raster_model();

    std::size_t programs() const;
    std::size_t draw_calls() const; // of the driver's; those of one multi-draw count as one

private:
    friend class rasterizer;
    explicit raster_model(std::unique_ptr<raster_model_state> state);
    std::unique_ptr<raster_model_state> state_;
};

// A framebuffer of the host's textures, which must outlive it.
class raster_targets {
public:
    raster_targets(raster_targets&&) noexcept;
    raster_targets& operator=(raster_targets&&) noexcept;
    ~raster_targets();

private:
    friend class rasterizer;
    explicit raster_targets(std::unique_ptr<raster_targets_state> state);
    std::unique_ptr<raster_targets_state> state_;
};

class rasterizer {
public:
    using image = unsigned int; // a texture name (GLuint)
    using commands = gl::commands;
    using model = raster_model;
    using targets = raster_targets;

    // Fails as backend::create does, and where vertex shaders cannot read storage buffers.
    static result<rasterizer> create(backend::get_proc_address loader, const raster_options& chosen = {});
    static result<rasterizer> create(backend::get_proc_address_as_data loader, const raster_options& chosen = {});

    rasterizer(rasterizer&&) noexcept;
    rasterizer& operator=(rasterizer&&) noexcept;
    ~rasterizer();

    // errc::invalid_size: a picture or texture beyond the driver's limits; errc::out_of_memory; errc::shader.
    // Precondition: the plan was made from the scene.
    result<model> load(const scene& s, const draw_plan& p);
    // errc::plan_mismatch: other objects than those loaded, or one that mirrors now and did not, or the other way round;
    // errc::invalid_scene: a matrix that is not finite.
    std::optional<error> move(model& loaded, const scene& s);
    // errc::invalid_size, errc::unsupported_format: a texture that does not fit the plan, and which.
    result<targets> bind(model& loaded, const gbuffer_images<image>& images);
    void record(commands into, model& loaded, targets& bound, const gbuffer_camera& camera);

private:
    rasterizer(std::unique_ptr<functions> loaded, const raster_options& chosen);
    static result<rasterizer> create(std::unique_ptr<functions> loaded, const raster_options& chosen);

    std::unique_ptr<functions> gl_;
    raster_options options_;
};

static_assert(ao::rasterizer<rasterizer>);

} // namespace ao::gl
