// Temporal ambient occlusion by the reference: it converges, follows motion and drops what is wrong.
#include "ao/half.hpp"
#include "unit/temporal_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace temporal_test;
using reals = ao::math<float>;

namespace {

// A frame of a stage that stands still.
scene_frame still_frame(const stage& s = {})
{
    return make_frame(s, s);
}

ao::temporal_settings plain()
{
    ao::temporal_settings s;
    s.filter = 1;
    return s;
}

} // namespace

TEST_CASE("a history comes back from its words: exactly, to half a step of 16 bits, or as half floats")
{
    ao::random_stream random(7);
    for (int i = 0; i < 20000; ++i) {
        const reals::ao_history h{ random.uniform(), static_cast<float>(random.next() % 4096),
                                   static_cast<float>(random.next() % 65504), std::exp(60 * random.uniform() - 20) };
        const auto back = [&](int format) { return reals::ao_unpacked_history(reals::ao_packed_history(h, format), format); };
        const auto precise = back(reals::ao_history_precise);
        REQUIRE(std::memcmp(&precise, &h, sizeof h) == 0);
        const auto packed = back(reals::ao_history_packed);
        REQUIRE(std::abs(packed.value - h.value) <= 0.5001F / 65535);
        REQUIRE(packed.weight == h.weight);
        REQUIRE(packed.index == h.index);
        REQUIRE(std::abs(packed.depth - h.depth) <= h.depth / 4096);
        const auto half = back(reals::ao_history_half_stalls);
        const auto rounded = [](float x) { return ao::half_to_float(ao::float_to_half(std::min(x, 65504.0F))); };
        REQUIRE(half.value == rounded(h.value));
        REQUIRE(half.weight == rounded(h.weight));
        REQUIRE(half.index == rounded(h.index));
        REQUIRE(half.depth == rounded(h.depth));
    }
    const reals::ao_history nothing{ 0, 0, 0, 0 };
    for (const int format : { 0, 1, 2 }) {
        const auto h = reals::ao_unpacked_history(reals::ao_packed_history(nothing, format), format);
        CHECK(h.weight == 0);
        CHECK(h.depth == 0);
    }
}

TEST_CASE("a still view converges to the integral, then nothing runs any more")
{
    const scene_frame frame = still_frame();
    for (const auto format : { ao::history_format::precise, ao::history_format::packed }) {
        ao::temporal_settings s = plain();
        s.first_samples = s.later_samples = 8;
        s.most_weight = 512;
        s.format = format;
        const ao::temporal_facts f = facts_of({}, false);
        const picture truth = integral_of(frame, s, f);
        executor e = make_executor(s, f);
        std::vector<double> errors;
        for (int i = 1; i <= 64; ++i) {
            errors.push_back(rmse(e.run(frame.inputs, frame.camera), truth));
            REQUIRE(e.steps() == 2);
        }
        const double slope = std::log(errors[63] / errors[0]) / std::log(64.0);
        INFO("errors " << errors[0] << ", " << errors[15] << ", " << errors[63] << ", slope " << slope);
        CHECK(errors[15] <= 0.02);
        CHECK(errors[63] <= 0.008);
        CHECK(slope <= -0.6);
        const picture last = e.run(frame.inputs, frame.camera);
        CHECK(e.steps() == 0);
        CHECK(rmse(last, truth) == errors[63]);
        // One sequence: 512 samples without repeat or gap.
        CHECK(e.history_of(40, 30).index == 512);
        CHECK(e.history_of(40, 30).weight == 512);
    }
}

