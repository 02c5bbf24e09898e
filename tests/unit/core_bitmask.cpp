// The method `bitmask`: its sectors against the integral they stand for, and the whole pass against closed forms.
#include "unit/core_geometry.hpp"

#include "ao/conformance/reference.hpp"
#include "ao/slices.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace core_test;

namespace {

constexpr double pi = 3.14159265358979323846;

// Share of a slice's weight cos(theta - gamma) sin theta from V to theta, by the midpoint rule.
double share_up_to(double theta, double gamma)
{
    const auto weight = [&](double t) { return std::cos(t - gamma) * std::sin(t); };
    const auto integral = [&](double from, double to) {
        constexpr int steps = 20000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            sum += weight(from + (to - from) * (i + 0.5) / steps);
        }
        return sum * (to - from) / steps;
    };
    return integral(0, theta) / integral(0, gamma + pi / 2);
}

ao::settings unfiltered(ao::preset chosen, float radius = 1)
{
    ao::settings s = ao::settings_of(chosen, radius);
    s.filter = 1;
    s.resolution = ao::resolution::full;
    return s;
}

std::vector<float> visibility(const viewer& v, const pictures& p, const ao::settings& s,
                              ao::normal_source source = ao::normal_source::vector)
{
    const ao::plan planned = plan_for(p, s, v.camera(), v.parallel, source);
    ao::picture depth(ao::pixel_format::r32f, v.width, v.height);
    ao::picture normal(ao::pixel_format::rgba32f, v.width, v.height);
    for (std::size_t i = 0; i < p.depth.size(); ++i) {
        depth.set_texel(i, p.depth[i]);
        normal.set_texel(i, glm::vec4(p.normals[i], 0.0F));
    }
    ao::conformance::executor<float> run(planned, depth, normal);
    std::vector<float> all;
    for (const auto& texel : run.run().texels) {
        all.push_back(texel.x);
    }
    return all;
}

double mean(const std::vector<float>& all)
{
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

// Mean of many turns of the slices.
std::vector<float> mean_of_seeds(const viewer& v, const pictures& p, ao::settings s, int seeds)
{
    std::vector<float> all(p.depth.size());
    for (int i = 0; i < seeds; ++i) {
        s.seed = static_cast<std::uint32_t>(i + 1);
        const std::vector<float> once = visibility(v, p, s);
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k] += once[k] / static_cast<float>(seeds);
        }
    }
    return all;
}

// Mean over the pixels whose share of the picture's width lies in [left, right).
double mean_of_columns(const viewer& v, const std::vector<float>& all, int left, int right)
{
    double sum = 0;
    for (int y = 0; y < v.height; ++y) {
        for (int x = left; x < right; ++x) {
            sum += static_cast<double>(all[static_cast<std::size_t>(y * v.width + x)]);
        }
    }
    return sum / (v.height * (right - left));
}

} // namespace

TEST_CASE("The polynomial of sectors is as near as it says", "[core][bitmask]")
{
    double worst = 0;
    for (int i = 0; i <= 100000; ++i) {
        const double c = i / 100000.0;
        const double exact = std::asin(c) + c * std::sqrt(std::max(0.0, 1 - c * c));
        const double lens = c * static_cast<double>(ao::math<float>::ao_half_lens(static_cast<float>(c * c)));
        worst = std::max(worst, std::abs(lens - exact));
    }
    CHECK(worst < 1.7e-3);
    CHECK(worst > 1e-3);
}

TEST_CASE("Borders between sectors share a slice's weight evenly", "[core][bitmask]")
{
    using reals = ao::math<float>;
    for (const double gamma : { -1.4, -0.7, 0.0, 0.2, 1.1, 1.5 }) {
        const auto slice = reals::ao_make_slice(static_cast<float>(std::sin(gamma)), static_cast<float>(std::cos(gamma)));
        const double g = std::sin(gamma);
        const double k = std::cos(gamma);
        CHECK(static_cast<double>(slice.weight) == Approx(g * (gamma + pi / 2 + g * k) + k * k * k).margin(1e-6));
        for (int i = 1; i < 40; ++i) {
            const double theta = (gamma + pi / 2) * i / 40;
            const int border = reals::ao_sector_border(slice, static_cast<float>(std::cos(theta)));
            CAPTURE(gamma, theta, border);
            // Half a sector by rounding; the polynomial's error, times the slice's weight, is a tenth of a sector at most.
            CHECK(std::abs(32 * share_up_to(theta, gamma) - border) * static_cast<double>(slice.weight) <
                  0.5 * static_cast<double>(slice.weight) + 32 * 1.8e-3);
        }
    }
}

