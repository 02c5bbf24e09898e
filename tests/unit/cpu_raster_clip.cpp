// Triangles that cross the near and far planes, the eye's plane and the guard band, against rays in double.
#include "unit/cpu_raster_support.hpp"

#include <random>

using namespace cpu_test;
using glm::dvec2;
using glm::dvec3;
using raster_test::mesh_data;
using raster_test::world;

namespace {

constexpr int width = 96;
constexpr int height = 64;
constexpr double near = 0.5;
constexpr double far = 40;

struct view_kind {
    ao::projection_options options;
    double far_plane;
};

// Each triangle is an object; the camera is at the origin.
world random_triangles(unsigned seed)
{
    std::mt19937 random(seed);
    const auto signed_unit = [&] { return std::uniform_real_distribution<float>(-1.0F, 1.0F)(random); };
    world w;
    w.materials.resize(2);
    w.materials[1].two_sided = false;
    for (int i = 0; i < (seed % 2 == 0 ? 40 : 3); ++i) {
        // Around the eye, far away, and with corners at very different distances.
        mesh_data m;
        for (int corner = 0; corner < 3; ++corner) {
            const float reach = i % 4 == 0 ? 3.0F : i % 4 == 1 ? 60.0F : i % 4 == 2 ? 1e5F : corner == 0 ? 1e6F : 2.0F;
            m.positions.push_back({ reach * signed_unit(), reach * signed_unit(), reach * signed_unit() });
            m.normals.push_back({ 0, 0, 1 });
            m.uvs.push_back({ signed_unit(), signed_unit() });
        }
        m.indices = { 0, 1, 2 };
        w.meshes.push_back(m);
        w.add(i, i % 5 == 3 ? 1 : 0, glm::mat4(1));
    }
    return w;
}

struct ray {
    dvec3 origin;
    dvec3 direction;
};

// Through a point of the picture; the parameter is the eye depth.
ray through(const ao::gbuffer_camera& c, dvec2 pixel, bool parallel)
{
    const auto folded = ao::fold_projection(c.projection, width, height);
    const auto& p = folded->projection;
    const double x = pixel.x * static_cast<double>(p.slope_x) + static_cast<double>(p.offset_x);
    const double y = pixel.y * static_cast<double>(p.slope_y) + static_cast<double>(p.offset_y);
    return parallel ? ray{ { x, y, 0 }, { 0, 0, -1 } } : ray{ { 0, 0, 0 }, { x, y, -1 } };
}

struct hit {
    int object = -1;
    double depth = 1e300;
    double second = 1e300; // of the next surface
    bool front = true;
};

// Möller and Trumbore's intersection.
hit nearest(const world& w, const ray& r, double far_plane)
{
    hit found;
    for (std::size_t i = 0; i < w.meshes.size(); ++i) {
        const auto& p = w.meshes[i].positions;
        const dvec3 a(p[0]);
        const dvec3 u = dvec3(p[1]) - a;
        const dvec3 v = dvec3(p[2]) - a;
        const dvec3 q = glm::cross(r.direction, v);
        const double determinant = glm::dot(u, q);
        const dvec3 s = r.origin - a;
        const double b = glm::dot(s, q) / determinant;
        const dvec3 e = glm::cross(s, u);
        const double c = glm::dot(r.direction, e) / determinant;
        const double depth = glm::dot(v, e) / determinant;
        if (!(b >= 0 && c >= 0 && b + c <= 1 && depth >= near && depth <= far_plane)) {
            continue;
        }
        const bool front = glm::dot(glm::cross(u, v), r.direction) < 0;
        if (!front && w.objects[i].material == 1) {
            continue;
        }
        if (depth < found.depth) {
            found = { static_cast<int>(i), depth, found.depth, front };
        }
        else {
            found.second = std::min(found.second, depth);
        }
    }
    return found;
}

ao::gbuffer_camera camera_of(const view_kind& k)
{
    ao::gbuffer_camera c;
    c.projection = k.options.parallel ? ao::make_projection({ -6, 7, -5, 4, near, k.far_plane }, k.options)
                                      : ao::make_projection({ -0.8, 0.7, -0.6, 0.5, near, k.far_plane }, k.options);
    c.previous_projection = c.projection;
    return c;
}

std::array<view_kind, 5> view_kinds()
{
    using enum ao::depth_range;
    return { { { {}, far },
               { { .range = minus_one_to_one }, far },
               { { .reversed = true }, std::numeric_limits<double>::infinity() },
               { { .range = minus_one_to_one, .rows = ao::first_row::at_ndc_plus_one, .reversed = true, .y_down = true }, far },
               { { .parallel = true }, far } } };
}

ao::gbuffer_facts facts()
{
    ao::gbuffer_facts f;
    f.width = width;
    f.height = height;
    f.ids = f.position = f.surface = f.motion = true;
    f.normal_format = ao::pixel_format::rgba32f;
    return f;
}

} // namespace

