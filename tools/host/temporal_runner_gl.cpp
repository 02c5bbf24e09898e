#include "host/temporal_runner.hpp"

#include "ao/gl/temporal.hpp"
#include "host/gl_texture.hpp"

#include <GL/glcorearb.h>

#include <chrono>
#include <optional>
#include <utility>

namespace ao::host {

namespace {

using clock = std::chrono::steady_clock;

error device_error(const std::string& reason)
{
    return error(errc::device, reason);
}

class gl_temporal_runner final : public temporal_runner {
public:
    gl_temporal_runner(std::unique_ptr<gl_context> context, gl::temporal executor)
        : context_(std::move(context)),
          executor_(std::move(executor)),
          exact_(contains_ignoring_case(context_->renderer, "llvmpipe") || contains_ignoring_case(context_->renderer, "softpipe"))
    {
    }
    ~gl_temporal_runner() override
    {
        // What follows is deleted in this context.
        static_cast<void>(context_->make_current());
        clear();
    }

    std::string_view backend() const override { return "gl"; }
    std::string device() const override { return context_->renderer; }
    std::string route() const override
    {
        return std::string("compute") + (executor_.chosen().source == gl::shader_source::text ? ", text" : ", SPIR-V");
    }
    bool exact() const override { return exact_; }

    ao::result<success> prepare(const temporal_settings& s, const temporal_facts& f) override
    {
        if (const auto entered = enter(); !entered) {
            return entered.error();
        }
        clear();
        const auto planned = make_temporal_plan(s, f);
        if (!planned) {
            return planned.error();
        }
        auto program = executor_.prepare_temporal(*planned);
        if (!program) {
            return program.error();
        }
        const facts& known = f.frame;
        const bool has_normals = known.normals != normal_source::from_depth;
        if (const auto wrong = make(depth_, known.depth_format, known)) {
            return *wrong;
        }
        if (const auto wrong = has_normals ? make(normal_, known.normal_format, known) : std::nullopt) {
            return *wrong;
        }
        if (const auto wrong = f.motion ? make(motion_, f.motion_format, known) : std::nullopt) {
            return *wrong;
        }
        if (const auto wrong = make(visibility_, known.output_format, known)) {
            return *wrong;
        }
        const auto name = [](const std::optional<gl_texture>& t) { return t ? t->name : 0; };
        auto bound =
            executor_.bind_temporal(*program, *planned, { depth_->name, name(normal_), name(motion_), visibility_->name });
        if (!bound) {
            return bound.error();
        }
        plan_ = *planned;
        state_ = {};
        program_.emplace(std::move(*program));
        bound_.emplace(std::move(*bound));
        return success{};
    }

    ao::result<success> upload(const picture& depth, const picture& normal, const picture& motion) override
    {
        if (const auto fits = check_inputs(plan_.facts, depth, normal, motion); !fits) {
            return fits.error();
        }
        if (const auto entered = enter(); !entered) {
            return entered.error();
        }
        const auto put = [](std::optional<gl_texture>& to, const picture& from) -> std::optional<error> {
            if (to) {
                if (const auto written = to->upload(from.bytes); !written) {
                    return device_error(written.reason());
                }
            }
            return std::nullopt;
        };
        if (const auto wrong = put(depth_, depth)) {
            return *wrong;
        }
        if (const auto wrong = put(normal_, normal)) {
            return *wrong;
        }
        if (const auto wrong = put(motion_, motion)) {
            return *wrong;
        }
        return success{};
    }

    // By the host's clock about glFinish, as runner's.
    ao::result<std::vector<temporal_pass_time>> frame(const temporal_camera& view, bool cut) override
    {
        if (const auto entered = enter(); !entered) {
            return entered.error();
        }
        const auto next = next_frame(plan_, state_, view, cut);
        if (!next) {
            return next.error();
        }
        std::vector<temporal_pass_time> times;
        finish();
        for (std::size_t i = 0; i < next->steps.size(); ++i) {
            const auto start = clock::now();
            executor_.record_temporal({}, *program_, *bound_, plan_, *next, i);
            finish();
            times.push_back(
                { plan_.steps[next->steps[i]].type, std::chrono::duration<double, std::milli>(clock::now() - start).count() });
        }
        return times;
    }

    ao::result<picture> download() override
    {
        if (const auto entered = enter(); !entered) {
            return entered.error();
        }
        const facts& known = plan_.facts.frame;
        picture read(known.output_format, known.width, known.height);
        if (const auto got = visibility_->download(read.bytes); !got) {
            return device_error(got.reason());
        }
        return read;
    }

    ao::result<std::vector<std::uint32_t>> history() override
    {
        if (const auto entered = enter(); !entered) {
            return entered.error();
        }
        std::vector<std::uint32_t> words(history_bytes(plan_) / 4);
        entry<PFNGLGETNAMEDBUFFERSUBDATAPROC>("glGetNamedBufferSubData")(
            program_->history(state_.latest), 0, static_cast<GLsizeiptr>(history_bytes(plan_)), words.data());
        return words;
    }

    ao::result<success> set_history(std::span<const std::uint32_t> words) override
    {
        if (words.size() * 4 != history_bytes(plan_)) {
            return error(errc::invalid_size, "a history of another size than the plan's");
        }
        if (const auto entered = enter(); !entered) {
            return entered.error();
        }
        entry<PFNGLNAMEDBUFFERSUBDATAPROC>("glNamedBufferSubData")(program_->history(state_.latest), 0,
                                                                   static_cast<GLsizeiptr>(words.size_bytes()), words.data());
        return success{};
    }

    const temporal_plan& plan() const override { return plan_; }

private:
    ao::result<success> enter()
    {
        if (const auto current = context_->make_current(); !current) {
            return device_error(current.reason());
        }
        return success{};
    }
    std::optional<error> make(std::optional<gl_texture>& texture, pixel_format format, const facts& f)
    {
        auto made = gl_texture::create(*context_, format, { static_cast<unsigned>(f.width), static_cast<unsigned>(f.height) });
        if (!made) {
            return device_error(made.reason());
        }
        texture.emplace(std::move(*made));
        return std::nullopt;
    }
    // Precondition: the context is current.
    void clear()
    {
        bound_.reset();
        program_.reset();
        visibility_.reset();
        motion_.reset();
        normal_.reset();
        depth_.reset();
    }
    template <class Function>
    Function entry(const char* name) const
    {
        return reinterpret_cast<Function>(context_->loader()(name));
    }
    void finish() const { entry<PFNGLFINISHPROC>("glFinish")(); }

    std::unique_ptr<gl_context> context_;
    gl::temporal executor_;
    bool exact_;
    temporal_plan plan_;
    temporal_state state_;
    std::optional<gl_texture> depth_;
    std::optional<gl_texture> normal_;
    std::optional<gl_texture> motion_;
    std::optional<gl_texture> visibility_;
    std::optional<gl::temporal_program> program_;
    std::optional<gl::temporal_binding> bound_;
};

} // namespace

ao::result<temporal_runner_ptr> make_gl_temporal_runner(const gl_options& context, const gl::options& o)
{
    auto made = gl_context::create(context);
    if (!made) {
        return device_error(made.reason());
    }
    auto executor = gl::temporal::create((*made)->loader(), o);
    if (!executor) {
        return executor.error();
    }
    return temporal_runner_ptr(std::make_unique<gl_temporal_runner>(std::move(*made), std::move(*executor)));
}

} // namespace ao::host
