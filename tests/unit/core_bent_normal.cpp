// Bent normals of the method `bitmask`: the polynomials against the integral they stand for, the passes against closed forms.
#include "unit/core_geometry.hpp"

#include "ao/conformance/reference.hpp"
#include "ao/harmonic_light.hpp"
#include "ao/sphere_rule.hpp"

#include <catch2/catch.hpp>

#include <array>

using namespace core_test;

namespace {

constexpr double pi = 3.14159265358979323846;
using reals = ao::math<float>;

// Visibility and bent normal of every pixel.
std::vector<glm::vec4> bent(const viewer& v, const pictures& p, ao::settings s,
                            ao::normal_source source = ao::normal_source::vector)
{
    s.bent_normal = true;
    ao::facts f;
    f.width = p.width;
    f.height = p.height;
    f.normals = source;
    f.normal_format = ao::pixel_format::rgba32f;
    f.parallel = v.parallel;
    f.output_format = ao::pixel_format::rgba16f;
    const auto planned = ao::make_plan(s, f, v.camera());
    REQUIRE(planned);
    ao::picture depth(ao::pixel_format::r32f, v.width, v.height);
    ao::picture normal(ao::pixel_format::rgba32f, v.width, v.height);
    for (std::size_t i = 0; i < p.depth.size(); ++i) {
        depth.set_texel(i, p.depth[i]);
        normal.set_texel(i, glm::vec4(p.normals[i], 0.0F));
    }
    ao::conformance::executor<float> run(*planned, depth, normal);
    return run.run().texels;
}

ao::settings unfiltered(int taps, int slices)
{
    ao::settings s = ao::settings_of(ao::preset::ultra);
    s.filter = 1;
    s.taps = taps;
    s.slices = slices;
    return s;
}

// Sum over the pixels of some columns.
glm::dvec3 sum_of_columns(const viewer& v, const std::vector<glm::vec4>& all, int left, int right)
{
    glm::dvec3 sum(0.0);
    for (int y = 0; y < v.height; ++y) {
        for (int x = left; x < right; ++x) {
            const glm::vec4& texel = all[static_cast<std::size_t>(y * v.width + x)];
            sum += glm::dvec3(texel.y, texel.z, texel.w);
        }
    }
    return sum;
}

double degrees(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / pi;
}

} // namespace

TEST_CASE("Mean directions of a slice's quarters are as near as they say", "[core][bent]")
{
    double worst = 0;
    for (int i = 0; i <= 200; ++i) {
        const double gamma = pi * (i / 200.0 - 0.5);
        const auto slice = reals::ao_make_slice(static_cast<float>(std::sin(gamma)), static_cast<float>(std::cos(gamma)));
        // Moments of each quarter by the midpoint rule.
        constexpr int steps = 8000;
        const double end = gamma + pi / 2;
        const auto weight = [&](double t) { return std::max(0.0, std::cos(t - gamma) * std::sin(t)); };
        double whole = 0;
        for (int k = 0; k < steps; ++k) {
            whole += weight(end * (k + 0.5) / steps);
        }
        if (whole == 0) {
            continue;
        }
        std::array<glm::dvec3, 4> quarters{};
        double before = 0;
        for (int k = 0; k < steps; ++k) {
            const double t = end * (k + 0.5) / steps;
            const double w = weight(t);
            const auto quarter = std::min(static_cast<std::size_t>(4 * (before + w / 2) / whole), std::size_t{ 3 });
            quarters[quarter] += w * glm::dvec3(std::cos(t), std::sin(t), 1);
            before += w;
        }
        for (std::size_t q = 0; q < 4; ++q) {
            const auto found = reals::ao_openness_of(slice, glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), ~(0xffU << (8 * q)));
            const glm::dvec3 expected = quarters[q] / quarters[q].z;
            CAPTURE(gamma, q, expected.x, expected.y, found.open.x, found.open.y);
            const double error = std::hypot(4 * static_cast<double>(found.open.x) - expected.x,
                                            4 * static_cast<double>(found.open.y) - expected.y);
            worst = std::max(worst, error * static_cast<double>(slice.weight));
        }
    }
    CHECK(worst < 0.013);
    CHECK(worst > 0.005);
}