TEST_CASE("triangles across the near and far planes, behind the eye, and far outside are seen where rays meet them")
{
    auto cpu = cpu_test::rasterizer();
    for (const view_kind& k : view_kinds()) {
        const ao::gbuffer_camera camera = camera_of(k);
        int compared = 0;
        int background = 0;
        for (unsigned seed = 0; seed < 12; ++seed) {
            world w = random_triangles(seed);
            const drawn d = cpu_test::draw(cpu, w.get(), facts(), camera);
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) {
                    const auto look = [&](double column, double row) {
                        return nearest(w, through(camera, { column, row }, k.options.parallel), k.far_plane);
                    };
                    const hit at = look(x + 0.5, y + 0.5);
                    // Near an edge, a plane, or where two surfaces meet.
                    constexpr double margin = 0.02;
                    const bool doubtful = (at.object >= 0 && at.second < at.depth * 1.001) ||
                                          look(x + 0.5 - margin, y + 0.5).object != at.object ||
                                          look(x + 0.5 + margin, y + 0.5).object != at.object ||
                                          look(x + 0.5, y + 0.5 - margin).object != at.object ||
                                          look(x + 0.5, y + 0.5 + margin).object != at.object;
                    if (doubtful) {
                        continue;
                    }
                    const auto i = static_cast<std::size_t>(y * width + x);
                    INFO("seed " << seed << ", pixel " << x << ", " << y << ", reversed " << k.options.reversed);
                    REQUIRE(static_cast<int>(d.ids.texel<glm::uvec2>(i).x) == at.object + 1);
                    ++compared;
                    background += at.object < 0 ? 1 : 0;
                    if (at.object >= 0) {
                        const auto position = d.position.texel<glm::vec4>(i);
                        REQUIRE(std::abs(static_cast<double>(-position.z) - at.depth) < 1e-3 * at.depth);
                        REQUIRE(d.surface.texel<glm::vec4>(i).w == (at.front ? 1.0F : -1.0F));
                        const float depth = d.depth.texel<float>(i);
                        REQUIRE(depth >= 0);
                        REQUIRE(depth <= 1);
                    }
                }
            }
        }
        CHECK(compared > 12 * width * height / 2);
        CHECK(background > 100);
        CHECK(compared - background > 10000);
    }
}

TEST_CASE("every target is the same bits with any threads and tiles")
{
    for (const view_kind& k : view_kinds()) {
        for (unsigned seed = 0; seed < 2; ++seed) {
            world w = random_triangles(seed);
            // An alpha map, so that fragments are also decided within a tile.
            std::vector<std::uint8_t> texels(4 * 64);
            for (std::size_t i = 0; i < texels.size(); ++i) {
                texels[i] = static_cast<std::uint8_t>(i * 89 % 256);
            }
            w.add_texture(8, texels, ao::wrap_mode::repeat);
            w.materials.resize(3);
            w.materials[2].alpha_map = 0;
            for (std::size_t i = 0; i < w.objects.size(); i += 2) {
                w.objects[i].material = 2;
            }
            std::vector<drawn> all;
            for (const ao::cpu::options& o : divisions()) {
                auto cpu = cpu_test::rasterizer(o);
                all.push_back(cpu_test::draw(cpu, w.get(), facts(), camera_of(k)));
                CHECK(cpu_test::differing(all.front(), all.back()) == 0);
            }
        }
    }
}

TEST_CASE("a large mesh, most of it out of view, is drawn as its triangles are one by one")
{
    auto cpu = cpu_test::rasterizer();
    std::mt19937 random(11);
    const auto signed_unit = [&] { return std::uniform_real_distribution<float>(-1.0F, 1.0F)(random); };
    mesh_data large;
    for (int i = 0; i < 3000; ++i) {
        // In the order of their place, so that neighbours in the mesh are neighbours in space.
        const float along = static_cast<float>(i) / 20 - 75;
        const glm::vec3 centre(along, 5 * signed_unit(), -20 + 10 * signed_unit());
        for (int corner = 0; corner < 3; ++corner) {
            large.indices.push_back(static_cast<std::uint32_t>(large.positions.size()));
            large.positions.push_back(centre + glm::vec3(signed_unit(), signed_unit(), signed_unit()));
        }
    }
    world together;
    together.meshes = { large };
    world apart;
    for (std::size_t i = 0; i < large.positions.size(); i += 3) {
        mesh_data one;
        one.positions = { large.positions[i], large.positions[i + 1], large.positions[i + 2] };
        one.indices = { 0, 1, 2 };
        apart.meshes.push_back(one);
    }
    const ao::matrix4 turned(glm::rotate(glm::mat4(1), 0.1F, glm::vec3(0, 1, 0)));
    together.add(0, 0, turned.to_glm());
    for (std::size_t i = 0; i < apart.meshes.size(); ++i) {
        apart.add(static_cast<int>(i), 0, turned.to_glm());
    }
    for (const view_kind& k : view_kinds()) {
        for (const float turn : { 0.0F, 1.2F, 3.1F }) {
            ao::gbuffer_camera camera = camera_of(k);
            camera.view = ao::matrix4(glm::rotate(glm::mat4(1), turn, glm::vec3(0.1F, 1, 0)));
            auto f = facts();
            f.motion = f.surface = false;
            const drawn a = cpu_test::draw(cpu, together.get(), f, camera);
            const drawn b = cpu_test::draw(cpu, apart.get(), f, camera);
            CHECK(picture_test::differing(a.depth, b.depth) == 0);
            CHECK(picture_test::differing(a.position, b.position) == 0);
            CHECK(picture_test::differing(a.normal, b.normal) == 0);
            std::size_t seen = 0;
            for (std::size_t i = 0; i < a.ids.pixels(); ++i) {
                seen += a.ids.texel<glm::uvec2>(i).x;
            }
            CHECK((seen > 500 || turn > 2));
        }
    }
}
