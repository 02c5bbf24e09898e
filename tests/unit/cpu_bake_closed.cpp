// The raster, which looks at closed surfaces from one side, against the reference: the same bits, also where all depends on
// which surfaces are closed, on which side of them a start lies, and on the rounding of depths. tests/CMakeLists.txt plants the
// faults that these meshes are for.
#include "core_bake_meshes.hpp"

#include "ao/bake.hpp"
#include "ao/conformance/bake_reference.hpp"
#include "ao/cpu/bake.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace bake_test;

namespace {

using pass = ao::bake_pass<float>;

constexpr double lattice_step = 1.0 / 8388608;

// Closed surfaces that the raster looks at from one side: rough, flat, in one another, inside out, cut by an open one, and few
// and large beside many and small.
mesh closed_meshes(int which)
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto rough = [&](const glm::dvec3& centre, double radius, double noise, const glm::dvec3& stretch) {
        mesh m = sphere({ 0, 0, 0 }, radius, 2);
        for (glm::dvec3& p : m.positions) {
            p = glm::dvec3(glm::vec3(centre + p * (1 + noise * uniform(random)) * stretch));
        }
        return m;
    };
    const glm::dvec3 even(1.0);
    mesh m = rough({ 0, 0, 0 }, 1, 0.3, even);
    switch (which) {
    case 0:
        append(m, rough({ 0.9, 0.2, 0.1 }, 0.8, 0.1, even));
        append(m, rough({ 0, 0.1, 0 }, 0.3, 0.1, even));
        break;
    case 1:
        m = rough({ 0, 0, 0 }, 1, 0.9, even);
        break;
    case 2:
        m = rough({ 0, 0, 0 }, 1, 0.2, { 1, 2e-4, 1 });
        append(m, rough({ 0.1, 0.3, 0 }, 1, 0.2, { 3e-6, 0.2, 1 }));
        break;
    case 3:
        append(m, grid({ -2, -2, 0.1 }, { 4, 0.1, 0 }, { 0, 4, 0.3 }, 5));
        break;
    case 4:
        m = welded(box({ -2, -1.5, -1 }, { 2, 1.5, 1.2 }, 1, true));
        append(m, rough({ 0.3, 0.2, 0.1 }, 0.5, 0.3, even));
        break;
    default:
        for (std::size_t i = 0; i < m.indices.size(); i += 3) {
            std::swap(m.indices[i], m.indices[i + 1]);
        }
        append(m, rough({ 2.5, 0, 0 }, 1, 0.3, even));
    }
    m.normals.clear();
    return m;
}

ao::bake_job prepared(const mesh& m, const ao::sphere_rule& rule, const ao::bake_settings& settings = {})
{
    auto job = ao::prepare_bake(m.input(), rule, settings);
    INFO((job ? std::string() : std::string(job.error().reason())));
    REQUIRE(job);
    return std::move(*job);
}

// Receivers whose sums the raster has otherwise than the reference, in any of two widths.
std::size_t differing(const ao::bake_job& job)
{
    const auto wanted = ao::bake_reference(job);
    std::size_t count = 0;
    for (const ao::cpu::width lanes : { ao::cpu::width::scalar, ao::cpu::width::automatic }) {
        auto baker = ao::cpu::baker::create({ .lanes = lanes, .threads = 1 });
        REQUIRE(baker);
        const auto sums = baker->run(job, { .route = ao::bake_route::raster });
        REQUIRE(sums);
        REQUIRE(sums->holds(job));
        for (std::size_t i = 0; i < wanted->sums.size(); ++i) {
            count += sums->sums[i] == wanted->sums[i] ? 0 : 1;
        }
    }
    return count;
}

mesh in_floats(mesh m)
{
    for (glm::dvec3& p : m.positions) {
        p = glm::dvec3(glm::vec3(p));
    }
    m.normals.clear();
    return m;
}

// A ball of twelve vertices, and two of many whose box is the mesh's, so that units are those of the model and so
// few vertices are that ball's that the raster may take them apart.
mesh ball_in_the_middle(const glm::dvec3& centre = glm::dvec3(0.0))
{
    mesh m = sphere(centre, 0.02, 0);
    append(m, sphere({ 0.45, 0.45, 0.45 }, 0.05, 2));
    append(m, sphere({ -0.45, -0.45, -0.45 }, 0.05, 2));
    return in_floats(std::move(m));
}

