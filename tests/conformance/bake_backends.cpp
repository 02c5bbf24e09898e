// Ambient occlusion per vertex: every backend and route finds the visibility of every vertex and direction as the reference does.
#include "unit/bake_cgal_meshes.hpp"
#include "unit/bake_cube_cases.hpp"

#ifdef AO_HAS_CPU
#include "ao/cpu/bake.hpp"
#endif
#ifdef AO_HAS_GL
#include "ao/gl/bake.hpp"
#include "host/gl_context.hpp"
#endif
#ifdef AO_HAS_VK
#include "ao/vk/bake.hpp"
#include "support/vk_runner.hpp"
#endif

#include <functional>
#include <memory>

using namespace bake_test;

namespace {

struct way {
    std::string name;
    ao::bake_route route;
    std::function<ao::result<ao::bake_sums>(const ao::bake_job&, const ao::bake_request&)> run;
};

// Those with the same bits.
constexpr std::array exact_routes{ std::pair{ ao::bake_route::brute, "brute" }, std::pair{ ao::bake_route::tiled, "tiled" },
                                   std::pair{ ao::bake_route::packed, "packed" },
                                   std::pair{ ao::bake_route::hierarchy, "hierarchy" },
                                   std::pair{ ao::bake_route::raster, "raster" } };

template <class Baker>
void add(std::vector<way>& ways, const std::string& name, const std::shared_ptr<Baker>& baker)
{
    for (const auto& [route, route_name] : exact_routes) {
        if (!Baker::has(route)) {
            continue;
        }
        ways.push_back(
            { name + " " + route_name, route, [baker, asked = route](const ao::bake_job& job, ao::bake_request request) {
                 request.route = asked;
                 return baker->run(job, request);
             } });
    }
}

const std::vector<way>& ways()
{
    static const std::vector<way> all = [] {
        std::vector<way> made;
#ifdef AO_HAS_CPU
        for (const ao::cpu::width lanes : { ao::cpu::width::scalar, ao::cpu::width::automatic }) {
            auto cpu = ao::cpu::baker::create({ .lanes = lanes });
            REQUIRE(cpu);
            const std::string name = "cpu " + std::string(ao::cpu::name_of(cpu->lanes()));
            add(made, name, std::make_shared<ao::cpu::baker>(std::move(*cpu)));
        }
#endif
#ifdef AO_HAS_GL
        static auto context = ao::host::gl_context::create();
        REQUIRE(context);
        auto gl = ao::gl::baker::create((*context)->loader());
        REQUIRE(gl);
        add(made, "gl", std::make_shared<ao::gl::baker>(std::move(*gl)));
#endif
#ifdef AO_HAS_VK
        static auto device = ao::host::vulkan_device::create();
        REQUIRE(device);
        auto vk = ao::vk::baker::create(vk_runner::context_of(**device), { (*device)->queue, (*device)->queue_family });
        REQUIRE(vk);
        add(made, "vk", std::make_shared<ao::vk::baker>(std::move(*vk)));
#endif
        return made;
    }();
    return all;
}

// By the CPU where it is there, whose lanes make it the fastest.
ao::result<ao::bake_sums> by_brute_force(const ao::bake_job& job, const ao::bake_request& part)
{
    const way* by = nullptr;
    for (const way& each : ways()) {
        if (each.route == ao::bake_route::brute && each.name.rfind("cpu", 0) == 0) {
            by = &each;
        }
    }
    return by != nullptr ? by->run(job, part) : ao::bake_reference(job, part);
}

// Sums of two lines each, with the directions that are open: what is seen along every one of them.
void check_visibility(const mesh& m, const ao::sphere_rule& rule)
{
    const auto job = job_of(m, rule, { .bent_normals = true });
    for (std::size_t line = 0; line < job.lines.size(); line += 2) {
        const ao::bake_request part{ .first_line = line, .last_line = std::min(line + 2, job.lines.size()) };
        const auto expected = ao::bake_reference(job, part);
        REQUIRE(expected);
        for (const way& each : ways()) {
            INFO(each.name << ", line " << line);
            const auto sums = each.run(job, part);
            INFO((sums ? std::string() : std::string(sums.error().reason())));
            REQUIRE(sums);
            CHECK(differing_sums(*sums, *expected) == 0);
        }
    }
}

} // namespace

