// 4.11 and 4.12: the same again, and what must change nothing.
#include "stability/figure.hpp"
#include "stability/methods.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"

#include "ao/conformance/reference.hpp"
#include "unit/core_bake_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace stability {

namespace {

using bake_test::mesh;

void mark_faulty(subject& s)
{
    s.faulty = true;
}

solid room()
{
    return both(both(crease(0.8), tilted(0, 7)), sphere({ -0.4, -0.6, -4 }, 0.5));
}

double differing(const std::vector<float>& a, const std::vector<float>& b)
{
    double count = a.size() == b.size() ? 0 : endless;
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
        count += std::memcmp(&a[i], &b[i], sizeof(float)) == 0 ? 0 : 1;
    }
    return count;
}

double mean_difference(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = a.size() == b.size() ? 0 : endless;
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
        sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])) / static_cast<double>(a.size());
    }
    return sum;
}

// Values that differ when the same frame runs again, after another one, and on a device of its own.
double repeated(subject& s)
{
    double wrong = 0;
    for (const ao::method m : methods) {
        ao::settings settings;
        settings.method = m;
        settings.bias = 0.03F;
        const shot one = shoot({ 64, 48, 0.5, false }, room(), settings);
        const auto first = s.frame(one);
        shot other = one;
        std::reverse(other.depth.begin(), other.depth.end());
        s.frame(other);
        wrong += differing(first, s.frame(one));
        if (m == methods[0] || s.thorough) {
            for (subject& fresh : all_subjects(s.thorough)) {
                if (std::string(fresh.name()) == s.name()) {
                    wrong += differing(first, fresh.frame(one));
                }
            }
        }
    }
    return wrong;
}

void add_counter(subject& s)
{
    s.change_visibility = [count = 0](std::vector<float>& all) mutable { all[0] += 1e-6F * static_cast<float>(count++); };
}

// Values that differ from the reference's: every method, depth and normals in several formats.
double against_reference(subject& s)
{
    double wrong = 0;
    std::size_t turn = 0;
    for (const depth_storage& d : depth_storages) {
        for (const ao::method m : methods) {
            if (!s.thorough && turn++ % methods.size() != 0) {
                continue;
            }
            ao::settings settings;
            settings.method = m;
            settings.bias = 0.03F;
            const viewer v{ 64, 48, 0.5, false };
            const shot made = stored_as(shoot(v, room(), settings), d, v, 0.1, 100);
            const stored_shot stored = store(made);
            const ao::picture expected = ao::conformance::reference_visibility(
                *ao::make_plan(made.settings, made.facts, made.camera), stored.depth, stored.normal);
            std::vector<float> values;
            for (std::size_t i = 0; i < expected.pixels(); ++i) {
                values.push_back(expected.texel<float>(i));
            }
            wrong += differing(values, s.frame(made, stored));
        }
    }
    return wrong;
}

void one_ulp(subject& s)
{
    s.change_visibility = [](std::vector<float>& all) { all[7] = std::nextafter(all[7], 2.0F); };
}

// A mirrored scene: mean visibilities.
double mirrored(subject& s)
{
    ao::settings settings;
    settings.bias = 0.03F;
    const shot made = shoot({ 64, 48, 0.5, false }, room(), settings);
    shot other = made;
    for (std::size_t i = 0; i < made.depth.size(); ++i) {
        const std::size_t from = i / 64 * 64 + (63 - i % 64);
        other.depth[i] = made.depth[from];
        other.normals[i] = made.normals[from];
        other.normals[i].x *= s.faulty ? 1.0F : -1.0F;
    }
    return std::abs(mean(s.frame(made)) - mean(s.frame(other)));
}

// Everything scaled by 2^-10 to 2^17, and by powers of ten: values that differ, and the mean difference.
double scaled(subject& s)
{
    worst w;
    ao::settings settings;
    settings.bias = 0.03F;
    const viewer v{ 48, 36, 0.5, false };
    const shot plain = stored_as(shoot(v, room(), settings), depth_storages[1], v, 0.1, 100);
    const auto expected = s.frame(plain);
    for (const double scale : { 1e-3, 0.1, 131072.0, 1e5 }) {
        shot made = plain;
        for (float& d : made.depth) {
            d = static_cast<float>(static_cast<double>(d) * scale);
        }
        made.settings.radius = static_cast<float>(scale);
        made.settings.bias = static_cast<float>(0.03 * (s.faulty ? 1 : scale));
        made = stored_as(made, depth_storages[1], v, 0.1 * scale, 100 * scale);
        w.add(mean_difference(expected, s.frame(made)));
    }
    return w.value();
}

