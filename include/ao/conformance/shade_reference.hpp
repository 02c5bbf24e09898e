// An executor of shading plans without any API: the reference that backends are compared with, and with double the truth that
// float is compared with. Compile with -ffp-contract=off (ao::strict_fp).
#pragma once

#include "ao/conformance/reference.hpp"
#include "ao/shading.hpp"
#include "ao/texture.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ao::conformance {

// Targets of a geometry pass and a visibility. Those that a plan does not read may be empty.
struct shade_inputs {
    picture geometry; // the position, or the depth buffer, as shade_facts::stored_position says
    picture normal;
    picture ids;
    picture surface;
    picture frame;
    picture visibility;
};

template <class Real>
class shade_executor {
public:
    shade_executor(const shade_plan& p, const texel_heap& heap, const shade_inputs& inputs)
        : plan_(&p),
          heap_(&heap),
          geometry_(decode<Real>(inputs.geometry)),
          normal_(decode<Real>(inputs.normal)),
          surface_(decode<Real>(inputs.surface)),
          frame_(decode<Real>(inputs.frame)),
          visibility_(decode<Real>(inputs.visibility)),
          ids_(&inputs.ids),
          color_(p.facts.width, p.facts.height),
          targets_(static_cast<std::size_t>(p.targets), color_)
    {
    }

    // Linear color, 0 0 0 0 on background.
    const values<Real>& run()
    {
        body_type body{ { this },
                        plan_->options.stored_position,
                        plan_->options.parallel,
                        plan_->options.normal_source,
                        plan_->options.visibility,
                        plan_->options.maps,
                        plan_->options.reflections,
                        plan_->options.frames,
                        plan_->options.blends,
                        plan_->options.bent_normal,
                        plan_->options.multi_bounce };
        for (const shade_pass& pass : plan_->passes) {
            run_pass(body, pass);
        }
        return color_;
    }
    // Weights outside [0, 1] or NaN, one for each pixel and use.
    std::uint64_t clamped() const { return clamped_; }

private:
    struct resources {
        shade_executor* of;

        using vec4 = glm::vec<4, Real>;
        vec4 geometry(glm::ivec2 p) const { return of->geometry_.at(p.x, p.y); }
        vec4 normal(glm::ivec2 p) const { return of->normal_.at(p.x, p.y); }
        vec4 surface(glm::ivec2 p) const { return of->surface_.at(p.x, p.y); }
        vec4 frame(glm::ivec2 p) const { return of->frame_.at(p.x, p.y); }
        glm::uvec2 ids(glm::ivec2 p) const { return of->ids_->template texel<glm::uvec2>(of->index(p)); }
        Real visibility(glm::ivec2 p) const { return of->visibility_.at(p.x, p.y).x; }
        glm::vec<3, Real> bent_normal(glm::ivec2 p) const
        {
            const vec4& t = of->visibility_.at(p.x, p.y);
            return { t.y, t.z, t.w };
        }
        vec4 target(int i, glm::ivec2 p) const { return of->targets_[static_cast<std::size_t>(i)].at(p.x, p.y); }
        std::uint32_t word(std::uint32_t i) const { return of->plan_->words[i]; }
        std::uint32_t texel(std::uint32_t i) const { return of->heap_->words[i]; }
        void count_clamped(std::uint32_t n) const { of->clamped_ += n; }
    };
    using body_type = shading_pass<Real, resources>;

    std::size_t index(glm::ivec2 p) const
    {
        return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(color_.width) + static_cast<std::size_t>(p.x);
    }

    void run_pass(body_type& body, const shade_pass& pass)
    {
        const auto c = convert_constants<typename body_type::ao_shade_constants, Real, shade_constants, float>(pass.constants);
        values<Real>& output = pass.output == blend_result ? color_ : targets_[static_cast<std::size_t>(pass.output)];
        for (int y = 0; y < color_.height; ++y) {
            for (int x = 0; x < color_.width; ++x) {
                const glm::ivec2 at(x, y);
                if (pass.type == shade_pass_type::shade) {
                    output.texels[index(at)] = body.ao_shade_pass(c, at);
                    continue;
                }
                const auto color = body.ao_segment_pass(c, at);
                if (color.w >= Real(0)) {
                    output.texels[index(at)] = color;
                }
            }
        }
    }

    const shade_plan* plan_;
    const texel_heap* heap_;
    values<Real> geometry_;
    values<Real> normal_;
    values<Real> surface_;
    values<Real> frame_;
    values<Real> visibility_;
    const picture* ids_;
    values<Real> color_;
    std::vector<values<Real>> targets_;
    std::uint64_t clamped_ = 0;
};

// The color of the reference as rgba32f.
inline picture reference_color(const shade_plan& p, const texel_heap& heap, const shade_inputs& inputs)
{
    shade_executor<float> run(p, heap, inputs);
    const values<float>& color = run.run();
    picture stored(pixel_format::rgba32f, p.facts.width, p.facts.height);
    for (std::size_t i = 0; i < stored.pixels(); ++i) {
        stored.set_texel(i, color.texels[i]);
    }
    return stored;
}

} // namespace ao::conformance
