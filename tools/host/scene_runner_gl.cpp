#include "ao/gl/rasterizer.hpp"
#include "ao/gl/shading.hpp"
#include "host/gl_texture.hpp"
#include "host/scene_runner_with.hpp"

#include <GL/glcorearb.h>

#include <chrono>

namespace ao::host {

namespace {

error device_error(const std::string& reason)
{
    return error(errc::device, reason);
}

class gl_host {
public:
    using rasterizer = gl::rasterizer;
    using shading = gl::shading;
    using texture = gl_texture;
    using image = unsigned;

    gl_host(std::unique_ptr<gl_context> context, gl::rasterizer drawing, gl::shading shader, gl::raster_options chosen)
        : context_(std::move(context)),
          drawing_(std::move(drawing)),
          shader_(std::move(shader)),
          chosen_(chosen)
    {
    }

    std::string_view backend() const { return "gl"; }
    std::string device() const { return context_->renderer; }
    std::string route() const
    {
        return std::string(chosen_.source == gl::shader_source::text ? "text" : "SPIR-V") +
               (chosen_.sampling == gl::sampling::hardware ? ", hardware sampler" : "");
    }
    bool exact() const
    {
        return contains_ignoring_case(context_->renderer, "llvmpipe") || contains_ignoring_case(context_->renderer, "softpipe");
    }
    std::vector<std::string> messages() const { return {}; }
    gl::rasterizer& drawing() { return drawing_; }
    gl::shading& shader() { return shader_; }
    draw_counts counts(const gl::raster_model& m) const
    {
        draw_counts c;
        c.programs = m.programs();
        c.calls = m.draw_calls();
        return c;
    }

    ao::result<success> enter() { return as_ours(context_->make_current()); }
    ao::result<gl_texture> make(pixel_format format, int width, int height)
    {
        auto made = gl_texture::create(*context_, format, { static_cast<unsigned>(width), static_cast<unsigned>(height) });
        if (!made) {
            return device_error(made.reason());
        }
        return std::move(*made);
    }
    ao::result<success> upload(gl_texture& to, const picture& from) { return as_ours(to.upload(from.bytes)); }
    ao::result<success> download(gl_texture& from, picture& to) { return as_ours(from.download(to.bytes)); }
    unsigned image_of(gl_texture& t, picture_use) { return t.name; }

    // By the host's clock about glFinish, as runner's.
    template <class Uses, class Record>
    ao::result<double> run(const Uses&, const Record& record)
    {
        finish();
        const auto start = std::chrono::steady_clock::now();
        record(gl::commands{});
        finish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }

private:
    static ao::result<success> as_ours(const host::result<done>& r)
    {
        if (!r) {
            return device_error(r.reason());
        }
        return success{};
    }
    void finish() { reinterpret_cast<PFNGLFINISHPROC>(context_->loader()("glFinish"))(); }

    std::unique_ptr<gl_context> context_;
    gl::rasterizer drawing_;
    gl::shading shader_;
    gl::raster_options chosen_;
};

} // namespace

ao::result<scene_runner_ptr> make_gl_scene_runner(const gl_options& context, const gl::raster_options& o)
{
    auto made = gl_context::create(context);
    if (!made) {
        return device_error(made.reason());
    }
    auto drawing = gl::rasterizer::create((*made)->loader(), o);
    if (!drawing) {
        return drawing.error();
    }
    auto shader = gl::shading::create((*made)->loader(), { .source = o.source, .restore_state = o.restore_state });
    if (!shader) {
        return shader.error();
    }
    return scene_runner_ptr(
        std::make_unique<scene_runner_with<gl_host>>(gl_host(std::move(*made), std::move(*drawing), std::move(*shader), o)));
}

} // namespace ao::host
