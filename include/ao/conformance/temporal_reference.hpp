// An executor of temporal plans without any API: the reference that backends are compared with. Compile with -ffp-contract=off
// (ao::strict_fp).
#pragma once

#include "ao/conformance/reference.hpp"
#include "ao/temporal.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ao::conformance {

// A frame's pictures. Those that a plan does not read may be empty.
struct temporal_inputs {
    picture depth;
    picture normal;
    picture motion;
};

// Real is float, or double for a history that is precise.
template <class Real>
class temporal_executor {
public:
    explicit temporal_executor(const temporal_plan& p)
        : plan_(p),
          linear_(p.facts.frame.width, p.facts.frame.height),
          rows_(linear_),
          visibility_(linear_),
          tile_(make_tile(p.settings)),
          taps_(make_temporal_taps(p.settings))
    {
        for (auto& history : histories_) {
            history.assign(history_bytes(p) / 4, 0);
        }
    }

    // Runs the next frame and returns the visibility.
    const values<Real>& run(const temporal_inputs& inputs, const temporal_camera& view, bool cut = false)
    {
        const result<temporal_frame> frame = next_frame(plan_, state_, view, cut);
        assert(frame);
        steps_ = frame->steps.size();
        if (steps_ == 0) {
            return visibility_;
        }
        depth_ = decode<Real>(inputs.depth);
        normal_ = decode<Real>(inputs.normal);
        motion_ = decode<Real>(inputs.motion);
        for (const std::size_t step : frame->steps) {
            run_step(plan_.steps[step], *frame);
        }
        return visibility_;
    }

    // Words of the latest history.
    const std::vector<std::uint32_t>& history() const { return histories_[static_cast<std::size_t>(state_.latest)]; }
    // As run left it; may be written to, as faults do.
    std::vector<std::uint32_t>& history() { return histories_[static_cast<std::size_t>(state_.latest)]; }
    typename math<Real>::ao_history history_of(int x, int y) const
    {
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(linear_.width) + static_cast<std::size_t>(x);
        return math<Real>::ao_unpacked_history(history_words(history(), plan_.settings.format, pixel), format());
    }
    const temporal_state& state() const { return state_; }
    temporal_plan& plan() { return plan_; }
    // Of the last run.
    std::size_t steps() const { return steps_; }

private:
    struct resources {
        temporal_executor* of;
        const std::vector<std::uint32_t>* words;

        using vec4 = glm::vec<4, Real>;
        const values<Real>& eye_depth() const { return of->plan_.linearize ? of->linear_ : of->depth_; }
        Real stored_depth(glm::ivec2 p) const
        {
            const auto& texel = of->depth_.at(p.x, p.y);
            return of->plan_.facts.frame.depth == depth_source::position ? texel.z : texel.x;
        }
        Real depth(glm::ivec2 p) const { return eye_depth().at(p.x, p.y).x; }
        vec4 normal(glm::ivec2 p) const { return of->normal_.at(p.x, p.y); }
        vec4 motion(glm::ivec2 p) const { return of->motion_.at(p.x, p.y); }
        glm::uvec4 history(std::uint32_t pixel) const { return history_words(*words, of->plan_.settings.format, pixel); }
        glm::vec<2, Real> rotation(glm::ivec2 p) const
        {
            return glm::vec<2, Real>(of->tile_[static_cast<std::size_t>(p.y * tile_size + p.x)]);
        }
        vec4 tap(std::uint32_t i) const { return vec4(of->taps_[i]); }
        Real row(glm::ivec2 p) const { return of->rows_.at(p.x, p.y).x; }
    };

    int format() const { return static_cast<int>(plan_.settings.format); }

    template <class Body>
    void over_pixels(Body&& body)
    {
        std::size_t i = 0;
        for (int y = 0; y < linear_.height; ++y) {
            for (int x = 0; x < linear_.width; ++x) {
                body(glm::ivec2(x, y), i++);
            }
        }
    }

    void run_step(const temporal_step& step, const temporal_frame& frame)
    {
        const temporal_options& o = step.options;
        const resources read{
            this, &histories_[static_cast<std::size_t>(step.type == temporal_pass_type::accumulate ? frame.read : frame.write)]
        };
        if (step.type == temporal_pass_type::linearize) {
            using body = linearize_pass<Real, resources>;
            body run{ read, o.affine };
            const auto c = convert_constants<typename body::ao_depth_decode, Real, linearize_constants, float>(
                constants_of<linearize_constants>(step));
            over_pixels([&](glm::ivec2 pixel, std::size_t i) { linear_.texels[i].x = run.ao_linearize_pass(c, pixel); });
            return;
        }
        if (step.type == temporal_pass_type::accumulate) {
            using body = temporal_pass<Real, resources>;
            body run{ read,    o.most_samples,  o.contribution,   o.history_format, o.invalidation,    o.reproject, o.use_motion,
                      o.cubic, o.normal_source, o.rotate_normals, o.parallel,       o.limit_thickness, o.slice_taps };
            const auto c = convert_constants<typename body::ao_temporal_constants, Real, temporal_constants, float>(
                constants_of<temporal_constants>(step));
            std::vector<std::uint32_t>& written = histories_[static_cast<std::size_t>(frame.write)];
            const auto words = static_cast<std::size_t>(math<Real>::ao_history_words(format()));
            over_pixels([&](glm::ivec2 pixel, std::size_t i) {
                const glm::uvec4 stored = run.ao_packed_history(run.ao_accumulate_pass(c, pixel), format());
                for (std::size_t word = 0; word < words; ++word) {
                    written[words * i + word] = stored[static_cast<glm::length_t>(word)];
                }
            });
            return;
        }
        using body = temporal_filter_pass<Real, resources>;
        body run{ read, o.filter_radius, o.history_format, o.parallel };
        const auto c = convert_constants<typename body::ao_temporal_filter_constants, Real, temporal_filter_constants, float>(
            constants_of<temporal_filter_constants>(step));
        over_pixels([&](glm::ivec2 pixel, std::size_t i) {
            if (step.type == temporal_pass_type::filter_rows) {
                rows_.texels[i].x = run.ao_temporal_rows_pass(c, pixel);
            }
            else {
                visibility_.texels[i].x = step.type == temporal_pass_type::resolve ? run.ao_temporal_resolve_pass(c, pixel)
                                                                                   : run.ao_temporal_columns_pass(c, pixel);
            }
        });
    }

    temporal_plan plan_;
    temporal_state state_;
    std::size_t steps_ = 0;
    values<Real> depth_;
    values<Real> normal_;
    values<Real> motion_;
    values<Real> linear_;
    values<Real> rows_;
    values<Real> visibility_;
    std::array<glm::vec2, tile_size * tile_size> tile_;
    std::vector<glm::vec4> taps_;
    std::array<std::vector<std::uint32_t>, 2> histories_;
};

} // namespace ao::conformance