TEST_CASE("half floats stall: the index sticks and convergence ends")
{
    ao::temporal_settings s = plain();
    s.most_weight = 4000;
    s.first_samples = s.later_samples = 1;
    s.filter = 1;
    std::array<double, 2> errors{};
    std::array<float, 2> indices{};
    for (const std::size_t i : { 0U, 1U }) {
        s.format = i == 0 ? ao::history_format::packed : ao::history_format::half_stalls;
        const stage small{ .width = 24, .height = 16 };
        const scene_frame tiny = still_frame(small);
        const ao::temporal_facts tiny_facts = facts_of(small, true); // runs for ever
        const picture truth = integral_of(tiny, s, tiny_facts);
        executor e = make_executor(s, tiny_facts);
        for (int k = 0; k < 2999; ++k) {
            e.run(tiny.inputs, tiny.camera);
        }
        errors[i] = rmse(e.run(tiny.inputs, tiny.camera), truth);
        indices[i] = e.history_of(12, 2).index;
    }
    INFO("errors " << errors[0] << " and " << errors[1]);
    CHECK(indices[0] == 3000);
    CHECK(indices[1] == 2048);
    CHECK(errors[1] > 2 * errors[0]);
}

TEST_CASE("where nothing moves, reprojection returns the history bit for bit")
{
    scene_frame frame = still_frame();
    for (std::size_t i = 0; i < frame.inputs.motion.pixels(); ++i) {
        frame.inputs.motion.set_texel(i, glm::vec4(0));
    }
    for (const auto format : { ao::history_format::precise, ao::history_format::packed }) {
        ao::temporal_settings s;
        s.format = format;
        executor still = make_executor(s, facts_of({}, false));
        executor moving = make_executor(s, facts_of({}, true));
        for (int i = 0; i < 20; ++i) {
            const picture a = still.run(frame.inputs, frame.camera);
            const picture b = moving.run(frame.inputs, frame.camera);
            REQUIRE(differing(a, b) == 0);
            REQUIRE((still.history() == moving.history()));
        }
    }
}

TEST_CASE("a slow pan keeps its history and stays nearer to the truth than as many new samples alone")
{
    const ao::temporal_facts f = facts_of({}, false);
    ao::temporal_settings s = plain();
    executor e = make_executor(s, f);
    ao::temporal_settings alone = plain();
    alone.first_samples = alone.later_samples = 8;
    stage before;
    for (int i = 0; i < 40; ++i) {
        stage now;
        now.eye = { 0.004 * i, 0, 0 };
        now.yaw = 0.0005 * i;
        const scene_frame frame = make_frame(now, before);
        const picture seen = e.run(frame.inputs, frame.camera);
        before = now;
        if (i < 5 || i % 7 != 0) {
            continue;
        }
        const picture truth = integral_of(frame, s, f);
        executor fresh = make_executor(alone, f);
        INFO("frame " << i);
        CHECK(rmse(seen, truth) < rmse(fresh.run(frame.inputs, frame.camera), truth));
        // False rejections: neither the border nor what the ball has uncovered.
        int rejected = 0;
        for (int y = 0; y < now.height; ++y) {
            for (int x = 0; x + 4 < now.width; ++x) {
                rejected += e.history_of(x, y).weight <= 32 && e.history_of(x, y).depth > 4.5F && y > 40 ? 1 : 0;
            }
        }
        CHECK(rejected <= 6);
    }
}

TEST_CASE("a rolling ball leaves no shadow behind, and without invalidation it would")
{
    const ao::temporal_facts f = facts_of({}, true);
    const auto trail = [&](ao::invalidation_type how, int frames_after) {
        ao::temporal_settings s = plain();
        s.invalidation = how;
        executor e = make_executor(s, f);
        stage before;
        before.ball = -0.8;
        double error = 0;
        const int arrival = 12;
        for (int i = 0; i <= arrival + frames_after; ++i) {
            stage now;
            now.ball = -0.8 + 0.12 * std::min(i, arrival);
            const scene_frame frame = make_frame(now, before);
            const picture seen = e.run(frame.inputs, frame.camera);
            before = now;
            if (i == arrival + frames_after) {
                const picture truth = integral_of(frame, s, f);
                // On the floor that it has left.
                double sum = 0;
                int count = 0;
                for (int y = 44; y < 60; ++y) {
                    for (int x = 20; x < 40; ++x) {
                        const auto at = static_cast<std::size_t>(y * now.width + x);
                        sum += std::abs(static_cast<double>(seen.texels[at].x) - static_cast<double>(truth.texels[at].x));
                        ++count;
                    }
                }
                error = sum / count;
            }
        }
        return error;
    };
    const double smooth = trail(ao::invalidation_type::smooth, 8);
    const double clamped = trail(ao::invalidation_type::clamp, 8);
    const double none = trail(ao::invalidation_type::none, 8);
    INFO("mean errors: smooth " << smooth << ", clamp " << clamped << ", none " << none);
    CHECK(smooth < 0.01);
    CHECK(clamped < none);
    CHECK(none > 2 * smooth);
}

