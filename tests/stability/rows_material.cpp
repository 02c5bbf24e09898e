// 4.10: materials and blends, and poison in what shading reads.
#include "stability/figure.hpp"
#include "stability/row.hpp"

#include "ao/blend.hpp"
#include "ao/color.hpp"
#include "unit/deep_blends.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace stability {

namespace {

using ids = ao::conformance::evaluator<float>;

void mark_faulty(subject& s)
{
    s.faulty = true;
}

struct mixes {
    std::vector<glm::vec4> first; // w: the weight
    std::vector<glm::vec4> second;
};

mixes make_mixes(const std::vector<float>& weights)
{
    mixes m;
    ao::random_stream random(2);
    for (int i = 0; i < 4000; ++i) {
        const auto color = [&] { return glm::vec3(random.uniform(), random.uniform() * 1e-3F, random.uniform() * 1e4F); };
        const glm::vec3 a = color();
        m.first.emplace_back(a, weights[static_cast<std::size_t>(i) % weights.size()]);
        m.second.emplace_back(color(), 0.0F);
    }
    return m;
}

// How far blends leave the range of their children, over its width; weights beyond [0, 1] and NaN among them.
double convex(subject& s)
{
    const float nan = std::nanf("");
    const mixes m = make_mixes({ 0.0F, 0.3F, 1.0F, -0.5F, 1.5F, nan, 1e30F, -1e30F, 0.999F });
    const auto made = s.evaluate(ids::ao_of_blend, m.first, m.second);
    worst w;
    for (std::size_t i = 0; i < made.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const auto a = static_cast<double>(m.first[i][k]);
            const auto b = static_cast<double>(m.second[i][k]);
            const auto x = static_cast<double>(made[i][k]);
            const double over = std::max(std::min(a, b) - x, x - std::max(a, b)) / std::max(a, b);
            w.add(std::isnan(over) ? endless : std::max(over, 0.0));
        }
    }
    return w.value();
}

void lerp(subject& s)
{
    s.evaluate_instead = [](int, auto a, auto b, auto out) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = a[i] + (b[i] - a[i]) * a[i].w; // x + b (y - x)
        }
    };
}

// Components that are not their child's bits at weights 0 and 1.
double ends(subject& s)
{
    const mixes m = make_mixes({ 0.0F, 1.0F });
    const auto made = s.evaluate(ids::ao_of_blend, m.first, m.second);
    double wrong = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const float expected = i % 2 == 0 ? m.first[i][k] : m.second[i][k];
            wrong += std::bit_cast<std::uint32_t>(made[i][k]) == std::bit_cast<std::uint32_t>(expected) ? 0 : 1;
        }
    }
    return wrong;
}

// Codes that do not come back from linear light, and black and white at 1/2 off 188.
double srgb(subject& s)
{
    std::vector<glm::vec4> linear;
    for (const float x : ao::srgb_table) {
        linear.emplace_back(x, 0.0F, 0.0F, 0.0F);
    }
    linear.emplace_back(0.5F, 0.0F, 0.0F, 0.0F);
    const auto codes = s.evaluate(ids::ao_of_srgb, linear, linear);
    double wrong = 0;
    for (std::size_t i = 0; i < 256; ++i) {
        wrong += codes[i].y == static_cast<float>(i) ? 0 : 1;
    }
    return wrong + std::abs(static_cast<double>(codes[256].y) - 188);
}

void gamma(subject& s)
{
    s.evaluate_instead = [](int, auto a, auto, auto out) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = glm::vec4(0.0F, std::floor(std::pow(a[i].x, 1 / 2.2F) * 255 + 0.5F), 0.0F, 0.0F);
        }
    };
}

