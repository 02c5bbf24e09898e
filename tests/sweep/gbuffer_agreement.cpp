#include "sweep/gbuffer_agreement.hpp"

#include "ao/conformance/shade_reference.hpp"
#include "scene/lights_file.hpp"
#include "sweep/gbuffer_truth.hpp"
#include "unit/picture_test.hpp"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace gbuffer_test {

using ao::host::scene_picture;

namespace {

template <class T>
T take(ao::result<T> r)
{
    if (!r) {
        FAIL(std::string(r.error().reason()));
    }
    return std::move(*r);
}

// Alpha is rounded to 256 codes at each level; levels are blended by footprints that differ in the last places.
constexpr double alpha_doubt = 2.0 / 255;

// Mostly of planes seen edge-on: wider bounds are checked, but the differences are not among those that are printed.
constexpr double loose_position = 0.05; // of the distance
constexpr double loose_normal = 0.25;

struct compared_pixel {
    bool same = false;
    bool explained_a = false; // by some triangle, not by one for both
    bool explained_b = false;
    double bound_a = 0;
    double bound_b = 0;
    bool loose = false;
    double share = 0; // of the bound
};

dvec3 vector_at(const ao::picture& p, std::size_t i)
{
    return dvec3(glm::vec3(p.texel<glm::vec4>(i)));
}

// Looks for a triangle that both pictures can have shown at each pixel where their ids are the same.
class explanation {
public:
    explanation(const drawn_scene& s, const drawn_view& v, const lens& l, const std::vector<seen_triangle>& triangles,
                const drawn_pictures& a, const drawn_pictures& b)
        : scene_(s.view.get()),
          heap_(s.heap),
          view_(v),
          lens_(l),
          a_(a),
          b_(b),
          pixels_(a.ids.pixels()),
          triangles_(triangles)
    {
    }

