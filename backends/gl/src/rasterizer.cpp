#include "ao/gl/rasterizer.hpp"

#include "host_texture.hpp"
#include "limits.hpp"
#include "raster_state.hpp"
#include "saved_state.hpp"
#include "state.hpp"

#include <array>
#include <cassert>
#include <utility>

namespace ao::gl {

raster_model::raster_model(std::unique_ptr<raster_model_state> state) : state_(std::move(state)) {}
raster_model::raster_model(raster_model&&) noexcept = default;
raster_model& raster_model::operator=(raster_model&&) noexcept = default;
raster_model::~raster_model() = default;
std::size_t raster_model::programs() const
{
    return state_->programs.size();
}
std::size_t raster_model::draw_calls() const
{
    return state_->batches.size();
}

raster_targets::raster_targets(std::unique_ptr<raster_targets_state> state) : state_(std::move(state)) {}
raster_targets::raster_targets(raster_targets&&) noexcept = default;
raster_targets& raster_targets::operator=(raster_targets&&) noexcept = default;
raster_targets::~raster_targets() = default;

rasterizer::rasterizer(std::unique_ptr<functions> loaded, const raster_options& chosen) : gl_(std::move(loaded)), options_(chosen)
{
}
rasterizer::rasterizer(rasterizer&&) noexcept = default;
rasterizer& rasterizer::operator=(rasterizer&&) noexcept = default;
rasterizer::~rasterizer() = default;

result<rasterizer> rasterizer::create(std::unique_ptr<functions> loaded, const raster_options& chosen)
{
    options settled;
    settled.route = route::fragment;
    settled.source = chosen.source;
    if (const auto wrong = settle(*loaded, settled)) {
        return *wrong;
    }
    if (loaded->integer(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS) < 2) {
        return error(errc::device, "vertex shaders of the driver cannot read storage buffers");
    }
    raster_options own = chosen;
    own.source = settled.source;
    return rasterizer(std::move(loaded), own);
}

result<rasterizer> rasterizer::create(backend::get_proc_address loader, const raster_options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = gl::load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

result<rasterizer> rasterizer::create(backend::get_proc_address_as_data loader, const raster_options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = gl::load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

namespace {

// Color targets by location.
struct target {
    GLuint texture;
    const char* role;
    pixel_format format;
    bool wanted;
};

std::array<target, target_count> targets_of(const gbuffer_images<GLuint>& images, const gbuffer_facts& f)
{
    return { { { images.position, "position", f.position_format, f.position },
               { images.normal, "normal", f.normal_format, f.normal },
               { images.motion, "motion", f.motion_format, f.motion },
               { images.ids, "ids", pixel_format::rg32ui, f.ids },
               { images.surface, "surface", pixel_format::rgba32f, f.surface },
               { images.frame, "frame", pixel_format::rgba32f, f.frame } } };
}

} // namespace

result<raster_targets> rasterizer::bind(model& loaded, const gbuffer_images<image>& images)
{
    const functions& gl = *gl_;
    gl.take_error();
    const gbuffer_facts& f = loaded.state_->facts;
    if (const auto wrong = check_texture(gl, images.depth, "depth", f.depth_format, f.width, f.height)) {
        return *wrong;
    }
    auto state = std::make_unique<raster_targets_state>();
    state->framebuffer = make_object(gl, object_type::framebuffer, gl.CreateFramebuffers);
    const GLuint name = state->framebuffer.name();
    gl.NamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, images.depth, 0);
    std::array<GLenum, target_count> drawn{};
    const auto colors = targets_of(images, f);
    for (GLuint i = 0; i < target_count; ++i) {
        const target& each = colors[i];
        drawn[i] = GL_NONE;
        if (each.wanted) {
            if (const auto wrong = check_texture(gl, each.texture, each.role, each.format, f.width, f.height)) {
                return *wrong;
            }
            drawn[i] = GL_COLOR_ATTACHMENT0 + i;
            gl.NamedFramebufferTexture(name, drawn[i], each.texture, 0);
        }
    }
    gl.NamedFramebufferDrawBuffers(name, target_count, drawn.data());
    const GLenum status = gl.CheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return error(errc::device, "the driver does not render to these targets together", static_cast<int>(status));
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("binding the targets", code);
    }
    return raster_targets(std::move(state));
}

namespace {

void set_state(const functions& gl, const gbuffer_facts& f, const gbuffer_camera& camera, GLenum closer)
{
    const std::array<GLfloat, 4> viewport{ 0.0F, 0.0F, static_cast<GLfloat>(f.width), static_cast<GLfloat>(f.height) };
    gl.ViewportIndexedfv(0, viewport.data());
    gl.DepthRangeIndexed(0, 0.0, 1.0);
    gl.ClipControl(GL_LOWER_LEFT, camera.projection.range == depth_range::zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    for (GLuint i = 0; i < target_count; ++i) {
        gl.ColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl.Disablei(GL_BLEND, i);
    }
    gl.Disablei(GL_SCISSOR_TEST, 0);
    for (const GLenum capability : switched_off) {
        gl.Disable(capability);
    }
    for (const GLenum capability : switched_off_in_depth) {
        gl.Disable(capability);
    }
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthMask(GL_TRUE);
    gl.DepthFunc(closer);
    gl.CullFace(GL_BACK);
}

void clear(const functions& gl, GLuint framebuffer, const gbuffer_facts& f, float far_end)
{
    constexpr std::array<GLfloat, 4> nothing{};
    constexpr std::array<GLuint, 4> no_ids{};
    gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_end);
    const auto targets = targets_of({}, f);
    for (GLint i = 0; i < static_cast<GLint>(target_count); ++i) {
        const target& each = targets[static_cast<std::size_t>(i)];
        if (each.wanted && each.format == pixel_format::rg32ui) {
            gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, i, no_ids.data());
        }
        else if (each.wanted) {
            gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, i, nothing.data());
        }
    }
}