// A row of pixels shaded by the subject; empty where it refuses.
std::vector<glm::vec4> shade(subject& s, ao::scene from, const shade_test::pixel_row& row,
                             const ao::conformance::shade_inputs& in, const ao::blend_settings& settings = {})
{
    const std::vector<ao::object> objects = row.objects();
    const ao::mesh none;
    from.meshes = { &none, 1 };
    from.objects = objects;
    const ao::shade_facts facts = row.facts();
    const auto plan = ao::make_shade_plan(from, facts, shade_test::camera(false), settings);
    const auto heap = ao::make_texel_heap(from.textures);
    ao::gbuffer_facts g;
    g.width = facts.width;
    g.height = facts.height;
    g.position = g.ids = g.surface = g.frame = true;
    g.normal_format = facts.normal_format;
    ao::host::scene_runner& r = *s.scene();
    using ao::host::scene_picture;
    if (!plan || !heap || !r.make_targets(g) || !r.upload(scene_picture::position, in.geometry) ||
        !r.upload(scene_picture::normal, in.normal) || !r.upload(scene_picture::ids, in.ids) ||
        !r.upload(scene_picture::surface, in.surface) || !r.upload(scene_picture::frame, in.frame) ||
        !r.prepare_shading(*plan, *heap) || !r.upload(scene_picture::visibility, in.visibility) || !r.shade()) {
        return {};
    }
    const auto color = r.download(scene_picture::color);
    std::vector<glm::vec4> all;
    for (std::size_t i = 0; color && i < color->pixels(); ++i) {
        all.push_back(ao::conformance::decode_texel<float>(*color, i));
    }
    return all;
}

// Chains to either side and a balanced tree: error against double, over the depth; faulty: leaves in 8 bits, as the paper's
// targets hold them.
double deep_trees(subject& s)
{
    worst w;
    for (blend_test::blends tree : { blend_test::chain(s.thorough ? 1024 : 40, true), blend_test::chain(24, false),
                                     blend_test::balanced_tree(s.thorough ? 1024 : 32), blend_test::chain(1, true) }) {
        ao::random_stream random(5);
        std::vector<glm::dvec3> leaves;
        for (ao::standard_material& m : tree.materials) {
            m.ambient = glm::vec3(0.0F);
            m.emission = { random.uniform(), random.uniform(), random.uniform() };
            leaves.emplace_back(m.emission);
            for (int k = 0; k < 3 && s.faulty; ++k) {
                m.emission[k] = std::round(m.emission[k] * 255) / 255;
            }
        }
        const shade_test::pixel_row row{ { -1, -1 }, {} };
        const auto seen = shade(s, tree.scene(), row, row.inputs());
        const glm::dvec3 exact = blend_test::truth(tree.nodes, leaves)[0];
        w.add(seen.empty() ? endless : 0);
        for (const glm::vec4& c : seen) {
            for (int k = 0; k < 3; ++k) {
                w.add(std::abs(static_cast<double>(c[k]) - exact[k]) / blend_test::depth_of(tree.nodes));
            }
        }
    }
    return w.value();
}

// Results held at a time over floor(log2 n) + 1, and over 2 in chains; faulty: the children in the order they are written.
double temporaries(subject& s)
{
    worst w;
    const auto naive = [](const blend_test::blends& tree) {
        std::vector<int> need(tree.nodes.size());
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {
            const auto of = [&](int c) { return c >= 0 ? 1 : need[static_cast<std::size_t>(-1 - c)]; };
            need[i] = std::max(of(tree.nodes[i].first), of(tree.nodes[i].second) + 1);
        }
        return need[0];
    };
    for (const int leaves : { 2, 3, 8, 100, 4096 }) {
        const double most = std::floor(std::log2(leaves)) + 1;
        for (const blend_test::blends& tree :
             { blend_test::balanced_tree(leaves), blend_test::chain(leaves - 1, true), blend_test::chain(leaves - 1, false) }) {
            ao::scene from = tree.scene();
            auto planner = ao::blend_planner::create(from);
            w.add(!planner ? endless : (s.faulty ? naive(tree) : planner->program(0).label) / most);
        }
    }
    return w.value();
}

// Blends of nothing but white, minus white, over the blends in a row.
double white_trees(subject& s)
{
    worst w;
    for (blend_test::blends tree : { blend_test::chain(40, true), blend_test::balanced_tree(32) }) {
        for (ao::standard_material& m : tree.materials) {
            m.ambient = glm::vec3(0.0F);
            m.emission = glm::vec3(s.faulty ? 0.999F : 1.0F);
        }
        const shade_test::pixel_row row{ { -1 }, {} };
        const auto seen = shade(s, tree.scene(), row, row.inputs());
        w.add(seen.empty() ? endless : std::abs(static_cast<double>(seen[0].x) - 1) / blend_test::depth_of(tree.nodes));
    }
    return w.value();
}