    agreement run()
    {
        for (const seen_triangle& t : triangles_) {
            const auto range = [](double low, double high, int size) {
                return std::pair(std::max(static_cast<int>(std::max(low, 0.0)) - 1, 0),
                                 std::min(static_cast<int>(std::min(high, 1.0 * size)) + 1, size - 1));
            };
            const auto [left, right] = range(t.low().x, t.high().x, view_.facts.width);
            const auto [top, bottom] = range(t.low().y, t.high().y, view_.facts.height);
            for (int y = top; y <= bottom; ++y) {
                for (int x = left; x <= right; ++x) {
                    look(t, x, y);
                }
            }
        }
        agreement g;
        g.pixels = pixels_.size();
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            count(g, i);
        }
        return g;
    }

private:
    void look(const seen_triangle& t, int x, int y)
    {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.facts.width) + static_cast<std::size_t>(x);
        const auto id = a_.ids.texel<glm::uvec2>(i);
        const dvec2 pixel(x + 0.5, y + 0.5);
        compared_pixel& at = pixels_[i];
        // A corner that moves takes its edges along; half-planes of sharp corners reach further, the bounding box does not.
        if (id.x != t.object + 1 || id != b_.ids.texel<glm::uvec2>(i) || at.same ||
            !t.covers(pixel, std::sqrt(2.0) * t.displacement())) {
            return;
        }
        surface_point p;
        if (!t.at(pixel, lens_, heap_, vector_at(a_.position, i), p)) {
            return;
        }
        const auto off = [&](const drawn_pictures& of) { return glm::length(vector_at(of.position, i) - p.position); };
        const auto explains = [&](const drawn_pictures& of) {
            return off(of) <= p.position_bound && glm::length(vector_at(of.normal, i) - p.normal) <= p.normal_bound;
        };
        const bool a = explains(a_);
        const bool b = explains(b_);
        at.explained_a = at.explained_a || a;
        at.explained_b = at.explained_b || b;
        at.bound_a = a ? std::max(at.bound_a, p.position_bound) : at.bound_a;
        at.bound_b = b ? std::max(at.bound_b, p.position_bound) : at.bound_b;
        at.same = a && b;
        at.loose = at.same && (p.position_bound > loose_position * glm::length(p.position) || p.normal_bound > loose_normal);
        at.share = at.same ? std::max(off(a_), off(b_)) / p.position_bound : 0;
    }

    // Two triangles that cut through each other, or lie in one plane: which of them is seen is a matter of depths that differ by
    // less than their errors, those of interpolation and a few steps of 2^-24 of a depth buffer from near to infinity.
    bool crossing(std::size_t i) const
    {
        const dvec3 a = vector_at(a_.position, i);
        const dvec3 b = vector_at(b_.position, i);
        const double steps = 4 * 0x1p-24 * a.z * a.z / view_.near * glm::length(a) / -a.z;
        const compared_pixel& at = pixels_[i];
        return at.explained_a && at.explained_b && glm::length(a - b) <= at.bound_a + at.bound_b + steps;
    }

    void count(agreement& g, std::size_t i) const
    {
        const auto id = a_.ids.texel<glm::uvec2>(i);
        if (id != b_.ids.texel<glm::uvec2>(i)) {
            ++g.other_ids;
            return find_edge(g, i);
        }
        if (id.x == 0) {
            return;
        }
        const dvec3 position = vector_at(a_.position, i);
        const double difference = glm::length(position - vector_at(b_.position, i)) / glm::length(position);
        if (!pixels_[i].same && crossing(i)) {
            ++g.crossings;
            g.position = std::max(g.position, difference);
            return;
        }
        if (!pixels_[i].same) {
            ++g.other_surfaces;
            return find_edge(g, i);
        }
        if (pixels_[i].loose) {
            ++g.loose;
            return;
        }
        g.position = std::max(g.position, difference);
        g.position_share = std::max(g.position_share, pixels_[i].share);
        const int leaf = ao::geometry_material(scene_, scene_.objects[id.x - 1].material);
        double& normal =
            scene_.materials[static_cast<std::size_t>(leaf)].normal_map == ao::no_texture ? g.normal : g.mapped_normal;
        normal = std::max(normal, glm::length(vector_at(a_.normal, i) - vector_at(b_.normal, i)));
    }

    void find_edge(agreement& g, std::size_t i) const
    {
        const auto width = static_cast<std::size_t>(view_.facts.width);
        const dvec2 pixel(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5);
        double least = 1e300;
        std::vector<const seen_triangle*> there;
        for (const seen_triangle& t : triangles_) {
            if (pixel.x < t.low().x - 1 || pixel.x > t.high().x + 1 || pixel.y < t.low().y - 1 || pixel.y > t.high().y + 1) {
                continue;
            }
            least = std::min(least, t.distance_to_edge(pixel));
            if (t.alpha_edge(pixel, lens_, heap_, alpha_doubt)) {
                least = 0;
            }
            if (t.covers(pixel, 0.5)) {
                there.push_back(&t);
            }
        }
        for (const seen_triangle* s : there) {
            for (const seen_triangle* t : there) {
                if (s != t && s->object + 1 == a_.ids.texel<glm::uvec2>(i).x && t->object + 1 == b_.ids.texel<glm::uvec2>(i).x) {
                    least = std::min(least, s->distance_to_cut(*t, pixel, lens_));
                }
            }
        }
        g.far_from_edges += least <= 0.5 ? 0 : 1;
        g.edge_distance = std::max(g.edge_distance, least);
        if (least > 0.5) {
            const auto x = a_.ids.texel<glm::uvec2>(i);
            const auto y = b_.ids.texel<glm::uvec2>(i);
            const dvec3 p = vector_at(a_.position, i);
            const dvec3 q = vector_at(b_.position, i);
            UNSCOPED_INFO("pixel " << pixel.x << ", " << pixel.y << ": ids " << x.x << " " << x.y << " and " << y.x << " " << y.y
                                   << ", depth " << -p.z << " and " << -q.z << ", edge " << least << " away");
        }
    }

    ao::scene scene_;
    const ao::texel_heap& heap_;
    const drawn_view& view_;
    const lens& lens_;
    const drawn_pictures& a_;
    const drawn_pictures& b_;
    std::vector<compared_pixel> pixels_;
    const std::vector<seen_triangle>& triangles_;
};

ao::picture uneven_visibility(int width, int height)
{
    ao::picture v(ao::pixel_format::r32f, width, height);
    for (std::size_t i = 0; i < v.pixels(); ++i) {
        v.set_texel(i, static_cast<float>((i * 2654435761U >> 8U) % 1025U) / 1024);
    }
    return v;
}

ao::shade_plan shading_of(const ao::scene& s, const drawn_view& v)
{
    ao::shade_facts f;
    f.width = v.facts.width;
    f.height = v.facts.height;
    f.depth_format = v.facts.depth_format;
    f.normals = v.facts.normals;
    f.normal_format = v.facts.normal_format;
    return take(ao::make_shade_plan(s, f, { v.camera.projection, v.camera.view }));
}