TEST_CASE("the same picture at every scale and far from the origin")
{
    const auto sequence = [](double scale, double origin) {
        ao::temporal_settings s = plain();
        s.radius = static_cast<float>(scale);
        s.bias = static_cast<float>(0.02 * scale);
        stage before;
        before.scale = scale;
        before.origin = { origin, -origin, origin };
        executor e = make_executor(s, facts_of(before, false));
        picture seen;
        for (int i = 0; i < 12; ++i) {
            stage now = before;
            now.eye = { 0.03125 * i, 0, 0 };
            const scene_frame frame = make_frame(now, before);
            seen = e.run(frame.inputs, frame.camera);
            before = now;
        }
        return seen;
    };
    const picture unit = sequence(1, 0);
    // A power of two changes no bit; others move offsets that lie on the edge of being occluded.
    CHECK(differing(unit, sequence(0.0009765625, 0)) == 0);
    CHECK(differing(unit, sequence(1024, 0)) == 0);
    CHECK(rmse(unit, sequence(1e-3, 0)) < 2e-3);
    CHECK(rmse(unit, sequence(1e3, 0)) < 2e-3);
    CHECK(differing(unit, sequence(1, 1048576)) == 0);
}

TEST_CASE("a poisoned history heals in one frame, a cut forgets")
{
    const scene_frame frame = still_frame();
    ao::temporal_settings s = plain();
    executor e = make_executor(s, facts_of({}, true));
    executor fresh = make_executor(s, facts_of({}, true));
    e.run(frame.inputs, frame.camera);
    ao::random_stream random(3);
    for (std::uint32_t& word : e.history()) {
        word = random.next();
    }
    picture seen = e.run(frame.inputs, frame.camera);
    for (std::size_t i = 0; i < seen.texels.size(); ++i) {
        REQUIRE(seen.texels[i].x >= 0);
        REQUIRE(seen.texels[i].x <= 1);
    }
    for (std::uint32_t& word : e.history()) {
        word = 0x7fc00000U;
    }
    seen = e.run(frame.inputs, frame.camera);
    CHECK(differing(seen, fresh.run(frame.inputs, frame.camera)) == 0);
    CHECK((e.history() == fresh.history()));
    e.run(frame.inputs, frame.camera);
    seen = e.run(frame.inputs, frame.camera, true);
    CHECK((e.history() == fresh.history()));
}

TEST_CASE("motion that is no motion counts as out of the picture, singular cameras are refused and change nothing")
{
    stage s;
    scene_frame frame = still_frame(s);
    executor e = make_executor(plain(), facts_of(s, true));
    e.run(frame.inputs, frame.camera);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const std::array<glm::vec4, 5> bad{ glm::vec4(nan, 0, 1, 0), glm::vec4(infinite, 0, 1, 0), glm::vec4(0, -infinite, 1, 0),
                                        glm::vec4(1e6F, 0, 1, 0), glm::vec4(0, 0, nan, 0) };
    for (std::size_t i = 0; i < 50; ++i) {
        frame.inputs.motion.set_texel(60 * 96 + i, bad[i % 5]);
    }
    const picture seen = e.run(frame.inputs, frame.camera);
    for (int i = 0; i < 50; ++i) {
        const auto h = e.history_of(i, 60);
        REQUIRE(seen.texels[static_cast<std::size_t>(60 * 96 + i)].x >= 0);
        // A depth that is not one is taken from the camera's motion.
        REQUIRE(h.weight == (i % 5 == 4 ? 64.0F : 32.0F));
    }

    ao::temporal_plan p = *ao::make_temporal_plan(plain(), facts_of(s, true));
    ao::temporal_state state;
    REQUIRE(ao::next_frame(p, state, frame.camera));
    const ao::temporal_state kept = state;
    ao::temporal_camera wrong = frame.camera;
    wrong.world_to_view[1][1] = nan;
    CHECK(ao::next_frame(p, state, wrong).error().code() == ao::errc::invalid_projection);
    wrong = frame.camera;
    wrong.world_to_view = ao::matrix3::zero();
    CHECK_FALSE(ao::next_frame(p, state, wrong));
    wrong = frame.camera;
    wrong.projection.matrix[0][0] = 0;
    CHECK_FALSE(ao::next_frame(p, state, wrong));
    wrong = frame.camera;
    wrong.eye[1] = static_cast<double>(infinite);
    CHECK_FALSE(ao::next_frame(p, state, wrong));
    CHECK(state.latest == kept.latest);
    CHECK(state.still_frames == kept.still_frames);
}

