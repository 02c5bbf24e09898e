// One poisoned texel: the output stays finite in [0, 1], and only the pixels that read the texel may change (numerics.md P1, P2).
#include "unit/core_pictures.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <set>

using namespace core_test;

namespace {

const float poisons[] = { std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(),
                          1e38F,
                          -1e38F,
                          std::numeric_limits<float>::max(),
                          1e-41F,
                          0.0F,
                          -0.0F,
                          -1.0F };

struct outcome {
    std::vector<float> visibility;
    std::set<std::size_t> readers; // pixels that read the watched texel
};

// Scalar, one pixel at a time, so that every read belongs to a pixel.
outcome run_watched(const pictures& p, const ao::plan& plan, std::size_t watched)
{
    outcome result;
    std::size_t current = 0;
    picture_resources<float> resources(p, plan.settings);
    const auto note = [&](std::size_t texel) {
        if (texel == watched) {
            result.readers.insert(current);
        }
    };
    resources.on_depth = note;
    resources.on_normal = note;
    const ao::pass& planned = pass_of(plan, ao::pass_type::occlusion);
    ao::occlusion_pass<float, picture_resources<float>> body{ resources };
    set_options(body, planned.options);
    const auto constants = ao::constants_of<ao::occlusion_constants>(planned);
    using body_type = decltype(body);
    const auto own = ao::convert_constants<body_type::ao_occlusion_constants, float, ao::occlusion_constants, float>(constants);
    for (int y = 0; y < p.height; ++y) {
        for (int x = 0; x < p.width; ++x) {
            current = p.index(x, y);
            result.visibility.push_back(body.ao_occlusion_pass(own, { x, y }));
        }
    }
    return result;
}

} // namespace

TEST_CASE("Poison stays with the taps that read it", "[core][poison]")
{
    const auto source = GENERATE(ao::normal_source::vector, ao::normal_source::from_depth);
    const bool parallel = GENERATE(false, true);
    const int filter = GENERATE(1, 5);
    const float thickness = GENERATE(std::numeric_limits<float>::infinity(), 0.5F);
    const int width = 24;
    const int height = 20;
    const pictures clean = rough_scene(width, height, 3);
    ao::settings s;
    s.taps = 8;
    s.radius = 0.8F;
    s.filter = filter;
    s.thickness = thickness;
    const ao::plan plan = plan_for(clean, s, simple_camera(width, height, parallel ? 3.0 : 0.6, parallel), parallel, source);

    const std::size_t where = clean.index(11, 9);
    const outcome before = run_watched(clean, plan, where);
    for (const float poison : poisons) {
        for (int channel = 0; channel < 4; ++channel) {
            pictures poisoned = clean;
            if (channel == 3) {
                poisoned.depth[where] = poison;
            }
            else {
                poisoned.normals[where][channel] = poison;
            }
            const outcome after = run_watched(poisoned, plan, where);
            CAPTURE(poison, channel);
            std::set<std::size_t> changed;
            for (std::size_t i = 0; i < after.visibility.size(); ++i) {
                const float v = after.visibility[i];
                const bool marked = filter > 1 && v == -1.0F;
                REQUIRE(((v >= 0.0F && v <= 1.0F) || marked));
                if (v != before.visibility[i]) {
                    changed.insert(i);
                    REQUIRE((before.readers.count(i) != 0 || after.readers.count(i) != 0));
                }
            }
            // A filtered picture spreads no further than its window.
            if (filter > 1) {
                const auto a = run_filter<float>(before.visibility, width, height, filter);
                const auto b = run_filter<float>(after.visibility, width, height, filter);
                for (int y = 0; y < height; ++y) {
                    for (int x = 0; x < width; ++x) {
                        const std::size_t i = clean.index(x, y);
                        REQUIRE((b[i] >= 0.0F && b[i] <= 1.0F));
                        if (a[i] != b[i]) {
                            bool reached = false;
                            for (const std::size_t c : changed) {
                                const int u = static_cast<int>(c) % width;
                                const int v = static_cast<int>(c) / width;
                                reached = reached || (std::abs(u - x) <= filter / 2 && std::abs(v - y) <= filter / 2);
                            }
                            REQUIRE(reached);
                        }
                    }
                }
            }
        }
    }
    // The test can see poison at all: the texel is read by more than its own pixel.
    CHECK(before.readers.size() > 1);
}

TEMPLATE_TEST_CASE("A picture of nothing but poison is finite", "[core][poison]", float, lanes8)
{
    const int width = 16;
    const int height = 9;
    const auto source = GENERATE(ao::normal_source::vector, ao::normal_source::from_depth);
    std::mt19937 engine(2);
    pictures p(width, height);
    for (std::size_t i = 0; i < p.depth.size(); ++i) {
        const auto pick = [&] { return (engine() & 3U) == 0 ? 2.0F : poisons[engine() % std::size(poisons)]; };
        p.depth[i] = pick();
        p.normals[i] = { pick(), pick(), pick() };
    }
    for (const float radius : { 1e-30F, 1.0F, 1e15F }) {
        ao::settings s;
        s.radius = radius;
        const ao::plan plan = plan_for(p, s, simple_camera(width, height), false, source);
        const auto raw = run_occlusion<TestType>(plan, picture_resources<TestType>(p, s));
        for (const float v : raw) {
            REQUIRE(((v >= 0.0F && v <= 1.0F) || v == -1.0F));
        }
        for (const float v : run_filter<TestType>(raw, width, height, 5)) {
            REQUIRE((v >= 0.0F && v <= 1.0F));
        }
    }
}

TEST_CASE("Every poisoned stored depth linearises to background or to a finite depth in front of the eye", "[core][poison]")
{
    struct stored {
        float value;
        float stored_depth(glm::ivec2) const { return value; }
    };
    for (int bits = 0; bits < 8; ++bits) {
        ao::projection_options options;
        options.range = (bits & 1) != 0 ? ao::depth_range::minus_one_to_one : ao::depth_range::zero_to_one;
        options.reversed = (bits & 2) != 0;
        ao::frustum f;
        if ((bits & 4) != 0) {
            f.far = std::numeric_limits<double>::infinity();
        }
        const auto folded = ao::fold_projection(ao::make_projection(f, options), 8, 8);
        using body = ao::linearize_pass<float, stored>;
        const auto c = ao::convert_constants<body::ao_depth_decode, float, ao::linearize_constants, float>(folded->decode);
        for (const float value : poisons) {
            body pass{ { value } };
            const float d = pass.ao_linearize_pass(c, { 3, 4 });
            CAPTURE(bits, value, d);
            CHECK((d >= 0.0F && d < std::numeric_limits<float>::max()));
        }
        body cleared{ { folded->decode.cleared } };
        CHECK(cleared.ao_linearize_pass(c, { 3, 4 }) == 0.0F);
        body nan{ { std::numeric_limits<float>::quiet_NaN() } };
        CHECK(nan.ao_linearize_pass(c, { 3, 4 }) == 0.0F);
    }
}