void check_shading(const std::vector<ao::host::scene_runner_ptr>& runners, const drawn_scene& s, const drawn_view& v,
                   const drawn_pictures& drawn)
{
    const ao::shade_plan plan = shading_of(s.view.get(), v);
    const ao::conformance::shade_inputs in{ drawn.depth,   drawn.normal, drawn.ids,
                                            drawn.surface, drawn.frame,  uneven_visibility(v.facts.width, v.facts.height) };
    const ao::picture expected = ao::conformance::reference_color(plan, s.heap, in);
    CHECK(picture_test::differing(expected, ao::picture(ao::pixel_format::rgba32f, v.facts.width, v.facts.height)) >
          expected.pixels() / 10);
    for (const auto& r : runners) {
        INFO(r->name() << " on " << r->device());
        const auto put = [&](scene_picture which, const ao::picture& p) { static_cast<void>(take(r->upload(which, p))); };
        static_cast<void>(take(r->make_targets(v.facts)));
        put(scene_picture::depth, in.geometry);
        put(scene_picture::normal, in.normal);
        put(scene_picture::ids, in.ids);
        put(scene_picture::surface, in.surface);
        if (v.facts.frame) {
            put(scene_picture::frame, in.frame);
        }
        static_cast<void>(take(r->prepare_shading(plan, s.heap)));
        put(scene_picture::visibility, in.visibility);
        static_cast<void>(take(r->shade()));
        if (r->exact()) {
            CHECK(picture_test::differing(take(r->download(scene_picture::color)), expected) == 0);
        }
        CHECK(take(r->clamped_weights()) == 0);
        CHECK(r->messages().empty());
    }
}

} // namespace

drawn_scene::drawn_scene(const ao::tools::scene& s) : model(&s), view(s)
{
    auto lights = ao::tools::default_lights();
    view.set_lights(std::move(lights.lights), lights.ambient);
    heap = take(ao::make_texel_heap(view.get().textures));
}

drawn_view view_of(const drawn_scene& s, const std::string& name, const ao::tools::camera& c, int width, int height)
{
    const auto f = ao::tools::perspective(c, static_cast<float>(width) / static_cast<float>(height),
                                          ao::tools::clip_range(ao::tools::bounds_of(*s.model), c));
    const auto wide = [](float x) { return static_cast<double>(x); };
    drawn_view v;
    v.name = name;
    v.near = wide(f.near);
    v.camera.projection =
        ao::make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) },
                            { .rows = ao::first_row::at_ndc_plus_one });
    v.camera.view = ao::matrix4(ao::tools::view_matrix(c));
    v.camera.previous_projection = v.camera.projection;
    v.camera.previous_view = v.camera.view;
    v.facts.width = width;
    v.facts.height = height;
    v.facts.position = v.facts.ids = v.facts.surface = true;
    v.facts.normal_format = ao::pixel_format::rgba32f;
    v.facts.frame = ao::needs_frame(s.view.get());
    return v;
}

drawn_pictures draw(ao::host::scene_runner& r, const drawn_scene& s, const drawn_view& v)
{
    INFO(r.name() << " on " << r.device());
    static_cast<void>(take(r.load(s.view.get(), v.facts)));
    static_cast<void>(take(r.draw(v.camera)));
    const auto get = [&](scene_picture which) { return take(r.download(which)); };
    return { get(scene_picture::depth), get(scene_picture::position), get(scene_picture::normal),
             get(scene_picture::ids),   get(scene_picture::surface),  v.facts.frame ? get(scene_picture::frame) : ao::picture() };
}

void print_header()
{
    std::printf("%-10s %-10s %9s %9s %9s %8s %8s %11s %9s %9s %9s\n", "view", "pair", "ids", "crossings", "surfaces", "edge, px",
                "loose", "position", "of bound", "normal", "mapped");
}

void check_view(const std::vector<ao::host::scene_runner_ptr>& runners, const drawn_scene& s, const drawn_view& v)
{
    INFO(v.name);
    std::vector<drawn_pictures> drawn;
    for (const auto& r : runners) {
        drawn.push_back(draw(*r, s, v));
    }
    const lens l(v.camera, v.facts.width, v.facts.height, v.near);
    const std::vector<seen_triangle> triangles = seen_triangles(s.view.get(), l, v.facts.width, v.facts.height);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        for (std::size_t k = i + 1; k < drawn.size(); ++k) {
            const std::string pair = std::string(runners[i]->backend()) + ", " + std::string(runners[k]->backend());
            INFO(pair);
            const agreement g = explanation(s, v, l, triangles, drawn[i], drawn[k]).run();
            std::printf("%-10s %-10s %9zu %9zu %9zu %8.4f %8zu %11.3g %9.3f %9.2g %9.2g\n", v.name.c_str(), pair.c_str(),
                        g.other_ids, g.crossings, g.other_surfaces, g.edge_distance, g.loose, g.position, g.position_share,
                        g.normal, g.mapped_normal);
            std::fflush(stdout);
            CHECK(g.far_from_edges == 0);
            CHECK(static_cast<double>(g.other_ids) <= 1e-4 * static_cast<double>(g.pixels));
        }
    }
    if (!drawn.empty()) {
        check_shading(runners, s, v, drawn.front());
    }
}

} // namespace gbuffer_test