void append_tetrahedron(mesh& m, std::array<glm::dvec3, 4> p)
{
    if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) > 0) {
        std::swap(p[1], p[2]);
    }
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    m.positions.insert(m.positions.end(), p.begin(), p.end());
    for (const std::uint32_t i : { 0U, 1U, 2U, 0U, 3U, 1U, 1U, 3U, 2U, 2U, 3U, 0U }) {
        m.indices.push_back(base + i);
    }
    m = in_floats(std::move(m));
}

// Where the line through a start meets a triangle, and on which side it would without rounding of depths.
struct judged {
    bool inside;
    bool ahead;
    bool exactly_ahead;

    judged(const ao::bake_line& line, const glm::vec3& start, const std::array<glm::dvec3, 4>& p)
    {
        const pass::ao_bake_point s = pass::ao_bake_seen(line, start);
        std::array<pass::ao_bake_point, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = pass::ao_bake_seen(line, glm::vec3(p[k]));
        }
        const auto crossing = pass::ao_bake_crossing_of(s, corners[0], corners[1], corners[2]);
        inside = crossing.inside;
        ahead = crossing.moment > 0;
        // Products of whole numbers below 2^24 are exact in double, and so are the sums of two.
        const auto share = [&](std::size_t i, std::size_t k) {
            const auto x = [](float a, float b) { return static_cast<double>(a) - static_cast<double>(b); };
            return x(corners[i].u, s.u) * x(corners[k].w, s.w) - x(corners[i].w, s.w) * x(corners[k].u, s.u);
        };
        const auto depth = [&](std::size_t k) { return static_cast<double>(corners[k].d) - static_cast<double>(s.d); };
        const double moment = share(1, 2) * depth(0) + share(2, 0) * depth(1) + share(0, 1) * depth(2);
        exactly_ahead = crossing.turned ? moment < 0 : moment > 0;
    }
    bool misjudged() const { return inside && ahead != exactly_ahead; }
};

} // namespace

TEST_CASE("closed surfaces seen from one side give the reference's bits", "[bake][cpu]")
{
    const mesh m = closed_meshes(GENERATE(0, 1, 2, 3, 4, 5));
    const auto settings =
        GENERATE(ao::bake_settings{}, ao::bake_settings{ .coefficient = ao::bake_coefficient::cosine, .bent_normals = true });
    CHECK(differing(prepared(m, *ao::lebedev_rule(302), settings)) == 0);
}

TEST_CASE("a canopy whose back is what vertices see is no closed surface", "[bake][cpu][closed]")
{
    mesh m = sphere({ 0, 0, 0 }, 1, 2);
    append(m, grid({ -0.4, -0.4, 1.3 }, { 0.8, 0, 0 }, { 0, 0.8, 0 }, 2));
    CHECK(differing(prepared(in_floats(std::move(m)), *ao::lebedev_rule(110))) == 0);
}

// A face less than a step above the start, seen from right below: a few of these lines see the start on the inner side, where
// the face's corners all lie behind it.
TEST_CASE("starts within steps of a closed surface are not taken to be outside", "[bake][cpu][closed]")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto anywhere = [&] { return glm::dvec3(uniform(random), uniform(random), uniform(random)); };
    for (int i = 0; i < 200; ++i) {
        mesh m = ball_in_the_middle(anywhere() * 0.3);
        const ao::bake_job alone = prepared(m, *ao::lebedev_rule(6));
        const ao::bake_vertex vertex = alone.mesh.vertices[random() % 12];
        const glm::dvec3 up(vertex.normal);
        const glm::dvec3 x = glm::normalize(glm::cross(up, anywhere()));
        const glm::dvec3 y = glm::cross(up, x);
        const glm::dvec3 face = glm::dvec3(vertex.start) + up * ((0.5 + 0.5 * uniform(random)) * lattice_step);
        append_tetrahedron(m, { face + x * 0.2, face - x * 0.1 + y * 0.15, face - x * 0.1 - y * 0.15, face + up * 0.2 });
        const ao::sphere_rule along{ .directions = { { up.x, up.y, up.z }, { -up.x, -up.y, -up.z } },
                                     .weights = { 0.5, 0.5 },
                                     .antipodal = true };
        CHECK(differing(prepared(m, along)) == 0);
    }
}