// A turn of world and camera together: normals stored in the world and turned back, against normals in view space.
double turned_world(subject& s)
{
    ao::settings settings;
    settings.bias = 0.03F;
    const shot plain = shoot({ 48, 36, 0.5, false }, room(), settings);
    shot made = plain;
    const double c = std::cos(0.7);
    const double k = std::sin(0.7);
    made.facts.world_normals = true;
    made.camera.normal_to_view = ao::matrix3();
    const auto f = [](double x) { return static_cast<float>(x); };
    const double turn[3][3] = { { c, -k, 0 }, { k * 0.6, c * 0.6, -0.8 }, { k * 0.8, c * 0.8, 0.6 } }; // rows: world to view
    for (int column = 0; column < 3; ++column) {
        for (int line = 0; line < 3; ++line) {
            made.camera.normal_to_view[column][line] = f(s.faulty ? turn[column][line] : turn[line][column]);
        }
    }
    for (glm::vec3& n : made.normals) {
        const glm::dvec3 v(n);
        n = glm::vec3(f(turn[0][0] * v.x + turn[1][0] * v.y + turn[2][0] * v.z),
                      f(turn[0][1] * v.x + turn[1][1] * v.y + turn[2][1] * v.z),
                      f(turn[0][2] * v.x + turn[1][2] * v.y + turn[2][2] * v.z));
    }
    return mean_difference(s.frame(plain), s.frame(made));
}

// A picture cut out of a larger one with a guard band, a whole tile away, by an off-centre projection.
double cropped(subject& s)
{
    ao::settings settings;
    settings.radius = 0.5F;
    settings.filter = 3;
    settings.bias = 0.03F;
    const viewer v{ 192, 64, 0.3, false };
    const shot full = shoot(v, room(), settings);
    shot part = full;
    const int shift = s.faulty ? 60 : 64; // not a whole tile of rotations
    part.facts.width = 64;
    part.depth.clear();
    part.normals.clear();
    for (std::size_t i = 0; i < full.depth.size(); ++i) {
        const int x = static_cast<int>(i % 192);
        if (x >= shift && x < shift + 64) {
            part.depth.push_back(full.depth[i]);
            part.normals.push_back(full.normals[i]);
        }
    }
    const double wide = v.wide();
    part.camera.projection =
        ao::make_projection({ -wide + 2 * wide * shift / 192, -wide + 2 * wide * (shift + 64) / 192, -0.3, 0.3, 0.1, 1000 });
    const auto a = s.frame(full);
    const auto b = s.frame(part);
    double sum = 0;
    double count = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 20; x < 44; ++x) {
            sum += std::abs(static_cast<double>(a[static_cast<std::size_t>(y * 192 + x + shift)]) -
                            static_cast<double>(b[static_cast<std::size_t>(y * 64 + x)]));
            ++count;
        }
    }
    return sum / count;
}

// Values that change where background becomes a wall far behind everything.
double far_wall(subject& s)
{
    ao::settings settings;
    settings.filter = 1;
    settings.bias = 0.03F;
    const viewer v{ 48, 36, 0.5, false };
    const solid things = both(square(0.6, 4), sphere({ 0.9, 0, -4.3 }, 0.4));
    const auto without = s.frame(shoot(v, things, settings));
    const shot with = shoot(v, both(things, tilted(0, s.faulty ? 4.5 : 40)), settings);
    const auto seen = s.frame(with);
    double wrong = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        wrong += std::memcmp(&seen[i], &without[i], sizeof(float)) == 0 ? 0 : 1;
    }
    return wrong;
}

std::vector<float> bake(subject& s, const mesh& m, double distance = endless)
{
    ao::bake_settings settings;
    settings.distance = distance;
    const auto job = ao::prepare_bake(m.input(), *ao::lebedev_rule(302), settings);
    const auto sums = s.baker()->run(*job, {});
    return sums ? ao::finish_bake(*job, *sums).coefficients : std::vector<float>{};
}

mesh wall_and_ball(bool with_ball)
{
    mesh m = bake_test::grid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 8);
    m.positions.push_back({ 0, 0, 3 }); // the box about everything stays
    m.positions.push_back({ 0.1, 0, 3 });
    m.positions.push_back({ 0, 0.1, 3 });
    m.indices.insert(m.indices.end(), { 81, 82, 83 });
    if (with_ball) {
        bake_test::append(m, bake_test::sphere({ 0, 0, 1.2 }, 1, 2));
    }
    m.normals.clear();
    return m;
}

// By how much visibility rises when an occluder comes in.
double more_occluders(subject& s)
{
    const auto before = bake(s, wall_and_ball(s.faulty));
    const auto after = bake(s, wall_and_ball(!s.faulty));
    worst w;
    w.add(before.empty() || after.empty() ? endless : 0);
    for (std::size_t i = 0; i < 81 && i < before.size() && i < after.size(); ++i) {
        w.add(std::max(0.0, static_cast<double>(after[i]) - static_cast<double>(before[i])));
    }
    return w.value();
}

