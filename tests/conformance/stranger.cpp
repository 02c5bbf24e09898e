// A backend from outside runs the suite against itself, and the suite finds what is wrong with it.
#include "conformance/plain.hpp"
#include "conformance/suite.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace ao::conformance;

namespace {

using evaluate_function = void (*)(int, std::span<const glm::vec4>, std::span<const glm::vec4>, std::span<glm::vec4>);

void evaluate_right(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b, std::span<glm::vec4> out)
{
    for (std::size_t i = 0; i < a.size(); ++i) {
        out[i] = evaluator<float>::ao_evaluate(function, a[i], b[i]);
    }
}

plain::image to_image(const ao::picture& p)
{
    return { p.width, p.height, decode<float>(p).texels };
}

// `exact` is what it claims to be; a hardware backend claims false.
struct plain_subject {
    bool claims_exact = true;
    plain::fault planted = plain::fault::none;
    evaluate_function functions = evaluate_right;

    std::string_view name() const { return "plain"; }
    bool exact() const { return claims_exact; }

    ao::result<ao::picture> run(const ao::settings& chosen, const ao::facts& known, const ao::camera& view,
                                const ao::picture& depth, const ao::picture& normal) const
    {
        plain::backend b{ planted };
        auto effect = ao::effect<plain::backend>::create(b, chosen, known, view);
        if (!effect) {
            return effect.error();
        }
        plain::image depths = to_image(depth);
        plain::image normals = to_image(normal);
        plain::image visibility{ known.width, known.height, std::vector<glm::vec4>(depth.pixels()) };
        auto bound = effect->bind({ &depths, &normals, &visibility });
        if (!bound) {
            return bound.error();
        }
        effect->record({}, *bound);
        ao::picture out(known.output_format, known.width, known.height);
        for (std::size_t i = 0; i < out.pixels(); ++i) {
            const glm::vec4 texel = visibility.texels[i];
            const float v = texel.x;
            if (out.format == ao::pixel_format::rgba16f) {
                out.set_texel(i, std::array{ ao::float_to_half(v), ao::float_to_half(texel.y), ao::float_to_half(texel.z),
                                             ao::float_to_half(texel.w) });
            }
            else if (out.format == ao::pixel_format::r8) {
                out.set_texel(i, static_cast<std::uint8_t>(std::nearbyint(v * 255.0F)));
            }
            else {
                out.set_texel(i, v);
            }
        }
        return out;
    }

    ao::result<ao::success> evaluate(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                                     std::span<glm::vec4> out) const
    {
        functions(function, a, b, out);
        return ao::success{};
    }
};

} // namespace

TEST_CASE("a stranger's backend passes the suite, by its bits and by the bounds")
{
    for (const bool exact : { true, false }) {
        plain_subject subject{ exact };
        check_suite(subject);
    }
}

TEST_CASE("faults planted into a stranger's passes are found, by bits and by bounds")
{
    using plain::fault;
    for (const fault planted : { fault::bias_ignored, fault::texel_beside, fault::border_short, fault::tile_transposed,
                                 fault::thickness_ignored, fault::last_tap_lost, fault::whole_lost }) {
        for (const bool exact : { true, false }) {
            if (planted == fault::whole_lost && !exact) {
                continue; // bent normals have no bounds but their length
            }
            plain_subject subject{ exact, planted };
            const auto faults = faults_of(subject, { .functions = false });
            INFO("fault " << static_cast<int>(planted) << (exact ? ", exact" : ", bounds"));
            REQUIRE_FALSE(faults.empty());
            // Says where and how far.
            CHECK_THAT(faults.front(), Catch::Matchers::Contains("pixel ("));
            CHECK_THAT(faults.front(), Catch::Matchers::Contains("instead of"));
        }
    }
}

#define AO_DECLARE_PLANTED(name)                                                                                                 \
    namespace name {                                                                                                             \
    void evaluate(int, std::span<const glm::vec4>, std::span<const glm::vec4>, std::span<glm::vec4>);                            \
    }
AO_DECLARE_PLANTED(planted_half)
AO_DECLARE_PLANTED(planted_scale)
AO_DECLARE_PLANTED(planted_order)
AO_DECLARE_PLANTED(planted_tangent)
AO_DECLARE_PLANTED(planted_fold)
AO_DECLARE_PLANTED(planted_centre)

TEST_CASE("faults planted into the shared source are found in the function tables, by bits and by bounds")
{
    struct planted {
        const char* function;
        evaluate_function functions;
    };
    // 0.5 -> 0.5000003; a scale one unit off; another order of summation; -1 -> -1.000002; a fold of 1e-6; a centre not added
    for (const planted& p :
         { planted{ "unorm_code", planted_half::evaluate }, planted{ "radical_inverse(3)", planted_scale::evaluate },
           planted{ "dot", planted_order::evaluate }, planted{ "any_tangent", planted_tangent::evaluate },
           planted{ "octahedral", planted_fold::evaluate }, planted{ "to_pixel", planted_centre::evaluate } }) {
        for (const bool exact : { true, false }) {
            plain_subject subject{ exact, plain::fault::none, p.functions };
            const auto faults = faults_of(subject, { .passes = false });
            INFO(p.function << (exact ? ", exact" : ", bounds"));
            REQUIRE_FALSE(faults.empty());
            CHECK(std::any_of(faults.begin(), faults.end(), [&](const std::string& f) { return f.find(p.function) != f.npos; }));
        }
    }
}