// Found by search: the line along which surfaces are counted meets an edge within 1e-14, so that rounding tells neither face to
// be met. (0.35730, 0.64217, 0.67841) in bake_closed.cpp.
TEST_CASE("starts whose counting line meets an edge are not taken to be outside", "[bake][cpu][closed]")
{
    mesh m = ball_in_the_middle();
    const glm::dvec3 start(prepared(m, *ao::lebedev_rule(14)).mesh.vertices[0].start);
    const glm::dvec3 from(-0.241614595, 0.208421394, 0.0879560634);
    const glm::dvec3 to(0.220117003, -0.0116929645, 0.0531307124);
    const glm::dvec3 back = start - glm::normalize(glm::dvec3(0.35730, 0.64217, 0.67841)) * 0.2;
    const glm::dvec3 across = glm::normalize(glm::cross(to - from, start - back)) * 0.3;
    append_tetrahedron(m, { from, to, back + across, back - across });
    CHECK(differing(prepared(m, *ao::lebedev_rule(110))) == 0);
}

// Triangles that a line sees as slivers a few steps wide, whose edge passes just before or just behind the start while their
// corners lie on both sides of it: there rounding of the predicate's depths decides, and the rest of the closed surface does not
// agree with it.
TEST_CASE("slivers that rounding puts on the other side of a start", "[bake][cpu][closed]")
{
    const mesh middle = ball_in_the_middle();
    const ao::bake_job alone = prepared(middle, *ao::lebedev_rule(14));
    std::mt19937 random(1);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    std::size_t entered = 0;
    std::size_t left = 0;
    while (entered < 24 || left < 24) {
        const ao::bake_line& line = alone.lines[random() % alone.lines.size()];
        const double sign = random() % 2 == 0 ? 1 : -1;
        const glm::dvec3 d = glm::dvec3(line.dx, line.dy, line.dz) * sign;
        std::size_t vertex = 0; // that looks that way most
        for (std::size_t v = 1; v < 12; ++v) {
            const auto cosine = [&](std::size_t i) { return glm::dot(glm::dvec3(alone.mesh.vertices[i].normal), d); };
            vertex = cosine(v) > cosine(vertex) ? v : vertex;
        }
        const double turn = uniform(0, 2 * std::numbers::pi);
        const glm::dvec3 u(line.ux, line.uy, line.uz);
        const glm::dvec3 w(line.wx, line.wy, line.wz);
        const glm::dvec3 narrow = u * std::cos(turn) + w * std::sin(turn);
        const glm::dvec3 wide = w * std::cos(turn) - u * std::sin(turn);
        const glm::vec3& start = alone.mesh.vertices[vertex].start;
        const auto at = [&](double steps, double y, double depth) {
            return glm::dvec3(glm::vec3(glm::dvec3(start) + narrow * (steps * lattice_step) + wide * y + d * depth));
        };
        const double side = random() % 2 == 0 ? 1 : -1;
        const double height = side * std::pow(10.0, uniform(-5.6, -4));
        const double slope = uniform(-0.5, 0.5);
        const double low = -uniform(0.2, 0.45);
        const double high = uniform(0.2, 0.45);
        const double third = uniform(low, high);
        const double depth = height + slope * third + side * uniform(0.1, 0.4);
        const std::array<glm::dvec3, 4> corners{
            at(uniform(-3, 3), low, height + slope * low), at(uniform(-3, 3), high, height + slope * high),
            at(uniform(-3, 3), third, depth),
            at(uniform(0.2, 0.5) * (random() % 2 == 0 ? 1 : -1) / lattice_step, uniform(low, high), height + uniform(-0.1, 0.1))
        };
        if (!judged(line, start, corners).misjudged()) {
            continue;
        }
        mesh m = middle;
        append_tetrahedron(m, corners);
        const ao::bake_job job = prepared(m, *ao::lebedev_rule(14));
        REQUIRE(job.mesh.exponent == 0);
        if (job.mesh.vertices[vertex].start != start) { // it meets the vertex
            continue;
        }
        (side > 0 ? entered : left) += 1;
        CHECK(differing(job) == 0);
    }
}
