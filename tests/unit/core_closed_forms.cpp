// The whole pass against what it must tend to: open plane, wall crease, sphere above a plane, disc above a plane. The
// k-estimator is the share of the kernel's volume behind the depth buffer, not ray-traced occlusion; that share is known in
// closed form for plane and crease, and by brute force over the geometry in double for the others.
#include "unit/core_geometry.hpp"

#include <catch2/catch.hpp>

using namespace core_test;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr double degrees = 3.14159265358979323846 / 180;

// Largest change of the depth of the plane n . p = distance within half a pixel of any pixel's centre.
double half_pixel_step(const viewer& v, const solid& scene)
{
    double most = 0;
    for (int y = 0; y < v.height; ++y) {
        for (int x = 0; x < v.width; ++x) {
            const double middle = v.see(scene, x + 0.5, y + 0.5).depth;
            for (const double dx : { 0.0, 1.0 }) {
                for (const double dy : { 0.0, 1.0 }) {
                    most = std::max(most, std::abs(v.see(scene, x + dx, y + dy).depth - middle));
                }
            }
        }
    }
    return most;
}

} // namespace

TEMPLATE_TEST_CASE("An open plane is open at every tilt, exactly", "[core][closed]", float, double, lanes8)
{
    const auto kernel = GENERATE(ao::method::box, ao::method::hemisphere, ao::method::halton);
    const auto source = GENERATE(ao::normal_source::vector, ao::normal_source::from_depth);
    viewer v{ 28, 21, 0.3, false };
    v.parallel = GENERATE(false, true);
    if (v.parallel) {
        v.extent = 3;
    }
    for (const double tilt : { 0.0, 20.0, 40.0, 60.0 }) {
        for (const double around : { 70.0, 215.0 }) {
            const glm::dvec3 n(std::sin(tilt * degrees) * std::cos(around * degrees),
                               std::sin(tilt * degrees) * std::sin(around * degrees), std::cos(tilt * degrees));
            const solid scene = plane(n, -5 * n.z);
            const pictures p = v.picture(scene);
            ao::settings s;
            s.method = kernel;
            s.taps = 32;
            s.filter = 1;
            s.thickness = inf;
            // The bias that docs/integrating.md asks for: what the depth changes within half a pixel. 1e-4 for float's rounding.
            s.bias = static_cast<float>(half_pixel_step(v, scene) * 1.0001 + 1e-4);
            const ao::plan planned = plan_for(p, s, v.camera(), v.parallel, source);
            const auto raw = run_occlusion<TestType>(planned, picture_resources<TestType>(p, s));
            int wrong = 0;
            for (const float visibility : raw) {
                wrong += visibility != 1.0F;
            }
            CAPTURE(tilt, around, v.parallel, static_cast<int>(source));
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("Without bias the open plane at a tilt is not open", "[core][closed]")
{
    // What the bias is for; and the control of the test above.
    const viewer v{ 48, 36, 0.6, false };
    const solid scene = plane(normalized({ 0.5, 0.3, 0.8 }), -4);
    const pictures p = v.picture(scene);
    ao::settings s;
    s.bias = 0;
    const auto raw = run_occlusion<float>(plan_for(p, s, v.camera()), picture_resources<float>(p, s));
    CHECK(std::count_if(raw.begin(), raw.end(), [](float x) { return x != 1.0F; }) > 100);
}

TEST_CASE("Background is open, and no occluder", "[core][closed]")
{
    const viewer v{ 40, 30, 0.6, false };
    ao::settings s;
    s.filter = 1;
    SECTION("nothing but background")
    {
        const pictures p(v.width, v.height);
        for (const float x : run_occlusion<float>(plan_for(p, s, v.camera()), picture_resources<float>(p, s))) {
            CHECK(x == 1.0F);
        }
    }
    SECTION("a plane with a hole")
    {
        pictures p(v.width, v.height, 4.0F);
        for (int y = 10; y < 20; ++y) {
            for (int x = 10; x < 20; ++x) {
                p.depth[p.index(x, y)] = x < 15 ? 0.0F : inf;
            }
        }
        for (const float x : run_occlusion<float>(plan_for(p, s, v.camera()), picture_resources<float>(p, s))) {
            CHECK(x == 1.0F);
        }
    }
    SECTION("camera::background cuts far surfaces off")
    {
        pictures p(v.width, v.height, 4.0F);
        p.depth[p.index(20, 15)] = 3.0F; // an occluder in front of the plane
        ao::camera view = v.camera();
        view.background = 3.5F;
        for (const float x : run_occlusion<float>(plan_for(p, s, view), picture_resources<float>(p, s))) {
            CHECK(x == 1.0F);
        }
    }
}

TEST_CASE("Offsets behind the eye and off the picture are open", "[core][closed]")
{
    ao::settings s;
    s.filter = 1;
    s.taps = 64;
    s.thickness = inf;
    SECTION("a surface nearer than the radius, looking away from the eye: offsets with depth <= 0 are open, none is NaN")
    {
        const viewer v{ 32, 32, 0.6, false };
        pictures p(v.width, v.height, 0.05F);
        for (const float x : run_occlusion<float>(plan_for(p, s, v.camera()), picture_resources<float>(p, s))) {
            CHECK(x == 1.0F); // every offset is towards the eye or behind it
        }
    }
    SECTION("beyond the picture's edge an open floor goes on")
    {
        const viewer v{ 200, 150, 0.6, false };
        const solid scene = plane({ 0, 1, 0 }, -1);
        const pictures p = v.picture(scene);
        s.bias = 0.05F;
        const auto raw = run_occlusion<float>(plan_for(p, s, v.camera()), picture_resources<float>(p, s));
        for (int y = 0; y < 30; ++y) {
            CHECK(raw[p.index(199, y)] == 1.0F);
            CHECK(raw[p.index(0, y)] == 1.0F);
        }
        CHECK(raw[p.index(100, 0)] == 1.0F);
    }
    SECTION("beyond the picture's edge a wall goes on")
    {
        // Parallel view, floor at depth 5; the wall's top, .5 nearer, begins two pixels from the right edge.
        const viewer v{ 60, 60, 3.0, true };
        pictures p(v.width, v.height, 5.0F);
        for (int y = 0; y < 60; ++y) {
            p.depth[p.index(58, y)] = 4.5F;
            p.depth[p.index(59, y)] = 4.5F;
        }
        s.method = ao::method::hemisphere;
        s.taps = ao::max_taps;
        const auto raw = run_occlusion<float>(plan_for(p, s, v.camera(), true), picture_resources<float>(p, s));
        // Beside the wall, offsets below its top and beyond its edge: h = 1/20 of the radius away. Cut off at .5 of the height.
        const double h = 0.05;
        double share = 0; // of the half ball: x > h, 0 < z < 1/2
        const int steps = 2000;
        for (int i = 0; i < steps; ++i) {
            const double z = 0.5 * (i + 0.5) / steps;
            const double r = std::sqrt(1 - z * z);
            share += (r * r * std::acos(h / r) - h * std::sqrt(r * r - h * h)) * 0.5 / steps / (2.0 / 3 * 3.14159265358979323846);
        }
        const double k = 1 - static_cast<double>(raw[p.index(57, 30)]);
        CAPTURE(share, k);
        CHECK(std::abs(k - share) <
              0.02 / 2 + 4 * std::sqrt(share * (1 - share) / s.taps)); // the bias shifts the top by .02 of .5
    }
}

TEST_CASE("Occlusion of nothing and of everything is exact", "[core][closed]")
{
    // Every offset of this surface is behind a wall of depth 1; or nothing is in front.
    const int taps = GENERATE(1, 3, 32, 100, ao::max_taps);
    ao::settings s;
    s.taps = taps;
    s.radius = 0.5F;
    s.filter = 1;
    s.thickness = inf;
    struct resources : picture_resources<float> {
        using picture_resources<float>::picture_resources;
        ao::math<float>::ivec2 self{};
        float others = 1;
        float depth(ao::math<float>::ivec2 p) const { return p.x == self.x && p.y == self.y ? 50.0F : others; }
    };
    const pictures p(64, 64, 1.0F);
    resources r(p, s);
    using body_type = ao::occlusion_pass<float, resources>;
    const ao::plan planned = plan_for(p, s, simple_camera(64, 64, 0.001));
    const auto constants = ao::convert_constants<body_type::ao_occlusion_constants, float, ao::occlusion_constants, float>(
        ao::constants_of<ao::occlusion_constants>(planned.passes[0]));
    r.self = { 32, 32 };
    r.kernel.fill(glm::vec4(0.9F, 0.1F, 0.3F, 0)); // off the own texel for sure
    r.tile.fill(glm::vec2(1, 0));
    body_type body{ r };
    set_options(body, planned.passes[0].options);
    CHECK(body.ao_occlusion_pass(constants, { 32, 32 }) == 0.0F);
    body.resources.others = 60.0F;
    CHECK(body.ao_occlusion_pass(constants, { 32, 32 }) == 1.0F);
}

namespace {

struct closed_case {
    const char* name;
    solid scene;
    viewer view;
    std::vector<glm::ivec2> pixels; // floor pixels about the occluder
};

std::vector<closed_case> closed_cases()
{
    const glm::dvec3 up = normalized({ 0, 0.8, 0.6 });
    const double floor_distance = dot(up, { 0, 0, -5 });
    const glm::dvec3 above = glm::dvec3(0, 0, -5) + up * 0.45;
    const solid floor = plane(up, floor_distance);
    const auto row_of = [](int width, int row, int from, int step) {
        std::vector<glm::ivec2> pixels;
        for (int x = from; x < width - from; x += step) {
            pixels.emplace_back(x, row);
        }
        return pixels;
    };
    const viewer perspective{ 400, 300, 0.5, false };
    const viewer parallel{ 400, 300, 2.0, true };
    return {
        { "wall crease", both(floor, plane(normalized({ -0.8, 0, 0.6 }), dot(normalized({ -0.8, 0, 0.6 }), { 0.6, 0, -5 }))),
          perspective, row_of(400, 140, 150, 9) },
        { "sphere above plane", both(floor, sphere(above, 0.4)), perspective, row_of(400, 140, 130, 10) },
        { "disc above plane", both(floor, plane(up, floor_distance + 0.45, above, 0.4)), perspective, row_of(400, 150, 130, 10) },
        { "sphere above plane, parallel", both(floor, sphere(above, 0.4)), parallel, row_of(400, 140, 130, 10) },
    };
}

} // namespace

TEST_CASE("Crease, sphere and disc: unbiased, and within the sampling law", "[core][closed]")
{
    const auto kernel = GENERATE(ao::method::box, ao::method::hemisphere, ao::method::halton);
    const float thickness = GENERATE(std::numeric_limits<float>::infinity(), 0.5F);
    static const std::vector<closed_case> cases = closed_cases();
    double all_squares = 0;
    double all_law = 0;
    for (const closed_case& c : cases) {
        const pictures buffer = c.view.picture(c.scene);
        ao::settings s;
        s.method = kernel;
        s.taps = 32;
        s.bias = 0.02F;
        s.thickness = thickness;
        s.filter = 1;
        const int samples = 20000;
        const int seeds = 48;
        double squares = 0;
        double law = 0;
        double mean = 0;
        double mean_variance = 0;
        double occluded = 0;
        for (const glm::ivec2& pixel : c.pixels) {
            const double k = expected_occlusion(c.view, c.scene, buffer, s, pixel.x, pixel.y, samples);
            occluded += k > 0.02;
            for (int seed = 1; seed <= seeds; ++seed) {
                s.seed = static_cast<std::uint32_t>(seed);
                using body_type = ao::occlusion_pass<float, picture_resources<float>>;
                const ao::plan planned = plan_for(buffer, s, c.view.camera(), c.view.parallel);
                body_type body{ picture_resources<float>(buffer, s) };
                set_options(body, planned.passes[0].options);
                const auto constants =
                    ao::convert_constants<body_type::ao_occlusion_constants, float, ao::occlusion_constants, float>(
                        ao::constants_of<ao::occlusion_constants>(planned.passes[0]));
                const double e = 1 - static_cast<double>(body.ao_occlusion_pass(constants, { pixel.x, pixel.y })) - k;
                squares += e * e;
                mean += e;
            }
            const double per_run = k * (1 - k) / s.taps;
            const double of_reference = k * (1 - k) / samples;
            law += seeds * (per_run + of_reference);
            mean_variance += seeds * per_run + seeds * seeds * of_reference;
        }
        const double runs = static_cast<double>(seeds) * static_cast<double>(c.pixels.size());
        CAPTURE(c.name, static_cast<int>(kernel), thickness, std::sqrt(squares / runs), std::sqrt(law / runs), mean / runs);
        // Occlusion is there to be measured.
        CHECK(occluded >= 4);
        all_squares += squares;
        all_law += law;
        if (kernel != ao::method::halton) {
            // Independent seeds: the mean error is within four of its standard errors.
            CHECK(std::abs(mean) < 4 * std::sqrt(mean_variance));
        }
    }
    // The random kernels are stratified and so not above the law of independent taps; Halton's are well below.
    CAPTURE(static_cast<int>(kernel), thickness, all_squares / all_law);
    CHECK(all_squares < (kernel == ao::method::halton ? 0.7 : 1.0) * all_law);
}

TEST_CASE("The crease in closed form", "[core][closed]")
{
    // Floor and wall at right angles, both seen from inside: an offset is behind the depth buffer exactly where it is inside the
    // wall. At distance h R from the wall that is a share (1 - h)^2 (2 + h) / 4 of the half ball.
    const viewer v{ 1600, 1200, 0.5, false };
    const glm::dvec3 up = normalized({ 0, 0.8, 0.6 });
    const glm::dvec3 left = normalized({ -0.8, -0.36, 0.48 }); // up . left = 0
    REQUIRE(std::abs(dot(up, left)) < 1e-12);
    const solid scene = both(plane(up, dot(up, { 0, 0, -5 })), plane(left, dot(left, { 0.8, 0, -5 })));
    const pictures buffer = v.picture(scene);
    ao::settings s;
    s.method = ao::method::hemisphere;
    s.taps = ao::max_taps;
    s.bias = 0.003F;
    s.thickness = inf;
    s.filter = 1;
    using body_type = ao::occlusion_pass<float, picture_resources<float>>;
    const ao::plan planned = plan_for(buffer, s, v.camera());
    body_type body{ picture_resources<float>(buffer, s) };
    set_options(body, planned.passes[0].options);
    const auto constants = ao::convert_constants<body_type::ao_occlusion_constants, float, ao::occlusion_constants, float>(
        ao::constants_of<ao::occlusion_constants>(planned.passes[0]));
    int tested = 0;
    for (int x = 700; x < 1100; x += 10) {
        const surface_point seen = v.see(scene, x + 0.5, 560.5);
        if (dot(seen.normal, up) < 0.99) {
            continue;
        }
        const glm::dvec3 p = v.point(x + 0.5, 560.5, seen.depth);
        const double h = dot(left, p) - dot(left, { 0.8, 0, -5 });
        if (h > 0.98) {
            continue;
        }
        const double expected = (1 - h) * (1 - h) * (2 + h) / 4;
        const double k = 1 - static_cast<double>(body.ao_occlusion_pass(constants, { x, 560 }));
        // dk/dh is at most 3/4. The bias moves the wall by bias * |left.z| at most; half a pixel's diagonal, 2.1 mm * .7 at depth
        // 5, moves the surface that a tap is compared with by less than 5 mm either way. Four standard errors on top.
        const double allowed = 0.75 * (0.003 + 0.005) + 4 * std::sqrt(expected * (1 - expected) / s.taps);
        CAPTURE(x, h, expected, k);
        CHECK(std::abs(k - expected) < allowed);
        ++tested;
    }
    CHECK(tested > 10);
}

TEST_CASE("Every setting changes the picture", "[core][closed]")
{
    const closed_case c = closed_cases()[1];
    const pictures buffer = viewer{ 100, 75, 0.5, false }.picture(c.scene);
    const ao::camera view = viewer{ 100, 75, 0.5, false }.camera();
    const auto render = [&](const ao::settings& s) {
        const auto raw = run_occlusion<float>(plan_for(buffer, s, view), picture_resources<float>(buffer, s));
        return run_filter<float>(raw, buffer.width, buffer.height, s.filter);
    };
    ao::settings base;
    base.thickness = 0.8F;
    const auto reference = render(base);
    const auto changed = [&](auto change) {
        ao::settings s = base;
        change(s);
        return render(s) != reference;
    };
    CHECK(render(base) == reference);
    CHECK(changed([](ao::settings& s) { s.method = ao::method::box; }));
    CHECK(changed([](ao::settings& s) { s.method = ao::method::halton; }));
    CHECK(changed([](ao::settings& s) { s.taps = 31; }));
    CHECK(changed([](ao::settings& s) { s.radius = 1.1F; }));
    CHECK(changed([](ao::settings& s) { s.bias = 0.08F; }));
    CHECK(changed([](ao::settings& s) { s.thickness = 0.4F; }));
    CHECK(changed([](ao::settings& s) { s.thickness = inf; }));
    CHECK(changed([](ao::settings& s) { s.filter = 7; }));
    CHECK(changed([](ao::settings& s) { s.filter = 1; }));
    CHECK(changed([](ao::settings& s) { s.seed = 2; }));
}

TEST_CASE("Radius from below a pixel to beyond the picture: finite, and open where nothing can occlude", "[core][closed]")
{
    const viewer v{ 40, 30, 0.5, false };
    const pictures buffer = v.picture(closed_cases()[1].scene);
    ao::settings s;
    for (float radius = 1e-20F; radius <= 1e15F; radius *= 1e5F) {
        s.radius = radius;
        for (const float x : run_occlusion<float>(plan_for(buffer, s, v.camera()), picture_resources<float>(buffer, s))) {
            REQUIRE(((x >= 0.0F && x <= 1.0F) || x == -1.0F));
        }
    }
    // Far below a pixel every tap reads its own pixel, and bias keeps it from occluding itself.
    s.radius = 1e-4F;
    s.bias = 0.02F;
    for (const float x : run_occlusion<float>(plan_for(buffer, s, v.camera()), picture_resources<float>(buffer, s))) {
        CHECK((x == 1.0F || x == -1.0F));
    }
}
