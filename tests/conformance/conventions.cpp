// The same view gives the same picture in each of the 32 conventions of projections.
#include "conformance/conventions.hpp"

#include "ao/conformance/reference.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <cstdio>

using namespace ao;
using namespace ao::conformance;

namespace {

constexpr int width = 64;
constexpr int height = 48;

struct input {
    ao::plan plan;
    picture depth;
    picture normal;
};

input make_input(const convention& c, depth_source source, pixel_format format, bool infinite = false)
{
    const surfaces seen = scene_in(c, width, height);
    const camera_projection projection = projection_of(c, infinite);
    facts f;
    f.width = width;
    f.height = height;
    f.depth = source;
    f.depth_format = format;
    f.normal_format = pixel_format::rgba32f;
    f.parallel = c.options.parallel;
    settings s;
    s.radius = 0.8F;
    s.filter = 1;
    const result<plan> p = make_plan(s, f, camera{ .projection = projection, .normal_to_view = {} });
    INFO(c.name);
    REQUIRE(p);
    return { *p, pack_depth(seen.depth, width, height, source, format, projection),
             pack_normals(seen.normals, width, height, f.normals, f.normal_format) };
}

template <class Real>
values<Real> upside_down(const values<Real>& v)
{
    values<Real> turned(v.width, v.height);
    for (int y = 0; y < v.height; ++y) {
        std::copy_n(&v.at(0, v.height - 1 - y), v.width,
                    &turned.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(v.width)]);
    }
    return turned;
}

// The picture with its top row first. The tile of rotations belongs to rows in memory; where those are upside down it is turned
// as well, so that each point of the view gets the same rotation.
template <class Real>
values<Real> view(const input& in, bool bottom_first)
{
    executor<Real> run(in.plan, in.depth, in.normal);
    if (!bottom_first) {
        return run.run();
    }
    const values<Real> tile = run.image(image_id::rotation);
    values<Real> turned(tile.width, tile.height);
    for (int y = 0; y < tile.height; ++y) {
        const int row = (height - 1 - y + 4 * tile.height) % tile.height;
        for (int x = 0; x < tile.width; ++x) {
            turned.texels[static_cast<std::size_t>(y * tile.width + x)] = tile.at(x, row);
        }
    }
    run.set_rotation(turned);
    return upside_down(run.run());
}

struct comparison {
    int differing = 0;
    float worst = 0;
};

comparison compare(const values<float>& a, const values<float>& b)
{
    comparison c;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        const float difference = std::abs(a.texels[i].x - b.texels[i].x);
        c.differing += difference > 0 ? 1 : 0;
        c.worst = std::max(c.worst, difference);
    }
    return c;
}

} // namespace

TEST_CASE("linear depth: each convention gives the same bits, or stays inside the bounds where rows are upside down")
{
    for (const bool parallel : { false, true }) {
        convention first;
        first.options.parallel = parallel;
        first.options.rows = first_row::at_ndc_plus_one;
        const input base = make_input(first, depth_source::linear, pixel_format::r32f);
        const values<float> expected = view<float>(base, false);
        for (const convention& c : all_conventions()) {
            if (c.options.parallel != parallel) {
                continue;
            }
            const values<float> got = view<float>(make_input(c, depth_source::linear, pixel_format::r32f), c.bottom_first);
            INFO(c.name);
            if (!c.bottom_first) {
                // Range, direction and order cancel: the constants of the passes are the same bits.
                CHECK(compare(got, expected).differing == 0);
                continue;
            }
            // height - y rounds where y does not: taps at a texel's edge may fall to the other side.
            const comparison difference = compare(got, expected);
            CHECK(difference.differing <= width * height / 1000);
            CHECK(difference.worst <= 1.0F / 32 + 1e-6F);
        }
    }
}

TEST_CASE("depth buffers: every convention and an infinite far plane give the picture of linear depth, but for taps on the edge")
{
    for (const convention& c : all_conventions()) {
        const values<float> expected = view<float>(make_input(c, depth_source::linear, pixel_format::r32f), c.bottom_first);
        for (const bool infinite : { false, true }) {
            if (infinite && c.options.parallel) {
                continue;
            }
            const input hardware = make_input(c, depth_source::hardware, pixel_format::d32f, infinite);
            const comparison difference = compare(view<float>(hardware, c.bottom_first), expected);
            std::printf("convention: %-55s%s differing %.3f %%, worst %.4f\n", c.name.c_str(),
                        infinite ? " infinite" : "         ", 100.0 * difference.differing / (width * height),
                        static_cast<double>(difference.worst));
            INFO(c.name << (infinite ? ", infinite far plane" : ""));
            // What the buffer's steps move: eye depth by up to 1e-4 of a radius, and so 1e-4 of the taps.
            CHECK(difference.differing <= width * height * 32 / 10000);
            CHECK(difference.worst <= 2.0F / 32 + 1e-6F);
        }
    }
}
