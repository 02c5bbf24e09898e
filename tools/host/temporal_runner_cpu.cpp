#include "ao/cpu/temporal.hpp"
#include "host/temporal_runner.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace ao::host {

namespace {

using clock = std::chrono::steady_clock;

class cpu_temporal_runner final : public temporal_runner {
public:
    explicit cpu_temporal_runner(cpu::temporal t) : temporal_(std::move(t)) {}

    std::string_view backend() const override { return "cpu"; }
    std::string device() const override
    {
        return std::to_string(temporal_.threads()) + (temporal_.threads() == 1 ? " thread" : " threads");
    }
    std::string route() const override { return std::string(cpu::name_of(temporal_.lanes())); }
    bool exact() const override { return true; }

    ao::result<success> prepare(const temporal_settings& s, const temporal_facts& f) override
    {
        bound_.reset();
        program_.reset();
        state_ = {};
        auto planned = make_temporal_plan(s, f);
        if (!planned) {
            return planned.error();
        }
        auto program = temporal_.prepare_temporal(*planned);
        if (!program) {
            return program.error();
        }
        plan_ = *planned;
        program_.emplace(std::move(*program));
        const auto make = [&](bool wanted, pixel_format format) {
            return wanted ? picture(format, f.frame.width, f.frame.height) : picture();
        };
        depth_ = make(true, f.frame.depth_format);
        normal_ = make(f.frame.normals != normal_source::from_depth, f.frame.normal_format);
        motion_ = make(f.motion, f.motion_format);
        visibility_ = make(true, f.frame.output_format);
        auto bound = temporal_.bind_temporal(
            *program_, plan_, { cpu::view_of(depth_), cpu::view_of(normal_), cpu::view_of(motion_), cpu::view_of(visibility_) });
        if (!bound) {
            return bound.error();
        }
        bound_.emplace(std::move(*bound));
        return success{};
    }

    ao::result<success> upload(const picture& depth, const picture& normal, const picture& motion) override
    {
        if (const auto fits = check_inputs(plan_.facts, depth, normal, motion); !fits) {
            return fits.error();
        }
        // Into the bytes that are bound.
        std::copy(depth.bytes.begin(), depth.bytes.end(), depth_.bytes.begin());
        if (!normal_.bytes.empty()) {
            std::copy(normal.bytes.begin(), normal.bytes.end(), normal_.bytes.begin());
        }
        if (!motion_.bytes.empty()) {
            std::copy(motion.bytes.begin(), motion.bytes.end(), motion_.bytes.begin());
        }
        return success{};
    }

    ao::result<std::vector<temporal_pass_time>> frame(const temporal_camera& view, bool cut) override
    {
        const auto next = next_frame(plan_, state_, view, cut);
        if (!next) {
            return next.error();
        }
        std::vector<temporal_pass_time> times;
        for (std::size_t i = 0; i < next->steps.size(); ++i) {
            const auto start = clock::now();
            temporal_.record_temporal({}, *program_, *bound_, plan_, *next, i);
            const std::chrono::duration<double, std::milli> taken = clock::now() - start;
            times.push_back({ plan_.steps[next->steps[i]].type, taken.count() });
        }
        return times;
    }

    ao::result<picture> download() override { return visibility_; }

    ao::result<std::vector<std::uint32_t>> history() override
    {
        std::vector<std::uint32_t> words(history_bytes(plan_) / 4);
        program_->read_history(state_.latest, words);
        return words;
    }

    ao::result<success> set_history(std::span<const std::uint32_t> words) override
    {
        if (!program_->write_history(state_.latest, words)) {
            return error(errc::invalid_size, "the history has another number of words");
        }
        return success{};
    }

    const temporal_plan& plan() const override { return plan_; }

private:
    cpu::temporal temporal_;
    temporal_plan plan_;
    temporal_state state_;
    picture depth_;
    picture normal_;
    picture motion_;
    picture visibility_;
    std::optional<cpu::temporal_program> program_;
    std::optional<cpu::temporal_binding> bound_;
};

} // namespace

ao::result<temporal_runner_ptr> make_cpu_temporal_runner(const cpu::options& o)
{
    auto made = cpu::temporal::create(o);
    if (!made) {
        return made.error();
    }
    return temporal_runner_ptr(std::make_unique<cpu_temporal_runner>(std::move(*made)));
}

} // namespace ao::host