void bind_tables(const functions& gl, const raster_model_state& state)
{
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, state.camera.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, state.instances.name());
    if (state.facts.motion) {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, state.previous.name());
    }
    if (state.samples) {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, state.materials.name());
    }
    if (state.heap.name() != 0) {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, state.heap.name());
    }
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, state.draws.name());
}

void draw_batches(const functions& gl, const raster_model_state& state, bool turned)
{
    for (std::size_t i = 0; i < state.batches.size(); ++i) {
        const draw_batch& batch = state.batches[i];
        const raster_pipeline& pipeline = state.pipelines[batch.variant];
        gl.UseProgram(state.programs[pipeline.program].name());
        gl.BindVertexArray(pipeline.vertex_array.name());
        pipeline.variant.cull_back ? gl.Enable(GL_CULL_FACE) : gl.Disable(GL_CULL_FACE);
        gl.FrontFace(pipeline.variant.mirrored != turned ? GL_CW : GL_CCW);
        const auto [alpha_map, normal_map] = state.maps[i];
        if (alpha_map != 0 || normal_map != 0) {
            const GLuint any = alpha_map != 0 ? alpha_map : normal_map;
            const std::array<GLuint, 2> textures{ any, normal_map != 0 ? normal_map : any };
            constexpr std::array<GLuint, 2> samplers{};
            gl.BindTextures(0, 2, textures.data());
            gl.BindSamplers(0, 2, samplers.data());
        }
        const auto* offset = reinterpret_cast<const void*>(batch.first * sizeof(indirect_draw));
        gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, offset, static_cast<GLsizei>(batch.count),
                                     sizeof(indirect_draw));
    }
}

} // namespace

void rasterizer::record(commands, model& loaded, targets& bound, const gbuffer_camera& camera)
{
    const functions& gl = *gl_;
    const raster_model_state& state = *loaded.state_;
    const gbuffer_facts& f = state.facts;
    const geometry_view view = make_geometry_view(camera, f, false);
    gl.NamedBufferSubData(state.camera.name(), 0, sizeof view.camera, &view.camera);

    std::optional<saved_state> before;
    if (options_.restore_state) {
        before.emplace(gl, touched{ .textures = state.textures.empty() ? 0U : 2U,
                                    .uniform_buffers = 1,
                                    .storage_buffers = 4,
                                    .color_targets = target_count,
                                    .depth = true });
    }
    const GLuint framebuffer = bound.state_->framebuffer.name();
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    set_state(gl, f, camera, view.far_end > 0 ? GL_LESS : GL_GREATER);
    clear(gl, framebuffer, f, view.far_end);
    bind_tables(gl, state);
    draw_batches(gl, state, view.turned);
}

} // namespace ao::gl