TEST_CASE("a program executes the plans that differ in constants alone")
{
    const ao::temporal_settings s;
    const ao::temporal_facts f = facts_of({}, true);
    const ao::temporal_plan plan = *ao::make_temporal_plan(s, f);
    const auto same = [&](auto&& change) {
        ao::temporal_settings other = s;
        ao::temporal_facts seen = f;
        change(other, seen);
        return ao::same_program(plan, *ao::make_temporal_plan(other, seen));
    };
    CHECK(same([](auto&, auto&) {}));
    CHECK(same([](auto& o, auto&) { o.radius = 3; }));
    CHECK(same([](auto& o, auto&) { o.most_weight = 100; }));
    CHECK_FALSE(same([](auto& o, auto&) { o.period = 8192; })); // taps that the program does not have
    CHECK_FALSE(same([](auto& o, auto&) { o.seed = 2; }));
    CHECK_FALSE(same([](auto& o, auto&) { o.format = ao::history_format::packed; }));
    CHECK_FALSE(same([](auto& o, auto&) { o.filter = 1; }));
    CHECK_FALSE(same([](auto& o, auto&) { o.cubic = false; }));
    CHECK_FALSE(same([](auto&, auto& k) { k.frame.height += 1; }));
    CHECK_FALSE(same([](auto&, auto& k) { k.frame.output_format = ao::pixel_format::r8; }));
    CHECK_FALSE(same([](auto&, auto& k) { k.motion = false; }));
}

TEST_CASE("every convention of motion says the same")
{
    stage before;
    stage now;
    now.ball = 0.1;
    now.eye = { 0.05, 0.02, 0 };
    const scene_frame first = make_frame(before, before);
    const scene_frame second = make_frame(now, before);
    ao::temporal_facts f = facts_of(now, true);
    executor e = make_executor(plain(), f);
    e.run(first.inputs, first.camera);
    e.run(second.inputs, second.camera);
    for (const auto unit : { ao::motion_unit::pixels, ao::motion_unit::uv, ao::motion_unit::ndc }) {
        for (const int kind : { 0, 1, 2, 3 }) {
            f.convention = { unit, (kind & 1) != 0, (kind & 2) != 0, true };
            const float x = unit == ao::motion_unit::pixels ? 1.0F : (unit == ao::motion_unit::uv ? 1.0F : 2.0F) / 96;
            const float y = unit == ao::motion_unit::pixels ? 1.0F : (unit == ao::motion_unit::uv ? 1.0F : 2.0F) / 64;
            const float side = f.convention.from_previous ? -1.0F : 1.0F;
            const float up = f.convention.y_up ? -1.0F : 1.0F;
            const auto converted = [&](scene_frame frame) {
                for (std::size_t i = 0; i < frame.inputs.motion.pixels(); ++i) {
                    const auto m = frame.inputs.motion.texel<glm::vec4>(i);
                    frame.inputs.motion.set_texel(i, glm::vec4(m.x * x * side, m.y * y * side * up, m.z, 0));
                }
                return frame;
            };
            executor other = make_executor(plain(), f);
            const scene_frame a = converted(first);
            const scene_frame b = converted(second);
            other.run(a.inputs, a.camera);
            other.run(b.inputs, b.camera);
            std::size_t unlike = 0;
            for (int row = 0; row < now.height; ++row) {
                for (int column = 0; column < now.width; ++column) {
                    unlike += std::abs(other.history_of(column, row).weight - e.history_of(column, row).weight) > 0.5F ? 1 : 0;
                }
            }
            CHECK(unlike <= 6); // on the edge of two pixels
        }
    }
}