TEST_CASE("An open plane is open at every tilt up to 85 degrees, exactly, with no bias", "[core][bitmask][closed]")
{
    const auto preset = GENERATE(ao::preset::low, ao::preset::medium, ao::preset::high, ao::preset::ultra);
    const auto source = GENERATE(ao::normal_source::vector, ao::normal_source::from_depth);
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
            const solid scene = plane(n, -40 * n.z);
            ao::settings s = ao::settings_of(preset, 2.0F);
            if (!filtered) {
                s.filter = 1;
                s.resolution = ao::resolution::full;
            }
            int wrong = 0;
            for (const float x : visibility(v, v.picture(scene), s, source)) {
                wrong += x != 1.0F;
            }
            CAPTURE(tilt, around, v.parallel, static_cast<int>(source), s.taps);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("A wall, cut off at the radius, blocks what it should", "[core][bitmask][closed]")
{
    // A floor seen from above and a step as high as the radius, its side unseen. What of it lies within the radius blocks a
    // segment of the disc of cosine-weighted directions.
    viewer v{ 128, 128, 2, true };
    pictures p(v.width, v.height);
    for (int y = 0; y < v.height; ++y) {
        for (int x = 0; x < v.width; ++x) {
            p.depth[p.index(x, y)] = x < v.width / 2 ? 10.0F : 9.0F;
            p.normals[p.index(x, y)] = glm::vec3(0, 0, 1);
        }
    }
    ao::settings s = unfiltered(ao::preset::ultra);
    s.taps = 256;
    s.slices = 2;
    const std::vector<float> all = mean_of_seeds(v, p, s, 8);
    const double pixel = 4.0 / v.width;
    for (const int away : { 3, 8, 16, 24, 31 }) { // pixels from the wall, of 32 in the radius
        const double h = away * pixel;            // texels stand where their centres are
        const double expected = 1 - (std::acos(h) - h * std::sqrt(1 - h * h)) / pi;
        const double found = mean_of_columns(v, all, v.width / 2 - away, v.width / 2 - away + 1);
        CAPTURE(away, expected, found);
        CHECK(std::abs(found - expected) < 0.015);
    }
    for (int x = 0; x < v.width / 2 - 33; ++x) {
        CHECK(mean_of_columns(v, all, x, x + 1) == 1.0);
    }
    // On top of the wall nothing stands over the pixel.
    CHECK(mean_of_columns(v, all, v.width / 2 + 1, v.width) == 1.0);
}

TEST_CASE("A dome and a drum on a floor block what they should", "[core][bitmask][closed]")
{
    // Seen from above, so that columns reach down to the floor. Of the dome a point of the floor at distance d sees a half ball
    // whose middle is on its horizon: of cosine-weighted directions, projected to the unit disc, those of the segment beyond
    // cos(beta), sin(beta) = a / d. The drum as high as it is wide: its side covers sectors of the disc down to its rim.
    const bool dome = GENERATE(true, false);
    constexpr double a = 0.5;
    viewer v{ 121, 121, 2, true };
    pictures p(v.width, v.height, 10.0F);
    const double pixel = 4.0 / v.width;
    for (int y = 0; y < v.height; ++y) {
        for (int x = 0; x < v.width; ++x) {
            const double across = std::hypot((x - 60) * pixel, (y - 60) * pixel);
            if (across < a) {
                const double height = dome ? std::sqrt(a * a - across * across) : a;
                p.depth[p.index(x, y)] = static_cast<float>(10 - height);
                p.normals[p.index(x, y)] =
                    dome ? glm::vec3((x - 60) * pixel / a, (60 - y) * pixel / a, height / a) : glm::vec3(0, 0, 1);
            }
        }
    }
    ao::settings s = unfiltered(ao::preset::ultra, 4);
    s.taps = 256;
    s.slices = 1;
    const std::vector<float> all = mean_of_seeds(v, p, s, 32);
    for (const int away : { 18, 24, 36, 48 }) { // pixels from the middle; the dome's edge is at 15
        const double d = away * pixel;
        double hidden = 0;
        const double beta = std::asin(a / d);
        if (dome) {
            hidden = (beta - std::sin(beta) * std::cos(beta)) / pi;
        }
        else {
            constexpr int steps = 4000;
            for (int i = 0; i < steps; ++i) {
                const double phi = beta * (2 * (i + 0.5) / steps - 1);
                const double near = d * std::cos(phi) - std::sqrt(a * a - d * d * std::sin(phi) * std::sin(phi));
                const double rim = near / std::hypot(near, a); // sine of the angle to the normal
                hidden += (1 - rim * rim) / 2 * (2 * beta / steps) / pi;
            }
        }
        double found = 0;
        for (const auto& [x, y] :
             { std::pair(60 - away, 60), std::pair(60 + away, 60), std::pair(60, 60 - away), std::pair(60, 60 + away) }) {
            found += 0.25 * (1 - static_cast<double>(all[p.index(x, y)]));
        }
        CAPTURE(dome, away, hidden, found);
        CHECK(found == Approx(hidden).margin(0.02));
        CHECK(found > 0.5 * hidden);
    }
}

TEST_CASE("A floating square darkens nothing out of its reach", "[core][bitmask][closed]")
{
    const float height = GENERATE(3.0F, 0.8F); // radii over the floor
    viewer v{ 160, 120, 3, true };             // 20 pixels in the radius
    pictures p(v.width, v.height, 10.0F);
    for (int y = 40; y < 80; ++y) {
        for (int x = 60; x < 100; ++x) {
            p.depth[p.index(x, y)] = 10.0F - height;
        }
    }
    for (const auto preset : { ao::preset::low, ao::preset::medium, ao::preset::high, ao::preset::ultra }) {
        const ao::settings s = ao::settings_of(preset);
        const std::vector<float> all = visibility(v, p, s);
        const double reach = 20 + s.filter / 2; // pixels
        double halo = 0;
        int count = 0;
        for (int y = 0; y < v.height; ++y) {
            for (int x = 0; x < v.width; ++x) {
                const double dx = std::max({ 60 - x, x - 99, 0 });
                const double dy = std::max({ 40 - y, y - 79, 0 });
                const bool under_or_over = dx == 0 && dy == 0;
                if (!under_or_over && (height > 1 || std::sqrt(dx * dx + dy * dy) > reach)) {
                    halo += 1.0 - static_cast<double>(all[p.index(x, y)]);
                    ++count;
                }
            }
        }
        CAPTURE(height, static_cast<int>(preset), halo / count);
        CHECK(halo / count < 0.01);
    }
}

TEST_CASE("Presets differ in noise, not in mean", "[core][bitmask]")
{
    // A groove of a right angle, seen along its bottom line, many of the tile's slices in each distance. The denoiser
    // weighs the slices of neighbours by what they count for.
    viewer v{ 128, 128, 1.5, true };
    const pictures p = v.picture([&](const glm::dvec3& o, const glm::dvec3& d) {
        const surface_point a = plane(normalized({ 1, 0, 1 }), -7)(o, d);
        const surface_point b = plane(normalized({ -1, 0, 1 }), -7)(o, d);
        return a.depth > b.depth ? b : a;
    });
    const double high = mean(visibility(v, p, ao::settings_of(ao::preset::high)));
    const double ultra = mean(visibility(v, p, ao::settings_of(ao::preset::ultra)));
    CAPTURE(high, ultra);
    CHECK(std::abs(high - ultra) < 0.01);
    CHECK(ultra < 0.95);
}

TEST_CASE("Scaling world and radius by powers of two changes no bit", "[core][bitmask]")
{
    viewer v{ 48, 36, 0.6, false };
    const solid scene = both(plane({ 0, 0, 1 }, -6), sphere({ 0.3, 0.1, -4.5 }, 0.8));
    const pictures p = v.picture(scene);
    const std::vector<float> once = visibility(v, p, ao::settings_of(ao::preset::high));
    for (const float scale : { 0x1p-10F, 0x1p10F }) {
        pictures scaled = p;
        for (float& d : scaled.depth) {
            d *= scale;
        }
        CHECK(visibility(v, scaled, ao::settings_of(ao::preset::high, scale)) == once);
    }
}

TEST_CASE("Radii from below a pixel to over the picture, and normals that face away, give finite results", "[core][bitmask]")
{
    viewer v{ 33, 21, 0.6, false };
    pictures p = v.picture(both(plane({ 0, 0, 1 }, -6), sphere({ 0.3, 0.1, -4.5 }, 0.8)));
    const auto all_in_range = [](const std::vector<float>& all) {
        return std::all_of(all.begin(), all.end(), [](float x) { return x >= 0 && x <= 1; });
    };
    SECTION("radius")
    {
        for (const float radius : { 1e-30F, 1e-6F, 1e-3F, 1.0F, 100.0F, 1e6F, 1e15F }) {
            const std::vector<float> all = visibility(v, p, ao::settings_of(ao::preset::high, radius));
            CHECK(all_in_range(all));
            if (radius < 1e-2F) {
                CHECK(mean(all) == 1.0);
            }
        }
    }
    SECTION("depths so small that the radius covers all slopes")
    {
        for (const float depth : { 1e-30F, 1.2e-38F, 1e-40F }) {
            std::fill(p.depth.begin(), p.depth.end(), depth);
            CHECK(all_in_range(visibility(v, p, ao::settings_of(ao::preset::high, 1e15F))));
        }
    }
    SECTION("normals")
    {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (const glm::vec3 n :
             { glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(0, 1, -1e-3F), glm::vec3(0), glm::vec3(nan) }) {
            std::fill(p.normals.begin(), p.normals.end(), n);
            CHECK(all_in_range(visibility(v, p, ao::settings_of(ao::preset::high))));
        }
    }
    SECTION("infinite thickness darkens more")
    {
        ao::settings s = ao::settings_of(ao::preset::ultra);
        const double finite = mean(visibility(v, p, s));
        s.thickness = std::numeric_limits<float>::infinity();
        const std::vector<float> endless = visibility(v, p, s);
        CHECK(all_in_range(endless));
        CHECK(mean(endless) <= finite);
    }
}
