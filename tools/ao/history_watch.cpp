#include "ao/history_watch.hpp"

#include "ao/temporal_passes.hpp"
#include "scene/metrics.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ao::tools {

// What the shared bodies read of a frame: its pictures and the history before it. They take no sample here.
struct history_watch::resources {
    const history_watch* of;

    float stored_depth(glm::ivec2 p) const
    {
        const glm::vec4& texel = of->depth_.at(p.x, p.y);
        return of->plan_.facts.frame.depth == depth_source::position ? texel.z : texel.x;
    }
    float depth(glm::ivec2 p) const { return of->depth_.at(p.x, p.y).x; }
    glm::vec4 normal(glm::ivec2 p) const { return of->normal_.at(p.x, p.y); }
    glm::vec4 motion(glm::ivec2 p) const { return of->motion_.at(p.x, p.y); }
    glm::uvec4 history(std::uint32_t pixel) const { return history_words(of->history_, of->plan_.settings.format, pixel); }
};

history_watch::history_watch(const temporal_plan& p) : plan_(p), history_(history_bytes(p) / 4) {}

math<float>::ao_history history_watch::unpacked(std::span<const std::uint32_t> words, std::size_t pixel) const
{
    const history_format format = plan_.settings.format;
    return math<float>::ao_unpacked_history(history_words(words, format, pixel), static_cast<int>(format));
}

void history_watch::make_eye_depth(const temporal_step* linearize, const picture& depth)
{
    depth_ = conformance::decode<float>(depth);
    if (linearize == nullptr)
        return;
    using body = linearize_pass<float, resources>;
    body run{ resources{ this }, linearize->options.affine };
    const auto c = convert_constants<body::ao_depth_decode, float, linearize_constants, float>(
        constants_of<linearize_constants>(*linearize));
    for (int y = 0; y < depth_.height; ++y)
        for (int x = 0; x < depth_.width; ++x) {
            const glm::ivec2 pixel(x, y);
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(depth_.width) + static_cast<std::size_t>(x);
            depth_.texels[i].x = run.ao_linearize_pass(c, pixel);
        }
}

template <class Pass>
history_watch::pixel_facts history_watch::look_at(Pass& pass, const typename Pass::ao_temporal_constants& c, glm::ivec2 pixel,
                                                  std::span<const std::uint32_t> after) const
{
    const auto width = static_cast<std::size_t>(plan_.facts.frame.width);
    const auto place = [&](int x, int y) { return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x); };
    const auto begun = pass.ao_begin_pixel(c, pixel);
    pixel_facts facts;
    facts.from = place(static_cast<int>(begun.previous.pixel.x), static_cast<int>(begun.previous.pixel.y));
    if (!begun.foreground)
        return facts;
    const auto& known = begun.history;
    const float wanted = begun.wanted;
    facts.samples = static_cast<int>(wanted);
    // As the format holds it.
    const int format = static_cast<int>(plan_.settings.format);
    const float expected =
        pass.ao_unpacked_history(
                pass.ao_packed_history({ 0.0f, pass.ao_next_weight(known.weight, wanted, c.most_weight), 0.0f, 1.0f }, format),
                format)
            .weight;
    const float weight = unpacked(after, place(pixel.x, pixel.y)).weight;
    facts.is = known.weight == 0.0f ? fate::dropped : weight < expected ? fate::cut : fate::kept;
    facts.converged = weight >= c.most_weight;
    return facts;
}

// Nothing ran: everything is as it was.
std::vector<history_watch::pixel_facts> history_watch::standing() const
{
    std::vector<pixel_facts> pixels(surface_.size());
    for (std::size_t i = 0; i < pixels.size(); ++i)
        if (surface_[i] != 0)
            pixels[i] = { fate::kept, unpacked(history_, i).weight >= static_cast<float>(plan_.settings.most_weight), 0, i };
    return pixels;
}

std::vector<history_watch::pixel_facts> history_watch::accumulated(const temporal_step& step, const frame& now) const
{
    using body = temporal_pass<float, resources>;
    const temporal_options& o = step.options;
    const auto c =
        convert_constants<body::ao_temporal_constants, float, temporal_constants, float>(constants_of<temporal_constants>(step));
    const int width = plan_.facts.frame.width;
    std::vector<pixel_facts> pixels(now.visibility.size());
    tbb::parallel_for(tbb::blocked_range<int>(0, plan_.facts.frame.height), [&](const tbb::blocked_range<int>& rows) {
        body run{ resources{ this }, o.most_samples,    o.contribution, o.history_format, o.invalidation,
                  o.reproject,       o.use_motion,      o.cubic,        o.normal_source,  o.rotate_normals,
                  o.parallel,        o.limit_thickness, o.slice_taps };
        for (int y = rows.begin(); y != rows.end(); ++y)
            for (int x = 0; x < width; ++x)
                pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
                    look_at(run, c, glm::ivec2(x, y), now.history);
    });
    return pixels;
}

frame_facts history_watch::look(frame now)
{
    // The executor has accepted the camera.
    const temporal_frame planned = *next_frame(plan_, state_, now.camera, now.cut);
    const temporal_step* linearize = nullptr;
    const temporal_step* accumulate = nullptr;
    for (const std::size_t i : planned.steps) {
        const temporal_step& step = plan_.steps[i];
        linearize = step.type == temporal_pass_type::linearize ? &step : linearize;
        accumulate = step.type == temporal_pass_type::accumulate ? &step : accumulate;
    }
    std::vector<pixel_facts> pixels;
    if (accumulate == nullptr) {
        pixels = standing();
    }
    else {
        make_eye_depth(linearize, now.depth);
        normal_ = conformance::decode<float>(now.normal);
        motion_ = conformance::decode<float>(now.motion);
        pixels = accumulated(*accumulate, now);
    }

    frame_facts facts;
    surface_.assign(pixels.size(), 0);
    std::vector<double> change;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const pixel_facts& p = pixels[i];
        if (p.is == fate::background)
            continue;
        surface_[i] = 1;
        ++facts.surface;
        facts.converged += p.converged ? 1u : 0u;
        facts.dropped += p.is == fate::dropped ? 1u : 0u;
        facts.cut += p.is == fate::cut ? 1u : 0u;
        facts.samples += static_cast<std::uint64_t>(p.samples);
        if (p.is == fate::kept)
            change.push_back(std::abs(static_cast<double>(now.visibility[i]) - static_cast<double>(visibility_[p.from])));
    }
    if (!change.empty()) {
        facts.flicker = mean_of(change);
        facts.flicker_p99 = percentile_99(std::move(change));
    }
    history_ = std::move(now.history);
    visibility_.assign(now.visibility.begin(), now.visibility.end());
    return facts;
}

} // namespace ao::tools