TEST_CASE("densities have the moments that they are named for")
{
    const auto mean = [](ao::sample_density density, auto&& of) {
        double sum = 0;
        for (std::uint32_t i = 0; i < 65536; ++i) {
            sum += of(glm::dvec4(ao::temporal_tap(density, i)));
        }
        return sum / 65536;
    };
    const auto length = [](glm::dvec4 s) { return std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z); };
    using enum ao::sample_density;
    CHECK(mean(disc_area, length) == Approx(2.0 / 3).margin(1e-3));
    CHECK(mean(disc_linear, length) == Approx(0.5).margin(1e-3));
    CHECK(mean(hemisphere, length) == Approx(0.5).margin(1e-3));
    CHECK(mean(disc_area, [&](glm::dvec4 s) { return length(s) * length(s); }) == Approx(0.5).margin(1e-3));
    CHECK(mean(disc_linear, [&](glm::dvec4 s) { return length(s) * length(s); }) == Approx(1.0 / 3).margin(1e-3));
    // Cosine-weighted: E[cos] = 2/3, E[cos^2] = 1/2.
    CHECK(mean(hemisphere, [&](glm::dvec4 s) { return s.z / std::max(length(s), 1e-12); }) == Approx(2.0 / 3).margin(1e-3));
    CHECK(mean(hemisphere, [&](glm::dvec4 s) { return s.z * s.z / std::max(length(s) * length(s), 1e-12); }) ==
          Approx(0.5).margin(1e-3));
    for (const auto density : { disc_area, disc_linear, hemisphere }) {
        CHECK(std::abs(mean(density, [](glm::dvec4 s) { return s.x; })) < 1e-3);
        CHECK(std::abs(mean(density, [](glm::dvec4 s) { return s.y; })) < 1e-3);
    }
}

TEST_CASE("patches of Fox and Compton darken a corner and leave a plane open")
{
    const scene_frame frame = still_frame();
    for (const auto density : { ao::sample_density::disc_area, ao::sample_density::disc_linear }) {
        ao::temporal_settings s = plain();
        s.contribution = ao::contribution_type::fox_compton;
        s.density = density;
        executor e = make_executor(s, facts_of({}, false));
        picture seen;
        for (int i = 0; i < 8; ++i) {
            seen = e.run(frame.inputs, frame.camera);
        }
        const auto at = [&](int x, int y) { return seen.texels[static_cast<std::size_t>(y * 96 + x)].x; };
        CHECK(at(4, 63) == 1); // floor near the eye, far from everything
        float darkest = 1;
        for (int y = 0; y < 64; ++y) {
            darkest = std::min(darkest, at(4, y)); // where floor and wall meet
        }
        CHECK(darkest < 0.9F);
        CHECK(darkest > 0.2F);
    }
}

TEST_CASE("a million frames drift nowhere")
{
    const stage small{ .width = 2, .height = 1 };
    const scene_frame frame = still_frame(small);
    ao::temporal_settings s = plain();
    s.first_samples = s.later_samples = 2;
    s.period = 509; // prime: the sequence starts again anywhere in a frame
    s.format = ao::history_format::packed;
    const ao::temporal_facts f = facts_of(small, true);
    const picture truth = integral_of(frame, s, f);
    executor e = make_executor(s, f);
    for (int i = 0; i < 999999; ++i) {
        e.run(frame.inputs, frame.camera);
    }
    CHECK(rmse(e.run(frame.inputs, frame.camera), truth) < 0.01);
    CHECK(e.history_of(1, 0).weight == 500);
    CHECK(e.history_of(1, 0).index == 2000000 % 509);
}
