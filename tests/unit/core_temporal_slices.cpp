// The method `bitmask` over time: one slice a frame and pixel, against many slices in one frame.
#include "unit/temporal_scene.hpp"

#include "ao/conformance/reference.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace temporal_test;

namespace {

stage small_stage()
{
    stage s;
    s.width = 64;
    s.height = 48;
    return s;
}

ao::settings spatial(int taps, int slices)
{
    ao::settings s = ao::settings_of(ao::preset::medium);
    s.taps = taps;
    s.slices = slices;
    s.filter = 1;
    s.resolution = ao::resolution::full;
    return s;
}

// Mean of many slices a pixel, turned anew by every seed.
std::vector<double> many_slices(const scene_frame& frame, const ao::facts& facts)
{
    constexpr std::uint32_t seeds = 16;
    std::vector<double> mean;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        ao::settings s = spatial(128, 16);
        s.seed = seed;
        const ao::plan p = *ao::make_plan(s, facts, { .projection = frame.camera.projection });
        ao::conformance::executor<float> run(p, frame.inputs.depth, frame.inputs.normal);
        const picture& seen = run.run();
        mean.resize(seen.texels.size());
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += static_cast<double>(seen.texels[i].x) / seeds;
        }
    }
    return mean;
}

double rmse(const picture& seen, const std::vector<double>& expected)
{
    double sum = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double difference = static_cast<double>(seen.texels[i].x) - expected[i];
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(expected.size()));
}

} // namespace

TEST_CASE("A still view's slices come to the mean of many slices", "[core][temporal][bitmask]")
{
    const stage s = small_stage();
    const ao::temporal_facts f = facts_of(s, false);
    const scene_frame frame = make_frame(s, s);
    const std::vector<double> limit = many_slices(frame, f.frame);

    ao::temporal_settings chosen = ao::temporal_settings_of(spatial(8, 1));
    executor e = make_executor(chosen, f);
    double first = 0;
    double sixteenth = 0;
    picture seen;
    for (int i = 1; i <= 64; ++i) {
        seen = e.run(frame.inputs, frame.camera);
        first = i == 1 ? rmse(seen, limit) : first;
        sixteenth = i == 16 ? rmse(seen, limit) : sixteenth;
    }
    const double last = rmse(seen, limit);
    CAPTURE(first, sixteenth, last);
    CHECK(sixteenth < 0.25 * first);
    CHECK(last < 0.1 * first);
    // The walls are seen aslant, where slices weigh from a half to one and a half: a mean of unweighted slices is 0.02 off.
    CHECK(last < 0.01);
    CHECK(e.run(frame.inputs, frame.camera).texels == seen.texels);
}

TEST_CASE("A history without a slice that weighs anything is open", "[core][temporal][bitmask]")
{
    const stage s = small_stage();
    const ao::temporal_facts f = facts_of(s, false);
    scene_frame frame = make_frame(s, s);
    // At right angles to every slice.
    frame.inputs.normal.set_texel(static_cast<std::size_t>(24 * s.width + 32), glm::vec4(0, 0, -1, 0));
    executor e = make_executor(ao::temporal_settings_of(spatial(8, 1)), f);
    for (int i = 0; i < 4; ++i) {
        const picture& seen = e.run(frame.inputs, frame.camera);
        CHECK(std::all_of(seen.texels.begin(), seen.texels.end(), [](const auto& t) { return t.x >= 0 && t.x <= 1; }));
    }
}