// By how much it rises when occluders farther away count.
double larger_radius(subject& s)
{
    worst w;
    std::vector<float> last;
    for (const double distance : { 0.05, 0.1, 0.2, 0.4, 0.8 }) {
        const auto now = bake(s, wall_and_ball(true), s.faulty ? 0.85 - distance : distance);
        w.add(now.empty() ? endless : 0);
        for (std::size_t i = 0; i < last.size(); ++i) {
            w.add(std::max(0.0, static_cast<double>(now[i]) - static_cast<double>(last[i])));
        }
        last = now;
    }
    return w.value();
}

// Coefficients that differ when triangles are shuffled, or the bake is done in four parts.
double shuffled(subject& s)
{
    mesh m = wall_and_ball(true);
    const auto expected = bake(s, m);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < m.indices.size(); i += 3) {
        triangles.push_back({ m.indices[i], m.indices[i + 1], m.indices[i + 2] });
    }
    std::shuffle(triangles.begin(), triangles.end(), std::mt19937(4));
    if (s.faulty) {
        triangles.resize(triangles.size() - 20);
    }
    m.indices.clear();
    for (const auto& t : triangles) {
        m.indices.insert(m.indices.end(), t.begin(), t.end());
    }
    return expected.empty() ? endless : differing(expected, bake(s, m));
}

double in_parts(subject& s)
{
    const mesh m = wall_and_ball(true);
    const auto job = ao::prepare_bake(m.input(), *ao::lebedev_rule(302), {});
    const auto whole = s.baker()->run(*job, {});
    const std::size_t middle = job->vertices() / 3;
    auto first = s.baker()->run(*job, { .first_vertex = 0, .last_vertex = middle, .route = ao::bake_route::hierarchy });
    const auto second =
        s.baker()->run(*job, { .first_vertex = middle, .first_line = s.faulty ? 2U : 0U, .route = ao::bake_route::hierarchy });
    if (!whole || !first || !second || !ao::merge_bake_sums(*first, *second)) {
        return endless;
    }
    double wrong = 0;
    for (std::size_t i = 0; i < whole->sums.size(); ++i) {
        wrong += whole->sums[i].open == first->sums[i].open ? 0 : 1;
    }
    return wrong;
}

} // namespace

std::vector<row> repeat_rows()
{
    return {
        { "I1", "values that differ when a frame runs again, after another frame, on a fresh device", 0, false, "the same bits",
          domain::passes, repeated, "a counter of 1e-6 in one pixel", add_counter },
        { "I2", "values that differ from the reference: methods, depth formats", 0, false,
          "software drivers round as C++ does; docs/numerics.md", domain::passes, against_reference,
          "one pixel off by a unit in the last place", one_ulp },
        { "X1", "mean visibility of a scene minus that of its mirror image", 2e-3, false,
          "48 x 64 pixels of 32 taps: 0.4 / sqrt(98304) twice", domain::passes, mirrored, "normals not mirrored", mark_faulty },
        { "X2", "visibility under uniform scale of everything, 1e-3 to 1.3e5, mean difference", 1e-3, false,
          "taps flip by rounding only", domain::passes, scaled, "a bias in metres", mark_faulty },
        { "X3", "normals in a turned world against normals in view space, mean difference", 1e-3, false,
          "taps flip by rounding only", domain::passes, turned_world, "the inverse turn", mark_faulty },
        { "X4", "how much an added occluder raises visibility, baked", 0, false, "monotone", domain::bake, more_occluders,
          "taken away instead", mark_faulty },
        { "X5", "how much a larger distance raises visibility, baked", 0, false, "monotone", domain::bake, larger_radius,
          "smaller instead", mark_faulty },
        { "X6", "coefficients that differ with triangles shuffled", 0, false, "whole numbers", domain::bake, shuffled,
          "20 triangles missing", mark_faulty },
        { "X7", "sums that differ when a bake is done in parts by another route", 0, false, "whole numbers", domain::bake,
          in_parts, "a part of other lines, which does not merge", mark_faulty },
        { "X8", "a picture cut out with a guard band, by an off-centre projection, against the whole, mean difference", 1e-3,
          false, "taps flip by rounding only", domain::passes, cropped, "cut beside the tile of rotations", mark_faulty },
        { "X9", "values that change when background becomes a wall far behind", 0, false, "nothing lies within the radius",
          domain::passes, far_wall, "a wall within the radius", mark_faulty },
    };
}

} // namespace stability