// Blends evaluated over the nodes that there are, where each of 30 nodes blends the next with itself.
double shared_nodes(subject& s)
{
    const blend_test::blends tree = blend_test::self_shared(30);
    auto planner = ao::blend_planner::create(tree.scene());
    const double evaluated = s.faulty ? std::pow(2.0, 31) : planner ? planner->program(0).mixes : endless;
    return evaluated / static_cast<double>(tree.nodes.size());
}

// Colors that are not finite where positions, normals, surface, frame and visibility are poisoned; faulty: an infinite emission.
double poisoned_targets(subject& s)
{
    shade_test::pixel_row row;
    const std::size_t count = s.thorough ? 16384 : 1024;
    row.materials.assign(count, 0);
    std::vector<ao::standard_material> materials(1);
    materials[0].specular = glm::vec3(0.5F);
    materials[0].emission = glm::vec3(s.faulty ? std::numeric_limits<float>::infinity() : 0.1F);
    std::array<ao::light, 2> lights;
    lights[1].type = ao::light_type::point;
    lights[1].vector = { 0, 2, -3 };
    ao::scene from;
    from.materials = materials;
    from.lights = lights;
    from.ambient = ao::ambient_light(glm::vec3(0.4F));
    auto in = row.inputs();
    ao::conformance::poison(in.normal, 3);
    ao::conformance::poison(in.surface, 4);
    ao::conformance::poison(in.frame, 5);
    ao::conformance::poison(in.visibility, 6);
    const auto seen = shade(s, from, row, in);
    double bad = seen.empty() ? endless : 0;
    for (const glm::vec4& c : seen) {
        bad += std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && c.x >= 0 && c.y >= 0 && c.z >= 0 ? 0 : 1;
    }
    return bad;
}

// What visibility takes from direct light: the greatest difference between colors at visibility 0 and near 1, no ambient light;
// faulty: with some.
double direct_light(subject& s)
{
    shade_test::pixel_row row;
    row.materials.assign(64, 0);
    const std::vector<ao::standard_material> materials(1);
    std::array<ao::light, 1> lights;
    lights[0].vector = { 0.3F, 0.2F, 1 };
    ao::scene from;
    from.materials = materials;
    from.lights = lights;
    from.ambient = ao::ambient_light(glm::vec3(s.faulty ? 0.4F : 0.0F));
    const auto seen = shade(s, from, row, row.inputs());
    worst w;
    w.add(seen.empty() || !(seen[0].x > 0) ? endless : 0);
    for (const glm::vec4& c : seen) {
        w.add(std::abs(static_cast<double>(c.x) - static_cast<double>(seen[0].x)));
    }
    return w.value();
}

} // namespace

std::vector<row> material_rows()
{
    return {
        { "M1", "blends beyond the range of their children, over its top; weights -1e30 to 1e30 and NaN", 1.2e-7, false,
          "clamped; two roundings", domain::passes, convex, "x + b (y - x), weight as it is", lerp },
        { "M2", "components that are not their child's bits at weights 0 and 1", 0, false, "exact", domain::passes, ends,
          "x + b (y - x)", lerp },
        { "M3", "sRGB codes that do not come back, and black and white at 1/2 off code 188", 0, false, "numerics.md M3",
          domain::passes, srgb, "gamma 2.2", gamma },
        { "M4", "error of deep trees against double, per blend in a row", 1e-6, false, "docs/numerics.md", domain::scene,
          deep_trees, "leaves in 8 bits", mark_faulty },
        { "M4t", "results held at a time over floor(log2 n) + 1, trees of 2 to 4096 leaves", 1, false, "Sethi and Ullman 1970",
          domain::core, temporaries, "children in the order they are written", mark_faulty },
        { "M5", "blends of white minus white, per blend in a row", 1.2e-7, false, "one unit in the last place a blend",
          domain::scene, white_trees, "leaves of 0.999", mark_faulty },
        { "M6", "blends evaluated over nodes, each of 30 used twice", 1, false, "each once", domain::core, shared_nodes,
          "as a tree: 2^31", mark_faulty },
        { "P1s", "colors that are negative or not finite where normals, surface, frame and visibility are poisoned", 0, false,
          "numerics.md P1", domain::scene, poisoned_targets, "an infinite emission", mark_faulty },
        { "7.35", "what visibility takes from direct light", 0, false, "it scales the ambient term only", domain::scene,
          direct_light, "ambient light as well", mark_faulty },
    };
}

} // namespace stability
