#include "host/runner.hpp"

#include "ao/gl/backend.hpp"
#include "host/gl_texture.hpp"
#include "host/runner_gl_evaluate.hpp"

#include <GL/glcorearb.h>

#include <chrono>
#include <optional>
#include <utility>

namespace ao::host {

namespace {

using clock = std::chrono::steady_clock;
using gl_effect = effect<gl::backend>;

double ms_since(clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(clock::now() - start).count();
}

error device_error(const std::string& reason)
{
    return error(errc::device, reason);
}

class gl_runner final : public runner {
public:
    gl_runner(std::unique_ptr<gl_context> context, gl::backend b)
        : context_(std::move(context)),
          backend_(std::move(b)),
          exact_(contains_ignoring_case(context_->renderer, "llvmpipe") || contains_ignoring_case(context_->renderer, "softpipe"))
    {
    }
    ~gl_runner() override
    {
        // What follows is deleted in this context.
        static_cast<void>(context_->make_current());
        bound_.reset();
        effect_.reset();
        visibility_.reset();
        normal_.reset();
        depth_.reset();
    }

    std::string_view backend() const override { return "gl"; }
    std::string device() const override { return context_->renderer; }
    std::string route() const override
    {
        const gl::options& o = backend_.chosen();
        return std::string(o.route == gl::route::compute ? "compute" : "fragment") +
               (o.source == gl::shader_source::text ? ", text" : ", SPIR-V");
    }
    bool exact() const override { return exact_; }

    ao::result<success> prepare(const settings& chosen, const facts& known, const camera& view) override
    {
        if (const auto current = context_->make_current(); !current) {
            return device_error(current.reason());
        }
        const auto start = clock::now();
        bound_.reset();
        auto made = gl_effect::create(backend_, chosen, known, view);
        if (!made) {
            return made.error();
        }
        effect_.emplace(std::move(*made));
        const extent size{ static_cast<unsigned>(known.width), static_cast<unsigned>(known.height) };
        if (const auto wrong = make(depth_, known.depth_format, size)) {
            return *wrong;
        }
        const bool has_normals = known.normals != normal_source::from_depth;
        normal_.reset();
        if (const auto wrong = has_normals ? make(normal_, known.normal_format, size) : std::nullopt) {
            return *wrong;
        }
        if (const auto wrong = make(visibility_, known.output_format, size)) {
            return *wrong;
        }
        auto bound = effect_->bind({ depth_->name, has_normals ? normal_->name : 0, visibility_->name });
        if (!bound) {
            return bound.error();
        }
        bound_.emplace(std::move(*bound));
        finish();
        first_frame_ms_ = ms_since(start);
        first_frame_ = true;
        return success{};
    }

    ao::result<success> set_camera(const camera& view) override
    {
        if (const auto wrong = effect_->set_camera(view)) {
            return *wrong;
        }
        return success{};
    }

    ao::result<success> upload(const picture& depth, const picture& normal) override
    {
        if (const auto fits = check_inputs(effect_->current_plan().facts, depth, normal); !fits) {
            return fits.error();
        }
        if (const auto current = context_->make_current(); !current) {
            return device_error(current.reason());
        }
        if (const auto done = depth_->upload(depth.bytes); !done) {
            return device_error(done.reason());
        }
        if (normal_) {
            if (const auto done = normal_->upload(normal.bytes); !done) {
                return device_error(done.reason());
            }
        }
        return success{};
    }

    // By the host's clock about glFinish: timer queries do not work on llvmpipe (numerics.md 5), and elsewhere one clock for
    // all is easier to compare.
    ao::result<std::vector<pass_time>> frame() override
    {
        if (const auto current = context_->make_current(); !current) {
            return device_error(current.reason());
        }
        std::vector<pass_time> times;
        const auto& passes = effect_->current_plan().passes;
        finish();
        for (std::size_t i = 0; i < passes.size(); ++i) {
            const auto start = clock::now();
            effect_->record_pass({}, *bound_, i);
            finish();
            times.push_back({ passes[i].type, ms_since(start) });
            first_frame_ms_ += first_frame_ ? times.back().ms : 0;
        }
        first_frame_ = false;
        return times;
    }

    ao::result<picture> download() override
    {
        if (const auto current = context_->make_current(); !current) {
            return device_error(current.reason());
        }
        const facts& known = effect_->current_plan().facts;
        picture read(known.output_format, known.width, known.height);
        if (const auto done = visibility_->download(read.bytes); !done) {
            return device_error(done.reason());
        }
        return read;
    }

    ao::result<success> evaluate(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                                 std::span<glm::vec4> out) override
    {
        if (const auto current = context_->make_current(); !current) {
            return device_error(current.reason());
        }
        return evaluate_gl(context_->loader(), backend_.chosen().source, function, a, b, out);
    }

private:
    std::optional<error> make(std::optional<gl_texture>& texture, pixel_format format, extent size)
    {
        auto made = gl_texture::create(*context_, format, size);
        if (!made) {
            return device_error(made.reason());
        }
        texture.emplace(std::move(*made));
        return std::nullopt;
    }
    void finish() { reinterpret_cast<PFNGLFINISHPROC>(context_->loader()("glFinish"))(); }

    std::unique_ptr<gl_context> context_;
    gl::backend backend_;
    bool exact_;
    std::optional<gl_texture> depth_;
    std::optional<gl_texture> normal_;
    std::optional<gl_texture> visibility_;
    std::optional<gl_effect> effect_;
    std::optional<gl_effect::binding> bound_;
};

} // namespace

ao::result<runner_ptr> make_gl_runner(const gl_options& context, const gl::options& o)
{
    auto made = gl_context::create(context);
    if (!made) {
        return device_error(made.reason());
    }
    auto b = gl::backend::create((*made)->loader(), o);
    if (!b) {
        return b.error();
    }
    return runner_ptr(std::make_unique<gl_runner>(std::move(*made), std::move(*b)));
}

} // namespace ao::host
