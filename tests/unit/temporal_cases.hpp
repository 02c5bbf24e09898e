// What every executor of temporal plans must do, whatever the API, behind its runner: in every bit, history included, what the
// reference does.
#pragma once

#include "host/temporal_runner.hpp"
#include "unit/temporal_sequence.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

namespace temporal_test {

// Settings and facts of a moving scene of little work: every pass, both of adaptive sampling, precise histories.
inline temporal_case base_case(const char* name, bool motion = true, int width = 48, int height = 33)
{
    temporal_case c;
    c.name = name;
    c.settings.first_samples = 12;
    c.settings.later_samples = 3;
    c.settings.most_weight = 40; // reached by still stretches
    c.settings.moving_weight = 24;
    c.settings.clamped_weight = 4;
    c.facts = facts_of({ .width = width, .height = height }, motion);
    return c;
}

inline std::vector<temporal_case> temporal_cases()
{
    using enum ao::pixel_format;
    std::vector<temporal_case> all;
    const auto add = [&](const temporal_case& c) -> temporal_case& { return all.emplace_back(c); };

    add(base_case("moving objects"));
    add(base_case("a moving camera", false));
    for (const auto& [format, name] : { std::pair(ao::history_format::packed, "packed histories"),
                                        std::pair(ao::history_format::half_stalls, "half-float histories") }) {
        add(base_case(name)).settings.format = format;
        temporal_case& spoilt = add(base_case("poison, "));
        spoilt.name += name;
        spoilt.settings.format = format;
        spoilt.poison = true;
    }
    add(base_case("poison")).poison = true;
    temporal_case& camera_poison = add(base_case("poison, camera only", false));
    camera_poison.poison = true;
    camera_poison.settings.cubic = false;

    temporal_case& area = add(base_case("patches, uniform disc, clamped weights, bilinear"));
    area.settings.contribution = ao::contribution_type::fox_compton;
    area.settings.density = ao::sample_density::disc_area;
    area.settings.invalidation = ao::invalidation_type::clamp;
    area.settings.cubic = false;
    temporal_case& linear = add(base_case("patches, linear disc, a period that ends, background", false));
    linear.settings.contribution = ao::contribution_type::fox_compton;
    linear.settings.density = ao::sample_density::disc_linear;
    linear.settings.period = 37;
    linear.background = 5.5F;
    temporal_case& none = add(base_case("no invalidation, no filter, to 8 bits, motion of two numbers in ndc"));
    none.settings.invalidation = ao::invalidation_type::none;
    none.settings.filter = 1;
    none.facts.frame.output_format = r8;
    none.facts.motion_format = rg32f;
    none.facts.convention = { ao::motion_unit::ndc, true, true, false };

    temporal_case& hardware = add(base_case("hardware depth, 24 bits, 10-bit world normals, to 8 bits, half-float motion in uv"));
    hardware.facts.frame.depth = ao::depth_source::hardware;
    hardware.facts.frame.depth_format = d24;
    hardware.facts.frame.normals = ao::normal_source::unorm10;
    hardware.facts.frame.normal_format = rgb10a2;
    hardware.facts.frame.world_normals = true;
    hardware.facts.frame.output_format = r8;
    hardware.facts.motion_format = rgba16f;
    hardware.facts.convention = { ao::motion_unit::uv, false, true, true };
    temporal_case& window = add(base_case("hardware depth, floats, octahedral normals, no thickness", false));
    window.facts.frame.depth = ao::depth_source::hardware;
    window.facts.frame.depth_format = d32f;
    window.facts.frame.normals = ao::normal_source::octahedral;
    window.facts.frame.normal_format = rg16;
    window.settings.thickness = std::numeric_limits<float>::infinity();
    temporal_case& position = add(base_case("positions in halves, half-float normals, invalidation by a clamp"));
    position.facts.frame.depth = ao::depth_source::position;
    position.facts.frame.depth_format = rgba16f;
    position.facts.frame.normal_format = rgba16f;
    position.settings.invalidation = ao::invalidation_type::clamp;
    position.settings.filter = 9;
    temporal_case& rebuilt = add(base_case("positions, normals from depth, packed", false));
    rebuilt.facts.frame.depth = ao::depth_source::position;
    rebuilt.facts.frame.depth_format = rgba32f;
    rebuilt.facts.frame.normals = ao::normal_source::from_depth;
    rebuilt.settings.format = ao::history_format::packed;
    add(base_case("parallel projection")).facts.frame.parallel = true;
    temporal_case& parallel = add(base_case("parallel projection, patches", false));
    parallel.facts.frame.parallel = true;
    parallel.settings.contribution = ao::contribution_type::fox_compton;
    parallel.settings.density = ao::sample_density::disc_area;

    const auto slices = [](temporal_case& c, ao::preset chosen) {
        const ao::temporal_settings before = c.settings;
        c.settings = ao::temporal_settings_of(ao::settings_of(chosen, before.radius));
        c.settings.format = before.format;
    };
    slices(add(base_case("slices")), ao::preset::medium);
    temporal_case& low = add(base_case("slices of 4 taps, several a frame, packed, a moving camera", false));
    slices(low, ao::preset::low);
    low.settings.format = ao::history_format::packed;
    low.settings.first_samples = 12;
    low.settings.later_samples = 8;
    low.settings.period = 20;
    temporal_case& spoilt_slices = add(base_case("slices, poison, invalidation by a clamp, no thickness"));
    slices(spoilt_slices, ao::preset::medium);
    spoilt_slices.poison = true;
    spoilt_slices.settings.invalidation = ao::invalidation_type::clamp;
    spoilt_slices.settings.thickness = std::numeric_limits<float>::infinity();
    temporal_case& flat = add(base_case("slices, parallel projection, normals from depth", false));
    slices(flat, ao::preset::medium);
    flat.facts.frame.parallel = true;
    flat.facts.frame.normals = ao::normal_source::from_depth;

    add(base_case("one pixel", true, 1, 1));
    add(base_case("7x5", false, 7, 5));
    add(base_case("33x17", true, 33, 17)).settings.format = ao::history_format::packed;
    temporal_case& extreme = add(base_case("weights of 1, as many samples as the sequence has", true, 19, 9));
    extreme.settings.most_weight = extreme.settings.moving_weight = 1;
    extreme.settings.clamped_weight = 0;
    extreme.settings.period = extreme.settings.first_samples = 5;
    return all;
}

// The reference's visibility, stored in the output format; r8 rounds to the nearest code.
inline ao::picture stored_visibility(const picture& visibility, ao::pixel_format format)
{
    ao::picture stored(format, visibility.width, visibility.height);
    for (std::size_t i = 0; i < stored.pixels(); ++i) {
        if (format == ao::pixel_format::r8) {
            stored.set_texel(i, static_cast<std::uint8_t>(std::nearbyint(visibility.texels[i].x * 255.0F)));
        }
        else {
            stored.set_texel(i, visibility.texels[i].x);
        }
    }
    return stored;
}

// Bytes and words that differ, after a frame of both. Precondition: the runner has run what the executor has.
struct difference {
    std::size_t visibility = 0; // bytes
    std::size_t history = 0;    // words
};

inline difference compare(ao::host::temporal_runner& runner, const picture& visibility, const executor& reference)
{
    const auto seen = runner.download();
    const auto words = runner.history();
    REQUIRE(seen);
    REQUIRE(words);
    const ao::picture expected = stored_visibility(visibility, runner.plan().facts.frame.output_format);
    REQUIRE(seen->bytes.size() == expected.bytes.size());
    REQUIRE(words->size() == reference.history().size());
    difference d;
    for (std::size_t i = 0; i < expected.bytes.size(); ++i) {
        d.visibility += seen->bytes[i] == expected.bytes[i] ? 0 : 1;
    }
    for (std::size_t i = 0; i < words->size(); ++i) {
        d.history += (*words)[i] == reference.history()[i] ? 0 : 1;
    }
    return d;
}

inline void check_case(ao::host::temporal_runner& runner, const temporal_case& c)
{
    INFO(runner.name() << ": " << c.name);
    const auto prepared = runner.prepare(c.settings, c.facts);
    INFO((prepared ? std::string() : std::string(prepared.error().reason())));
    REQUIRE(prepared);
    executor reference = make_executor(c.settings, c.facts);
    std::uint32_t index = 0;
    for (const sequence_frame& f : make_sequence(c)) {
        INFO("frame " << index);
        if (f.fault) {
            spoil_history(reference.history(), index);
            REQUIRE(runner.set_history(reference.history()));
        }
        REQUIRE(runner.upload(f.frame.inputs.depth, f.frame.inputs.normal, f.frame.inputs.motion));
        const auto ran = runner.frame(f.frame.camera, f.cut);
        REQUIRE(ran);
        const picture& visibility = reference.run(f.frame.inputs, f.frame.camera, f.cut);
        CHECK(ran->size() == reference.steps());
        const difference d = compare(runner, visibility, reference);
        REQUIRE(d.history == 0);
        REQUIRE(d.visibility == 0);
        ++index;
    }
}

inline void check_cases(ao::host::temporal_runner& runner)
{
    for (const temporal_case& c : temporal_cases()) {
        check_case(runner, c);
    }
}

// A still view runs its passes until every pixel has converged, and none from then on.
inline void check_rest(ao::host::temporal_runner& runner)
{
    temporal_case c = base_case("a view that comes to rest", false, 16, 9);
    REQUIRE(runner.prepare(c.settings, c.facts));
    executor reference = make_executor(c.settings, c.facts);
    const scene_frame f = make_frame({ .width = 16, .height = 9 }, { .width = 16, .height = 9 });
    std::size_t idle = 0;
    for (int i = 0; i < 20; ++i) {
        REQUIRE(runner.upload(f.inputs.depth, f.inputs.normal, f.inputs.motion));
        const auto ran = runner.frame(f.camera);
        REQUIRE(ran);
        idle += ran->empty() ? 1 : 0;
        const difference d = compare(runner, reference.run(f.inputs, f.camera), reference);
        REQUIRE(d.history == 0);
        REQUIRE(d.visibility == 0);
    }
    CHECK(idle == 20 - static_cast<std::size_t>(ao::frames_to_converge(c.settings)));
}

// Requests that make no sense are refused, and what was there goes on as if they had not been made.
inline void check_bad_requests(ao::host::temporal_runner& runner)
{
    const temporal_case c = base_case("bad requests");
    {
        ao::temporal_settings wrong = c.settings;
        wrong.period = 0;
        const auto prepared = runner.prepare(wrong, c.facts);
        REQUIRE_FALSE(prepared);
        CHECK(prepared.error().code() == ao::errc::invalid_settings);
        ao::temporal_facts unlike = c.facts;
        unlike.frame.width = 0;
        CHECK_FALSE(runner.prepare(c.settings, unlike));
        unlike = c.facts;
        unlike.motion_format = ao::pixel_format::rgb10a2;
        CHECK_FALSE(runner.prepare(c.settings, unlike));
    }
    REQUIRE(runner.prepare(c.settings, c.facts));
    executor reference = make_executor(c.settings, c.facts);
    const auto frames = make_sequence(c);
    const auto run = [&](const scene_frame& f) {
        REQUIRE(runner.upload(f.inputs.depth, f.inputs.normal, f.inputs.motion));
        REQUIRE(runner.frame(f.camera));
        const difference d = compare(runner, reference.run(f.inputs, f.camera), reference);
        CHECK(d.history == 0);
        CHECK(d.visibility == 0);
    };
    run(frames[2].frame);
    const scene_frame& next = frames[3].frame;
    const ao::picture larger(ao::pixel_format::r32f, c.facts.frame.width + 1, c.facts.frame.height);
    const ao::picture other(ao::pixel_format::rgba16f, c.facts.frame.width, c.facts.frame.height);
    CHECK_FALSE(runner.upload(larger, next.inputs.normal, next.inputs.motion));
    CHECK_FALSE(runner.upload(next.inputs.depth, other, next.inputs.motion));
    CHECK_FALSE(runner.upload(next.inputs.depth, next.inputs.normal, other));
    CHECK_FALSE(runner.set_history(std::vector<std::uint32_t>(3)));
    REQUIRE(runner.upload(next.inputs.depth, next.inputs.normal, next.inputs.motion));
    ao::temporal_camera singular = next.camera;
    singular.projection.matrix[0][0] = 0;
    CHECK_FALSE(runner.frame(singular));
    singular = next.camera;
    singular.world_to_view[1][1] = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(runner.frame(singular));
    run(next);
    // Prepared anew, it begins anew.
    REQUIRE(runner.prepare(c.settings, c.facts));
    reference = make_executor(c.settings, c.facts);
    run(next);
    run(frames[4].frame);
}

} // namespace temporal_test