TEST_CASE("Packed directions hold multiples of 1/127 exactly", "[core][bent]")
{
    for (const int x : { -127, -126, -64, -1, 0, 1, 2, 63, 127 }) {
        for (const int y : { -127, -5, 0, 77, 127 }) {
            for (const int z : { -127, -31, 0, 99, 127 }) {
                const glm::vec3 v(x, y, z);
                const float packed = reals::ao_pack_direction(v / 127.0F);
                CHECK(reals::ao_unpack_direction(packed) == v);
            }
        }
    }
    CHECK(reals::ao_unpack_direction(reals::ao_pack_direction({ 1.5F, -2, 0 })) == glm::vec3(127, -127, 0));
}

TEST_CASE("On an open plane the bent normal is the normal, at every tilt", "[core][bent][closed]")
{
    const auto preset = GENERATE(ao::preset::low, ao::preset::medium, ao::preset::high, ao::preset::ultra);
    const bool filtered = GENERATE(false, true);
    viewer v{ 40, 30, 0.2, false };
    v.parallel = GENERATE(false, true);
    if (v.parallel) {
        v.extent = 2;
    }
    for (const double tilt : { 0.0, 30.0, 60.0, 75.0, 80.0, 85.0 }) {
        for (const double around : { 70.0, 215.0 }) {
            const glm::dvec3 n(std::sin(tilt * pi / 180) * std::cos(around * pi / 180),
                               std::sin(tilt * pi / 180) * std::sin(around * pi / 180), std::cos(tilt * pi / 180));
            ao::settings s = ao::settings_of(preset, 2.0F);
            if (!filtered) {
                s.resolution = ao::resolution::full;
                s.filter = 1;
            }
            double worst = 0;
            const pictures p = v.picture(plane(n, -40 * n.z));
            const std::vector<glm::vec4> all = bent(v, p, s);
            for (std::size_t i = 0; i < all.size(); ++i) {
                const glm::vec4& texel = all[i];
                REQUIRE(texel.x == 1.0F);
                if (!(p.depth[i] > 0)) {
                    CHECK(texel == glm::vec4(1, 0, 0, 1)); // background
                    continue;
                }
                for (int k = 0; k < 3; ++k) {
                    worst = std::max(worst, std::abs(static_cast<double>(texel[k + 1]) - n[k]));
                }
            }
            CAPTURE(tilt, around, v.parallel, s.taps, filtered);
            // Half a step of what is stored, and a few roundings of a float.
            CHECK(worst < 0.5 / 2048 + 1e-6);
        }
    }
}

TEST_CASE("Beside a wall the bent normal leans away as far as it should", "[core][bent][closed]")
{
    // A floor seen from above and a step as high as the radius. Projected to the unit disc, cosine-weighted directions are
    // uniform, and those beyond h, the distance to the wall in radii, are blocked: the mean of the rest is
    // (-2 (1 - h^2)^(3/2) / (3 pi), 1/3 + h/2 - h^3/6).
    viewer v{ 128, 48, 0.75, true }; // a pixel is 1/32
    pictures p(v.width, v.height);
    for (int y = 0; y < v.height; ++y) {
        for (int x = 0; x < v.width; ++x) {
            p.depth[p.index(x, y)] = x < v.width / 2 ? 10.0F : 9.0F;
            p.normals[p.index(x, y)] = glm::vec3(0, 0, 1);
        }
    }
    const double pixel = 2 * v.wide() / v.width;
    const std::vector<glm::vec4> all = bent(v, p, unfiltered(1024, 16));
    for (const int away : { 3, 8, 16, 24, 31 }) { // pixels from the wall, of 32 in the radius
        const double h = away * pixel;
        const glm::dvec3 expected(-2 * std::pow(1 - h * h, 1.5) / (3 * pi), 0, 1.0 / 3 + h / 2 - h * h * h / 6);
        const glm::dvec3 found = sum_of_columns(v, all, v.width / 2 - away, v.width / 2 - away + 1);
        CAPTURE(away, h, expected.x, expected.z, found.x, found.y, found.z);
        // A quarter of a slice spans some 30 degrees and counts as its mean, however much of it is open.
        CHECK(degrees(expected, found) < 1.5);
    }
    for (int x = 0; x < v.width / 2 - 33; ++x) {
        CHECK(sum_of_columns(v, all, x, x + 1) == glm::dvec3(0, 0, v.height));
    }
}