TEST_CASE("all routes see the same along every direction of every vertex")
{
    check_visibility(sphere_on_floor(6, 2), *ao::lebedev_rule(50));
    // Rays through edges and corners, and along walls.
    check_visibility(box({ 0, 0, 0 }, { 1, 2, 1 }, 4, true), *ao::lebedev_rule(26, ao::no_rotation));
    check_visibility(welded(box({ 0, 0, 0 }, { 1, 2, 1 }, 4, true)), *ao::lebedev_rule(26, ao::no_rotation));
    check_visibility(broken(500, 11), *ao::fibonacci_rule(21));
}

TEST_CASE("all routes see the same on meshes of thousands of vertices")
{
    check_visibility(sphere_on_floor(20, 4), *ao::lebedev_rule(6));
    check_visibility(broken(1500, 12), *ao::fibonacci_rule(4));
}

TEST_CASE("all routes see the same on broken meshes")
{
    const std::vector<std::string> names{ "degtri_sliding.off",   "mpi.off",
                                          "patch-13.off",         "double-torus-3-holes.off",
                                          "oblong-shuffled.off",  "mask_cone.off",
                                          "boeing.off",           "elephant-with-holes.off",
                                          "mech-holes-shark.off", "ChineseDragon-10kv.off" };
    const auto folder = cgal_folder::unpack(names);
    if (!folder) {
        WARN("skipped: " << cgal_archive << " of the package libcgal-demo is not there, or tar cannot read it");
        return;
    }
    for (const std::string& name : names) {
        INFO(name);
        const auto m = folder->read(name);
        REQUIRE(m);
        const auto job = job_of(*m, *ao::lebedev_rule(50), { .bent_normals = true });
        const auto tests = static_cast<double>(job.vertices()) * static_cast<double>(job.mesh.triangles.size());
        const std::size_t lines = tests < 1e6 ? job.lines.size() : tests < 1e7 ? 4 : 2;
        for (std::size_t line = 0; line < lines; line += 2) {
            const ao::bake_request part{ .first_line = line, .last_line = std::min(line + 2, job.lines.size()) };
            const auto expected = by_brute_force(job, part);
            REQUIRE(expected);
            for (const way& each : ways()) {
                // On software drivers brute force takes minutes.
                const bool goes_through_all = each.route == ao::bake_route::brute || each.route == ao::bake_route::tiled ||
                                              each.route == ao::bake_route::packed;
                if (goes_through_all && tests > 1e7) {
                    continue;
                }
                INFO(each.name << ", line " << line);
                const auto sums = each.run(job, part);
                REQUIRE(sums);
                CHECK(differing_sums(*sums, *expected) == 0);
            }
        }
    }
}

// Whether a ray meets any triangle ahead of `from`, in doubles (Moeller and Trumbore's test), each grown by a share of itself.
bool meets(const ao::bake_mesh& m, const glm::dvec3& from, const glm::dvec3& d, double grown)
{
    for (const ao::bake_triangle& t : m.triangles) {
        const glm::dvec3 a(m.points[t[0]]);
        const glm::dvec3 ab = glm::dvec3(m.points[t[1]]) - a;
        const glm::dvec3 ac = glm::dvec3(m.points[t[2]]) - a;
        const glm::dvec3 p = glm::cross(d, ac);
        const double volume = glm::dot(ab, p);
        const glm::dvec3 s = from - a;
        const double u = glm::dot(s, p) / volume;
        const glm::dvec3 q = glm::cross(s, ab);
        const double v = glm::dot(d, q) / volume;
        if (u >= -grown && v >= -grown && u + v <= 1 + grown && glm::dot(ac, q) / volume > 0) {
            return true;
        }
    }
    return false;
}

// Whether what a cube map says is so in the middle of the texel, but for rounding.
bool is_so(const ao::bake_mesh& m, const glm::dvec3& from, const glm::dvec3& middle, bool open)
{
    constexpr double rounding = 1e-5;
    return open ? !meets(m, from, middle, -rounding) : meets(m, from, middle, rounding);
}

