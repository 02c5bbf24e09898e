// Convergence, invalidation and planning of temporal ambient occlusion, at compile time.
#include "ao/temporal_backend.hpp"

namespace {

using reals = ao::math<float>;

static_assert(reals::ao_convergence(250, 500) == 0.5F);
static_assert(reals::ao_accumulated(0.25F, 24, 8, 8) == 0.4375F);
static_assert(reals::ao_next_weight(496, 8, 500) == 500 && reals::ao_next_weight(16, 8, 500) == 24);
static_assert(reals::ao_next_index(4090, 8, 4096) == 2 && reals::ao_next_index(4088, 8, 4096) == 0);
static_assert(reals::ao_next_index(0, 4096, 4096) == 0);

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
static_assert(reals::ao_same_surface(10, 10.05F, 0.1F) && !reals::ao_same_surface(10, 10.2F, 0.1F));
static_assert(!reals::ao_same_surface(0, 0, 1));
static_assert(reals::ao_depth_tolerance(10, 0.01F, 0.5F, 0, 0.001F, 0.25F) > reals::ao_depth_tolerance(10, 0.01F, 0.5F, 0, 0, 0));

// Nothing moved: confidence is 1 (its complement, which circulates, would be 0).
static_assert(reals::ao_confidence(0, 20) == 1 && reals::ao_confidence(1, 19) == 0.05F);
static_assert(reals::ao_kept_weight(500, 0.05F) == 25 && reals::ao_kept_weight(500, 1) == 500);

static_assert(reals::ao_filter_support(0, 0.3F) == 1 && reals::ao_filter_support(0.3F, 0.3F) == 0);
static_assert(reals::ao_filter_support(1, 0.3F) == 0 && reals::ao_filter_support(0, 0) == 0);
static_assert(reals::ao_filter_weight(0, 0) == 1 && reals::ao_filter_weight(1, 0) == 0);
static_assert(reals::ao_filter_weight(0, 4) == 1 && reals::ao_filter_weight(4, 4) == 0 && reals::ao_filter_weight(2, 4) == 0.25F);

// At a texel's centre it alone counts; between, weights add up to 1 and their second moment is the position's own.
constexpr bool cubic_weights_hold(float f)
{
    float sum = 0;
    float first = 0;
    float second = 0;
    const auto weights = reals::ao_cubic_weights(f);
    for (int i = 0; i < 4; ++i) {
        const float w = weights[i];
        const auto x = static_cast<float>(i - 1);
        sum += w;
        first += w * x;
        second += w * x * x;
    }
    const auto near = [](float a, float b) { return a - b < 1e-6F && b - a < 1e-6F; };
    return near(sum, 1) && near(first, f) && near(second, f * f);
}
static_assert(cubic_weights_hold(0) && cubic_weights_hold(0.25F) && cubic_weights_hold(0.5F) && cubic_weights_hold(0.9F));
static_assert(reals::ao_cubic_weights(0)[1] == 1 && reals::ao_cubic_weights(0)[0] == 0 && reals::ao_cubic_weights(0)[2] == 0 &&
              reals::ao_cubic_weights(0)[3] == 0);

constexpr ao::temporal_facts facts(bool motion)
{
    ao::temporal_facts f;
    f.frame.width = 64;
    f.frame.height = 48;
    f.motion = motion;
    return f;
}

constexpr ao::temporal_camera view(double x)
{
    ao::temporal_camera c;
    c.projection = ao::make_projection({ -1, 1, -1, 1, 1, 100 }, {});
    c.eye = { x, 0, 0 };
    return c;
}

constexpr ao::temporal_plan plan(const ao::temporal_settings& s, bool motion)
{
    return *ao::make_temporal_plan(s, facts(motion));
}

// Both ways to accumulate, the filter and its absence; with moving objects the still way is not even prepared.
static_assert(plan({}, false).steps.size() == 5 && plan({}, true).steps.size() == 4);

constexpr std::size_t steps_of_frame(int frames, bool move_last)
{
    ao::temporal_settings s;
    s.most_weight = 64;
    ao::temporal_plan p = plan(s, false);
    ao::temporal_state state;
    std::size_t steps = 0;
    for (int i = 0; i < frames; ++i) {
        steps = ao::next_frame(p, state, view(move_last && i + 1 == frames ? 0.5 : 0))->steps.size();
    }
    return steps;
}
static_assert(steps_of_frame(1, false) == 4 && steps_of_frame(8, false) == 2 && steps_of_frame(9, false) == 0);
static_assert(steps_of_frame(30, true) == 4);

// Only the difference of eyes counts.
static_assert(ao::detail::to_previous_rows(view(1e6 + 0.25), view(1e6))[3] == 0.25F);

constexpr bool refuses(ao::temporal_settings s)
{
    return ao::validate(s).has_value();
}
static_assert(!refuses({}));
static_assert(refuses({ .most_weight = 0 }) && refuses({ .most_weight = std::numeric_limits<int>::max() }));
static_assert(refuses({ .period = 16 }) && refuses({ .period = 65537 }) && refuses({ .later_samples = 4097 }));
static_assert(refuses({ .density = ao::sample_density::disc_area }));
static_assert(refuses({ .contribution = ao::contribution_type::fox_compton }));
static_assert(refuses({ .contribution = ao::contribution_type::bitmask }));
constexpr ao::temporal_settings slices(int taps, int first, int period)
{
    ao::temporal_settings s = ao::temporal_settings_of(ao::settings_of(ao::preset::medium));
    s.slice_taps = taps;
    s.first_samples = first;
    s.later_samples = 3 * taps;
    s.period = period;
    return s;
}
static_assert(!refuses(slices(8, 16, 64)) && !refuses(slices(3, 6, 33)));
static_assert(refuses(slices(1025, 1025, 4100)) && refuses(slices(0, 8, 64)) && refuses(slices(8, 12, 64)) &&
              refuses(slices(8, 16, 60)));
static_assert(!refuses(ao::temporal_settings_of(ao::settings_of(ao::preset::low))) &&
              !refuses(ao::temporal_settings_of(ao::settings_of(ao::preset::ultra))));
static_assert(refuses({ .tolerance = nan }) && refuses({ .smoothness = -1 }) && refuses({ .filter = 4 }));

} // namespace
