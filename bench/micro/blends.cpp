// Trees of blends: time over the leaves that are not pruned, in one pass and as in the paper. Interleaved medians of one run, as
// Markdown; every picture is compared with the reference's before its clock starts.
#include "ao/conformance/shade_reference.hpp"
#include "micro/measure.hpp"
#include "micro/scene_runners.hpp"
#include "unit/blend_trees.hpp"

#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace ao;
using namespace ao::bench;
using blend_test::blends;

constexpr int width = 32;
constexpr int height = 18;
constexpr int rounds = 5;

// A tree in every pixel, its leaves lit by one lamp.
struct subject {
    blends tree;
    int registers;
};

struct pictures {
    gbuffer_facts facts;
    conformance::shade_inputs inputs;
};

pictures flat_wall()
{
    pictures p;
    p.facts.width = width;
    p.facts.height = height;
    p.facts.position = p.facts.ids = true;
    p.facts.normal_format = pixel_format::rgba32f;
    p.inputs.geometry = p.inputs.normal = picture(pixel_format::rgba32f, width, height);
    p.inputs.ids = picture(pixel_format::rg32ui, width, height);
    for (std::size_t i = 0; i < p.inputs.ids.pixels(); ++i) {
        p.inputs.geometry.set_texel(i, glm::vec4(0.1F, 0.2F, -5, 1));
        p.inputs.normal.set_texel(i, glm::vec4(0, 0, 1, 0));
        p.inputs.ids.set_texel(i, glm::uvec2(1, 0)); // object 0 with blend 0
    }
    return p;
}

shade_plan plan_of(const subject& s)
{
    std::vector<standard_material> materials = s.tree.materials;
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (standard_material& m : materials) {
        m.diffuse = { uniform(engine), uniform(engine), uniform(engine) };
    }
    const mesh none;
    object shown;
    shown.material = -1;
    light lamp;
    lamp.vector = { 0.3F, 0.2F, 1 };
    scene all = s.tree.scene();
    all.materials = materials;
    all.meshes = { &none, 1 };
    all.objects = { &shown, 1 };
    all.lights = { &lamp, 1 };
    all.ambient = ambient_light(glm::vec3(0.3F));
    shade_facts f;
    f.width = width;
    f.height = height;
    f.stored_position = true;
    f.normal_format = pixel_format::rgba32f;
    f.visibility = false;
    blend_settings settings;
    settings.registers = s.registers;
    return take(make_shade_plan(all, f, { make_projection({}), {} }, settings));
}

contestant shaded(std::string_view backend, const std::string& name, const subject& s)
{
    const pictures wall = flat_wall();
    const shade_plan plan = plan_of(s);
    const texel_heap heap = take(make_texel_heap({}));
    const std::shared_ptr<host::scene_runner> runner = scene_runner_of(backend);
    take(runner->make_targets(wall.facts));
    take(runner->upload(host::scene_picture::position, wall.inputs.geometry));
    take(runner->upload(host::scene_picture::normal, wall.inputs.normal));
    take(runner->upload(host::scene_picture::ids, wall.inputs.ids));
    take(runner->prepare_shading(plan, heap));
    take(runner->shade());
    // All pixels are alike: one is enough for the reference.
    shade_plan one = plan;
    one.facts.width = one.facts.height = 1;
    conformance::shade_inputs pixel = wall.inputs;
    for (picture* p : { &pixel.geometry, &pixel.normal, &pixel.ids }) {
        p->width = p->height = 1;
    }
    const picture expected = conformance::reference_color(one, heap, pixel);
    const picture drawn = take(runner->download(host::scene_picture::color));
    for (std::size_t i = 0; runner->exact() && i < drawn.pixels(); ++i) {
        if (drawn.texel<glm::vec4>(i) != expected.texel<glm::vec4>(0)) {
            stop(runner->name() + " blends to another color than the reference");
        }
    }
    return { name, [runner] { return take(runner->shade()); }, {} };
}

// The same tree with all but `live` of its leaves behind weights of 0.
blends pruned(blends tree, int live)
{
    std::vector<int> leaves(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        for (const int child : { tree.nodes[i].first, tree.nodes[i].second }) {
            leaves[i] += child >= 0 ? 1 : leaves[static_cast<std::size_t>(-1 - child)];
        }
        if (leaves[i] > live) {
            tree.nodes[i].k = 0;
        }
    }
    return tree;
}

void compare(std::string_view backend)
{
    struct form {
        const char* name;
        bool chain;
        int registers;
    };
    const std::vector<form> forms{ { "balanced, one pass", false, 16 },
                                   { "chain, one pass", true, 16 },
                                   { "balanced, a picture per leaf", false, 1 },
                                   { "chain, a picture per leaf", true, 1 } };
    const std::vector<int> counts{ 64, 256, 1024, 4096 };
    const auto tree_of = [](const form& f, int leaves) {
        return f.chain ? blend_test::chain(leaves - 1, true) : blend_test::balanced_tree(leaves);
    };
    std::vector<contestant> field;
    for (const form& f : forms) {
        for (const int leaves : counts) {
            field.push_back(shaded(backend, f.name, { tree_of(f, leaves), f.registers }));
        }
    }
    field.push_back(shaded(backend, "64 of 4096", { pruned(blend_test::balanced_tree(4096), 64), 16 }));
    measure(field, rounds);
    std::printf("## Trees of blends, %s at %dx%d, ms\n\n| leaves | 64 | 256 | 1024 | 4096 | us a leaf | leaves a line by |\n"
                "|---|---|---|---|---|---|---|\n",
                std::string(backend).c_str(), width, height);
    const std::vector<double> x(counts.begin(), counts.end());
    for (std::size_t i = 0; i < forms.size(); ++i) {
        std::vector<double> y;
        std::printf("| %s |", forms[i].name);
        for (std::size_t j = 0; j < counts.size(); ++j) {
            y.push_back(field[i * counts.size() + j].median());
            std::printf(" %.2f |", y.back());
        }
        const line l = fit(x, y);
        std::printf(" %.2f | %.1f %% |\n", l.slope * 1000, l.bend * 100);
    }
    std::printf("\nWith all but 64 of 4096 leaves pruned: %.2f ms, %.2f times a tree of 64.\n\n", field.back().median(),
                field.back().median() / field[0].median());
    std::fflush(stdout);
}

} // namespace

// Takes and ignores Google Benchmark's options, which ./run bench gives to every program.
int main()
{
    for (const std::string& backend : names_of_scene_runners()) {
        compare(backend);
    }
}