TEST_CASE("In the middle of a trench the bent normal is the normal", "[core][bent][closed]")
{
    viewer v{ 65, 48, 0.75, true };
    pictures p(v.width, v.height);
    for (int y = 0; y < v.height; ++y) {
        for (int x = 0; x < v.width; ++x) {
            p.depth[p.index(x, y)] = std::abs(x - 32) < 8 ? 10.0F : 9.0F;
            p.normals[p.index(x, y)] = glm::vec3(0, 0, 1);
        }
    }
    for (const auto preset : { ao::preset::medium, ao::preset::high, ao::preset::ultra }) {
        glm::dvec3 middle(0.0);
        glm::dvec3 left(0.0);
        glm::dvec3 right(0.0);
        ao::settings s = ao::settings_of(preset);
        for (s.seed = 1; s.seed <= 8; ++s.seed) {
            const std::vector<glm::vec4> all = bent(v, p, s);
            middle += sum_of_columns(v, all, 32, 33);
            left += sum_of_columns(v, all, 26, 27);
            right += sum_of_columns(v, all, 38, 39);
        }
        CAPTURE(static_cast<int>(preset), middle.x, middle.y, middle.z, left.x, left.z, right.x, right.z);
        CHECK(degrees(middle, { 0, 0, 1 }) < 1);
        // Nearer to one wall, away from it, and alike on both sides.
        CHECK(degrees(left, { 0, 0, 1 }) > 5);
        CHECK(left.x > 0);
        CHECK(degrees(left, { -right.x, right.y, right.z }) < 2);
    }
}

TEST_CASE("Visibility beside bent normals is what it is without", "[core][bent]")
{
    viewer v{ 48, 36, 0.6, false };
    const pictures p = v.picture(both(plane({ 0, 0, 1 }, -6), sphere({ 0.3, 0.1, -5.4 }, 0.8)));
    for (const int filter : { 1, 5 }) {
        ao::settings s = ao::settings_of(ao::preset::high);
        s.filter = filter;
        s.resolution = filter == 1 ? ao::resolution::full : ao::resolution::half;
        const std::vector<glm::vec4> both_of_it = bent(v, p, s);
        const ao::plan planned = plan_for(p, s, v.camera());
        ao::picture depth(ao::pixel_format::r32f, v.width, v.height);
        ao::picture normal(ao::pixel_format::rgba32f, v.width, v.height);
        for (std::size_t i = 0; i < p.depth.size(); ++i) {
            depth.set_texel(i, p.depth[i]);
            normal.set_texel(i, glm::vec4(p.normals[i], 0.0F));
        }
        ao::conformance::executor<float> run(planned, depth, normal);
        const auto& alone = run.run().texels;
        int leaning = 0;
        for (std::size_t i = 0; i < alone.size(); ++i) {
            CHECK(std::abs(both_of_it[i].x - alone[i].x) <= 0.5F / 2048);
            const glm::vec3 direction(both_of_it[i].y, both_of_it[i].z, both_of_it[i].w);
            // Less than a right angle, but for the steps of what is stored.
            CHECK(glm::dot(direction, p.normals[i]) > -1e-3F);
            leaning += degrees(glm::dvec3(direction), glm::dvec3(p.normals[i])) > 3 ? 1 : 0;
        }
        CHECK(leaning > 50);
    }
}