// How cube maps differ from rays, of all pairs of a vertex and a direction above it.
struct cube_differences {
    double share = 0;       // that differ
    double horizon = 0;     // of these: the middle of the texel lies below the vertex's tangent plane, the direction above it
    double unexplained = 0; // of these: the ray through the middle of the texel is not what the texel says
    double rms = 0;         // of the uniform coefficient
    double greatest = 0;
};

cube_differences differences_of(const ao::bake_job& job, int texels)
{
    using pass = ao::bake_pass<float>;
    std::size_t pairs = 0;
    std::size_t differing = 0;
    std::size_t horizon = 0;
    std::size_t unexplained = 0;
    std::size_t baked = 0;
    double squares = 0;
    cube_differences found;
    for (std::size_t i = 0; i < job.vertices(); ++i) {
        if ((job.mesh.flags[i] & ao::bake_unbaked) != 0) {
            continue;
        }
        const cube_map cube(job, i, texels);
        const ao::bake_ray_reference ray{ job, i };
        const ao::bake_vertex& v = job.mesh.vertices[i];
        double difference = 0;
        std::size_t count = 0;
        for (const ao::bake_line& line : job.lines) {
            const float cosine = pass::ao_bake_cosine(line, v.normal);
            const float sign = cosine >= 0 ? 1.0F : -1.0F;
            const glm::vec3 d(line.dx * sign, line.dy * sign, line.dz * sign);
            const bool open = ray.open(line, sign) == 1.0F;
            const bool open_in_cube = cube.distance(d) > job.reach;
            ++count;
            if (open != open_in_cube) {
                const glm::dvec3 middle = cube.middle(d);
                ++differing;
                horizon += glm::dot(middle, glm::dvec3(v.normal)) < 0 ? 1 : 0;
                unexplained += is_so(job.mesh, glm::dvec3(v.start), middle, open_in_cube) ? 0 : 1;
                difference += open ? 1 : -1;
            }
        }
        pairs += count;
        ++baked;
        difference /= static_cast<double>(count);
        squares += difference * difference;
        found.greatest = std::max(found.greatest, std::abs(difference));
    }
    const auto all = static_cast<double>(std::max<std::size_t>(differing, 1));
    found.share = static_cast<double>(differing) / static_cast<double>(pairs);
    found.horizon = static_cast<double>(horizon) / all;
    found.unexplained = static_cast<double>(unexplained) / all;
    found.rms = std::sqrt(squares / static_cast<double>(baked));
    return found;
}

TEST_CASE("cube maps differ from rays by their texels, and by nothing else")
{
    mesh ball = sphere({ 0, 0, 0 }, 1, 2);
    for (std::size_t i = 0; i < ball.positions.size(); ++i) { // dents
        const glm::dvec3 p = ball.positions[i];
        ball.positions[i] *= 1 + 0.15 * std::sin(7 * p.x) * std::sin(6 * p.y + 1) * std::sin(5 * p.z);
    }
    const std::array scenes{ std::pair{ "sphere on a floor", sphere_on_floor() }, std::pair{ "ball with dents", ball },
                             std::pair{ "soup", broken(80, 3) } };
    for (const auto& [name, m] : scenes) {
        const auto job = job_of(m, *ao::lebedev_rule(194), {});
        for (const int texels : { 16, 32, 64 }) {
            const cube_differences found = differences_of(job, texels);
            CAPTURE(name, texels, found.share, found.horizon, found.unexplained, found.rms, found.greatest);
            // Outlines cross so many texels as they are long: twice the texels, half the share. docs/numerics.md, "Per vertex".
            CHECK(found.share * texels < 0.4);
            CHECK(found.share > 0);
            CHECK(found.unexplained == 0);
        }
    }
}

TEST_CASE("all routes have the same sums for all settings")
{
    const mesh scene = sphere_on_floor(8, 2);
    for (const setting_case& each : setting_cases()) {
        INFO(each.name);
        const auto job = job_of(scene, *ao::lebedev_rule(38), each.settings);
        const auto expected = ao::bake_reference(job);
        REQUIRE(expected);
        std::size_t able = 0;
        for (const way& by : ways()) {
            INFO(by.name);
            const auto sums = by.run(job, {});
            if (!sums) {
                CHECK(sums.error().code() == ao::errc::unsupported_format);
                continue;
            }
            ++able;
            CHECK(differing_sums(*sums, *expected) == 0);
        }
        CHECK(able >= ways().size() / 2);
    }
}