TEST_CASE("Bent normals have a plan of their own, and cost nothing where they are not asked for", "[core][bent]")
{
    ao::facts f;
    f.width = 64;
    f.height = 48;
    const ao::camera view = simple_camera(64, 48);
    ao::settings s = ao::settings_of(ao::preset::high);
    const auto reason = [&] {
        const auto made = ao::make_plan(s, f, view);
        return made ? std::string() : std::string(made.error().reason());
    };
    const auto plain = ao::make_plan(s, f, view);
    REQUIRE(plain);
    CHECK(plain->transients[0].format == ao::pixel_format::rg32f);
    CHECK(plain->transients[1].format == ao::pixel_format::rg32f);
    s.bent_normal = true;
    CHECK(reason() == "visibility with bent normals must be rgba16f");
    f.output_format = ao::pixel_format::rgba16f;
    const auto both_of_it = ao::make_plan(s, f, view);
    REQUIRE(both_of_it);
    CHECK_FALSE(ao::same_structure(*plain, *both_of_it));
    CHECK(both_of_it->passes.size() == plain->passes.size());
    CHECK(both_of_it->transients[0].format == ao::pixel_format::rgba32f);
    for (const ao::pass& each : plain->passes) {
        CHECK_FALSE(each.options.bent_normal);
    }
    s.bent_normal = false;
    CHECK(reason() == "visibility must be r32f or r8");
    s.bent_normal = true;
    s.method = ao::method::hemisphere;
    CHECK(reason() == "bent normals come from the method bitmask");
}

TEST_CASE("Light of harmonics beside a wall is nearer to truth along the bent normal than along the normal",
          "[core][bent][light]")
{
    // As above the wall at x = h blocks what lies beyond h of the unit disc. Light of 1 + d . x brings the open share of the disc
    // plus d . the open mean; unoccluded it brings 1 + 2/3 d . n.
    for (const double h : { 0.05, 0.25, 0.5, 0.75 }) {
        const double visibility = 1 - (std::acos(h) - h * std::sqrt(1 - h * h)) / pi;
        const glm::dvec3 open(-2 * std::pow(1 - h * h, 1.5) / (3 * pi), 0, 1.0 / 3 + h / 2 - h * h * h / 6);
        const glm::dvec3 bent = glm::normalize(open);
        double along_bent = 0;
        double along_normal = 0;
        for (const glm::dvec3 d : { glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.6, 0, 0.8),
                                    glm::dvec3(-0.6, 0.48, 0.64) }) {
            const auto sky = [&](const ao::direction3& x) { return glm::dvec3(1 + d.x * x[0] + d.y * x[1] + d.z * x[2]); };
            const auto packed = ao::pack_harmonics(ao::averaged(ao::project<glm::dvec3>(*ao::fibonacci_rule(20000), 1, sky), 1));
            const double truth = visibility + glm::dot(d, open);
            along_bent += std::pow(ao::light_of_harmonics(packed, bent, visibility).x - truth, 2);
            along_normal += std::pow(ao::light_of_harmonics(packed, glm::dvec3(0, 0, 1), visibility).x - truth, 2);
            // What the wall leaves open of constant light is exact.
            const auto grey = ao::pack_harmonics(ao::averaged(
                ao::project<glm::dvec3>(*ao::fibonacci_rule(20000), 0, [](const ao::direction3&) { return glm::dvec3(1); }), 1));
            CHECK(ao::light_of_harmonics(grey, bent, visibility).x == Approx(visibility).epsilon(1e-6));
        }
        CAPTURE(h, along_bent, along_normal);
        CHECK(along_bent < 0.25 * along_normal);
    }
}
